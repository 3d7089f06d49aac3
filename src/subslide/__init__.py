"""Collapse of submerged granular columns: a two-layer Coulomb model, its sweeps, tables and figures.

Importing the package sets numba's cache folder, so it must come before any kernel is made and stay light.
"""

from subslide import _early  # noqa: F401 - the first, since it hears signals while the others load
from subslide._cache import set_cache_folder
from subslide._sources import source_hash

__version__ = "0.1.0"
__all__ = ["__version__", "source_hash"]

set_cache_folder()
