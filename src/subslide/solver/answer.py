"""From the scaled samples and snapshots of a loop to a run in SI units and words."""

import math

import numpy as np

from subslide import scenes
from subslide.kernels import clock as k
from subslide.kernels import measures, samples
from subslide.kernels.measures import Scales
from subslide.keys import names
from subslide.models.limits import inner
from subslide.models.model import Model
from subslide.naming import FINISHED, FRONT_THRESHOLDS, STATUSES
from subslide.points import Point
from subslide.solver.arrest import time_of_arrest
from subslide.solver.run import Run
from subslide.solver.snapshots import Snapshot, profiles_in_si
from subslide.study import choice

SMEARED = 4
"""Cells by which a scheme lets a wave be early: where the box was tried against one six times as wide, the surface then
differed by 0.3 % at most before `wave_free_until`, from 100 cells on and a_H 0.2 to 10."""


def describe(status: str, model: Model, sampled: np.ndarray, time_scale: float) -> str:
    """Return one line on a run that did not end well: what, when, after how many steps, and where.

    Parameters
    ----------
    status
        Status of the run.
    model
        What was run, in its last state.
    sampled
        Samples (samples, columns), scaled.
    time_scale
        Time (s) of scaled time 1.

    Returns
    -------
    str
        The line.
    """
    text = f"{STATUSES[status]}; t = {sampled[-1, samples.TIME] * time_scale:.6g} s, step {len(sampled) - 1}"
    suspect = ""
    if status in ("diverged", "negative_depth", "step_collapse"):
        suspect = model.suspect()
    elif status == "hyperbolicity_lost":
        suspect = model.sheared()
    return f"{text}, {suspect}" if suspect else text


def series_in_si(model: Model, point: Point, sampled: np.ndarray, stood: bool) -> dict[str, np.ndarray]:
    """Return the series of a run in SI units.

    Parameters
    ----------
    model
        What was run.
    point
        The run.
    sampled
        Samples (samples, columns), scaled.
    stood
        Whether no grain ever moved.

    Returns
    -------
    dict
        Series by name, see `Run`; NaN where the model lacks a layer, or the x axis grains.
    """
    volume = model.copies * point.column_height * point.radius**model.dimensions
    si = Scales(point.radius, point.column_height, point.g, volume, model.copies)
    column = sampled.T
    front = column[samples.FRONT : samples.FRONT + samples.FRONTS]
    # 0 where no cell beyond the axis reaches the threshold: there is the edge of a dam, or nothing
    at_axis = choice.of(point).geometry == "line" and column[samples.COLUMN["sediment_volume"]].max() > 0
    series = {"x_front": np.where((front > 0) | at_axis, front * si.length, np.nan)}
    side = scenes.front(point)
    if side is not None:
        series["x_front"][:, : None if stood else 1] = side * si.length
    alone, fitted = model.settings.layers == 1, choice.is_fitted(point)
    nothing = np.full(len(sampled), np.nan)
    series["eta_gauge"] = nothing if alone or fitted else column[samples.GAUGE] * si.height
    for name, measured in measures.SERIES.items():
        known = model.settings.layers >= measured.layers and not (fitted and measured.wave)
        series[name] = measured.si(column[samples.COLUMN[name]], si) if known else nothing
    return series


def room_for_waves(point: Point, model: Model) -> float:
    """Return how far the outermost cell that is not still water is from the open edge of the box, less SMEARED cells.

    Parameters
    ----------
    point
        The run.
    model
        What is to be run, in its first state.

    Returns
    -------
    float
        Distance (m) along an axis; infinite on a sea without end, NaN without an open edge, or where nothing is known
        of waves.
    """
    if point.boundary not in names.LEAVING or model.settings.layers == 1 or choice.is_fitted(point):
        return math.nan
    if choice.at_sea(point):
        return math.inf
    values = inner(model.cells, model.variables).values()
    moved = np.any([value != value.flat[-1] for value in values], axis=0)
    axes = range(moved.ndim)
    used = [model.x[moved.any(axis=tuple(other for other in axes if other != axis))] for axis in axes]
    reach = float(np.abs(np.concatenate(used)).max(initial=0.0))
    return max(0.0, float(model.half_width - reach) - (SMEARED + 0.5) * point.scaled_dx) * point.radius


def wave_free_until(point: Point, room: float, time: np.ndarray, eta: np.ndarray) -> float:
    """Return when the first wave can be at the open edge of the box.

    Waves of some height outrun sqrt(g H) on still water of depth H: a crest of height e moves at 3 sqrt(g (H + e)) -
    2 sqrt(g H) (simple wave; a bore is slower).

    Parameters
    ----------
    point
        The run.
    room
        Distance (m) from `room_for_waves`.
    time, eta
        Times (samples) in s, and the largest displacement (m) of the surface beyond R.

    Returns
    -------
    float
        Time (s); beyond the end of the run if none can have been there, NaN as `room` is.
    """
    if math.isnan(room) or (math.isinf(room) and np.isfinite(eta).all()):
        return room
    still = point.wave_speed
    pace = 3 * np.sqrt(still**2 + point.g * np.fmax.accumulate(eta)) - 2 * still
    gone = np.append(0.0, np.cumsum(pace[1:] * np.diff(time)))
    if gone[-1] < room:
        return float(time[-1] + (room - gone[-1]) / pace[-1])
    return float(np.interp(room, gone, time))


def make_run(
    point: Point,
    model: Model,
    sampled: np.ndarray,
    snapshots: list[Snapshot],
    ended: tuple[str, str],
    wall: float,
    clock: np.ndarray,
    room: float,
) -> Run:
    """Return the `Run` of a finished loop, in SI units.

    Parameters
    ----------
    point
        The run.
    model
        What was run.
    sampled
        Samples (samples, columns), scaled.
    snapshots
        Snapshots in order, the end of the run last.
    ended
        Status of the run, and what ended it, in words.
    wall
        Seconds of the loop.
    clock
        Scaled times, see `kernels.clock`.
    room
        Distance (m) from `room_for_waves`.

    Returns
    -------
    Run
        Its answer.
    """
    time_scale = point.time_scale
    time = sampled[:, samples.TIME] * time_scale
    series = series_in_si(model, point, sampled, stood=clock[k.REST_SINCE] == 0)
    front = series["x_front"]
    status, detail = ended
    free = wave_free_until(point, room, time, series["max_abs_eta_outside"])
    final = status in FINISHED
    rested = final and clock[k.REST_SINCE] >= 0
    return Run(
        point=point,
        model=model.name,
        model_reason=choice.of(point).reason,
        dx=math.nan if choice.is_fitted(point) else point.dx,
        time=time,
        series=series,
        snapshot_time=np.array([snapshot.time for snapshot in snapshots]),
        **profiles_in_si(point, model, snapshots),
        L_f=front[:, -1].copy() if final else np.full(len(FRONT_THRESHOLDS), np.nan),
        status=status,
        status_detail=detail,
        steps=len(sampled) - 1,
        wall_seconds=wall,
        wave_free_until=float(np.minimum(free, model.free_until * time_scale)),
        time_of_arrest=np.array([time_of_arrest(time, one) if rested else np.nan for one in front]),
        time_at_rest=float(clock[k.REST_SINCE] * time_scale if rested else np.nan),
        box_half_width=model.half_width * point.radius,
        grid=choice.of(point).grid,
        grid_reason=choice.of(point).grid_reason,
    )
