"""The arrays that kernels work on.

All are padded by GHOSTS cells on each side and scaled: depths by H2, lengths by R, speeds by sqrt(g H2), time by
R / sqrt(g H2), so that g = 1 and every threshold is a plain number.

Deviation from the scaling in section 4: there depths are printed over H1, speeds over sqrt(g H1) and time over
sqrt(R / g), which is not what the system below them is scaled by.

Along a row of n cells, states stand in cells, reconstructed states at the two faces of each cell, and fluxes at edges.
Edge k is between its two cells, and between the right face of the one and the left face of the other:

    edge e                 0        1        2                n-1       n
    padded      +----+----|L  c  R|L  c  R|L  c  R|  ...  |L  c  R|----+----+
    cell i        0    1      2       3       4              n+1    n+2  n+3
                 ghosts                                               ghosts

so the edge e = k has the cell i = k + GHOSTS - 1 before it and the cell k + GHOSTS after it. `Cells`, `Side` and
`CellTerms` are indexed by padded cells i, `Fluxes` by edges e. In the plane rows lie along x, the row below first;
fluxes along y lie between two padded rows, and their edge e = k is between the cells k + GHOSTS of both.
"""

from typing import TYPE_CHECKING, Any, NamedTuple, Self

import numpy as np

from subslide.kernels.jit import inlined

GHOSTS = 2
"""The slope in the first ghost cell needs the second."""

BEFORE = GHOSTS - 1
"""Edge k of a row is between the padded cells k + BEFORE and k + GHOSTS."""


class Settings(NamedTuple):
    """Scaled numbers of a run and choices of its method, reals in the working precision, flags and counts integers.

    The kernels compiled for it are lean: they leave out what the choices from `speeds` on can do.
    """

    layers: int
    scheme: int  # place of the name in `keys.names.SCHEMES`; so are the flags below in theirs
    order: int
    r: float
    m: float  # tan(delta) R / H2, the friction number
    dx: float
    cfl: float
    dry_depth: float
    exact_front: int  # 1: grains run onto a dry bed with the exact flux of grains alone
    lanes: int  # numbers in 64 bytes: a vector
    speeds: int = 0
    law: int = 0
    law_1: float = 0.0  # numbers of the friction law, see `friction`
    law_2: float = 0.0
    law_3: float = 0.0
    treatment: int = 0
    as_printed: int = 0
    printed_bound: float = 0.0  # (1-r) tan(delta) g / sqrt(g H2), numbers in SI units: see `printed.braking`
    viscous_friction: int = 1  # 0: the viscosity does not see what friction holds


if TYPE_CHECKING:

    class GeneralSettings(Settings):
        """Settings for which kernels with every choice are compiled; see `is_general`."""

        general: int

        def __new__(cls, *values: Any, general: int) -> Self:
            """Take the values of `Settings`, in order, and the mark of the type."""

else:  # for numba a tuple of its own, with one field more
    GeneralSettings = NamedTuple("GeneralSettings", [*Settings.__annotations__.items(), ("general", int)])

LEAN_FIELDS = len(Settings._fields)


@inlined
def is_general(s):
    """Return whether the kernels are compiled with every choice, known by the type so that lean ones drop the rest."""
    return len(s) > LEAN_FIELDS


class Cells(NamedTuple):
    """State of each cell (velocities, not momenta) and what a step derives from it first."""

    h1: np.ndarray
    u1: np.ndarray
    v1: np.ndarray
    h2: np.ndarray
    u2: np.ndarray
    v2: np.ndarray
    eta: np.ndarray  # h1 + h2
    head2: np.ndarray  # r h1 + h2, whose slope drives the grains
    square2: np.ndarray  # |u2|^2
    slow_x: np.ndarray
    fast_x: np.ndarray
    slow_y: np.ndarray
    fast_y: np.ndarray
    pace: np.ndarray  # fastest wave along x plus fastest along y
    ratio: np.ndarray  # scratch of `measures.hyperbolicity`


class Side(NamedTuple):
    """State at one face of each cell, or of the face beside an edge."""

    eta: np.ndarray
    h1: np.ndarray
    u1: np.ndarray
    v1: np.ndarray
    h2: np.ndarray
    u2: np.ndarray
    v2: np.ndarray


class Fluxes(NamedTuple):
    """Through each edge: mass, normal momentum, tangential momentum and pressure product of both layers."""

    f1: np.ndarray
    m1: np.ndarray
    t1: np.ndarray
    p1: np.ndarray
    f2: np.ndarray
    m2: np.ndarray
    t2: np.ndarray
    p2: np.ndarray
    stuck: np.ndarray  # 1 where friction holds the grains on both sides at rest, else 0


class CellTerms(NamedTuple):
    """What a cell's update needs beside the fluxes through its edges."""

    keep1: np.ndarray  # fraction of the mass flux out of the cell that its water can feed
    keep2: np.ndarray  # the same for grains
    held: np.ndarray  # 1 where friction stops the grains in this step, else 0
    inner_p1x: np.ndarray  # pressure products across the cell (0 at first order)
    inner_p2x: np.ndarray
    inner_p1y: np.ndarray
    inner_p2y: np.ndarray


