"""One run: a point in, a `Run` out. The time loop is compiled; here are its ends, snapshots and failures."""

import math
import time
from collections.abc import Callable
from dataclasses import dataclass

import numba
import numpy as np

from subslide.kernels import clock as k
from subslide.models.axial import Axial
from subslide.models.build import build
from subslide.models.plane import Plane
from subslide.naming import FRONT_THRESHOLDS, STATUSES
from subslide.points import Point
from subslide.study import choice

DRY_DEPTH = 1e-6
"""Over H2: below it a layer counts as dry (HLL instead of IFCP) and velocities are cut off smoothly."""

REST_CAP = 60.0
"""Cap on runs to rest, in R / sqrt(g H2 (1-r)): the paper's slowest column rests at 5, a_2 = 1.5, delta = 20 at 9."""

GROWTH = 1.5
LARGEST_BOX = 4.0
"""The box grows by GROWTH while the front reaches its edge, up to LARGEST_BOX times the paper's."""

CHUNK = 512
"""Samples between two looks at the clock on the wall."""

ENDED = {
    k.AT_REST: "ok",
    k.FRONT_AT_EDGE: "left_domain",
    k.NOT_FINITE: "diverged",
    k.NEGATIVE: "negative_depth",
    k.COLLAPSED: "step_collapse",
    k.SHEARED: "hyperbolicity_lost",
}
assert set(ENDED.values()) <= set(STATUSES)


@dataclass
class Run:
    """Result of a point's run: float64 arrays in SI units.

    What a model does not have (water of one layer, the diagonal of a radius) is NaN or None.

    Attributes
    ----------
    point
        The run.
    model, model_reason
        Model that was solved, and why, in words.
    dx, x
        Cell size and cell centres (x) in m from the axis.
    time
        Times (samples) of the series in s; the series are those of `naming.SERIES`.
    x_front
        Front (thresholds, samples) in m at each of `naming.FRONT_THRESHOLDS`.
    snapshot_time
        Times (snapshots) in s of the profiles (snapshots, x) and of the fields (snapshots, y, x), which are float32.
    L_f
        Length of the deposit (thresholds) in m; NaN if the run failed.
    status, status_detail
        How the run ended, one of `naming.STATUSES`, and what ended it, in words.
    steps, wall_seconds
        Time steps, and seconds of the time loop alone.
    time_at_rest
        Time in s since which no grain has moved; NaN if there is none.
    box_half_width
        Half-width of the box in m.
    """

    point: Point
    model: str
    model_reason: str
    dx: float
    x: np.ndarray
    time: np.ndarray
    x_front: np.ndarray
    max_abs_eta: np.ndarray
    max_abs_eta_outside: np.ndarray
    sediment_volume: np.ndarray
    water_volume: np.ndarray
    energy: np.ndarray
    nonhyperbolic_cells: np.ndarray
    hyperbolic_margin: np.ndarray
    snapshot_time: np.ndarray
    h2: np.ndarray
    eta: np.ndarray
    h2_diagonal: np.ndarray | None
    h2_field: np.ndarray | None
    eta_field: np.ndarray | None
    L_f: np.ndarray
    status: str
    status_detail: str
    steps: int
    wall_seconds: float
    time_at_rest: float
    box_half_width: float


def solve(point: Point, threads: int = 1, progress: Callable[[float], object] | None = None) -> Run:
    """Return the `Run` of a point; a numerical failure is a status, never an exception.

    Parameters
    ----------
    point
        The run.
    threads
        Cores for one plane run; no result depends on it.
    progress
        Function that is called with the fraction of the run's time that is done.
    """
    numba.set_num_threads(max(1, min(threads, numba.config.NUMBA_NUM_THREADS)))
    box = point.half_cells
    while True:
        run = attempt(point, box, progress)
        grown = math.ceil(box * GROWTH)
        if run.status != "left_domain" or grown > LARGEST_BOX * point.half_cells:
            return run
        box = grown


def attempt(point: Point, box: int, progress: Callable[[float], object] | None) -> Run:
    """Return the run in a box of `box` cells from the axis, its surface watched within the smallest box."""
    time_scale = point.time_scale
    cap = REST_CAP / math.sqrt(1.0 - point.r) * time_scale
    end = cap if point.t_end is None else point.t_end
    times = [t for t in point.profile_times if t <= end]
    model = build(point, box, point.half_cells, DRY_DEPTH)
    clock = np.array([0.0, 0.0, math.inf, -1.0])
    if point.t_end is None:
        clock[k.REST_FROM] = max(times[-1] / time_scale if times else 0.0, np.nextafter(0.0, 1.0))
    warm_up(model)
    chunks, snapshots, wall = [], [], 0.0
    for stop in sorted({*times, end}):
        clock[k.STOP] = stop / time_scale
        outcome, seconds = advance_to(
            model, clock, chunks, lambda now: progress and progress(now * time_scale / end)
        )
        wall += seconds
        if stop in times and clock[k.NOW] >= clock[k.STOP]:
            snapshots.append((stop, model.profile(), model.fields() if point.fields else None))
        if outcome != k.REACHED:
            break
    snapshots.append((clock[k.NOW] * time_scale, model.profile(), model.fields() if point.fields else None))
    series = np.concatenate(chunks)
    status = ENDED.get(outcome, "ok" if point.t_end is not None else "not_at_rest")
    detail = "" if status == "ok" else describe(status, model, series, time_scale)
    return make_run(point, model, series, snapshots, status, detail, wall, clock)


