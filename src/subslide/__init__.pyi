# What type checkers and editors see: names that __init__.py imports when they are asked for.
from subslide._sources import SNAKEFILE as SNAKEFILE
from subslide._sources import source_hash as source_hash
from subslide.emulator import Emulator as Emulator
from subslide.keys.schema import ConfigError as ConfigError
from subslide.library import BatchError as BatchError
from subslide.library import Caution as Caution
from subslide.library import Study as Study
from subslide.library import solve as solve
from subslide.library import sweep as sweep
from subslide.results.dataset import open_study as open_study

__version__: str
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
