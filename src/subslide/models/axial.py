"""One dimension: a radius (round scenes, `radial`) or a line, with one layer or two."""

import numpy as np

from subslide.kernels.advance_axial import advance_axial
from subslide.kernels.arrays import GHOSTS, Cells, Fluxes, Marks, Side, allocate
from subslide.models.limits import LOST_GRAINS, first_sheared, first_suspect


class Axial:
    """A state on n cells and the time loop that moves it.

    scene: `kernels.arrays.Scene` in the working precision. state: (h1, u1, h2, u2), each (n), scaled. radial: whether
    cells are rings about the axis. walls: what the (left, right) end is, see `kernels.boundary`. level: the
    undisturbed surface. watched: cells from the axis within which the surface is watched.
    """

    copies = 1

    def __init__(self, name, scene, state, grid, *, radial, walls, level, watched):
        real = type(scene.r)
        n = len(grid.centres)
        padded = n + 2 * GHOSTS
        self.name = name
        self.scene = scene
        self.level = real(level)
        self.x = grid.centres
        self.half_width = grid.edges[-1]
        self.dimensions = 2 if radial else 1
        self.cells = allocate(Cells, (padded,), real)
        for field, values in zip(("h1", "u1", "h2", "u2"), state, strict=True):
            getattr(self.cells, field)[GHOSTS:-GHOSTS] = values
        own = Side(*(getattr(self.cells, field) for field in Side._fields))
        self.left, self.right = (
            (own, own) if scene.order == 1 else (allocate(Side, (padded,), real) for _ in range(2))
        )
        self.fluxes = allocate(Fluxes, (n + 1,), real)
        self.marks = allocate(Marks, (padded,), real)
        self.marks.keep1[:] = self.marks.keep2[:] = 1
        dx = grid.dx
        r = self.x if radial else np.ones(n)
        self.area = (grid.edges if radial else np.ones(n + 1)).astype(real)
        self.inverse_volume = (1 / (r * dx)).astype(real)
        self.weight = np.zeros(padded, real)
        self.weight[GHOSTS:-GHOSTS] = r * dx * (2 * np.pi if radial else 1)
        self.total = np.concatenate([[0.0], np.cumsum(self.weight, dtype=np.float64)])
        self.source = np.zeros(padded, real)
        if radial:
            self.source[GHOSTS:-GHOSTS] = -0.5 / self.x
            self.source[GHOSTS - 1] = -self.source[GHOSTS]  # mirrored, so that nothing passes a wall
            self.source[-GHOSTS] = -self.source[-GHOSTS - 1] if walls[1] else -0.5 / (self.x[-1] + dx)
        self.walls = (int(walls[0]), int(walls[1]))
        beside = int(np.searchsorted(self.x, 0.0))
        beyond = int(np.searchsorted(self.x, 1.0))
        near = np.flatnonzero(np.abs(self.x) < watched * dx)
        margin = 64.0 * float(np.finfo(real).eps)
        columns = np.array([beside, beyond, near[0], near[-1] + 1]) + GHOSTS
        least = (1 - LOST_GRAINS) * float(np.sum(self.weight * self.cells.h2, dtype=np.float64))
        still = state[0][-1], state[2][-1]
        self.probe = (self.level, least, *(int(column) for column in columns), margin, *still)

    def advance(self, thresholds, clock, samples, counters):
        """Run the time loop; see `advance_axial`."""
        advance_axial(
            self.scene,
            self.cells,
            self.left,
            self.right,
            self.fluxes,
            self.marks,
            self.area,
            self.inverse_volume,
            self.weight,
            self.total,
            self.source,
            self.walls,
            self.probe,
            thresholds,
            clock,
            samples,
            counters,
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
        return first_sheared(self.cells, ("h1", "u1", "h2", "u2"), self.scene)
