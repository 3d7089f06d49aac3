"""The fitted grid of a column: fine where its side falls apart, and as wide as that has spread.

Cells are of nearly one size in the fan, which reaches from the first wave into the column to where a dam break with
friction goes (see `kernels.motion.ends`), and grow from there as a power of their number, to the axis and into the
water. Every edge is a number times each end of the fan, and one more: known before the run, whatever it does.

The numbers were chosen on columns drawn at random (a_H 0.5 to 10, a_2 0.3 to 1.5, r to 0.8, delta 20 to 40); answers
depend little on any of them (docs/design/measured.md).
"""

import functools
import math

import numpy as np

from subslide.kernels import motion
from subslide.kernels.arrays import Fan
from subslide.kernels.jit import plain
from subslide.points import Point

PARTS = (11, 21, 16)
"""Of 48 cells: those behind the fan, in it and beyond it."""

START = 2.0
"""Width of the part of the fan that is in the column at the start, times the number of cells to 3/2: 0.006 with 48."""

FRONT = 1.6
"""Speed of the right end of the fan at the start, over that of waves into the column: the 1 % front has 1.7."""

SHARE = 0.65
"""Way of the right end over that of the last grains of a dam break; the 1 % front of a deposit is at 0.76 of it."""

GRADE, BOWL = 0.2, 0.15
"""By how much cells of the fan grow to the right, and to both ends, which move: waves near edges there faster."""

POWER = 4.0
"""By which cells grow outside the fan."""

FAR = 8.0
"""Least radius at which the water ends, at a wall: what comes back from it hardly moves grains."""

BEYOND = 1.3
"""Mean size of the cells beyond the fan, over that of its last one, at least."""


ends = plain(motion.ends)
"""Where the ends of the fan are at a time, as Python."""


def parts(cells: int) -> tuple[int, int, int]:
    """Return how many of so many cells are behind the fan, in it and beyond it; the column's side is an edge.

    With three in the fan, grains nearly without friction gained 1.9 times the energy that the start can release.
    """
    whole = sum(PARTS)
    left = max(2, round(cells * PARTS[0] / whole))
    fan = max(6, 3 * round(cells * PARTS[1] / whole / 3))
    return left, fan, cells - left - fan


def within(s: np.ndarray | float) -> np.ndarray | float:
    """Return where the edges of the fan are, from 0 to 1, by their number over that of its cells."""
    return s + GRADE / 2 * (s * s - s) + BOWL * (((2 * s - 1) ** 3 + 1) / 6 - s / 3)


def sizes() -> tuple[float, float]:
    """Return the sizes of the first and the last cell of the fan over their mean, by the slope of `within`."""
    return 1 - GRADE / 2 + BOWL / 1.5, 1 + GRADE / 2 + BOWL / 1.5


def fan_of(point: Point) -> Fan:
    """Return how the ends of a point's fan move, scaled; without friction its right end never stops.

    A dam break of grains with the gravity g (1-r) sends its last grains to 2 c t - (1-r) m t^2 / 2, c^2 = 1-r, where
    nothing slows them down but the least friction.
    """
    left, fan, _ = parts(point.cells)
    slack = START / point.cells**1.5
    lead = slack * (1 / within(1 / 3) - 1)
    wave = math.sqrt(1 - point.r)
    front = FRONT * wave
    brake = (1 - point.r) * point.least_friction * FRONT**2 / (4 * SHARE)
    braked = front / brake if brake else math.inf
    evenly = left / (left + fan)
    farthest = 1 + lead + 0.5 * front * braked
    stop = max(braked, (1 - slack - evenly * farthest) / wave)
    return Fan(slack, lead, wave, front, brake, evenly, braked, stop)


def coefficients(cells: int, far: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return what the place of each edge is made of: base + near left + ahead right, by the ends of the fan.

    Parameters
    ----------
    cells
        Number of cells.
    far
        End of the grid over R.

    Returns
    -------
    tuple of ndarray
        base, near and ahead, each (cells + 1), of which the last two are shared.
    """
    outwards, near, ahead = _shares(cells)
    return far * outwards, near, ahead


@functools.lru_cache(64)
def _shares(cells: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the share of the end of the grid, and of both ends of the fan, in the place of each edge."""
    left, fan, right = parts(cells)
    behind, beyond = np.arange(left, 0, -1.0), np.arange(1, right + 1.0)
    inner = within(np.arange(fan + 1) / fan)
    share_left, share_right = (behind / left) ** POWER, (beyond / right) ** POWER
    first, last = sizes()
    more_left = first * (behind - left * share_left) / fan
    more_right = last * (beyond - right * share_right) / fan
    outwards = np.concatenate([0 * behind, 0 * inner, share_right])
    near = np.concatenate([1 - share_left + more_left, 1 - inner, -more_right])
    ahead = np.concatenate([-more_left, inner, 1 - share_right + more_right])
    return outwards, near, ahead


def far_end(point: Point, fan: Fan) -> float:
    """Return where the grid of a point ends: so far that cells beyond the fan never shrink below those in it.

    Parameters
    ----------
    point
        The run.
    fan
        Its fan.

    Returns
    -------
    float
        Distance over R.
    """
    left, fan_cells, right = parts(point.cells)
    _, farthest = ends(fan, point.latest_end / point.time_scale)
    return max(FAR, farthest * (1 + BEYOND * sizes()[1] * right / (left + fan_cells)))


def first_edges(
    point: Point, fan: Fan, coefficients: tuple[np.ndarray, np.ndarray, np.ndarray]
) -> np.ndarray:
    """Return the edges of the cells at the start.

    Parameters
    ----------
    point
        The run.
    fan
        Its fan.
    coefficients
        What its edges are made of.

    Returns
    -------
    ndarray
        Places (cells + 1) over R; the column's side is one of them, to the bit.
    """
    base, near, ahead = coefficients
    left, right = ends(fan, 0.0)
    edges = base + near * left + ahead * right
    behind, fan_cells, _ = parts(point.cells)
    edges[behind + fan_cells // 3] = 1.0
    return edges
