"""One run: a point in, a `Run` out. The time loop is compiled; here are its ends, snapshots and failures."""

import math
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numba
import numpy as np

from subslide.kernels import clock as k
from subslide.kernels import measures, samples
from subslide.kernels.arrays import Track
from subslide.kernels.measures import Scales
from subslide.models.build import build
from subslide.models.model import Model
from subslide.naming import FINISHED, FRONT_THRESHOLDS, STATUSES
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

    Series are attributes too: `run.x_front` is `run.series["x_front"]`. What a model does not have (water of one layer,
    the diagonal of a radius) is NaN or None.

    Attributes
    ----------
    point
        The run.
    model, model_reason
        Model that was solved, and why, in words.
    dx, x
        Cell size and cell centres (x) in m from the axis.
    time
        Times (samples) of the series in s.
    series
        Series by their names in `naming.SERIES`, each (samples), but for `x_front`, the front (thresholds, samples) in
        m at each of `naming.FRONT_THRESHOLDS`.
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
    series: dict[str, np.ndarray]
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

    def __getattr__(self, name: str) -> np.ndarray:
        """Return the series of that name."""
        series = self.__dict__.get("series", {})
        if name not in series:
            raise AttributeError(f"a run has no {name}")
        return series[name]


class Snapshot(NamedTuple):
    """Time (s) of a snapshot, and scaled profiles and, where they are kept, fields of the plane, by name."""

    time: float
    profile: dict[str, np.ndarray]
    fields: dict[str, np.ndarray] | None


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
    chunks: list[np.ndarray] = []
    snapshots: list[Snapshot] = []
    wall = 0.0
    for stop in sorted({*times, end}):
        clock[k.STOP] = stop / time_scale
        outcome, seconds = advance_to(
            model, clock, chunks, lambda now: progress and progress(now * time_scale / end)
        )
        wall += seconds
        if stop in times and clock[k.NOW] >= clock[k.STOP]:
            snapshots.append(Snapshot(stop, model.profile(), model.fields() if point.fields else None))
        if outcome != k.REACHED:
            break
    last = float(clock[k.NOW] * time_scale)
    snapshots.append(Snapshot(last, model.profile(), model.fields() if point.fields else None))
    sampled = np.concatenate(chunks)
    status = ENDED.get(outcome, "ok" if point.t_end is not None else "not_at_rest")
    detail = "" if status == "ok" else describe(status, model, sampled, time_scale)
    return make_run(point, model, sampled, snapshots, (status, detail), wall, clock)


def thresholds(model: Model) -> tuple[float, ...]:
    """Return the front's thresholds in the working precision."""
    real = type(model.level)
    return tuple(real(value) for value in FRONT_THRESHOLDS)


def warm_up(model: Model) -> None:
    """Compile the time loop (or load it) with a segment of no length, which changes nothing but derived values."""
    track = Track(np.array([0.0, 0.0, math.inf, -1.0]), np.empty((2, samples.COLUMNS)), np.zeros(2, np.int64))
    model.advance(thresholds(model), track)


def advance_to(
    model: Model, clock: np.ndarray, chunks: list[np.ndarray], look: Callable[[float], object]
) -> tuple[int, float]:
    """Return why the loop ended and its seconds; samples are appended to `chunks`, one for each instant.

    A loop that starts again samples its first instant again, so the last sample before it is dropped.
    """
    wall = 0.0
    while True:
        track = Track(clock, np.empty((CHUNK, samples.COLUMNS)), np.zeros(2, np.int64))
        started = time.perf_counter()
        model.advance(thresholds(model), track)
        wall += time.perf_counter() - started
        if chunks:
            chunks[-1] = chunks[-1][:-1]
        chunks.append(track.samples[: track.counters[k.SAMPLES]])
        look(clock[k.NOW])
        if track.counters[k.OUTCOME] != k.FULL:
            return int(track.counters[k.OUTCOME]), wall


def describe(status: str, model: Model, sampled: np.ndarray, time_scale: float) -> str:
    """Return one line on a run that did not end well: what, when, after how many steps, and where."""
    text = f"{STATUSES[status]}; t = {sampled[-1, samples.TIME] * time_scale:.6g} s, step {len(sampled) - 1}"
    suspect = ""
    if status in ("diverged", "negative_depth", "step_collapse"):
        suspect = model.suspect()
    elif status == "hyperbolicity_lost":
        suspect = model.sheared()
    return f"{text}, {suspect}" if suspect else text


def series_in_si(model: Model, point: Point, sampled: np.ndarray) -> dict[str, np.ndarray]:
    """Return the series of a run by name, in SI units, from its samples; NaN where the model lacks a layer."""
    volume = model.copies * point.column_height * point.radius**model.dimensions
    si = Scales(point.radius, point.column_height, point.g, volume, model.copies)
    column = sampled.T
    series = {"x_front": column[samples.FRONT : samples.FRONT + samples.FRONTS] * si.length}
    for name, measured in measures.SERIES.items():
        known = model.settings.layers >= measured.layers
        values = column[samples.COLUMN[name]]
        series[name] = measured.si(values, si) if known else np.full(len(sampled), np.nan)
    return series


def in_metres(values: list[dict[str, np.ndarray]], name: str, height: float) -> np.ndarray:
    """Return one of the scaled profiles or fields of each snapshot in m, stacked along a new first axis."""
    return np.stack([of_snapshot[name] for of_snapshot in values]) * height


def make_run(
    point: Point,
    model: Model,
    sampled: np.ndarray,
    snapshots: list[Snapshot],
    ended: tuple[str, str],
    wall: float,
    clock: np.ndarray,
) -> Run:
    """Return the `Run` of a finished loop, in SI units. ended: its status and the detail of it."""
    height, time_scale = point.column_height, point.time_scale
    profiles = [snapshot.profile for snapshot in snapshots]
    whole = [snapshot.fields for snapshot in snapshots if snapshot.fields]
    series = series_in_si(model, point, sampled)
    front = series["x_front"]
    status, detail = ended
    final = status in FINISHED

    alone = model.settings.layers == 1
    rested = clock[k.REST_SINCE] >= 0 and final
    return Run(
        point=point,
        model=model.name,
        model_reason=choice.of(point).reason,
        dx=point.dx,
        x=model.x * point.radius,
        time=sampled[:, samples.TIME] * time_scale,
        series=series,
        snapshot_time=np.array([snapshot.time for snapshot in snapshots]),
        h2=in_metres(profiles, "h2", height),
        eta=np.full((len(profiles), len(model.x)), np.nan) if alone else in_metres(profiles, "eta", height),
        h2_diagonal=in_metres(profiles, "h2_diagonal", height) if "h2_diagonal" in profiles[0] else None,
        h2_field=in_metres(whole, "h2", height).astype(np.float32) if whole else None,
        eta_field=in_metres(whole, "eta", height).astype(np.float32) if whole else None,
        L_f=front[:, -1].copy() if final else np.full(len(FRONT_THRESHOLDS), np.nan),
        status=status,
        status_detail=detail,
        steps=len(sampled) - 1,
        wall_seconds=wall,
        time_at_rest=float(clock[k.REST_SINCE] * time_scale if rested else np.nan),
        box_half_width=model.half_width * point.radius,
    )
