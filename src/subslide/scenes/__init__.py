"""Scenes: initial states, one file each, scaled (depths by H2, lengths by R, speeds by sqrt(g H2)).

A scene module has `SYMMETRY` ("round", "quarter", "line" or "none": which models are exact for it) and
`initial(grid, point)`, which returns a `State`.
"""

from importlib import import_module
from pathlib import Path
from typing import NamedTuple

import numpy as np

NAMES = tuple(sorted(path.stem for path in Path(__file__).parent.glob("[a-z]*.py")))


class State(NamedTuple):
    """An initial state: each a scalar or an array of the grid's shape (y first)."""

    h1: np.ndarray
    h2: np.ndarray
    u1: np.ndarray | float = 0.0
    v1: np.ndarray | float = 0.0
    u2: np.ndarray | float = 0.0
    v2: np.ndarray | float = 0.0


def load(name):
    """Return the scene module of that name."""
    return import_module(f"{__name__}.{name}")


def level_off(h2, level):
    """Return (h1, h2) whose sum is `level` to the bit in the precision of `h2`."""
    h1 = level - h2
    return h1, level - h1


def still_water(h2, level):
    """Return the state at rest of grains `h2` under a flat surface at `level`."""
    return State(*level_off(h2, level))
