"""One dimension: a radius (round scenes, `radial`) or a line, with one layer or two."""

import numpy as np

from subslide.kernels.advance_axial import advance_axial
from subslide.kernels.arrays import GHOSTS, Cells, CellTerms, Fluxes, Mesh, Side, Watch, allocate
from subslide.models.limits import LOST_GRAINS, first_sheared, first_suspect


class Axial:
    """A state on n cells and the time loop that moves it.

    Parameters
    ----------
    name : str
        The model's name.
    settings : kernels.arrays.Settings
        Scaled numbers in the working precision.
    state : tuple
        (h1, u1, h2, u2), each (n), scaled.
    grid : models.grid.Grid
        A radius, whose cells are rings about the axis, or a line.
    walls : tuple of int
        What the (left, right) end is, see `kernels.boundary`.
    level : float
        The undisturbed surface, scaled.
    watched : int
        Cells from the axis within which the surface is watched.
    """

    copies = 1

    def __init__(self, name, settings, state, grid, *, walls, level, watched):
        real = type(settings.r)
        radial = grid.geometry == "radius"
        n = len(grid.centres)
        padded = n + 2 * GHOSTS
        self.name = name
        self.settings = settings
        self.level = real(level)
        self.x = grid.centres
        self.half_width = grid.edges[-1]
        self.dimensions = 2 if radial else 1
        self.cells = allocate(Cells, (padded,), real)
        for variable, values in zip(("h1", "u1", "h2", "u2"), state, strict=True):
            getattr(self.cells, variable)[GHOSTS:-GHOSTS] = values
        in_cells = Side(*(getattr(self.cells, variable) for variable in Side._fields))
        self.left, self.right = (
            (in_cells, in_cells)
            if settings.order == 1
            else (allocate(Side, (padded,), real) for _ in range(2))
        )
        self.fluxes = allocate(Fluxes, (n + 1,), real)
        self.terms = allocate(CellTerms, (padded,), real)
        self.terms.keep1[:] = self.terms.keep2[:] = 1
        self.mesh = mesh_of(grid, radial, walls[1], real)
        self.walls = (int(walls[0]), int(walls[1]))
        self.watch = self._watch(grid.dx, watched, state[0][-1], state[2][-1])

    def _watch(self, dx, watched, still1, still2):
        """Return the `Watch` of the loop; still water is the state of the last cell at the start."""
        near = np.flatnonzero(np.abs(self.x) < watched * dx)
        columns = (near[0], near[-1] + 1, np.searchsorted(self.x, 0.0), np.searchsorted(self.x, 1.0))
        start, stop, beside, beyond = (int(column) + GHOSTS for column in columns)
        grains = float(np.sum(self.mesh.weight * self.cells.h2, dtype=np.float64))
        return Watch(
            level=self.level,
            least_grains=(1 - LOST_GRAINS) * grains,
            margin=64.0 * float(np.finfo(self.level.dtype).eps),
            still1=still1,
            still2=still2,
            start=start,
            stop=stop,
            bottom=0,
            top=0,
            beside=beside,
            beyond=beyond,
            below_axis=0,
            above_axis=0,
        )

    def advance(self, thresholds, track):
        """Run the time loop; see `advance_axial`."""
        advance_axial(
            self.settings,
            self.cells,
            self.left,
            self.right,
            self.fluxes,
            self.terms,
            self.mesh,
            self.walls,
            self.watch,
            thresholds,
            track,
        )

    def profile(self):
        """Return h2 and eta - level (n) as float64 copies, the innermost cell first."""
        inner = slice(GHOSTS, -GHOSTS)
        h2 = self.cells.h2[inner].astype(np.float64)
        return {
            "h2": h2,
            "eta": (self.cells.h1 + self.cells.h2)[inner].astype(np.float64) - float(self.level),
        }

    def suspect(self):
        """Return where the state is first not finite or negative, and what stands there; '' if nowhere."""
        return first_suspect(self.cells, ("h1", "u1", "h2", "u2"))

    def sheared(self):
        """Return where wave speeds are first complex, and the state there; '' if nowhere."""
        return first_sheared(self.cells, ("h1", "u1", "h2", "u2"), self.settings)


def mesh_of(grid, radial, right_wall, real):
    """Return the `Mesh` of a line or a radius in the working precision `real`."""
    n, dx, x = len(grid.centres), grid.dx, grid.centres
    padded = n + 2 * GHOSTS
    r = x if radial else np.ones(n)
    weight = np.zeros(padded, real)
    weight[GHOSTS:-GHOSTS] = r * dx * (2 * np.pi if radial else 1)
    source = np.zeros(padded, real)
    if radial:
        source[GHOSTS:-GHOSTS] = -0.5 / x
        source[GHOSTS - 1] = -source[GHOSTS]  # mirrored, so that nothing passes a wall
        source[-GHOSTS] = -source[-GHOSTS - 1] if right_wall else -0.5 / (x[-1] + dx)
    return Mesh(
        area=(grid.edges if radial else np.ones(n + 1)).astype(real),
        inverse_volume=(1 / (r * dx)).astype(real),
        source=source,
        weight=weight,
        total=np.concatenate([[0.0], np.cumsum(weight, dtype=np.float64)]),
    )
