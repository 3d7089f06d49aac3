"""Ends of a row of padded cells: what the ghosts copy."""

from subslide.kernels.arrays import GHOSTS
from subslide.kernels.jit import inlined
from subslide.keys.names import BOUNDARIES, flags

FLAGS = flags(BOUNDARIES)
OPEN, WALL, PERIODIC, PAPER = (FLAGS[name] for name in ("open", "wall", "periodic", "paper"))


@inlined
def lets_out(end):
    """Return whether grains may leave through an end."""
    return end in (OPEN, PAPER)


@inlined
def copied_before(end, g, n):
    """Return the cell that the g-th ghost before the first of n padded cells copies, counted away from it."""
    if end == PERIODIC:
        return n - GHOSTS - 1 - g
    return GHOSTS + (g if end == WALL else 0)


@inlined
def copied_after(end, g, n):
    """Return the cell that the g-th ghost after the last cell copies."""
    if end == PERIODIC:
        return GHOSTS + g
    return n - GHOSTS - 1 - (g if end == WALL else 0)


@inlined
def join(row, end):
    """Give the ghosts beside the ends of a periodic row the values of the cells they stand for."""
    if end == PERIODIC:
        n = row.shape[0]
        row[GHOSTS - 1] = row[n - GHOSTS - 1]
        row[n - GHOSTS] = row[GHOSTS]


@inlined
def join_plane(values, walls):
    """Do so in the plane, whose ends (left, right, bottom, top) are `walls`."""
    ny, nx = values.shape
    for j in range(GHOSTS, ny - GHOSTS):
        join(values[j], walls[0])
    for i in range(GHOSTS, nx - GHOSTS):
        join(values[:, i], walls[2])
