"""The plane: whole, or the quarter x, y > 0 with walls on the axes for scenes with two mirror symmetries."""

import numpy as np

from subslide.kernels.active import SPANS
from subslide.kernels.advance_planar import BLOCK, ROW_COLUMNS, advance_planar
from subslide.kernels.arrays import GHOSTS, Cells, CellTerms, Fluxes, Mesh, Side, Watch, allocate
from subslide.models.limits import LOST_GRAINS, first_sheared, first_suspect


class Plane:
    """A state on ny x nx square cells and the time loop that moves it.

    Parameters
    ----------
    name : str
        The model's name.
    settings : kernels.arrays.Settings
        Scaled numbers in the working precision.
    state : tuple
        (h1, u1, v1, h2, u2, v2), each (ny, nx), scaled.
    grid : models.grid.Grid
        The plane or its quarter.
    walls : tuple of int
        What (left, right, bottom, top) are, see `kernels.boundary`.
    level : float
        The undisturbed surface, scaled.
    watched : int
        Half-width in cells of the region where the surface is watched.
    """

    dimensions = 2

    def __init__(self, name, settings, state, grid, *, walls, level, watched):
        real = type(settings.r)
        ny, nx = state[0].shape
        padded = (ny + 2 * GHOSTS, nx + 2 * GHOSTS)
        self.name = name
        self.settings = settings
        self.level = real(level)
        self.x = grid.centres
        self.half_width = grid.edges[-1]
        self.copies = 4 if name == "quarter" else 1
        first = int(np.searchsorted(self.x, 0.0))
        self.centre = (first, first)
        self.cells = allocate(Cells, padded, real)
        inner = (slice(GHOSTS, -GHOSTS),) * 2
        for variable, values in zip(("h1", "u1", "v1", "h2", "u2", "v2"), state, strict=True):
            getattr(self.cells, variable)[inner] = values
        blocks = -(-ny // BLOCK)
        if settings.order == 1:
            self.faces = (Side(*(getattr(self.cells, variable) for variable in Side._fields)),) * 4
        else:
            rows = (blocks, blocks, blocks, 2 * blocks)
            self.faces = tuple(allocate(Side, (count, padded[1]), real) for count in rows)
        self.fluxes = allocate(Fluxes, (ny, nx + 1), real), allocate(Fluxes, (ny + 1, nx), real)
        self.terms = allocate(CellTerms, padded, real)
        self.terms.keep1[:] = self.terms.keep2[:] = 1
        self.mesh = mesh_of(padded[1], grid.dx, real)
        self.walls = tuple(int(wall) for wall in walls)
        self.watch = self._watch(padded, first + GHOSTS, watched, state[0][-1, -1], state[3][-1, -1])
        box = (self.watch.start, self.watch.stop)
        self.inside = columns_within_radius(padded[0], first + GHOSTS, first + GHOSTS, grid.dx, box)
        self.spans = np.zeros((padded[0], SPANS), np.int64)
        self.rows = np.zeros((padded[0], ROW_COLUMNS))

    def _watch(self, padded, axis, watched, still1, still2):
        """Return the `Watch` of the loop. axis: first padded column, and row, beyond the axis."""
        grains = float(np.sum(self.mesh.weight * self.cells.h2, dtype=np.float64))
        return Watch(
            level=self.level,
            least_grains=(1 - LOST_GRAINS) * grains,
            margin=64.0 * float(np.finfo(self.level.dtype).eps),
            still1=still1,
            still2=still2,
            start=max(GHOSTS, axis - watched),
            stop=min(padded[1] - GHOSTS, axis + watched),
            bottom=max(GHOSTS, axis - watched),
            top=min(padded[0] - GHOSTS, axis + watched),
            beside=axis,
            beyond=0,
            below_axis=axis if self.copies == 4 else axis - 1,
            above_axis=axis,
        )

    def advance(self, thresholds, track):
        """Run the time loop; see `advance_planar`."""
        advance_planar(
            self.settings,
            self.cells,
            *self.faces,
            *self.fluxes,
            self.terms,
            self.mesh,
            self.walls,
            self.watch,
            self.inside,
            self.spans,
            self.rows,
            thresholds,
            track,
        )

    def fields(self):
        """Return h2 and eta - level (ny, nx) as float64 copies."""
        inner = (slice(GHOSTS, -GHOSTS),) * 2
        surface = (self.cells.h1 + self.cells.h2)[inner].astype(np.float64)
        return {"h2": self.cells.h2[inner].astype(np.float64), "eta": surface - float(self.level)}

    def profile(self):
        """Return h2 and eta along the x axis (mean of the rows beside it) and h2 along the diagonal, each (nx)."""
        whole = self.fields()
        rows = [row - GHOSTS for row in (self.watch.below_axis, self.watch.above_axis)]
        out = {name: 0.5 * (values[rows[0]] + values[rows[1]]) for name, values in whole.items()}
        out["h2_diagonal"] = diagonal(whole["h2"], self.centre)
        return out

    def suspect(self):
        """Return where the state is first not finite or negative, and what stands there; '' if nowhere."""
        return first_suspect(self.cells, ("h1", "u1", "v1", "h2", "u2", "v2"))

    def sheared(self):
        """Return where wave speeds are first complex, and the state there; '' if nowhere."""
        return first_sheared(self.cells, ("h1", "u1", "v1", "h2", "u2", "v2"), self.settings)


def mesh_of(columns, dx, real):
    """Return the `Mesh` of a row of padded columns in the plane, in the working precision `real`."""
    weight = np.zeros(columns, real)
    weight[GHOSTS:-GHOSTS] = dx * dx
    total = np.concatenate([[0.0], np.cumsum(weight, dtype=np.float64)])
    nothing = np.zeros(0, real)
    return Mesh(area=nothing, inverse_volume=nothing, source=nothing, weight=weight, total=total)


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
