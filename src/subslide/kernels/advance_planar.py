"""The time loop in the plane: four launches a step, each over rows or blocks of them.

Blocks do not depend on the number of threads, nor does any result. Each launch is a function of its own: numba fuses
loops over the same range that follow each other in one function, and an update would overtake its neighbours' marks.
"""

import math

import numpy as np
from numba import prange

from subslide.kernels import clock as k
from subslide.kernels.active import (
    FIRST,
    HIGH,
    LAST,
    LOW,
    WET_FIRST,
    WET_HIGH,
    WET_LAST,
    WET_LOW,
    grain_span,
    joint,
    joint_wet,
    moved_span,
    split,
    water_may_be_alone,
    wet_span,
    widen,
)
from subslide.kernels.arrays import GHOSTS
from subslide.kernels.boundary import OPEN, PERIODIC, join_plane
from subslide.kernels.hyperbolicity import judged
from subslide.kernels.jit import driver, inlined, launch
from subslide.kernels.measures.budget import row_budget, row_hyperbolicity
from subslide.kernels.measures.front import front_position
from subslide.kernels.measures.surface import largest_displacement
from subslide.kernels.planar import (
    cell_speeds,
    edges,
    fill_ghosts,
    fill_stuck,
    marks,
    turned,
    update,
    water_cell_speeds,
    water_edges,
)
from subslide.kernels.planar_faces import faces
from subslide.kernels.reduce import extremes, largest, smallest

BLOCK = 16
"""Rows a block: few enough to share among cores, many enough that the row before it costs little."""

(
    PACE,
    SQUARE2,
    SHALLOWEST,
    RIM,
    ROW_ETA,
    ROW_OUTSIDE,
    ROW_WATER,
    ROW_GRAINS,
    ROW_ENERGY,
    ROW_COMPLEX,
    ROW_MARGIN,
) = range(11)
ROW_COLUMNS = 11


@inlined
def measure_row(s, c, j, walls, probe, inside, weight, total, span, row):
    """Write what the padded row j adds to a sample into `row`, and into `span` which of its cells are not still."""
    level, _, start, stop, first_row, last_row, margin, still1, still2 = probe
    ny, nx = c.h1.shape
    h1, u1, v1, h2, u2, v2 = c.h1[j], c.u1[j], c.v1[j], c.h2[j], c.u2[j], c.v2[j]
    low, high = moved_span(h1, u1, v1, h2, u2, v2, (still1, still2), span[FIRST], span[LAST])
    span[LOW] = low
    span[HIGH] = high
    span[WET_LOW], span[WET_HIGH] = grain_span(h2, u2, v2, span[WET_FIRST], span[WET_LAST])
    row[SHALLOWEST], row[SQUARE2], pace = extremes(h1, h2, c.square2[j], c.pace[j], low, high)
    row[PACE] = max(pace, max(c.pace[j, 0], c.pace[j, nx - 1]))
    row[RIM] = 0.0
    if walls[0] == OPEN:
        row[RIM] = max(row[RIM], max(h2[GHOSTS], h2[GHOSTS + 1]))
    if walls[1] == OPEN:
        row[RIM] = max(row[RIM], max(h2[nx - GHOSTS - 1], h2[nx - GHOSTS - 2]))
    if (j < GHOSTS + 2 and walls[2] == OPEN) or (j >= ny - GHOSTS - 2 and walls[3] == OPEN):
        row[RIM] = max(row[RIM], largest(h2, 0, nx))
    row[ROW_ETA] = 0.0
    row[ROW_OUTSIDE] = 0.0
    if first_row <= j < last_row:
        before = largest_displacement(c.eta[j], level, start, inside[j, 0])
        beyond = largest_displacement(c.eta[j], level, inside[j, 1], stop)
        row[ROW_OUTSIDE] = max(before, beyond)
        row[ROW_ETA] = max(
            row[ROW_OUTSIDE], largest_displacement(c.eta[j], level, inside[j, 0], inside[j, 1])
        )
    water, grains, energy = row_budget(h1, u1, v1, h2, u2, v2, weight, s.r, low, high)
    rest = total[nx] - (total[high] - total[low])
    row[ROW_WATER] = water + rest * still1
    row[ROW_GRAINS] = grains + rest * still2
    row[ROW_ENERGY] = energy + rest * (
        0.5 * (s.r * still1 * still1 + still2 * still2) + s.r * still1 * still2
    )
    left, right = wet_span(h2, s.dry_depth, max(span[WET_LOW], GHOSTS), min(span[WET_HIGH], nx - GHOSTS))
    row[ROW_COMPLEX], row[ROW_MARGIN] = row_hyperbolicity(
        h1, u1, v1, h2, u2, v2, c.ratio[j], s.r, s.dry_depth, margin, left, right
    )


