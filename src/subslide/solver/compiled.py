"""Loops over a run's samples, compiled like kernels, which their files are not among."""

import hashlib
from collections.abc import Callable
from pathlib import Path
from typing import Any

from subslide.kernels.jit import driver


def compiled(function: Callable) -> Any:
    """Return a function compiled and kept: its name states its file, which the folder of kernels does not.

    Parameters
    ----------
    function
        A function of arrays and numbers that calls none of other files.

    Returns
    -------
    callable
        The same, compiled at its first call in a process, or loaded.
    """
    sources = hashlib.sha256(Path(function.__code__.co_filename).read_bytes()).hexdigest()[:12]
    function.__qualname__ = f"{function.__name__}_{sources}"
    return driver(function)