class Fan(NamedTuple):
    """Numbers of `motion.ends`, scaled: how the ends of the fan of a column that falls apart move."""

    slack: float  # how far the fan reaches into the column at the start
    lead: float  # and how far beyond it
    wave: float  # speed of its left end
    front: float  # speed of its right end at the start
    brake: float  # by which that end is slowed down
    evenly: float  # place of the left end over that of the right one when all cells up to it have one width
    braked: float  # time when the right end stops
    stop: float  # time when both have


class Motion(NamedTuple):
    """Cells of unequal sizes along a row of n, whose edges may move: edge e is at base + near left + far right.

    left and right are the ends of the fan (see `motion.ends`), three known functions of time. Places and volumes are
    float64; what a step takes of them is in the working precision, and from the same numbers.
    """

    base: np.ndarray
    near: np.ndarray
    far: np.ndarray
    edges: np.ndarray  # (n + 1) now
    ahead: np.ndarray  # at the end of a step
    drift: np.ndarray  # velocity of each edge in a step (n + 1)
    width: np.ndarray  # of each padded cell now
    inverse_width: np.ndarray
    before: np.ndarray  # weights of the differences to both neighbours in the slope of a padded cell
    after: np.ndarray
    gap: np.ndarray  # between the centres beside each edge (n + 1)
    growth: np.ndarray  # of each cell (n): its volume before a step over that after it, less 1
    lever: (
        np.ndarray
    )  # radius of each cell (n) in a step over its volume after it; on a line 1 over its width
    turn: float  # what a volume per radian is taken times: 2 pi, or 2 for both halves of a line
    widest: float  # the largest distance of two centres where grains may be, ever
    radial: float  # 1 in round scenes, 0 on a line


class Mesh(NamedTuple):
    """Sizes along a row of n cells: radii, areas and lengths over R.

    In the plane cells are squares, `area` and `inverse_volume` are not used, and `weight` and `total` are of one row.
    Where cells move, areas are of the middle of a step, inverse volumes of its end, and the others of now.
    """

    area: np.ndarray  # of each edge (n + 1): its radius in round scenes, 1 on a line
    inverse_volume: np.ndarray  # one over the size of each cell (n): 1 / (radius dx), or 1 / dx
    source: np.ndarray  # of each padded cell: -1 / (2 radius) in round scenes, 0 on a line
    weight: np.ndarray  # volume of each padded cell per depth, 0 for ghosts
    total: np.ndarray  # sums of `weight` from the left end of the box, float64
    size: float  # of that box: volumes and energy are of it, and of what has gone beyond it less still water


class Watch(NamedTuple):
    """Numbers by which a run is watched, the same at every step; rows and columns are padded."""

    level: float  # undisturbed surface, in the working precision
    least_grains: float  # volume of grains below which too much has left the box
    margin: float  # of the discriminant: below it round-off decides
    still1: float  # depths of still water, where nothing need be solved
    still2: float
    start: int  # columns [start, stop) and rows [bottom, top) where the surface is watched
    stop: int
    bottom: int
    top: int
    split: int  # 1 if the ends of that region lie between two cells, 0 if on the centres of its outermost
    rim_left: (
        int  # on a line or radius: first of the two columns where a front leaves on that side, 0 if nowhere
    )
    rim_right: int
    beside: int  # first column beyond the axis
    beyond: int  # on a line or radius: first column beyond R
    below_axis: int  # in the plane: the two rows beside the x axis
    above_axis: int


class Track(NamedTuple):
    """What a time loop is asked for and answers: see `clock` and `samples`."""

    clock: np.ndarray
    samples: np.ndarray
    counters: np.ndarray


def allocate(kind, shape, dtype):
    """Return `kind` with one zeroed array of `shape` each, their addresses spread over the 4 KiB page.

    Arrays that share their offset modulo 4 KiB evict each other: half the speed.
    """
    arrays = []
    size = int(np.prod(shape))
    itemsize = np.dtype(dtype).itemsize
    for k in range(len(kind._fields)):
        shift = (k * 5 % 31) * 128 // itemsize
        buffer = np.zeros(size + shift, dtype=dtype)
        arrays.append(buffer[shift:].reshape(shape))
    return kind(*arrays)


@inlined
def row_of(c, j):
    """Return row j of `Cells` in the plane as `Cells` of one row."""
    return Cells(
        c.h1[j],
        c.u1[j],
        c.v1[j],
        c.h2[j],
        c.u2[j],
        c.v2[j],
        c.eta[j],
        c.head2[j],
        c.square2[j],
        c.slow_x[j],
        c.fast_x[j],
        c.slow_y[j],
        c.fast_y[j],
        c.pace[j],
        c.ratio[j],
    )


@inlined
def side_row(side, j):
    """Return row j of a `Side` in the plane."""
    return Side(side.eta[j], side.h1[j], side.u1[j], side.v1[j], side.h2[j], side.u2[j], side.v2[j])


@inlined
def side_row_turned(side, j):
    """Return row j of a `Side` seen along y: its velocities change places."""
    return Side(side.eta[j], side.h1[j], side.v1[j], side.u1[j], side.h2[j], side.v2[j], side.u2[j])


@inlined
def flux_row(f, j):
    """Return row j of `Fluxes` in the plane."""
    return Fluxes(f.f1[j], f.m1[j], f.t1[j], f.p1[j], f.f2[j], f.m2[j], f.t2[j], f.p2[j], f.stuck[j])
