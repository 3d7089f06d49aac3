"""Formulas that judge the solver: one exact solution a file, for the scene of the same name.

A module, found by listing this folder, has one of

``solution(point, x, time) -> Profiles``
    Profiles h2 and eta (m) at the places x (m) and the time (s), NaN where no exact solution is known.
``stays(point) -> bool``
    Whether the grains must not move at all.

Functions beside it are in scaled variables unless they take g: lengths over R, depths over H2, speeds over sqrt(g H2).
Formulas that the initial state needs too stand in the scene's own module.
"""

from importlib import import_module
from types import ModuleType

import numpy as np

from subslide import catalogue
from subslide.points import Point

Profiles = dict[str, np.ndarray]
"""Depth h2 and displacement eta of the surface (m), each (n), by name."""

NAMES = tuple(catalogue.names("exact"))
"""Scenes with an exact solution."""


def load(name: str) -> ModuleType:
    """Return the exact solution of the scene of that name."""
    return import_module(f"{__name__}.{name}")


def scaled(point: Point, x: float | np.ndarray, time: float) -> tuple[np.ndarray, float]:
    """Return x (m) and time (s) in scaled variables."""
    return np.asarray(x, float) / point.radius, time / point.time_scale


def in_metres(point: Point, h2: float | np.ndarray, eta: float | np.ndarray) -> Profiles:
    """Return the profiles of scaled h2 and eta in m."""
    return {"h2": np.asarray(h2) * point.column_height, "eta": np.asarray(eta) * point.column_height}


def frictionless(point: Point) -> bool:
    """Return whether no friction law acts on the grains."""
    return point.friction == "coulomb" and point.delta == 0
