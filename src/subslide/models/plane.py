"""The plane: whole, or the quarter x, y > 0 with walls on the axes for scenes with two mirror symmetries."""

import math
from collections.abc import Sequence

import numpy as np

from subslide.kernels.active import SPANS
from subslide.kernels.advance_planar import BLOCK, ROW_COLUMNS, advance_planar
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
from subslide.kernels.boundary import PAPER
from subslide.kernels.radiation import COSINE, DECAY
from subslide.models.limits import LOST_GRAINS
from subslide.models.model import Model
from subslide.scenes import Grid


class Plane(Model):
    """State on ny x nx square cells, and the time loop that moves it.

    Parameters
    ----------
    name
        The model's name.
    settings
        Scaled numbers in the working precision.
    state
        (h1, u1, v1, h2, u2, v2), each (ny, nx), scaled.
    grid
        The plane or its quarter.
    walls
        What (left, right, bottom, top) are, see `kernels.boundary`.
    level
        The undisturbed surface, scaled.
    watched
        Half-width in cells of the region where the surface is watched, a whole number or one and a half.
    """

    dimensions = 2
    variables = ("h1", "u1", "v1", "h2", "u2", "v2")

    def __init__(
        self,
        name: str,
        settings: Settings,
        state: Sequence[np.ndarray],
        grid: Grid,
        *,
        walls: tuple[int, int, int, int],
        level: float,
        watched: float,
    ):
        """Put the state into padded arrays, and allocate those that a step works on."""
        real = type(settings.r)
        ny, nx = state[0].shape
        padded = (ny + 2 * GHOSTS, nx + 2 * GHOSTS)
        self.name = name
        self.settings = settings
        self.level = real(level)
        self._x = grid.centres
        self.half_width = grid.edges[-1]
        self.copies = 4 if name == "quarter" else 1
        first = int(np.searchsorted(self.x, 0.0))
        self.centre = (first, first)
        self.cells = allocate(Cells, padded, real)
        inner = (slice(GHOSTS, -GHOSTS),) * 2
        for variable, values in zip(self.variables, state, strict=True):
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
        self.rim = rim_of(padded[0], first + GHOSTS, grid.dx, self.half_width, real)
        self.spans = np.zeros((padded[0], SPANS), np.int64)
        self.rows = np.zeros((padded[0], ROW_COLUMNS))

    def _watch(
        self, padded: tuple[int, int], axis: int, watched: float, still1: float, still2: float
    ) -> Watch:
        """Return the `Watch` of the loop. axis: first padded column, and row, beyond the axis."""
        cells = math.ceil(watched)
        grains = float(np.sum(self.mesh.weight * self.cells.h2, dtype=np.float64))
        return Watch(
            level=self.level,
            least_grains=(1 - LOST_GRAINS) * grains,
            margin=64.0 * float(np.finfo(type(self.level)).eps),
            still1=still1,
            still2=still2,
            start=max(GHOSTS, axis - cells),
            stop=min(padded[1] - GHOSTS, axis + cells),
            bottom=max(GHOSTS, axis - cells),
            top=min(padded[0] - GHOSTS, axis + cells),
            split=int(watched == cells and PAPER not in self.walls),
            rim_left=0,
            rim_right=0,
            beside=axis,
            beyond=0,
            below_axis=axis if self.copies == 4 else axis - 1,
            above_axis=axis,
        )

    @property
    def x(self) -> np.ndarray:
        """Centres (nx) of the cells along x over R."""
        return self._x

    def state(self) -> dict[str, np.ndarray]:
        """Return the cells, and what the edges of the box know of the waves that have left it."""
        return super().state() | {"rim": self.rim}

    def resume(self, state: dict[str, np.ndarray]) -> None:
        """Put a state back."""
        super().resume(state)
        self.rim[:] = state["rim"]

    def advance(self, thresholds: tuple[float, ...], track: Track) -> None:
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
            self.rim,
            self.spans,
            self.rows,
            thresholds,
            track,
        )

    def fields(self) -> dict[str, np.ndarray]:
        """Return h2 and eta - level (ny, nx) as float64 copies."""
        inner = (slice(GHOSTS, -GHOSTS),) * 2
        surface = (self.cells.h1 + self.cells.h2)[inner].astype(np.float64)
        return {"h2": self.cells.h2[inner].astype(np.float64), "eta": surface - float(self.level)}

    def profile(self) -> dict[str, np.ndarray]:
        """Return h2 and eta along the x axis (mean of the rows beside it) and h2 along the diagonal, each (nx)."""
        whole = self.fields()
        rows = [row - GHOSTS for row in (self.watch.below_axis, self.watch.above_axis)]
        out = {name: 0.5 * (values[rows[0]] + values[rows[1]]) for name, values in whole.items()}
        out["h2_diagonal"] = diagonal(whole["h2"], self.centre)
        return out


