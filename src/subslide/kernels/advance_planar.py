"""The time loop in the plane: four launches a step, each over rows or blocks of them.

Blocks do not depend on the number of threads, nor does any result. Each launch is a function of its own: numba fuses
loops over the same range that follow each other in one function, and an update would overtake its neighbours' terms.
"""

import numpy as np
from numba import prange

from subslide.kernels import clock as k
from subslide.kernels import measures, samples
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
    widen,
)
from subslide.kernels.arrays import BEFORE, GHOSTS, flux_row, row_of, side_row, side_row_turned
from subslide.kernels.boundary import PERIODIC, join_plane, lets_out
from subslide.kernels.edge.film import may_overtop
from subslide.kernels.front import front_position
from subslide.kernels.gauge import displacement
from subslide.kernels.hyperbolicity import judged
from subslide.kernels.jit import driver, inlined, launch
from subslide.kernels.measures import RowSpan
from subslide.kernels.measures.surface import largest_between
from subslide.kernels.planar import (
    cell_speeds,
    fill_ghosts,
    fill_stuck,
    fill_terms,
    slow_down,
    update,
    water_cell_speeds,
)
from subslide.kernels.planar_faces import faces
from subslide.kernels.radiation import decay, radiate
from subslide.kernels.reduce import extremes, largest, smallest
from subslide.kernels.row import edges, film_edges, tangential, water_edges, water_tangential

BLOCK = 16
"""Rows a block: few enough to share among cores, many enough that the row before it costs little."""

PACE, SQUARE2, NEGATIVE, THIN, RIM, MEASURED = range(6)
"""Columns of the scratch `rows`: what each row adds to a sample."""

ROW_COLUMNS = MEASURED + measures.COUNT


@inlined
def rim_depth(h2, j, rows, walls):
    """Return the largest depth of grains of the padded row j in the last two cells before an open end."""
    n = h2.shape[0]
    depth = 0.0
    if lets_out(walls[0]):
        depth = max(depth, max(h2[GHOSTS], h2[GHOSTS + 1]))
    if lets_out(walls[1]):
        depth = max(depth, max(h2[n - GHOSTS - 1], h2[n - GHOSTS - 2]))
    if (j < GHOSTS + 2 and lets_out(walls[2])) or (j >= rows - GHOSTS - 2 and lets_out(walls[3])):
        depth = max(depth, largest(h2, 0, n))
    return depth


@inlined
def measure_row(s, c, j, rows, mesh, walls, watch, inside, span, row):
    """Write what the padded row j of `rows` adds to a sample into `row`, and into `span` which cells are not still."""
    still = watch.still1, watch.still2
    low, high = moved_span(c.h1, c.u1, c.v1, c.h2, c.u2, c.v2, still, span[FIRST], span[LAST])
    wet_low, wet_high = grain_span(c.h2, c.u2, c.v2, span[WET_FIRST], span[WET_LAST])
    span[LOW], span[HIGH] = low, high
    span[WET_LOW], span[WET_HIGH] = wet_low, wet_high
    least1, least2, row[SQUARE2], pace = extremes(c.h1, c.h2, c.square2, c.pace, low, high)
    row[NEGATIVE] = min(least1, least2)
    row[THIN] = 1.0 if may_overtop(s, least1, s.dx) else 0.0
    row[PACE] = max(pace, max(c.pace[0], c.pace[c.pace.shape[0] - 1]))
    row[RIM] = rim_depth(c.h2, j, rows, walls)
    watched = watch.bottom <= j < watch.top
    start, stop = (watch.start, watch.stop) if watched else (0, 0)
    inner, outer = (inside[j, 0], inside[j, 1]) if watched else (0, 0)
    columns = RowSpan(low, high, wet_low, wet_high, start, inner, outer, stop)
    measures.fill(s, c, mesh, watch, columns, row, MEASURED)


