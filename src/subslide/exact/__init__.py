"""Formulas that judge the solver: one exact solution a file, for the scene of the same name.

`solution(point, x, time)` returns profiles {"h2": m, "eta": m} at the places x (m) and the time (s), NaN where no
exact solution is known; or `stays(point)` returns whether the grains must not move at all. Functions beside it are in
scaled variables unless they take g: lengths over R, depths over H2, speeds over sqrt(g H2).
"""

from importlib import import_module

import numpy as np

from subslide import catalogue

NAMES = tuple(catalogue.names("exact"))
"""Scenes with an exact solution."""


def load(name):
    """Return the exact solution of the scene of that name."""
    return import_module(f"{__name__}.{name}")


def scaled(point, x, time):
    """Return x (m) and time (s) in scaled variables."""
    return np.asarray(x, float) / point.radius, time / point.time_scale


def in_metres(point, h2, eta):
    """Return the profiles of scaled h2 and eta in m."""
    return {"h2": h2 * point.column_height, "eta": eta * point.column_height}


def frictionless(point):
    """Return whether no friction law acts on the grains."""
    return point.friction == "coulomb" and point.delta == 0