def mesh_of(columns: int, dx: float, real: type[float]) -> Mesh:
    """Return the `Mesh` of a row in the plane.

    Parameters
    ----------
    columns
        Padded columns.
    dx
        Cell size over R.
    real
        Type of the working precision.

    Returns
    -------
    Mesh
        Arrays of that type, the sums float64.
    """
    weight = np.zeros(columns, real)
    weight[GHOSTS:-GHOSTS] = dx * dx
    total = np.concatenate([[0.0], np.cumsum(weight, dtype=np.float64)])
    nothing = np.zeros(0, real)
    return Mesh(
        area=nothing,
        inverse_volume=nothing,
        source=nothing,
        weight=weight,
        total=total,
        size=float(total[-1]),
    )


def rim_of(padded: int, axis: int, dx: float, half_width: float, real: type[float]) -> np.ndarray:
    """Return what `kernels.radiation` keeps of the edges of a square box: K, 0 at the start, and what does not change.

    Parameters
    ----------
    padded
        Rows, and columns, with ghosts.
    axis
        First padded row and column beyond the axis.
    dx, half_width
        Cell size, and distance of the edges from the axis, over R.
    real
        Type of the working precision.

    Returns
    -------
    ndarray
        Numbers (6, padded) of that type.
    """
    along = (np.arange(padded) - axis + 0.5) * dx
    radius = np.hypot(half_width, along)
    rim = np.zeros((6, padded), real)
    rim[COSINE] = half_width / radius
    rim[DECAY] = half_width / (2 * radius**2)
    return rim


def columns_within_radius(
    padded_rows: int, row: int, column: int, dx: float, box: tuple[int, int]
) -> np.ndarray:
    """Return the columns of each row whose centres lie within R = 1.

    Parameters
    ----------
    padded_rows
        Rows with ghosts.
    row, column
        First padded row and column beyond the axis.
    dx
        Cell size over R.
    box
        Padded columns [start, stop) that count.

    Returns
    -------
    ndarray
        Padded columns [start, stop) of each padded row, int64 (padded_rows, 2).
    """
    y = (np.arange(padded_rows) - row + 0.5) * dx
    reach = np.sqrt(np.maximum(0.0, 1.0 - y**2)) / dx
    stop = column + np.floor(reach + 0.5).astype(np.int64)
    start = 2 * column - stop
    return np.clip(np.stack([start, stop], axis=1), *box)


def diagonal(h2: np.ndarray, centre: tuple[int, int]) -> np.ndarray:
    """Return h2 along the diagonal.

    Parameters
    ----------
    h2
        Depth (ny, nx).
    centre
        First column and row beyond the axis.

    Returns
    -------
    ndarray
        Depth (nx) at the cells (column + k, row + k), NaN where the box has none.
    """
    ny, nx = h2.shape
    column = np.arange(nx)
    row = column - centre[0] + centre[1]
    inside = (row >= 0) & (row < ny)
    return np.where(inside, h2[np.clip(row, 0, ny - 1), column], np.nan)