@inlined
def collect(s, c, watch, thresholds, spans, rows, now, sample):
    """Write one sample by the columns of `samples`, the rows' parts joined in the rows' order."""
    sample[samples.TIME] = now
    below, above = watch.below_axis, watch.above_axis
    stop = max(spans[below, WET_HIGH], spans[above, WET_HIGH])
    for m in range(samples.FRONTS):
        sample[samples.FRONT + m] = front_position(
            c.h2[below], c.h2[above], watch.beside, stop, thresholds[m], s.dx
        )
    sample[samples.GAUGE] = displacement(c.eta[below], c.eta[above], watch.level, watch.beside, s.dx)
    measures.start_joining(sample, samples.MEASURED)
    for j in range(GHOSTS, rows.shape[0] - GHOSTS):
        measures.join(sample, samples.MEASURED, rows[j], MEASURED)
    if watch.split:
        columns = watch.level, watch.start, watch.stop
        largest = float(largest_between(c.eta[watch.top - 1], c.eta[watch.top], *columns))
        if watch.bottom < above:
            lower = largest_between(c.eta[watch.bottom - 1], c.eta[watch.bottom], *columns)
            largest = max(largest, float(lower))
        sample[samples.ETA] = max(sample[samples.ETA], largest)
        sample[samples.ETA_OUTSIDE] = max(sample[samples.ETA_OUTSIDE], largest)


@inlined
def survey_row(s, c, mesh, walls, watch, inside, spans, rows, whole, j):
    """Fill what a step derives from the padded row j, and `rows`; see `survey`."""
    row = row_of(c, j)
    n = row.h1.shape[0]
    span = spans[j]
    if whole:
        span[FIRST] = span[WET_FIRST] = 0
        span[LAST] = span[WET_LAST] = n
    low, high = split(span[FIRST], span[LAST], span[WET_FIRST], span[WET_LAST])
    water_cell_speeds(s, row, span[FIRST], low)
    cell_speeds(s, row, low, high)
    water_cell_speeds(s, row, high, span[LAST])
    measure_row(s, row, j, spans.shape[0], mesh, walls, watch, inside, span, rows[j])
    if whole:
        span[FIRST] = span[WET_FIRST] = n
        span[LAST] = span[WET_LAST] = 0


@launch
def survey(s, c, mesh, walls, watch, inside, spans, rows, whole):
    """Fill what a step derives from the cells that the last one may have changed (all if `whole`), and `rows`."""
    for j in prange(spans.shape[0]):
        survey_row(s, c, mesh, walls, watch, inside, spans, rows, whole, np.int64(j))


@inlined
def row_fluxes(s, f, slow, fast, before, after, shift, step, span, wet, film):
    """Fill the fluxes through the edges [span) of a row, those of water alone outside [wet); see `row`."""
    start, stop = span
    low, high = wet
    edges(s, f, slow, fast, before, after, shift, step, low, high)
    if film:
        film_edges(s, f, before, after, shift, step, low, high)
    tangential(s, f, before, after, shift, step, low, high)
    water_edges(s, f, slow, fast, before, after, shift, step, start, low)
    water_tangential(f, before, after, shift, step, start, low)
    water_edges(s, f, slow, fast, before, after, shift, step, high, stop)
    water_tangential(f, before, after, shift, step, high, stop)


@inlined
def block_fluxes(s, c, left, right, lower, upper, fx, fy, terms, spans, film, dt, b, blocks):
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
            faces(s, c, terms, n, (left, right, lower, upper), now, new, start, stop, dt)
        if first <= j < ny:
            start, stop = joint(spans, n, n, -GHOSTS, 1 - GHOSTS, nx + 1)
            low, high = joint_wet(spans, n, n, -GHOSTS, -GHOSTS, start, stop)  # no grains at either end
            fill_stuck(s, c, fx.stuck[j], (n, n), BEFORE, 1, low, high, dt)
            slow, fast = (c.slow_x[n], c.slow_x[n]), (c.fast_x[n], c.fast_x[n])
            before, after = side_row(right, now), side_row(left, now)
            row_fluxes(
                s, flux_row(fx, j), slow, fast, before, after, BEFORE, 1, (start, stop), (low, high), film
            )
        if j >= first:
            start, stop = joint(spans, p, n, -GHOSTS, -GHOSTS, nx)
            low, high = joint_wet(spans, p, n, -GHOSTS, -GHOSTS, start, stop)
            fill_stuck(s, c, fy.stuck[j], (p, n), GHOSTS, 0, low, high, dt)
            slow, fast = (c.slow_y[p], c.slow_y[n]), (c.fast_y[p], c.fast_y[n])
            before, after = side_row_turned(upper, old), side_row_turned(lower, now)
            row_fluxes(
                s, flux_row(fy, j), slow, fast, before, after, GHOSTS, 0, (start, stop), (low, high), film
            )


