"""The paper's scene: a round column of grains of radius 1 and height 1 under still water of depth 1 + a_H."""

import numpy as np

from subslide.keys.entries import Entry
from subslide.points import Point
from subslide.scenes import Grid, State, still_water
from subslide.scenes._cells import over_plane

OPTIONS: dict[str, Entry] = {}


def symmetry(point: Point) -> str:
    """Return the scene's symmetry."""
    return "round"


def front(point: Point) -> float:
    """Return the radius."""
    return 1.0


def is_column(point: Point) -> bool:
    """Return that there is one column about the axis."""
    return True


def initial(grid: Grid, point: Point) -> State:
    """Return the column at rest under still water (alone for `one-layer`)."""
    lone = grid.geometry == "radius"
    h2 = radial_depth(grid.edges) if lone else over_plane(grid, quadrant_depth)
    return still_water(h2, point.scaled_level)


def radial_depth(edges: np.ndarray) -> np.ndarray:
    """Return h2 (n) of the cells between the radii `edges` (n + 1): the exact fraction of each ring's area."""
    inner, outer = edges[:-1], edges[1:]
    covered = np.minimum(outer, 1.0) ** 2 - np.minimum(inner, 1.0) ** 2
    return np.where(outer <= 1.0, 1.0, covered / (outer**2 - inner**2))


def quadrant_depth(edges: np.ndarray) -> np.ndarray:
    """Return h2 (n, n) of the cells between the non-negative `edges` (n + 1) on both axes: exact area fractions.

    Cells whole inside or outside the disc are exactly 1 or 0, and the result equals its transpose to the bit.
    """
    lower, upper = edges[:-1], edges[1:]
    corner = disc_corner_area(edges[:, None], edges[None, :])
    area = corner[1:, 1:] - corner[1:, :-1] - corner[:-1, 1:] + corner[:-1, :-1]
    fraction = area / np.outer(upper - lower, upper - lower)
    fraction = np.clip(0.5 * (fraction + fraction.T), 0.0, 1.0)
    nearest = np.hypot(lower[:, None], lower[None, :])
    farthest = np.hypot(upper[:, None], upper[None, :])
    return np.where(farthest <= 1.0, 1.0, np.where(nearest >= 1.0, 0.0, fraction))


def disc_corner_area(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Return the area that the unit disc shares with [0, x] x [0, y], for x, y >= 0."""
    x = np.minimum(x, 1.0)
    y = np.minimum(y, 1.0)
    leaves = np.sqrt(1.0 - y**2)  # where the circle comes below y

    def under_circle(s: np.ndarray) -> np.ndarray:
        return 0.5 * (s * np.sqrt(1.0 - s**2) + np.arcsin(s))

    return np.where(x <= leaves, x * y, leaves * y + under_circle(x) - under_circle(np.minimum(leaves, x)))
