"""A dam of grains that breaks onto a dry bed under still water which pulls on it: r > 0, no friction.

The answer depends on x / t alone. From the left: an outer wave, which is weak; the fan of the inner wave, in which the
depth of grains falls to 0; the outer wave of the water alone. Along a simple wave of speed s the state follows the
right eigenvector of the matrix of Eq. (2) at s; where the fan ends, the water must be on the wave that comes from the
right, u1 = 2 (sqrt(h1) - sqrt(1 + a_H)), which sets the strength of the first wave. Where an outer wave is a shock, it
stands at the mean of the speeds beside it: that errs by the cube of its strength, as taking it for a simple wave does.

Known from a_H = 2 on. In shallower water the speed does not grow all along the fan, which becomes a compound wave.
"""

import functools
import itertools
import math
from typing import NamedTuple

import numpy as np

from subslide.exact import Profiles, frictionless, in_metres, scaled
from subslide.points import Point
from subslide.scenes import defaults, options

SHALLOWEST = 2.0
"""Least a_H for which the solution is of this form at any r."""
LAST = 1e-3
"""Root of the depth of grains at which the fan is cut and its tip extrapolated: speed is linear in that root there."""
OUTER, INNER = 0, 1
"""Places of the two waves to the left among the four, the slowest first."""
STEPS = 200


class Fan(NamedTuple):
    """The solution at places x / t that do not fall: both depths, each (n); beyond the first and the last at rest."""

    place: np.ndarray
    h1: np.ndarray
    h2: np.ndarray


def speeds(state: np.ndarray, r: float) -> np.ndarray:
    """Return the four wave speeds (4) of (h1, u1, h2, u2), the slowest first."""
    h1, u1, h2, u2 = state
    matrix = np.array([[u1, h1, 0, 0], [1, u1, 1, 0], [0, 0, u2, h2], [r, 0, 1, u2]])
    return np.sort(np.linalg.eigvals(matrix).real)


def along(state: np.ndarray, r: float, wave: int) -> np.ndarray:
    """Return the right eigenvector (4) of a wave, changes of (h1, u1, h2, u2) for a change of 1 in h1."""
    h1, u1, _, u2 = state
    speed = speeds(state, r)[wave]
    a = u1 - speed
    rise = a * a / h1 - 1
    return np.array([1.0, -a / h1, rise, -(r + rise) / (u2 - speed)])


def outer_wave(left: np.ndarray, r: float, fall: float) -> np.ndarray:
    """Return the state (4) behind the first wave, across which h1 falls by `fall`, little (midpoint rule)."""
    middle = left - 0.5 * fall * along(left, r, OUTER)
    return left - fall * along(middle, r, OUTER)


def inner_fan(state: np.ndarray, r: float) -> tuple[np.ndarray, np.ndarray]:
    """Return states (n, 4) and speeds (n) along the inner wave, from a state to the depth LAST^2 of grains.

    In the root w of the depth the equation is regular up to the tip: dW/dw = 2 w e / e_h2 (Runge-Kutta, fourth order).
    """

    def rate(w: float, at: np.ndarray) -> np.ndarray:
        vector = along(np.array([at[0], at[1], w * w, at[3]]), r, INNER)
        return 2 * w * vector / vector[2]

    roots = np.linspace(math.sqrt(state[2]), LAST, STEPS + 1)
    states = [state]
    for w, after in itertools.pairwise(roots):
        d, at = after - w, states[-1]
        k1 = rate(w, at)
        k2 = rate(w + d / 2, at + d / 2 * k1)
        k3 = rate(w + d / 2, at + d / 2 * k2)
        k4 = rate(after, at + d * k3)
        states.append(at + d / 6 * (k1 + 2 * k2 + 2 * k3 + k4))
    return np.array(states), np.array([speeds(at, r)[INNER] for at in states])


def tip(values: np.ndarray) -> np.ndarray:
    """Return what values (n, ...) along the fan are where the grains end, linear in the root of their depth."""
    step = (1 - LAST) / STEPS
    return values[-1] + (values[-1] - values[-2]) * LAST / step


@functools.lru_cache(64)
def fan(a_H: float, r: float) -> Fan:
    """Return the solution for a depth of water over that of the grains, and a ratio of densities.

    Parameters
    ----------
    a_H
        At least SHALLOWEST.
    r
        Above 0.

    Returns
    -------
    Fan
        Scaled.
    """
    left = np.array([a_H, 0.0, 1.0, 0.0])
    calm = math.sqrt(1 + a_H)

    def mismatch(fall: float) -> float:
        end = tip(inner_fan(outer_wave(left, r, fall), r)[0])
        return float(end[1] - 2 * (math.sqrt(end[0]) - calm))

    falls = [0.0, 0.05]  # secant
    misses = [mismatch(fall) for fall in falls]
    while abs(misses[-1]) > 1e-12 and len(falls) < 20:
        falls.append(falls[-1] - misses[-1] * (falls[-1] - falls[-2]) / (misses[-1] - misses[-2]))
        misses.append(mismatch(falls[-1]))
    behind = outer_wave(left, r, falls[-1])
    states, inner = inner_fan(behind, r)
    end, last = tip(states), float(tip(inner))
    first = _wave(speeds(left, r)[OUTER], speeds(behind, r)[OUTER])
    right = _wave(end[1] + math.sqrt(end[0]), calm)
    place = np.concatenate([first, inner, [last], right])
    h1 = np.concatenate([[a_H, behind[0]], states[:, 0], [end[0], end[0], 1 + a_H]])
    h2 = np.concatenate([[1.0, behind[2]], states[:, 2], [0.0, 0.0, 0.0]])
    return Fan(place, h1, h2)


def _wave(begin: float, end: float) -> np.ndarray:
    """Return where a weak wave begins and ends, given the speeds beside it: in one place if it is a shock."""
    return np.array([begin, end]) if begin <= end else np.full(2, 0.5 * (begin + end))


def solution(point: Point, x: float | np.ndarray, time: float) -> Profiles:
    """Return h2 and eta (m) at x (m); NaN unless it is the dam break above, before a wave is at the end of the box."""
    s, t = scaled(point, x, time)
    nothing = np.full(s.shape, np.nan)
    dam = options(point) == defaults(point.scene)
    known = dam and frictionless(point) and point.r > 0 and point.a_H >= SHALLOWEST
    if not known or math.sqrt(point.scaled_level) * t > point.half_box:
        return in_metres(point, nothing, nothing)
    if t == 0:
        return in_metres(point, np.where(s < 0, 1.0, 0.0), 0 * s)
    waves = fan(point.a_H, point.r)
    h1, h2 = (np.interp(s / t, waves.place, depth) for depth in (waves.h1, waves.h2))
    return in_metres(point, h2, h1 + h2 - point.scaled_level)
