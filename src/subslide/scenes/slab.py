"""A long column of grains of half-width 1 and height 1 under still water, on a line: the twin of the cylinder.

The front is that on the right; the left one is its mirror image.
"""

import numpy as np

from subslide.keys.entries import Entry
from subslide.points import Point
from subslide.scenes import Grid, State, still_water

OPTIONS: dict[str, Entry] = {}


def symmetry(point: Point) -> str:
    """Return the scene's symmetry."""
    return "line"


def front(point: Point) -> float:
    """Return the half-width."""
    return 1.0


def is_column(point: Point) -> bool:
    """Return that there is one column about the axis."""
    return True


def initial(grid: Grid, point: Point) -> State:
    """Return the column at rest under still water (alone for `one-layer`)."""
    left, right = np.maximum(grid.edges[:-1], -1.0), np.minimum(grid.edges[1:], 1.0)
    inside = np.abs(grid.edges) <= 1.0
    share = np.maximum(right - left, 0.0) / np.diff(grid.edges)
    return still_water(np.where(inside[:-1] & inside[1:], 1.0, share), point.scaled_level)
