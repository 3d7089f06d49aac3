"""The library: what a program, a notebook or a shell of Python calls."""

from subslide.library.given import Caution
from subslide.library.one_run import solve
from subslide.library.processes import BatchError
from subslide.library.studies import Study, sweep

__all__ = ["BatchError", "Caution", "Study", "solve", "sweep"]
