"""Grids: square cells of the scaled size dx on a radius, a line, the plane or its quarter."""

from typing import NamedTuple

import numpy as np


class Grid(NamedTuple):
    """Where cells are. `edges` (n + 1) holds along each axis, scaled by R; the axis of the scene is at 0."""

    model: str
    dx: float
    edges: np.ndarray

    @property
    def centres(self):
        """Return the cell centres (n)."""
        return 0.5 * (self.edges[1:] + self.edges[:-1])


def make_grid(model, dx, half_cells):
    """Return the grid of `model` that reaches `half_cells` cells from the axis, on both sides where it has two."""
    first = -half_cells if model in ("plane", "line") else 0
    return Grid(model, dx, np.arange(first, half_cells + 1) * dx)
