"""Formulas that judge the solver: one exact solution a file, for the scene of the same name.

A module, found by listing this folder, has one of

solution(point, x, time) -> Profiles
    Return the profiles h2 and eta (m), each (n), at the places ``x`` (m), a number or an array (n), and the ``time``
    (s) since release; NaN where no exact solution is known.
stays(point) -> bool
    Return whether the grains must not move at all.

and, only where it needs them,

amplitude(point, time) -> float
    Return the amplitude over H2 of a small wave, which errors are relative to.
edge_known(point, time) -> bool
edge_position(point, time) -> float
    Return whether it is known where the grains end at the time (s), and that place (m).

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
    """Return places and a time in scaled variables.

    Parameters
    ----------
    point
        The run's.
    x
        Places (m), a number or an array (n).
    time
        Time (s) since release.

    Returns
    -------
    tuple
        Places over R, as an array, and time over `Point.time_scale`.
    """
    return np.asarray(x, float) / point.radius, time / point.time_scale


def in_metres(point: Point, h2: float | np.ndarray, eta: float | np.ndarray) -> Profiles:
    """Return the profiles of scaled h2 and eta in m.

    Parameters
    ----------
    point
        The run's.
    h2, eta
        Depth of the grains and displacement of the surface over H2, each (n).

    Returns
    -------
    Profiles
        Both in m, by name.
    """
    return {"h2": np.asarray(h2) * point.column_height, "eta": np.asarray(eta) * point.column_height}


def frictionless(point: Point) -> bool:
    """Return whether no friction law acts on the grains."""
    return point.friction == "coulomb" and point.delta == 0