@launch
def fill_fluxes(s, c, left, right, lower, upper, fx, fy, terms, spans, film, dt, blocks):
    """Fill the fluxes of all edges within the rows' spans, a block of rows at a time.

    At first order the four sides are the cells' own states. At second order each block has rows of its own for them
    (its first row's faces below belong to the row before), few enough to stay in a core's cache.
    """
    for b in prange(blocks):
        block_fluxes(s, c, left, right, lower, upper, fx, fy, terms, spans, film, dt, np.int64(b), blocks)


@launch
def fill_all_terms(s, c, fx, fy, terms, spans, dt, ny):
    """Fill `CellTerms` of the cells within the rows' spans."""
    for j in prange(ny):
        fill_terms(s, c, fx, fy, terms, spans, np.int64(j), dt)


@launch
def update_cells(s, c, fx, fy, terms, spans, dt, acts, ny):
    """Advance the cells within the rows' spans by dt; see `planar.update`."""
    for j in prange(ny):
        update(s, c, fx, fy, terms, spans, np.int64(j), dt, acts)


@launch
def slow_down_rows(s, c, time):
    """Advance the moving grains of all rows, ghosts too, by friction alone for a time."""
    for j in prange(c.h2.shape[0]):
        slow_down(s, row_of(c, np.int64(j)), time)


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
    terms,
    mesh,
    walls,
    watch,
    inside,
    rim,
    spans,
    rows,
    thresholds,
    track,
):
    """Advance from clock[NOW] to clock[STOP], or until clock[REST_FROM] and rest, or until a run cannot go on.

    One sample is written before each step and one at the end, from samples[counters[SAMPLES]] on; counters[OUTCOME]
    says why the loop ended. `walls`: what (left, right, bottom, top) are, see `boundary`; `inside` (padded rows, 2):
    the columns within R; `rim`: see `radiation`; `spans`: see `active`; `rows`: scratch.
    """
    clock, counters = track.clock, track.counters
    n = counters[k.SAMPLES]
    ny = fx.f1.shape[0]
    blocks = (ny + BLOCK - 1) // BLOCK
    joined = walls[0] == PERIODIC or walls[2] == PERIODIC
    whole = True
    code = k.RUNNING
    while code == k.RUNNING:
        fill_ghosts(c, walls)
        radiate(c, walls, rim, watch.level)
        survey(s, c, mesh, walls, watch, inside, spans, rows, whole)
        widen(spans, c.h1.shape[1], s.lanes, water_may_be_alone(s), joined)
        whole = False
        now = clock[k.NOW]
        sample = track.samples[n]
        collect(s, c, watch, thresholds, spans, rows, now, sample)
        n += 1
        at_rim = largest(rows[:, RIM], 0, rows.shape[0])
        at_edge = at_rim >= thresholds[0] or sample[samples.GRAINS] < watch.least_grains
        shallowest = smallest(rows[:, NEGATIVE], 0, rows.shape[0])
        square2 = largest(rows[:, SQUARE2], 0, rows.shape[0])
        full = n == track.samples.shape[0]
        code = k.outcome(clock, samples.is_finite(sample), shallowest, square2, at_edge, full)
        code = judged(s, code, sample[samples.COMPLEX])
        if code == k.RUNNING:
            pace = largest(rows[:, PACE], 0, rows.shape[0])
            film = largest(rows[:, THIN], 0, rows.shape[0]) > 0.0
            stable = k.stable_step(s, k.starting_pace(s, clock, film, pace), clock[k.STOP] - now)
            if stable < k.SMALLEST_STEP * s.dx:
                code = k.COLLAPSED
            else:
                taken = k.next_step(now, clock[k.STOP], stable)
                dt = type(s.r)(taken)
                if k.friction_is_even(s, clock):
                    slow_down_rows(s, c, type(s.r)(k.ahead(clock, taken)))
                acts = type(s.r)(k.friction_time(s, clock, taken))
                fill_fluxes(s, c, left, right, lower, upper, fx, fy, terms, spans, film, dt, blocks)
                fill_all_terms(s, c, fx, fy, terms, spans, dt, ny)
                join_plane(terms.keep1, walls)
                join_plane(terms.keep2, walls)
                update_cells(s, c, fx, fy, terms, spans, dt, acts, ny)
                decay(c, walls, rim, watch.level, dt)
                clock[k.NOW] = k.after(now, taken, dt, clock[k.STOP])
    counters[k.SAMPLES] = n
    counters[k.OUTCOME] = code
