"""Formulas that judge the solver: one exact solution a file, for the scene of the same name.

`solution(point, x, time)` returns profiles {"h2": m, "eta": m} at the places x (m) and the time (s), NaN where no
exact solution is known; or `stays(point)` returns whether the grains must not move at all. Functions beside it are in
scaled variables unless they take g: lengths over R, depths over H2, speeds over sqrt(g H2).
"""

import math
from importlib import import_module
from pathlib import Path

import numpy as np

NAMES = tuple(sorted(path.stem for path in Path(__file__).parent.glob("[a-z]*.py")))
"""Scenes with an exact solution."""


def load(name):
    """Return the exact solution of the scene of that name."""
    return import_module(f"{__name__}.{name}")


def scaled(point, x, time):
    """Return x (m) and time (s) in scaled variables."""
    return np.asarray(x, float) / point.radius, time / math.sqrt(point.radius / (point.g * point.a_2))


def in_metres(point, h2, eta):
    """Return the profiles of scaled h2 and eta in m."""
    height = point.a_2 * point.radius
    return {"h2": h2 * height, "eta": eta * height}


def half_box(point):
    """Return the scaled half-width of the smallest box."""
    return -(-point.cells // 2) * (0.6 / point.cells / 0.0705)


def frictionless(point):
    """Return whether no friction law acts on the grains."""
    return point.friction == "coulomb" and point.delta == 0


def friction_number(point):
    """Return the scaled deceleration by friction of grains alone, tan(delta) / a_2."""
    return math.tan(math.radians(point.delta)) / point.a_2
