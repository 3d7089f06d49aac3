"""What points cost, told before they are solved: seconds on one core, memory, bytes on the disk.

Measured on columns of 50 to 3,200 cells (docs/design/measured.md). A run to rest is taken to end when friction has
stopped its grains, at 1.8/m in R / sqrt(g H2 (1-r)) with m = tan(delta) R / H2 (91 of 96 columns had come to rest by
then, the last by 2.5/m), or after its last snapshot, and at the solver's cap where nothing brakes it. A run whose step
collapses is longer than any estimate. Imports no kernels.
"""

import math
from collections.abc import Sequence
from typing import NamedTuple

from subslide import scenes
from subslide.keys import names
from subslide.points import Point
from subslide.study import choice

START = {"all": 0.004, "series": 0.003, "summary": 0.001}
"""Seconds of a run of no steps and of its part of a record, by what is kept of it."""
SUMMARY = 3_000
"""Bytes of a run in a record that keeps a summary."""
SECONDS_PER_CELL = {
    ("axial", 1): 2.5e-8,
    ("axial", 2): 3.7e-8,
    ("fitted", 1): 4e-8,
    ("fitted", 2): 6e-8,
    ("planar", 1): 4e-8,
    ("planar", 2): 6.5e-8,
}
"""Of one step, by kind of grid and order, on one core with the lean kernels."""
GENERAL = 2.3
"""Times as many with the general ones."""
WATCHED, WATCHED_CELL = 1.2e-4, 3e-8
"""Seconds more of a step of a run with gauges or footprints, which stops after each; and of a cell of the plane."""

ENOUGH = 200
"""Runs by which the seconds of more are told."""

REST = 1.8
"""Time to rest over 1/m in R / sqrt(g H2 (1-r))."""
FAR = 1.25
"""Way of the front over R/m, beyond the radius of its column; none was seen to go further."""
FASTEST = 2.0
"""Speed of a front over sqrt(g H2), that of a dam break on a dry bed."""
BOXES = (1.0, 1.5, 2.25, 3.375)
"""Widths over the smallest of the boxes that a run may need, one after the other."""
SEA = 0.25
"""Time that a cell of the open sea beyond the box takes, over that of one in it, by the waves' way at the end: it has
no grains, and is at rest until they come."""
FILM = 1.1
"""Way of the thinnest grains that a profile shows over that of their front."""
MOST_AT_SEA = 4e6
"""Cells to which the solver lengthens a sea at most."""

GROWING, SETTLED = 0.16, 0.96
"""Steps on a fitted grid, over its cells and at a Courant number of 0.9: while the fan grows, over (1 + sqrt(1 + a_H) /
sqrt(1-r)) times the logarithm of its growth; and later over the scaled time times sqrt(1 + a_H) and over where it ends.
Within 16 % for 318 runs of 24 to 110 cells."""
SPREAD, FIRST_FAN = 1.3, 6.0
"""End of the fan over 1/m beyond the radius, and its width at the start times the number of cells to 3/2."""

PROCESS = 250e6
"""Bytes of a process that has loaded its kernels (180e6), and some; compiling them takes up to 1e9 (`jobs.warm`)."""
ARRAYS, AXIAL_ARRAYS = 44, 80
"""Numbers of the working precision that the solver keeps of each cell of the plane, and of a line or radius."""
SERIES, AT_GAUGE = 12, 6
"""Numbers of 8 bytes that a sample has, and that it has at each gauge."""
FOOTPRINT = 4
"""Numbers that footprints keep of each cell."""
MOST_SAMPLES = 10_000
"""Samples of a run that a record keeps."""
COPIES = 4
"""Of the samples, in memory, while a run is made of them."""
FIELD_BYTES, KEPT_BYTES = 20, 4
"""Of each value of a field at a snapshot, in memory and in a record."""


class Cost(NamedTuple):
    """What a run costs, by itself.

    Attributes
    ----------
    seconds
        Of its steps, on one core.
    memory
        Bytes of the process that solves it, its results once included.
    series, profiles
        Bytes of what a record may keep of it.
    """

    seconds: float
    memory: float
    series: float
    profiles: float

    def kept(self, keep: str) -> float:
        """Return the bytes in a record by what is kept, one of `subslide.keys.kept.WORDS`."""
        if keep == "summary":
            return min(SUMMARY, self.series)
        return self.series + (self.profiles if keep == "all" else 0)


COST = "_cost"
"""Attribute of points whose cost was asked for: no value of theirs can change afterwards."""


class _Size(NamedTuple):
    """Cells that a point is solved on in all its boxes, those that the last has, those of its profiles, and steps."""

    solved: float
    cells: float
    row: float
    steps: float
    kind: str


def of(point: Point) -> Cost:
    """Return what a run costs, in some 20 us the first time.

    Parameters
    ----------
    point
        The run.

    Returns
    -------
    Cost
        Seconds, memory and bytes.
    """
    known: Cost | None = vars(point).get(COST)
    if known is None:
        size = _size(point)
        fields = 2 * KEPT_BYTES * size.cells if point.fields else 0
        series = 8 * (SERIES + AT_GAUGE * len(point.gauges)) * min(size.steps, MOST_SAMPLES)
        profiles = _snapshots(point) * (8 * 3 * size.row + fields)
        profiles += FOOTPRINT * KEPT_BYTES * size.cells if point.footprints else 0
        known = Cost(_seconds(point, size), _memory(point, size), series, profiles)
        vars(point)[COST] = known
    return known