def thresholds(model: Axial | Plane) -> tuple[np.floating, ...]:
    """Return the front's thresholds in the working precision."""
    return tuple(model.scene.r.dtype.type(value) for value in FRONT_THRESHOLDS)


def warm_up(model: Axial | Plane) -> None:
    """Compile the time loop (or load it) with a segment of no length, which changes nothing but derived values."""
    model.advance(
        thresholds(model), np.array([0.0, 0.0, math.inf, -1.0]), np.empty((2, k.COLUMNS)), np.zeros(2, int)
    )


def advance_to(
    model: Axial | Plane, clock: np.ndarray, chunks: list[np.ndarray], look: Callable[[float], object]
) -> tuple[int, float]:
    """Return why the loop ended and its seconds; samples are appended to `chunks`, one for each instant.

    A loop that starts again samples its first instant again, so the last sample before it is dropped.
    """
    wall = 0.0
    while True:
        samples = np.empty((CHUNK, k.COLUMNS))
        counters = np.zeros(2, np.int64)
        started = time.perf_counter()
        model.advance(thresholds(model), clock, samples, counters)
        wall += time.perf_counter() - started
        if chunks:
            chunks[-1] = chunks[-1][:-1]
        chunks.append(samples[: counters[k.SAMPLES]])
        look(clock[k.NOW])
        if counters[k.OUTCOME] != k.FULL:
            return int(counters[k.OUTCOME]), wall


def describe(status: str, model: Axial | Plane, series: np.ndarray, time_scale: float) -> str:
    """Return one line on a run that did not end well: what, when, after how many steps, and where."""
    text = f"{STATUSES[status]}; t = {series[-1, k.TIME] * time_scale:.6g} s, step {len(series) - 1}"
    suspect = ""
    if status in ("diverged", "negative_depth", "step_collapse"):
        suspect = model.suspect()
    elif status == "hyperbolicity_lost":
        suspect = model.sheared()
    return f"{text}, {suspect}" if suspect else text


def make_run(
    point: Point,
    model: Axial | Plane,
    series: np.ndarray,
    snapshots: list[tuple],
    status: str,
    detail: str,
    wall: float,
    clock: np.ndarray,
) -> Run:
    """Return the `Run` of a finished loop, in SI units."""
    R, H2, time_scale = point.radius, point.column_height, point.time_scale
    volume = model.copies * H2 * R**model.dimensions
    lonely = model.scene.layers == 1
    column = series.T
    nothing = np.full(len(series), np.nan)
    profiles = [profile for _, profile, _ in snapshots]
    whole = [fields for _, _, fields in snapshots]
    front = column[k.FRONT : k.FRONT + len(FRONT_THRESHOLDS)] * R
    final = status in ("ok", "not_at_rest")

    def stack(values, name, kind=np.float64):
        if values[0] is None or name not in values[0]:
            return None
        return (np.stack([value[name] for value in values]) * H2).astype(kind)

    return Run(
        point=point,
        model=model.name,
        model_reason=choice.of(point).reason,
        dx=point.dx,
        x=model.x * R,
        time=column[k.TIME] * time_scale,
        x_front=front,
        max_abs_eta=nothing if lonely else column[k.ETA] * H2,
        max_abs_eta_outside=nothing if lonely else column[k.ETA_OUTSIDE] * H2,
        sediment_volume=column[k.GRAINS] * volume,
        water_volume=nothing if lonely else column[k.WATER] * volume,
        energy=column[k.ENERGY] * volume * H2 * point.g,
        nonhyperbolic_cells=column[k.COMPLEX] * model.copies,
        hyperbolic_margin=nothing if lonely else column[k.MARGIN],
        snapshot_time=np.array([t for t, _, _ in snapshots]),
        h2=stack(profiles, "h2"),
        eta=np.full((len(profiles), len(model.x)), np.nan) if lonely else stack(profiles, "eta"),
        h2_diagonal=stack(profiles, "h2_diagonal"),
        h2_field=stack(whole, "h2", np.float32),
        eta_field=stack(whole, "eta", np.float32),
        L_f=front[:, -1].copy() if final else np.full(len(FRONT_THRESHOLDS), np.nan),
        status=status,
        status_detail=detail,
        steps=len(series) - 1,
        wall_seconds=wall,
        time_at_rest=float(
            clock[k.REST_SINCE] * time_scale if clock[k.REST_SINCE] >= 0 and final else np.nan
        ),
        box_half_width=model.half_width * R,
    )
