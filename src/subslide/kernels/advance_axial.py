"""The time loop in one dimension: all steps of a segment in one launch, since a launch costs as much as a step."""

import math

from numba import prange

from subslide.kernels import clock as k
from subslide.kernels.active import grain_span, moved_span, reached, split, water_may_be_alone, wet_span
from subslide.kernels.arrays import GHOSTS
from subslide.kernels.axial import (
    cell_speeds,
    edges,
    faces,
    fill_ghosts,
    fill_stuck,
    grain_edges,
    marks,
    update,
    water_cell_speeds,
    water_edges,
    water_faces,
)
from subslide.kernels.boundary import OPEN, PERIODIC
from subslide.kernels.hyperbolicity import judged
from subslide.kernels.jit import inlined, launch
from subslide.kernels.measures.budget import row_budget, row_hyperbolicity
from subslide.kernels.measures.front import front_position
from subslide.kernels.measures.surface import largest_displacement
from subslide.kernels.reduce import extremes


@inlined
def sample(s, c, weight, total, thresholds, probe, low, high, wet, now, row):
    """Write one sample into `row`; the columns are named in `clock`. Cells outside low..high-1 are still, those outside
    [wet[0], wet[1]) without grains."""
    level, _, beside, beyond, start, stop, margin, still1, still2 = probe
    n = c.h1.shape[0]
    row[k.TIME] = now
    for m in range(3):
        row[k.FRONT + m] = front_position(c.h2, c.h2, beside, wet[1], thresholds[m], s.dx)
    row[k.ETA_OUTSIDE] = largest_displacement(c.eta, level, max(start, beyond), stop)
    row[k.ETA] = max(row[k.ETA_OUTSIDE], largest_displacement(c.eta, level, start, min(beyond, stop)))
    water, grains, energy = row_budget(c.h1, c.u1, c.v1, c.h2, c.u2, c.v2, weight, s.r, low, high)
    rest = total[n] - (total[high] - total[low])
    row[k.WATER] = water + rest * still1
    row[k.GRAINS] = grains + rest * still2
    row[k.ENERGY] = energy + rest * (0.5 * (s.r * still1 * still1 + still2 * still2) + s.r * still1 * still2)
    row[k.COMPLEX] = 0.0
    row[k.MARGIN] = 1.0
    if s.layers == 2:
        left, right = wet_span(c.h2, s.dry_depth, max(wet[0], GHOSTS), min(wet[1], n - GHOSTS))
        row[k.COMPLEX], row[k.MARGIN] = row_hyperbolicity(
            c.h1, c.u1, c.v1, c.h2, c.u2, c.v2, c.ratio, s.r, s.dry_depth, margin, left, right
        )


@inlined
def rim_depth(h2, walls):
    """Return the largest depth of grains in the last two cells before an open end."""
    n = h2.shape[0]
    left = 0.0 if walls[0] != OPEN else max(h2[GHOSTS], h2[GHOSTS + 1])
    right = 0.0 if walls[1] != OPEN else max(h2[n - GHOSTS - 1], h2[n - GHOSTS - 2])
    return max(left, right)


