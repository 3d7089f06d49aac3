"""A column on a fitted grid: a radius, or the right half of a line, with one layer or two."""

import math
from collections.abc import Sequence

import numpy as np

from subslide.kernels.advance_fitted import advance_fitted
from subslide.kernels.arrays import GHOSTS, Cells, CellTerms, Fluxes, Mesh, Motion, Settings, Side, Track, Watch, allocate
from subslide.kernels.motion import ends, place
from subslide.models import fan
from subslide.models.model import Model
from subslide.points import PAPER_BOX, Point


class Fitted(Model):
    """State on n cells whose edges move, and the time loop that moves it."""

    copies = 1
    variables = ("h1", "u1", "h2", "u2")
    half_width = PAPER_BOX

    def __init__(self, name, settings, state, mesh, motion, numbers, level):
        """Put the state into padded arrays, and allocate those that a step works on."""
        real = type(settings.r)
        self.name, self.settings, self.mesh, self.motion, self.fan = name, settings, mesh, motion, numbers
        self.level = real(level)
        self.dimensions = 2 if motion.radial else 1
        padded = len(mesh.weight)
        self.cells = allocate(Cells, (padded,), real)
        for variable, values in zip(self.variables, state, strict=True):
            getattr(self.cells, variable)[GHOSTS:-GHOSTS] = values
        self.cells.ratio[:] = 1
        if settings.order == 1:
            self.left = self.right = Side(*(getattr(self.cells, variable) for variable in Side._fields))
        else:
            self.left, self.right = (allocate(Side, (padded,), real) for _ in range(2))
        self.fluxes = allocate(Fluxes, (padded - 2 * GHOSTS + 1,), real)
        self.terms = allocate(CellTerms, (padded,), real)
        self.terms.keep1[:] = self.terms.keep2[:] = 1
        end = GHOSTS
        self.watch = Watch(
            level=self.level, least_grains=0.0, margin=64.0 * float(np.finfo(real).eps),
            still1=state[0][-1], still2=state[2][-1], start=end, stop=end, bottom=0, top=0, split=0, rim_left=0, rim_right=0,
            beside=GHOSTS, beyond=end, below_axis=0, above_axis=0,
        )

    @property
    def x(self):
        """Return the centres of the cells now."""
        edges = self.motion.edges
        return 0.5 * (edges[1:] + edges[:-1])

    @property
    def width(self):
        return np.diff(self.motion.edges)

    def advance(self, thresholds, track):
        advance_fitted(self.settings, self.cells, self.left, self.right, self.fluxes, self.terms, self.mesh, self.motion, self.fan, self.watch, thresholds, track)

    def profile(self):
        h2 = self.cells.h2[GHOSTS:-GHOSTS].astype(np.float64)
        return {"h2": h2, "eta": np.full(len(h2), np.nan)}


def mesh_of(point, radial, end, real):
    n = point.cells
    numbers = fan.numbers(point, end)
    braked = ends(numbers, 2 * end)[1]
    whole = fan.parts(n)
    far = max(fan.FAR, braked * (1 + fan.BEYOND * whole[2] / (whole[0] + whole[1])))
    base, near, ahead = fan.coefficients(n, far)
    left, right = ends(numbers, 0.0)
    edges = base + near * left + ahead * right
    padded = n + 2 * GHOSTS
    row, edge = (lambda: np.zeros(padded, real)), (lambda: np.zeros(n + 1, real))
    turn = 2 * np.pi if radial else 2.0
    parts = fan.parts(n)
    motion = Motion(base=base, near=near, far=ahead, edges=edges, ahead=edges.copy(), drift=edge(), width=row(), inverse_width=row(),
        before=row(), after=row(), gap=edge(), growth=np.ones(n, real), lever=np.zeros(n, real), turn=turn,
        mix=fan.MIX, widest=real(2 * far), radial=float(radial))
    size = 0.5 if radial else 1.0
    total = np.zeros(padded + 1)
    total[padded - GHOSTS] = turn * (0.5 * far**2 if radial else far)
    mesh = Mesh(area=np.ones(n + 1, real), inverse_volume=np.zeros(n, real), source=row(), weight=row(), total=total,
        size=turn * (0.5 * PAPER_BOX**2 if radial else PAPER_BOX))
    place(mesh, motion)
    return mesh, motion, numbers
