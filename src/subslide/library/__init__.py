"""The library: what a program, a notebook or a shell of Python calls."""

from subslide.library.given import Caution
from subslide.library.one_run import solve

__all__ = ["Caution", "solve"]