@inlined
def advance(
    s,
    c,
    left,
    right,
    fx,
    mk,
    area,
    inverse_volume,
    weight,
    total,
    source,
    walls,
    probe,
    thresholds,
    clock,
    samples,
    counters,
):
    """Advance from clock[NOW] to clock[STOP], or until clock[REST_FROM] and rest, or until a run cannot go on.

    One sample is written before each step and one at the end, from samples[counters[SAMPLES]] on; counters[OUTCOME]
    says why the loop ended. `weight` (n + 4) is the volume of a cell per depth, 0 for ghosts, and `total` its sums from
    the left; `source` (n + 4) is -1 / (2 radius) for round scenes; `probe` is (level, volume of grains below which too
    much has left the box, padded column beside the axis, first beyond R, columns [start, stop) of the initial box,
    margin of the discriminant, depths h1 and h2 of still water).
    """
    real = type(s.r)
    least_grains = probe[1]
    n = counters[k.SAMPLES]
    cells = c.h1.shape[0]
    alone = water_may_be_alone(s)
    first = wet_first = 0
    last = wet_last = cells
    whole = True
    code = k.RUNNING
    while code == k.RUNNING:
        fill_ghosts(c, walls[0], walls[1])
        low, high = split(first, last, wet_first, wet_last)
        water_cell_speeds(s, c, first, low)
        cell_speeds(s, c, low, high)
        water_cell_speeds(s, c, high, last)
        low, high = moved_span(c.h1, c.u1, c.v1, c.h2, c.u2, c.v2, (probe[7], probe[8]), first, last)
        wet = grain_span(c.h2, c.u2, c.v2, wet_first, wet_last)
        if whole:
            first = wet_first = cells
            last = wet_last = 0
            whole = False
        first, last = reached(first, last, low, high, cells, s.lanes)
        wet_low, wet_high = wet if alone else (low, high)
        wet_first, wet_last = reached(wet_first, wet_last, wet_low, wet_high, cells, s.lanes)
        if walls[0] == PERIODIC:  # what leaves at one end comes in at the other
            first = wet_first = 0
            last = wet_last = cells
        now = clock[k.NOW]
        row = samples[n]
        sample(s, c, weight, total, thresholds, probe, low, high, wet, now, row)
        finite = math.isfinite(row[k.ENERGY]) and math.isfinite(row[k.WATER] + row[k.GRAINS])
        shallowest, square2, pace = extremes(c.h1, c.h2, c.square2, c.pace, low, high)
        rim = rim_depth(c.h2, walls)
        n += 1
        code = k.outcome(
            clock,
            finite,
            shallowest,
            square2,
            rim >= thresholds[0] or row[k.GRAINS] < least_grains,
            n == samples.shape[0],
        )
        code = judged(s, code, row[k.COMPLEX])
        if code == k.RUNNING:
            pace = max(pace, max(c.pace[0], c.pace[cells - 1]))
            stop = clock[k.STOP]
            stable = s.cfl * s.dx / pace if pace > real(0) else real(stop - now)
            if stable < k.SMALLEST_STEP * s.dx:
                code = k.COLLAPSED
            else:
                step = k.next_step(now, stop, stable)
                dt = real(step)
                start = max(first - GHOSTS, 0)  # of cells without ghosts; edge k is before cell k
                end = min(last - GHOSTS, cells - 2 * GHOSTS)
                wet_start, wet_end = split(start, end, wet_first - GHOSTS, wet_last - GHOSTS)
                if s.order != 1:
                    low, high = split(start, end + 2, wet_first - GHOSTS, wet_last - GHOSTS + 1)
                    faces(s, c, left, right, mk, source, low, high, dt)
                    water_faces(s, c, left, right, mk, source, start, low, dt)
                    water_faces(s, c, left, right, mk, source, high, end + 2, dt)
                low, high = split(start, end + 1, wet_first - GHOSTS, wet_last - GHOSTS)
                fill_stuck(s, c, fx, low, high, dt)
                if s.layers == 1:
                    grain_edges(s, left, right, fx, low, high)
                else:
                    edges(s, c, left, right, fx, low, high)
                    water_edges(s, c, left, right, fx, start, low)
                    water_edges(s, c, left, right, fx, high, end + 1)
                marks(s, c, fx, mk, area, inverse_volume, start, end, wet_start, wet_end, walls[0], dt)
                update(s, c, fx, mk, area, inverse_volume, start, end, wet_start, wet_end, dt)
                clock[k.NOW] = stop if now + step >= stop else now + dt
    counters[k.SAMPLES] = n
    counters[k.OUTCOME] = code


@launch
def advance_axial(
    s,
    c,
    left,
    right,
    fx,
    mk,
    area,
    inverse_volume,
    weight,
    total,
    source,
    walls,
    probe,
    thresholds,
    clock,
    samples,
    counters,
):
    """Run `advance` in a parallel region of one, where arrays are known not to overlap; see `jit.launch`."""
    for _ in prange(1):
        advance(
            s,
            c,
            left,
            right,
            fx,
            mk,
            area,
            inverse_volume,
            weight,
            total,
            source,
            walls,
            probe,
            thresholds,
            clock,
            samples,
            counters,
        )
