"""Means over cells: the depth of a cell is the volume above it over its area, never the depth at its centre."""

from collections.abc import Callable

import numpy as np

from subslide.scenes import Grid


def over_plane(grid: Grid, quadrant: Callable[[np.ndarray], np.ndarray]) -> np.ndarray:
    """Return the values over the grid's plane or quarter of a scene with mirrors on both axes.

    quadrant: function of the non-negative edges (n + 1) that returns the values (n, n) of the cells between them. The
    plane is made of its mirror images, so that it is symmetric to the bit.
    """
    values = quadrant(grid.edges[grid.edges >= 0])
    if grid.geometry == "plane":
        values = np.concatenate([values[::-1], values])
        values = np.concatenate([values[:, ::-1], values], axis=1)
    return values


def means(
    function: Callable[[np.ndarray, np.ndarray], np.ndarray],
    x_edges: np.ndarray,
    y_edges: np.ndarray,
    points: int = 16,
) -> np.ndarray:
    """Return the means (ny, nx) of function(x, y) over cells, by the midpoints of points x points parts of each.

    Exact for linear functions; a kink of slope s costs s dx / (8 points^2) at most.
    """
    total = np.zeros((len(y_edges) - 1, len(x_edges) - 1))
    for j in range(points):
        y = y_edges[:-1] + (j + 0.5) / points * np.diff(y_edges)
        for i in range(points):
            x = x_edges[:-1] + (i + 0.5) / points * np.diff(x_edges)
            total = total + function(x[None, :], y[:, None])
    return total / points**2
