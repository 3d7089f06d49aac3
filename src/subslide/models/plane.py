"""The plane: whole, or the quarter x, y > 0 with walls on the axes for scenes with two mirror symmetries."""

import numpy as np

from subslide.kernels.active import SPANS
from subslide.kernels.advance_planar import BLOCK, ROW_COLUMNS, advance_planar
from subslide.kernels.arrays import GHOSTS, Cells, Fluxes, Marks, Side, allocate
from subslide.models.limits import LOST_GRAINS, first_sheared, first_suspect


class Plane:
    """A state on ny x nx square cells and the time loop that moves it.

    scene: `kernels.arrays.Scene` in the working precision. state: (h1, u1, v1, h2, u2, v2), each (ny, nx), scaled.
    walls: what (left, right, bottom, top) are, see `kernels.boundary`. level: the undisturbed surface. watched:
    half-width in cells of the region where the surface is watched.
    """

    dimensions = 2

    def __init__(self, name, scene, state, grid, *, walls, level, watched):
        real = type(scene.r)
        ny, nx = state[0].shape
        padded = (ny + 2 * GHOSTS, nx + 2 * GHOSTS)
        self.name = name
        self.scene = scene
        self.level = real(level)
        self.x = grid.centres
        self.half_width = grid.edges[-1]
        self.copies = 4 if name == "quarter" else 1
        first = int(np.searchsorted(self.x, 0.0))
        self.centre = (first, first)
        self.cells = allocate(Cells, padded, real)
        inner = (slice(GHOSTS, -GHOSTS),) * 2
        for field, values in zip(("h1", "u1", "v1", "h2", "u2", "v2"), state, strict=True):
            getattr(self.cells, field)[inner] = values
        blocks = -(-ny // BLOCK)
        if scene.order == 1:
            own = Side(*(getattr(self.cells, field) for field in Side._fields))
            self.faces = (own,) * 4
        else:
            self.faces = tuple(
                allocate(Side, (rows, padded[1]), real) for rows in (blocks, blocks, blocks, 2 * blocks)
            )
        self.fluxes = allocate(Fluxes, (ny, nx + 1), real), allocate(Fluxes, (ny + 1, nx), real)
        self.marks = allocate(Marks, padded, real)
        self.marks.keep1[:] = self.marks.keep2[:] = 1
        dx = grid.dx
        self.weight = np.zeros(padded[1], real)
        self.weight[inner[1]] = dx * dx
        self.total = np.concatenate([[0.0], np.cumsum(self.weight, dtype=np.float64)])
        self.walls = tuple(int(wall) for wall in walls)
        column = row = first + GHOSTS
        margin = 64.0 * float(np.finfo(real).eps)
        box = max(GHOSTS, column - watched), min(padded[1] - GHOSTS, column + watched)
        box += max(GHOSTS, row - watched), min(padded[0] - GHOSTS, row + watched)
        least = (1 - LOST_GRAINS) * float(np.sum(self.weight * self.cells.h2, dtype=np.float64))
        self.probe = (self.level, least, *box, margin, state[0][-1, -1], state[3][-1, -1])
        self.inside = columns_within_radius(padded[0], row, column, dx, box[:2])
        self.axis = (row if name == "quarter" else row - 1, row, column)
        self.spans = np.zeros((padded[0], SPANS), np.int64)
        self.rows = np.zeros((padded[0], ROW_COLUMNS))

    def advance(self, thresholds, clock, samples, counters):
        """Run the time loop; see `advance_planar`."""
        advance_planar(
            self.scene,
            self.cells,
            *self.faces,
            *self.fluxes,
            self.marks,
            self.weight,
            self.total,
            self.walls,
            self.probe,
            self.inside,
            self.axis,
            self.spans,
            self.rows,
            thresholds,
            clock,
            samples,
            counters,
        )

    def fields(self):
        """Return h2 and eta - level (ny, nx) as float64 copies."""
        inner = (slice(GHOSTS, -GHOSTS),) * 2
        surface = (self.cells.h1 + self.cells.h2)[inner].astype(np.float64)
        return {"h2": self.cells.h2[inner].astype(np.float64), "eta": surface - float(self.level)}

    def profile(self):
        """Return h2 and eta along the x axis (mean of the rows beside it) and h2 along the diagonal, each (nx)."""
        whole = self.fields()
        rows = [row - GHOSTS for row in self.axis[:2]]
        out = {name: 0.5 * (values[rows[0]] + values[rows[1]]) for name, values in whole.items()}
        out["h2_diagonal"] = diagonal(whole["h2"], self.centre)
        return out

    def suspect(self):
        """Return where the state is first not finite or negative, and what stands there; '' if nowhere."""
        return first_suspect(self.cells, ("h1", "u1", "v1", "h2", "u2", "v2"))

    def sheared(self):
        """Return where wave speeds are first complex, and the state there; '' if nowhere."""
        return first_sheared(self.cells, ("h1", "u1", "v1", "h2", "u2", "v2"), self.scene)


def columns_within_radius(padded_rows, row, column, dx, box):
    """Return for each padded row the padded columns [start, stop) whose centres lie within R = 1, as int64."""
    y = (np.arange(padded_rows) - row + 0.5) * dx
    reach = np.sqrt(np.maximum(0.0, 1.0 - y**2)) / dx
    stop = column + np.floor(reach + 0.5).astype(np.int64)
    start = 2 * column - stop
    return np.clip(np.stack([start, stop], axis=1), *box)


def diagonal(h2, centre):
    """Return h2 at the cells (column + k, row + k) of the diagonal, NaN where the box has none."""
    ny, nx = h2.shape
    column = np.arange(nx)
    row = column - centre[0] + centre[1]
    inside = (row >= 0) & (row < ny)
    return np.where(inside, h2[np.clip(row, 0, ny - 1), column], np.nan)