def of_all(points: Sequence[Point], keep: str) -> float:
    """Return the estimated seconds of many runs, from some of them.

    Parameters
    ----------
    points
        The runs.
    keep
        What a record keeps of each.

    Returns
    -------
    float
    """
    some = points[:: 1 + len(points) // ENOUGH]
    return sum(seconds(point, keep) for point in some) * len(points) / max(1, len(some))


def seconds(point: Point, keep: str = "all") -> float:
    """Return the estimated seconds of a run, its part of a record included, on one core.

    Parameters
    ----------
    point
        The run.
    keep
        What a record keeps of it.

    Returns
    -------
    float
        Seconds.
    """
    return START[keep] + of(point).seconds


def memory(point: Point) -> float:
    """Return the most bytes that a process which solves a point needs, its results once included."""
    return of(point).memory


def _size(point: Point) -> _Size:
    """Return how large the grids of a point are, and how many steps it takes."""
    geometry = choice.of(point).geometry
    planar = geometry in ("quarter", "plane")
    end = _end(point)
    if choice.is_fitted(point):
        cells = point.cells
        return _Size(cells, cells, 3 * cells, _fitted_steps(point, end), "fitted")  # with the places of cells
    half = point.half_cells
    reach = _reach(point, end)
    wide = 2 if geometry in ("line", "plane") else 1
    # a step is limited by the fastest wave along each axis, sqrt(H1 + H2) scaled
    steps = end * math.sqrt(point.scaled_level) / (point.cfl * point.scaled_dx) * (1 + planar) + 1
    kind = "planar" if planar else "axial"
    if choice.at_sea(point):
        far = min(wide * point.wave_reach(end * point.time_scale) / point.scaled_dx, MOST_AT_SEA)
        kept = wide * max(half, min(FILM * reach / point.scaled_dx, BOXES[-1] * half))
        return _Size(kept + SEA * max(0.0, far - kept), 2 * max(far, kept), kept, steps, kind)
    boxes = [width for n, width in enumerate(BOXES) if n == 0 or BOXES[n - 1] * point.half_box < reach]
    rows = [wide * width * half for width in boxes]
    cells = [row**2 if planar else row for row in rows]
    return _Size(sum(cells), cells[-1], rows[-1], steps, kind)


def _fitted_steps(point: Point, end: float) -> float:
    """Return the steps of a run on a fitted grid to a scaled time."""
    grains, water = math.sqrt(1 - point.r), math.sqrt(point.scaled_level)
    brake = _brake(point)
    way = min(SPREAD / brake if brake else math.inf, FASTEST * grains * end)
    growth = math.log1p(way * point.cells**1.5 / FIRST_FAN)
    steps = GROWING * (1 + water / grains) * growth + SETTLED * end * water / (1 + way)
    return point.cells * 0.9 / point.cfl * steps + 1


def _end(point: Point) -> float:
    """Return the scaled time at which a run is taken to end."""
    cap = point.latest_end / point.time_scale
    if point.t_end is not None:
        return cap
    last = (
        max((t for t in point.profile_times if t <= cap * point.time_scale), default=0.0) / point.time_scale
    )
    brake = _brake(point)
    return min(max(REST / brake / math.sqrt(1 - point.r), last), cap) if brake else cap


def _brake(point: Point) -> float:
    """Return the least scaled deceleration by friction of grains that move; 0 if they may move for ever."""
    if point.as_printed == "friction" or not point.friction_in_viscosity:
        return 0.0
    return point.least_friction


def _reach(point: Point, end: float) -> float:
    """Return how far from the axis, over R, grains may go in a box that grows; 0 if it does not grow."""
    if point.boundary not in names.LEAVING:
        return 0.0
    if point.scene == "cylinder":
        start = 1.0
    elif point.scene == "ellipse":
        ratio = scenes.options(point)["elongation"]
        start = math.sqrt(max(ratio, 1 / ratio))
    elif point.scene == "columns":
        options = scenes.options(point)
        start = 1 + math.hypot(options["x"], options["y"]) + options["distance"] / 2
    else:
        return math.inf
    brake = _brake(point)
    return start + min(FAR / brake if brake else math.inf, FASTEST * end)


def _seconds(point: Point, size: _Size) -> float:
    """Return the seconds of a point of a size."""
    slower = GENERAL if choice.of(point).general else 1
    of_cell, of_step = SECONDS_PER_CELL[size.kind, point.order] * slower, 0.0
    if point.gauges or point.footprints:
        of_cell, of_step = of_cell + WATCHED_CELL * (size.kind == "planar"), WATCHED
    return (of_cell * size.solved + of_step) * size.steps


def _memory(point: Point, size: _Size) -> float:
    """Return the bytes of a process that solves a point of a size."""
    real = 4 if point.dtype == "float32" else 8
    arrays = (ARRAYS if size.kind == "planar" else AXIAL_ARRAYS) * real * size.cells
    fields = 2 * FIELD_BYTES * size.cells * _snapshots(point) if point.fields else 0
    footprints = FOOTPRINT * 8 * size.cells if point.footprints else 0
    return (
        PROCESS
        + arrays
        + fields
        + footprints
        + COPIES * 8 * (SERIES + AT_GAUGE * len(point.gauges)) * size.steps
        + 8 * 3 * 4 * size.row * _snapshots(point)
    )


def _snapshots(point: Point) -> int:
    """Return the number of snapshots, the end of the run among them."""
    return 1 + len(point.profile_times)