@inlined
def collect(s, c, axis, thresholds, spans, rows, now, sample):
    """Write one sample from the rows' parts, summed in the rows' order; the columns are named in `clock`."""
    sample[k.TIME] = now
    for m in range(3):
        stop = max(spans[axis[0], WET_HIGH], spans[axis[1], WET_HIGH])
        sample[k.FRONT + m] = front_position(c.h2[axis[0]], c.h2[axis[1]], axis[2], stop, thresholds[m], s.dx)
    for column in range(k.ETA, k.COLUMNS):
        sample[column] = 0.0
    sample[k.MARGIN] = 1.0
    for j in range(GHOSTS, rows.shape[0] - GHOSTS):
        sample[k.ETA] = max(sample[k.ETA], rows[j, ROW_ETA])
        sample[k.ETA_OUTSIDE] = max(sample[k.ETA_OUTSIDE], rows[j, ROW_OUTSIDE])
        sample[k.WATER] += rows[j, ROW_WATER]
        sample[k.GRAINS] += rows[j, ROW_GRAINS]
        sample[k.ENERGY] += rows[j, ROW_ENERGY]
        sample[k.COMPLEX] += rows[j, ROW_COMPLEX]
        sample[k.MARGIN] = min(sample[k.MARGIN], rows[j, ROW_MARGIN])


@inlined
def survey_row(s, c, walls, probe, inside, weight, total, spans, rows, whole, j):
    """Fill what a step derives from the padded row j, and `rows`; see `survey`."""
    nx = c.h1.shape[1]
    span = spans[j]
    if whole:
        span[FIRST] = span[WET_FIRST] = 0
        span[LAST] = span[WET_LAST] = nx
    low, high = split(span[FIRST], span[LAST], span[WET_FIRST], span[WET_LAST])
    water_cell_speeds(s, c, j, span[FIRST], low)
    cell_speeds(s, c, j, low, high)
    water_cell_speeds(s, c, j, high, span[LAST])
    measure_row(s, c, j, walls, probe, inside, weight, total, span, rows[j])
    if whole:
        span[FIRST] = span[WET_FIRST] = nx
        span[LAST] = span[WET_LAST] = 0


@launch
def survey(s, c, walls, probe, inside, weight, total, spans, rows, whole):
    """Fill what a step derives from the cells that the last one may have changed (all if `whole`), and `rows`."""
    for j in prange(spans.shape[0]):
        survey_row(s, c, walls, probe, inside, weight, total, spans, rows, whole, np.int64(j))


@inlined
def block_fluxes(s, c, left, right, lower, upper, fx, fy, mk, spans, dt, b, blocks):
    """Fill the fluxes of block b of the rows; see `fill_fluxes`."""
    ny, nx = fy.f1.shape[0] - 1, fx.f1.shape[1] - 1
    first = b * BLOCK
    last = first + BLOCK if b < blocks - 1 else ny + 1  # the last edge has the ghost row above it
    for j in range(first - 1, last):
        p = j + GHOSTS - 1
        n = p + 1
        now = n if s.order == 1 else b
        new = n if s.order == 1 else 2 * b + (j - first + 1) % 2
        old = p if s.order == 1 else 4 * b + 1 - new
        if s.order != 1:
            start, stop = joint(spans, n - 1, min(n + 1, ny + 2 * GHOSTS - 1), -2, 0, nx + 2)
            faces(s, c, mk, n, left, right, lower, upper, now, new, start, stop, dt)
        if first <= j < ny:
            start, stop = joint(spans, n, n, -GHOSTS, 1 - GHOSTS, nx + 1)
            low, high = joint_wet(spans, n, n, -GHOSTS, -GHOSTS, start, stop)  # no grains at either end
            rows = (n, n)
            sides = (now, now)
            fill_stuck(s, c, fx.stuck, j, rows, GHOSTS - 1, 1, low, high, dt)
            edges(s, fx, j, c.slow_x, c.fast_x, rows, right, left, sides, GHOSTS - 1, 1, low, high)
            water_edges(s, fx, j, c.slow_x, c.fast_x, rows, right, left, sides, GHOSTS - 1, 1, start, low)
            water_edges(s, fx, j, c.slow_x, c.fast_x, rows, right, left, sides, GHOSTS - 1, 1, high, stop)
        if j >= first:
            start, stop = joint(spans, p, n, -GHOSTS, -GHOSTS, nx)
            low, high = joint_wet(spans, p, n, -GHOSTS, -GHOSTS, start, stop)
            rows = (p, n)
            sides = (old, now)
            below, above = turned(upper), turned(lower)
            fill_stuck(s, c, fy.stuck, j, rows, GHOSTS, 0, low, high, dt)
            edges(s, fy, j, c.slow_y, c.fast_y, rows, below, above, sides, GHOSTS, 0, low, high)
            water_edges(s, fy, j, c.slow_y, c.fast_y, rows, below, above, sides, GHOSTS, 0, start, low)
            water_edges(s, fy, j, c.slow_y, c.fast_y, rows, below, above, sides, GHOSTS, 0, high, stop)


