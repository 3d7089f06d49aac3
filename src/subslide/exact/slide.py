"""A uniform layer of grains that slides on a flat bed and is slowed by friction alone.

Nothing varies along the bed, so that the water above neither pushes nor drags: du/dt = -(1-r) mu g for Coulomb's law,
and -(1-r) mu g - g u^2 / (xi h2) for Voellmy's (Voellmy 1955, Schweiz. Bauztg. 73).
"""

import math

import numpy as np

from subslide.exact import Profiles, in_metres, scaled
from subslide.points import Point
from subslide.scenes import options


def speed(t: float | np.ndarray, start: float, friction: float, turbulence: float = 0.0) -> np.ndarray:
    """Return u at t of du/dt = -friction - turbulence u^2 from u = start until it is 0."""
    t = np.asarray(t, float)
    if turbulence == 0:
        return np.maximum(0.0, start - friction * t)
    if friction == 0:
        return start / (1 + turbulence * start * t)
    fall = math.sqrt(friction / turbulence)
    return fall * np.tan(np.maximum(0.0, math.atan(start / fall) - math.sqrt(friction * turbulence) * t))


def speed_of(point: Point, time: float | np.ndarray) -> np.ndarray:
    """Return the speed (m/s) of the layer of a point at the time (s); NaN for a law without a formula."""
    if point.friction not in ("coulomb", "voellmy"):
        return np.full(np.shape(time), np.nan)
    t = np.asarray(time) / point.time_scale
    turbulence = point.turbulence if point.friction == "voellmy" else 0.0
    start = options(point)["speed"]
    u = speed(t, start, (1 - point.r) * point.friction_number, turbulence)
    return u * point.speed_scale


def solution(point: Point, x: float | np.ndarray, time: float) -> Profiles:
    """Return h2 and eta (m) at x (m): both stay as they are until a wave comes from an end of the box."""
    s, t = scaled(point, x, time)
    start = options(point)["speed"]
    fastest = start + math.sqrt(
        point.scaled_level
    )  # also of the shock from the wall that the layer runs into
    reached = np.abs(s) > point.half_box - fastest * t
    return in_metres(point, np.where(reached, np.nan, 1.0), np.where(reached, np.nan, 0.0))
