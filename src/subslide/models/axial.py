"""One dimension: a radius (round scenes, `radial`) or a line, with one layer or two."""

from collections.abc import Sequence

import numpy as np

from subslide.kernels.advance_axial import advance_axial
from subslide.kernels.arrays import (
    GHOSTS,
    Cells,
    CellTerms,
    Fluxes,
    Mesh,
    Settings,
    Side,
    Track,
    Watch,
    allocate,
)
from subslide.kernels.boundary import WALL
from subslide.models.limits import LOST_GRAINS
from subslide.models.model import Model
from subslide.scenes import Grid


class Axial(Model):
    """State on n cells of a line or a radius, and the time loop that moves it.

    Parameters
    ----------
    name
        The model's name.
    settings
        Scaled numbers in the working precision.
    state
        (h1, u1, h2, u2), each (n), scaled.
    grid
        A radius, whose cells are rings about the axis, or a line.
    walls
        What the (left, right) end is, see `kernels.boundary`.
    level
        The undisturbed surface, scaled.
    watched
        Cells from the axis within which the surface is watched.
    """

    copies = 1
    variables = ("h1", "u1", "h2", "u2")

    def __init__(
        self,
        name: str,
        settings: Settings,
        state: Sequence[np.ndarray],
        grid: Grid,
        *,
        walls: tuple[int, int],
        level: float,
        watched: int,
    ):
        """Put the state into padded arrays, and allocate those that a step works on."""
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
        for variable, values in zip(self.variables, state, strict=True):
            getattr(self.cells, variable)[GHOSTS:-GHOSTS] = values
        if settings.order == 1:
            self.left = self.right = Side(*(getattr(self.cells, variable) for variable in Side._fields))
        else:
            self.left = allocate(Side, (padded,), real)
            self.right = allocate(Side, (padded,), real)
        self.fluxes = allocate(Fluxes, (n + 1,), real)
        self.terms = allocate(CellTerms, (padded,), real)
        self.terms.keep1[:] = self.terms.keep2[:] = 1
        self.mesh = mesh_of(grid, radial, walls[1] == WALL, real)
        self.walls = (int(walls[0]), int(walls[1]))
        self.watch = self._watch(grid.dx, watched, state[0][-1], state[2][-1])

    def _watch(self, dx: float, watched: int, still1: float, still2: float) -> Watch:
        """Return the `Watch` of the loop; still water is the state of the last cell at the start."""
        near = np.flatnonzero(np.abs(self.x) < watched * dx)
        columns = (near[0], near[-1] + 1, np.searchsorted(self.x, 0.0), np.searchsorted(self.x, 1.0))
        start, stop, beside, beyond = (int(column) + GHOSTS for column in columns)
        grains = float(np.sum(self.mesh.weight * self.cells.h2, dtype=np.float64))
        return Watch(
            level=self.level,
            least_grains=(1 - LOST_GRAINS) * grains,
            margin=64.0 * float(np.finfo(type(self.level)).eps),
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

    def advance(self, thresholds: tuple[float, ...], track: Track) -> None:
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

    def profile(self) -> dict[str, np.ndarray]:
        """Return h2 and eta - level (n) as float64 copies, the innermost cell first."""
        inner = slice(GHOSTS, -GHOSTS)
        h2 = self.cells.h2[inner].astype(np.float64)
        return {
            "h2": h2,
            "eta": (self.cells.h1 + self.cells.h2)[inner].astype(np.float64) - float(self.level),
        }


def mesh_of(grid: Grid, radial: bool, right_wall: bool, real: type[float]) -> Mesh:
    """Return the `Mesh` of a line or a radius.

    Parameters
    ----------
    grid
        Cells over R.
    radial
        Whether they are rings about the axis.
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
