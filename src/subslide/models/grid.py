"""Where cells are."""

import numpy as np

from subslide.scenes import Grid


def make_grid(geometry: str, dx: float, half_cells: int) -> Grid:
    """Return the grid that reaches `half_cells` cells from the axis, on both sides in the plane and on a line.

    Parameters
    ----------
    geometry
        ``radius``, ``line``, ``quarter`` or ``plane``.
    dx
        Cell size over R.
    half_cells
        Cells from the axis to the end of the box.

    Returns
    -------
    Grid
        Edges over R, float64, one of them at 0.
    """
    first = -half_cells if geometry in ("plane", "line") else 0
    return Grid(geometry, dx, np.arange(first, half_cells + 1) * dx)
