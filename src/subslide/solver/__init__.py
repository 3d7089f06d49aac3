"""One run: a point in, a `Run` out. The time loop is compiled; here are its ends, snapshots and failures."""

import math
from collections.abc import Callable

import numpy as np

from subslide.kernels import clock as k
from subslide.models.build import build
from subslide.models.limits import LARGEST_BOX
from subslide.naming import STATUSES
from subslide.points import Point
from subslide.solver.answer import describe, make_run, room_for_waves
from subslide.solver.checkpoint import Keeper, Saved
from subslide.solver.loop import Samples, advance_to, start_threads, warm_up
from subslide.solver.observing import Watchers
from subslide.solver.run import Run
from subslide.solver.snapshots import Snapshot, taken
from subslide.study import choice
from subslide.study.checking import check_point

DRY_DEPTH = 1e-6
"""Over H2: below it a layer counts as dry (HLL instead of IFCP) and velocities are cut off smoothly."""

GROWTH = 1.5
"""A box whose edge the front reaches grows by GROWTH, up to LARGEST_BOX times the paper's; the sea has no such edge."""

MOST_ROOM = 12
"""Most of it, over the paper's box: with fewer, waves of deep water come to the end of two runs in five."""

ROOM, REST = 1.15, 1.8
"""Room that a round sea starts with, over the way of a low wave until the end, and when most columns are at rest: by
REST/m in R / sqrt(g H2 (1-r))."""

SPARE = 32
"""Cells that a sea starts with beyond where its waves may come: steps look some vectors ahead."""

ALIKE = 128
"""Round seas have whole multiples of so many cells, so that runs share arrays and layouts; of a line without still
water at both ends the last bits depend on its length."""

ENDED = {
    k.AT_REST: "ok",
    k.FRONT_AT_EDGE: "left_domain",
    k.NOT_FINITE: "diverged",
    k.NEGATIVE: "negative_depth",
    k.COLLAPSED: "step_collapse",
    k.SHEARED: "hyperbolicity_lost",
}
assert set(ENDED.values()) <= set(STATUSES)


def solve(
    point: Point,
    threads: int = 1,
    progress: Callable[[float], object] | None = None,
    keeper: Keeper | None = None,
    profiles: bool = True,
) -> Run:
    """Return the `Run` of a point; a numerical failure is a status, never an exception.

    Parameters
    ----------
    point
        The run.
    threads
        Cores for one plane run; no result depends on it.
    progress
        Function that is called now and then with the time in s that the run has reached.
    keeper
        Where the state of a long run is saved, and was.
    profiles
        Whether profiles and fields are kept; all else has the same bits without.

    Returns
    -------
    Run
        Its answer, in the box that its front did not reach, or in the largest.

    Raises
    ------
    ConfigError
        If the point is none that a study could ask for: one line.
    """
    check_point(point)
    start_threads(threads)
    saved = keeper.under_way(point) if keeper else None
    box = saved.box if saved else first_box(point)
    while True:
        run = attempt(point, box, progress, keeper, saved, profiles)
        grown = math.ceil(box * GROWTH)
        if run.status != "left_domain" or choice.at_sea(point) or grown > LARGEST_BOX * point.half_cells:
            return run
        box, saved = grown, None


def first_box(point: Point) -> int:
    """Return the cells from the axis with which a run starts: of an open sea with room for its waves.

    Still cells are free, and room from the start costs less than more of it later, which no answer depends on.
    """
    box = point.half_cells
    if not choice.at_sea(point) or choice.of(point).model == "one-layer":
        return box
    last = max(point.profile_times, default=0.0) if point.t_end is None else point.t_end
    if choice.of(point).geometry == "line":
        room = 1.1 * point.wave_reach(last) / point.scaled_dx + SPARE
        return math.ceil(min(max(box, room), LARGEST_BOX * box + SPARE))
    if point.t_end is None and point.least_friction > 0:
        last = max(last, REST / point.least_friction / math.sqrt(1 - point.r) * point.time_scale)
    room = math.ceil((ROOM * point.wave_reach(last) / point.scaled_dx + SPARE) / ALIKE) * ALIKE
    return max(box, min(room, MOST_ROOM * box))


def attempt(
    point: Point,
    box: int,
    progress: Callable[[float], object] | None,
    keeper: Keeper | None = None,
    saved: Saved | None = None,
    profiles: bool = True,
) -> Run:
    """Return the run in a box of a size, its surface watched within the smallest box.

    Parameters
    ----------
    point
        The run.
    box
        Cells from the axis to the end of the box.
    progress, keeper, profiles
        As for `solve`.
    saved
        State in that box to go on from.

    Returns
    -------
    Run
        Its answer; `left_domain` if the front reached the end of the box.
    """
    time_scale = point.time_scale
    end = point.latest_end
    times = [t for t in point.profile_times if t <= end]
    model = build(point, box, DRY_DEPTH)
    room = room_for_waves(point, model)
    stops = sorted({*times, end})
    scaled = np.array(stops) / time_scale
    clock = k.started(later=() if profiles else scaled)
    if point.t_end is None:
        clock[k.REST_FROM] = max(times[-1] / time_scale if times else 0.0, np.nextafter(0.0, 1.0))
    warm_up(model)
    kept = Samples()
    snapshots: list[Snapshot] = []
    wall = 0.0
    watchers = Watchers(point, model, profiles)
    watchers.observe(model, 0, 0.0)
    if saved:
        model.resume(saved.model)
        watchers.resume(saved.model)
        clock, wall, snapshots = saved.clock, saved.wall, saved.snapshots
        kept = Samples(saved.samples)

    def place() -> int:
        """Return the place of the stop that the clock has; those before it, if no profiles are, are snapshots now."""
        now = int(np.searchsorted(scaled, clock[k.STOP], "right")) - 1
        snapshots.extend(taken(past, model, profiles, False) for past in stops[len(snapshots) : now])
        return now

    def look(seconds: float) -> None:
        """Show how far the run has come, and save it if that is due."""
        watchers.observe(model, len(kept.taken) - 1, float(clock[k.NOW]))
        if progress:
            progress(clock[k.NOW] * time_scale)
        if keeper and keeper.due:
            if not profiles:
                place()
            state = model.state() | watchers.state()
            keeper.save(point, Saved(box, state, clock, kept.taken, snapshots, wall + seconds))

    for leg in range(len(snapshots), len(stops)):
        clock[k.STOP] = scaled[leg]
        outcome, seconds = advance_to(model, clock, kept, look, bool(watchers.present))
        wall += seconds
        reached = clock[k.NOW] >= clock[k.STOP]
        stop = stops[leg if profiles else place()]
        if reached and stop in times:
            snapshots.append(taken(stop, model, profiles, point.fields))
        if outcome != k.REACHED or not profiles:
            break
    if not (reached and stop in times):  # else the end has its snapshot
        last = float(clock[k.NOW] * time_scale)
        snapshots.append(taken(last, model, profiles, point.fields))
    sampled = kept.taken
    status = ENDED.get(outcome, "ok" if point.t_end is not None else "not_at_rest")
    detail = "" if status == "ok" else describe(status, model, sampled, time_scale)
    run = make_run(point, model, sampled, snapshots, (status, detail), wall, clock, room)
    run.measured = watchers.measured(run, model)
    model.release()
    return run
