"""Where the cells of a line or a radius lie, and what of it all runs on as many cells share."""

import functools
import math
from typing import NamedTuple

import numpy as np

from subslide.kernels.arrays import GHOSTS, Mesh
from subslide.scenes import Grid

MOST_LAYOUTS, LARGEST_LAYOUT = 64, 1 << 14
"""Layouts that are kept for later runs, and the cells of the largest of these."""


class Layout(NamedTuple):
    """Cells of a line or radius, which many runs share: nothing in it ever changes.

    Attributes
    ----------
    x
        Centres (n) over R.
    mesh
        Their sizes.
    columns
        First padded column where the surface is watched and the one after the last, those beside the axis and beyond R.
    """

    x: np.ndarray
    mesh: Mesh
    columns: tuple[int, int, int, int]


@functools.lru_cache(MOST_LAYOUTS)
def layout_of(
    geometry: str,
    dx: float,
    span: tuple[int, int],
    box: tuple[int, int],
    right_wall: bool,
    watched: float,
    real: np.dtype,
) -> Layout:
    """Return the layout of a line or a radius.

    Parameters
    ----------
    geometry, dx
        As of a `Grid`.
    span
        Number of the first cell, counted from the axis, and how many there are.
    box, right_wall, real
        As in `mesh_of`.
    watched
        Cells from the axis within which the surface is watched.

    Returns
    -------
    Layout
        Its arrays are shared.
    """
    first, cells = span
    grid = Grid(geometry, dx, np.arange(first, first + cells + 1) * dx)
    x = grid.centres
    near = np.flatnonzero(np.abs(x) < math.ceil(watched) * dx)
    columns = (near[0], near[-1] + 1, np.searchsorted(x, 0.0), np.searchsorted(x, 1.0))
    start, stop, beside, beyond = (int(column) + GHOSTS for column in columns)
    return Layout(x, mesh_of(grid, box, right_wall, real), (start, stop, beside, beyond))


def mesh_of(grid: Grid, box: tuple[int, int], right_wall: bool, real: np.dtype) -> Mesh:
    """Return the `Mesh` of a line or a radius.

    Parameters
    ----------
    grid
        Cells over R; on a radius they are rings about the axis.
    box
        Cells from the axis to the (left, right) end of the box of which volumes are, the left ones counted below 0.
    right_wall
        Whether the right end is a wall.
    real
        Type of the working precision.

    Returns
    -------
    Mesh
        Arrays of that type, the sums float64.
    """
    n, dx, x = len(grid.centres), grid.dx, grid.centres
    radial = grid.geometry == "radius"
    padded = n + 2 * GHOSTS
    r = x if radial else np.ones(n)
    weight = np.zeros(padded, real)
    weight[GHOSTS:-GHOSTS] = r * dx * (2 * np.pi if radial else 1)
    source = np.zeros(padded, real)
    if radial:
        source[GHOSTS:-GHOSTS] = -0.5 / x
        source[GHOSTS - 1] = -source[GHOSTS]  # mirrored, so that nothing passes a wall
        source[-GHOSTS] = -source[-GHOSTS - 1] if right_wall else -0.5 / (x[-1] + dx)
    first = GHOSTS + box[0] - round(grid.edges[0] / dx)
    left = -np.cumsum(weight[:first][::-1], dtype=np.float64)[::-1]
    total = np.concatenate([left, [0.0], np.cumsum(weight[first:], dtype=np.float64)])
    return Mesh(
        area=(grid.edges if radial else np.ones(n + 1)).astype(real),
        inverse_volume=(1 / (r * dx)).astype(real),
        source=source,
        weight=weight,
        total=total,
        size=float(total[first + box[1] - box[0]]),
    )
