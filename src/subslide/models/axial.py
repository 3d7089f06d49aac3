"""One dimension: a radius (round scenes, `radial`) or a line, with one layer or two."""

import math
from collections.abc import Sequence

import numpy as np

from subslide.kernels.advance_axial import advance_axial
from subslide.kernels.arrays import GHOSTS, Settings, Track, Watch
from subslide.kernels.boundary import OPEN, PAPER, WALL
from subslide.models import space
from subslide.models.axial_layout import LARGEST_LAYOUT, layout_of
from subslide.models.limits import LARGEST_BOX, LOST_GRAINS, MOST_CELLS
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
        A radius, whose cells are rings about the axis, or a line. On the open sea it is lengthened in place by still
        cells, before what moves comes to its end.
    walls
        What the (left, right) end is, see `kernels.boundary`.
    level
        The undisturbed surface, scaled.
    watched
        Cells from the axis within which the surface is watched, a whole number or one and a half.
    """

    copies = 1
    variables = ("h1", "u1", "h2", "u2")

    def __init__(
        self,
        name: str,
        settings: Settings,
        state: Sequence[np.ndarray | float],
        grid: Grid,
        *,
        walls: tuple[int, int],
        level: float,
        watched: float,
    ):
        """Put the state into padded arrays, and allocate those that a step works on."""
        radial = grid.geometry == "radius"
        self.name = name
        self.settings = settings
        self.level = type(settings.r)(level)
        self.dimensions = 2 if radial else 1
        self.walls = (int(walls[0]), int(walls[1]))
        self.watched = watched
        self.between = watched == round(watched) and PAPER not in walls  # the paper's box is told as it was
        first = round(grid.edges[0] / grid.dx)
        last = first + len(grid.edges) - 1
        reach = math.ceil(watched) if OPEN in self.walls else last - first
        self.box = max(first, -reach), min(last, reach)
        self.half_width = grid.edges[self.box[1] - first]
        self.space: space.Space | None = None
        self._lay(state, grid)
        grains = float(np.sum(self.mesh.weight * self.cells.h2, dtype=np.float64))
        self.watch = self._watch(
            (1 - LOST_GRAINS) * grains, *(h[-GHOSTS - 1] for h in (self.cells.h1, self.cells.h2))
        )

    def _lay(self, state: Sequence[np.ndarray | float], grid: Grid) -> None:
        """Put a state on a grid into arrays."""
        real = type(self.settings.r)
        first = round(grid.edges[0] / grid.dx)
        cells = len(grid.edges) - 1
        self.layout = (layout_of if cells <= LARGEST_LAYOUT else layout_of.__wrapped__)(
            grid.geometry,
            grid.dx,
            (first, cells),
            self.box,
            self.walls[1] == WALL,
            self.watched,
            np.dtype(real),
        )
        self.grid, self.mesh = grid, self.layout.mesh
        before = self.space
        self.space = space.taken(cells + 2 * GHOSTS, self.settings.order, real)
        self.cells, self.left, self.right, self.fluxes, self.terms, *_ = self.space
        for variable, values in zip(self.variables, state, strict=True):
            getattr(self.cells, variable)[GHOSTS:-GHOSTS] = values
        if before is not None:
            space.returned(before)

    def _watch(self, least_grains: float, still1: float, still2: float) -> Watch:
        """Return the `Watch` of the loop; still water is the state of the last cell at the start."""
        start, stop, beside, beyond = self.layout.columns
        return Watch(
            level=self.level,
            least_grains=least_grains,
            margin=64.0 * float(np.finfo(type(self.level)).eps),
            still1=still1,
            still2=still2,
            start=start,
            stop=stop,
            bottom=0,
            top=0,
            split=int(self.between),
            rim_left=self._rim(0, beside),
            rim_right=self._rim(1, beside),
            beside=beside,
            beyond=beyond,
            below_axis=0,
            above_axis=0,
        )

    def _rim(self, side: int, beside: int) -> int:
        """Return the first of the two padded columns where a front leaves on the left (0) or right side; 0 if nowhere.

        On the open sea they end LARGEST_BOX times the paper's box, where the sea has come so far, else the arrays.
        """
        first, last = GHOSTS, len(self.x) + GHOSTS - 2
        place = round(LARGEST_BOX * self.watched)
        place = beside + place - 2 if side else beside - place
        inside = place if first <= place <= last else 0
        return {OPEN: inside, PAPER: last if side else first}.get(self.walls[side], 0)

    @property
    def x(self) -> np.ndarray:
        """Centres (n) of the cells over R."""
        return self.layout.x

    def state(self) -> dict[str, np.ndarray]:
        """Return the cells, their edges, what the ends of the grid are, and from when a sea has an end."""
        sea = {
            "edges": self.grid.edges,
            "walls": np.array(self.walls),
            "free_until": np.array(self.free_until),
        }
        return super().state() | sea

    def resume(self, state: dict[str, np.ndarray]) -> None:
        """Put a state back, on a sea as long as it was."""
        self.walls = int(state["walls"][0]), int(state["walls"][1])
        self.free_until = float(state["free_until"])
        self._lay([state[name] for name in self.variables], self.grid._replace(edges=state["edges"]))
        self.watch = self._watch(self.watch.least_grains, self.watch.still1, self.watch.still2)

    def make_room(self, now: float) -> None:
        """Give the sea as many still cells more at each open end, or make that an end like the paper's.

        The latter where the last cell is not still water at rest, or beyond MOST_CELLS; waves are free until then.

        Parameters
        ----------
        now
            Scaled time.
        """
        state = [getattr(self.cells, name)[GHOSTS:-GHOSTS] for name in self.variables]
        still = (self.watch.still1, 0, self.watch.still2, 0)
        added, walls = [0, 0], list(self.walls)
        for side, end in enumerate((0, -1)):
            if walls[side] == OPEN:
                rests = all(values[end] == rest for values, rest in zip(state, still, strict=True))
                if rests and 2 * len(self.x) <= MOST_CELLS:
                    added[side] = len(self.x)
                else:
                    walls[side] = PAPER
                    self.free_until = min(self.free_until, now)
        self.walls = walls[0], walls[1]
        if any(added):
            first = round(self.grid.edges[0] / self.grid.dx)
            edges = np.arange(first - added[0], first + len(self.x) + added[1] + 1) * self.grid.dx
            self._lay([_longer(values, *added) for values in state], self.grid._replace(edges=edges))
        self.watch = self._watch(self.watch.least_grains, self.watch.still1, self.watch.still2)

    def release(self) -> None:
        """Give the arrays to runs to come."""
        if self.space is not None:
            space.returned(self.space)
            self.space = None

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


def _longer(values: np.ndarray, before: int, after: int) -> np.ndarray:
    """Return values (n) with so many more at both ends, like the first and the last."""
    return np.concatenate([np.full(before, values[0]), values, np.full(after, values[-1])])
