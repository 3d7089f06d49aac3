"""Grids: square cells of the scaled size dx on a radius, a line, the plane or its quarter."""

from typing import NamedTuple

import numpy as np


class Grid(NamedTuple):
    """Where cells are. `edges` (n + 1) holds along each axis, scaled by R; the axis of the scene is at 0.

    geometry: "radius", "line", "quarter" or "plane".
    """

    geometry: str
    dx: float
    edges: np.ndarray

    @property
    def centres(self):
        """Return the cell centres (n)."""
        return 0.5 * (self.edges[1:] + self.edges[:-1])


def make_grid(geometry, dx, half_cells):
    """Return the grid that reaches `half_cells` cells from the axis, on both sides in the plane and on a line."""
    first = -half_cells if geometry in ("plane", "line") else 0
    return Grid(geometry, dx, np.arange(first, half_cells + 1) * dx)
