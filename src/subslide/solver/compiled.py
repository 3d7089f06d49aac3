"""Loops over a run's samples, compiled like kernels, which their files are not among."""

import functools
import hashlib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from subslide.kernels.jit import driver

FEW = 10_000
"""Samples that a function takes as Python in the time, some 8 ms, in which its compiled code is loaded."""


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


def sparing(function: Callable) -> Any:
    """Return a function that is compiled once it has been given more than FEW samples: one run does without.

    Parameters
    ----------
    function
        As for `compiled`; its first argument has the samples, and it returns a number or a tuple of them.

    Returns
    -------
    callable
        The same, to the bit; its attribute `compiled` returns the one that is compiled.
    """
    taken = 0
    load = functools.cache(lambda: compiled(function))

    @functools.wraps(function)
    def either(samples: np.ndarray, *others: Any) -> Any:
        nonlocal taken
        taken += len(samples)
        if taken > FEW:
            return load()(samples, *others)
        with np.errstate(all="ignore"):
            answer = function(samples, *others)
        return tuple(map(float, answer)) if isinstance(answer, tuple) else float(answer)

    either.compiled = load  # type: ignore[attr-defined]
    return either