@launch
def fill_fluxes(s, c, left, right, lower, upper, fx, fy, mk, spans, dt, blocks):
    """Fill the fluxes of all edges within the rows' spans, a block of rows at a time.

    At first order the four sides are the cells' own states. At second order each block has rows of its own for them
    (its first row's faces below belong to the row before), few enough to stay in a core's cache.
    """
    for b in prange(blocks):
        block_fluxes(s, c, left, right, lower, upper, fx, fy, mk, spans, dt, np.int64(b), blocks)


@launch
def fill_marks(s, c, fx, fy, mk, spans, dt, ny):
    """Fill `Marks` of the cells within the rows' spans."""
    for j in prange(ny):
        marks(s, c, fx, fy, mk, spans, np.int64(j), dt)


@launch
def update_cells(s, c, fx, fy, mk, spans, dt, ny):
    """Advance the cells within the rows' spans by dt."""
    for j in prange(ny):
        update(s, c, fx, fy, mk, spans, np.int64(j), dt)


@driver
def advance_planar(
    s,
    c,
    left,
    right,
    lower,
    upper,
    fx,
    fy,
    mk,
    weight,
    total,
    walls,
    probe,
    inside,
    axis,
    spans,
    rows,
    thresholds,
    clock,
    samples,
    counters,
):
    """Advance from clock[NOW] to clock[STOP], or until clock[REST_FROM] and rest, or until a run cannot go on.

    One sample is written before each step and one at the end, from samples[counters[SAMPLES]] on; counters[OUTCOME]
    says why the loop ended. `weight` (padded columns) is a cell's area, 0 for ghosts, and `total` its sums from the
    left; `probe` is (level, volume of grains below which too much has left the box, padded columns [start, stop) and
    rows [first, last) of the initial box, margin of the discriminant, depths h1 and h2 of still water); `inside`
    (padded rows, 2) the columns within R; `axis` the two padded rows beside the x axis and the first padded column
    beyond the y axis; `spans` see `span`; `rows` is scratch.
    """
    n = counters[k.SAMPLES]
    ny = fx.f1.shape[0]
    blocks = (ny + BLOCK - 1) // BLOCK
    whole = True
    code = k.RUNNING
    while code == k.RUNNING:
        fill_ghosts(c, walls)
        survey(s, c, walls, probe, inside, weight, total, spans, rows, whole)
        widen(
            spans, c.h1.shape[1], s.lanes, water_may_be_alone(s), walls[0] == PERIODIC or walls[2] == PERIODIC
        )
        whole = False
        now = clock[k.NOW]
        sample = samples[n]
        collect(s, c, axis, thresholds, spans, rows, now, sample)
        finite = math.isfinite(sample[k.ENERGY]) and math.isfinite(sample[k.WATER] + sample[k.GRAINS])
        n += 1
        code = k.outcome(
            clock,
            finite,
            smallest(rows[:, SHALLOWEST], 0, rows.shape[0]),
            largest(rows[:, SQUARE2], 0, rows.shape[0]),
            largest(rows[:, RIM], 0, rows.shape[0]) >= thresholds[0] or sample[k.GRAINS] < probe[1],
            n == samples.shape[0],
        )
        code = judged(s, code, sample[k.COMPLEX])
        if code == k.RUNNING:
            pace = largest(rows[:, PACE], 0, rows.shape[0])
            stop = clock[k.STOP]
            stable = s.cfl * s.dx / pace if pace > 0.0 else stop - now
            if stable < k.SMALLEST_STEP * s.dx:
                code = k.COLLAPSED
            else:
                step = k.next_step(now, stop, stable)
                dt = type(s.r)(step)
                fill_fluxes(s, c, left, right, lower, upper, fx, fy, mk, spans, dt, blocks)
                fill_marks(s, c, fx, fy, mk, spans, dt, ny)
                join_plane(mk.keep1, walls)
                join_plane(mk.keep2, walls)
                update_cells(s, c, fx, fy, mk, spans, dt, ny)
                clock[k.NOW] = stop if now + step >= stop else now + dt
    counters[k.SAMPLES] = n
    counters[k.OUTCOME] = code
