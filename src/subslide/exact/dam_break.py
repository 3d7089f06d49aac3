"""The dam break: a layer at rest that is deeper on the left of x = 0 is let go.

Without friction: Ritter (1892, Z. Ver. Dtsch. Ing. 36, 947) on a dry bed; Stoker (1957, Water Waves, section 10.8) on a
wet one. With Coulomb friction on a dry bed only the edge is exact (Mangeney, Heinrich and Roche 2000, Pure Appl.
Geophys. 157, 1081): grains that have not begun to move feel no friction, so the profile is not Ritter's, shifted.
"""

import math

import numpy as np

from subslide.exact import Profiles, frictionless, in_metres, scaled
from subslide.points import Point
from subslide.scenes import options
from subslide.scenes.dam_break import step


def middle(left: float, right: float, g: float = 1.0) -> tuple[float, float, float]:
    """Return depth, speed and shock speed between the rarefaction and the shock (0 < right <= left).

    The middle depth h solves u = 2 (sqrt(g left) - sqrt(g h)) = (h - right) sqrt(g (1/h + 1/right) / 2), by bisection.
    """
    low, high = right, left
    for _ in range(200):
        h = 0.5 * (low + high)
        excess = (h - right) * math.sqrt(0.5 * g * (1 / h + 1 / right)) - 2 * (
            math.sqrt(g * left) - math.sqrt(g * h)
        )
        low, high = (low, h) if excess > 0 else (h, high)
    u = 2 * (math.sqrt(g * left) - math.sqrt(g * h))
    return h, u, h * u / (h - right) if h > right else math.sqrt(g * h)


def depth(
    x: float | np.ndarray, t: float, left: float = 1.0, right: float = 0.0, g: float = 1.0
) -> np.ndarray:
    """Return the depth at x and t of a dam that parts depths left and right, without friction."""
    x = np.asarray(x, float)
    if t <= 0:
        return step(x, left, right)
    c = math.sqrt(g * left)
    fan = (2 * c - np.clip(x / t, -c, 2 * c)) ** 2 / (9 * g)
    if right == 0:
        return fan
    h, u, shock = middle(left, right, g)
    return np.where(x < (u - math.sqrt(g * h)) * t, fan, np.where(x < shock * t, h, right))


def edge(t: float | np.ndarray, friction: float, h0: float = 1.0) -> float | np.ndarray:
    """Return where the depth ends on a dry bed: 2 c0 t - friction t^2 / 2, at rest at 2 h0 / friction.

    friction: deceleration by Coulomb friction, mu g or scaled (g = 1); 0 without.
    """
    c = math.sqrt(h0)
    stop = 2 * c / friction if friction > 0 else math.inf
    t = np.minimum(t, stop)
    return 2 * c * t - 0.5 * friction * t**2


def edge_position(point: Point, time: float) -> float:
    """Return where the grains of a dry dam break end (m) at the time (s), were the depth traced to 0; grains alone."""
    _, t = scaled(point, 0.0, time)
    return edge(t, point.friction_number) * point.radius


def edge_known(point: Point, time: float) -> bool:
    """Return whether `edge_position` holds at the time (s): grains at r = 0 on a dry bed, within the box."""
    chosen = options(point)
    lone = (
        chosen["layer"] == "grains"
        and chosen["downstream"] == 0
        and point.r == 0
        and point.friction == "coulomb"
    )
    return lone and edge_position(point, time) < point.half_box * point.radius


def solution(point: Point, x: float | np.ndarray, time: float) -> Profiles:
    """Return h2 and eta (m) at x (m): of water alone; of grains at r = 0 without friction, whose water is not known.

    Known until a wave reaches the end of the box.
    """
    chosen = options(point)
    layer, downstream = chosen["layer"], chosen["downstream"]
    s, t = scaled(point, x, time)
    nothing = np.full(s.shape, np.nan)
    left = 1.0 if layer == "grains" else point.scaled_level
    right = downstream * left
    fastest = 2 * math.sqrt(left) if right == 0 else max(middle(left, right)[2], math.sqrt(left))
    if fastest * t > point.half_box:
        return in_metres(point, nothing, nothing)
    h = depth(s, t, left, right)
    if layer == "water":
        return in_metres(point, np.zeros(s.shape), h - left)
    return in_metres(point, h if point.r == 0 and frictionless(point) else nothing, nothing)
