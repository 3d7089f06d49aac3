"""Collapse of submerged granular columns: a two-layer Coulomb model, its sweeps, tables and figures.

Importing the package sets numba's cache folder, so it must come before any kernel is made and stay light.
"""

import importlib
from typing import Any

from subslide import _early  # noqa: F401 - the first, since it hears signals while the others load
from subslide._cache import set_cache_folder
from subslide._sources import SNAKEFILE, source_hash

__version__ = "0.1.0"
__all__ = [
    "SNAKEFILE",
    "BatchError",
    "Caution",
    "ConfigError",
    "Emulator",
    "Study",
    "__version__",
    "open_study",
    "solve",
    "source_hash",
    "sweep",
]
LAZY = {
    "ConfigError": "subslide.keys.schema",
    "Emulator": "subslide.emulator",
    "open_study": "subslide.results.dataset",
    **dict.fromkeys(("BatchError", "Caution", "Study", "solve", "sweep"), "subslide.library"),
}
"""Modules of what is imported when it is asked for."""

set_cache_folder()


def __getattr__(name: str) -> Any:
    """Return what `LAZY` names."""
    if name in LAZY:
        return getattr(importlib.import_module(LAZY[name]), name)
    raise AttributeError(f"module 'subslide' has no attribute {name!r}")
