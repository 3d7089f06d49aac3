"""A column on a fitted grid: a radius, or the right half of a line, with one layer or two."""

from collections.abc import Sequence

import numpy as np

from subslide.kernels.advance_fitted import advance_fitted
from subslide.kernels.arrays import GHOSTS, Fan, Mesh, Motion, Settings, Track, Watch
from subslide.models import fan as layout
from subslide.models import space
from subslide.models.model import Model
from subslide.points import PAPER_BOX, Point


class Fitted(Model):
    """State on n cells that go with the grains, and the time loop that moves both.

    Parameters
    ----------
    name
        The model's name.
    settings
        Scaled numbers in the working precision; `dx` is the smallest cell at the start.
    state
        (h1, u1, h2, u2), each (n), scaled.
    mesh
        Sizes of the cells at the start.
    motion, fan
        Their edges, and how these move.
    level
        The undisturbed surface, scaled.
    """

    copies = 1
    variables = ("h1", "u1", "h2", "u2")
    half_width = PAPER_BOX

    def __init__(
        self,
        name: str,
        settings: Settings,
        state: Sequence[np.ndarray | float],
        mesh: Mesh,
        motion: Motion,
        fan: Fan,
        *,
        level: float,
    ):
        """Put the state into padded arrays, and allocate those that a step works on."""
        real = type(settings.r)
        self.name, self.settings = name, settings
        self.mesh, self.motion, self.fan = mesh, motion, fan
        self.level = real(level)
        self.dimensions = 2 if motion.radial else 1
        self.space = space.taken(len(mesh.weight), settings.order, real)
        self.cells, self.left, self.right, self.fluxes, self.terms, *_ = self.space
        for variable, values in zip(self.variables, state, strict=True):
            getattr(self.cells, variable)[GHOSTS:-GHOSTS] = values
        self.watch = Watch(
            level=self.level,
            least_grains=0.0,
            margin=64.0 * float(np.finfo(real).eps),
            still1=self.cells.h1[-GHOSTS - 1],
            still2=self.cells.h2[-GHOSTS - 1],
            start=GHOSTS,  # no surface is watched
            stop=GHOSTS,
            bottom=0,
            top=0,
            split=0,
            rim_left=0,
            rim_right=0,
            beside=GHOSTS,
            beyond=GHOSTS,
            below_axis=0,
            above_axis=0,
        )

    @property
    def x(self) -> np.ndarray:
        """Centres (n) of the cells now."""
        return 0.5 * (self.motion.edges[1:] + self.motion.edges[:-1])

    @property
    def width(self) -> np.ndarray:
        """Widths (n) of the cells now."""
        return np.diff(self.motion.edges)

    def state(self) -> dict[str, np.ndarray]:
        """Return the cells and their edges."""
        return super().state() | {"edges": self.motion.edges}

    def resume(self, state: dict[str, np.ndarray]) -> None:
        """Put a state back, its cells where they were."""
        super().resume(state)
        self.motion.edges[:] = state["edges"]

    def release(self) -> None:
        """Give the arrays to runs to come."""
        space.returned(self.space)

    def advance(self, thresholds: tuple[float, ...], track: Track) -> None:
        """Run the time loop; see `advance_fitted`."""
        advance_fitted(
            self.settings,
            self.cells,
            self.left,
            self.right,
            self.fluxes,
            self.terms,
            self.mesh,
            self.motion,
            self.fan,
            self.watch,
            thresholds,
            track,
        )

    def profile(self) -> dict[str, np.ndarray]:
        """Return h2 (n) as a float64 copy, the innermost cell first; the surface is not known."""
        h2 = self.cells.h2[GHOSTS:-GHOSTS].astype(np.float64)
        return {"h2": h2, "eta": np.full(len(h2), np.nan)}


def mesh_of(point: Point, radial: bool) -> tuple[Mesh, Motion, Fan]:
    """Return the cells of a column at the start, and how they move.

    Parameters
    ----------
    point
        The run.
    radial
        Whether they are rings about the axis, or the right half of a line.

    Returns
    -------
    tuple of Mesh, Motion and Fan
        Places, weights of edges and sums float64, what steps take of them in the working precision of the point.
    """
    real = np.dtype(point.dtype).type
    fan = layout.fan_of(point)
    far = layout.far_end(point, fan)
    base, near, ahead = coefficients = layout.coefficients(point.cells, far)
    edges = layout.first_edges(point, fan, coefficients)
    left, right = layout.ends(fan, point.latest_end / point.time_scale)
    at_end = base + near * left + ahead * right
    cells, padded = point.cells, point.cells + 2 * GHOSTS
    turn = 2 * np.pi if radial else 2.0
    power = 2 if radial else 1
    motion = Motion(
        base=base,
        near=near,
        far=ahead,
        edges=edges,
        ahead=edges.copy(),
        drift=np.zeros(cells + 1, real),
        width=np.zeros(padded, real),
        inverse_width=np.zeros(padded, real),
        before=np.zeros(padded, real),
        after=np.zeros(padded, real),
        gap=np.zeros(cells + 1, real),
        growth=np.zeros(cells, real),
        lever=np.zeros(cells, real),
        turn=turn,
        widest=real((at_end[1:] - at_end[:-1]).max()),
        radial=float(radial),
    )
    total = np.zeros(padded + 1)
    total[-GHOSTS - 1] = turn * far**power / power
    mesh = Mesh(
        area=np.ones(cells + 1, real),
        inverse_volume=np.zeros(cells, real),
        source=np.zeros(padded, real),
        weight=np.zeros(padded, real),
        total=total,
        size=turn * PAPER_BOX**power / power,
    )
    return mesh, motion, fan
