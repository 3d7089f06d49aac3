"""The fitted grid of a column: fine where its side falls apart, and as wide as that has spread.

Cells are of one size in the fan between the first wave into the column and the last grains, whose way a dam break with
friction sets (Mangeney 2000), and grow as a power of their number to the axis and into the water. Every edge is a
number times each end of the fan, and another: known before the run, whatever it does.
"""

import math

import numpy as np

from subslide.kernels.arrays import Fan
from subslide.points import PAPER_BOX, Point

SLACK = 0.01
SHARE = 0.7
POWER = 3.0
PARTS = (8, 24, 16)
FAR = 8.0
BEYOND = 1.3
MIX=1.0
FRONT=1.4
LEFT = lambda wave, point: wave


def parts(cells: int) -> tuple[int, int, int]:
    """Return the cells behind the fan, in it and beyond it."""
    whole = sum(PARTS)
    left = max(2, round(cells * PARTS[0] / whole))
    fan = max(4, round(cells * PARTS[1] / whole))
    return left, fan, cells - left - fan


def numbers(point: Point, end: float) -> tuple[float, ...]:
    """Return the numbers of `kernels.motion.ends`: of a run to the scaled time `end`."""
    left, fan, _ = parts(point.cells)
    wave = math.sqrt(1 - point.r)
    brake = (1 - point.r) * point.friction_number
    front = FRONT * wave
    slowed = front**2 / (4 * SHARE * wave**2) * brake
    braked = front / slowed if brake else math.inf
    evenly = left / (left + fan)
    t = min(braked, end)
    right = 1 + 2 * SLACK + t * (front - 0.5 * slowed * t)
    fall = LEFT(wave, point)
    stop = max(braked, (1 - SLACK - evenly * right) / fall)
    return Fan(SLACK, fall, front, slowed, 1.0, evenly, braked, stop)


def coefficients(cells: int, far: float) -> tuple[np.ndarray, ...]:
    """Return of each edge what stands alone, and what the left and the right end of the fan are taken times."""
    left, fan, right = parts(cells)
    behind = np.arange(left, 0, -1.0)
    within = np.arange(fan + 1) / fan
    beyond = np.arange(1, right + 1.0)
    share = [(behind / left) ** POWER, (beyond / right) ** POWER]
    more = [(behind - left * share[0]) / fan, (beyond - right * share[1]) / fan]
    base = np.concatenate([0 * behind, 0 * within, far * share[1]])
    near = np.concatenate([1 - share[0] + more[0], 1 - within, -more[1]])
    ahead = np.concatenate([-more[0], within, 1 - share[1] + more[1]])
    return base, near, ahead
