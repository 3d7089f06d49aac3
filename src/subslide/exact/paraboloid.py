"""A round paraboloid of grains alone that spreads without friction (numerically, the radial dry dam break).

Thacker (1981, J. Fluid Mech. 107, 499) gives the family of such solutions, in a basin; this one has a flat bed.
"""

import numpy as np

from subslide.exact import Profiles, frictionless, in_metres, scaled
from subslide.points import Point
from subslide.scenes import paraboloid


def radius(t: float | np.ndarray) -> float | np.ndarray:
    """Return R(t) = sqrt(1 + 2 t^2), where the depth ends."""
    return np.sqrt(1.0 + 2 * t**2)


def depth(x: float | np.ndarray, t: float) -> np.ndarray:
    """Return h = (1 - x^2/R^2) / R^2, 0 beyond R; it solves the shallow-water equations with u = x R'/R."""
    return paraboloid.depth(x, radius(t))


def ring_mean(edges: np.ndarray, t: float) -> np.ndarray:
    """Return the mean depth (n) of the rings between the radii `edges` (n + 1)."""
    return paraboloid.ring_mean(edges, radius(t))


def solution(point: Point, x: float | np.ndarray, time: float) -> Profiles:
    """Return h2 and eta (m) at x (m); known without friction and where no water weighs on the grains (r = 0)."""
    s, t = scaled(point, x, time)
    nothing = np.full(s.shape, np.nan)
    known = frictionless(point) and point.r == 0
    return in_metres(point, depth(s, t) if known else nothing, nothing)
