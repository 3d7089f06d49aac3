"""The time loop in one dimension: all steps of a segment in one launch, since a launch costs as much as a step."""

from numba import prange

from subslide.kernels import clock as k
from subslide.kernels import measures, samples
from subslide.kernels.active import grain_span, moved_span, reached, split, water_may_be_alone
from subslide.kernels.arrays import BEFORE, GHOSTS
from subslide.kernels.axial import (
    cell_speeds,
    fill_ghosts,
    fill_stuck,
    fill_terms,
    slow_down,
    update,
    water_cell_speeds,
)
from subslide.kernels.axial_faces import faces, water_faces
from subslide.kernels.boundary import OPEN, PERIODIC
from subslide.kernels.edge.film import may_overtop
from subslide.kernels.front import front_position
from subslide.kernels.gauge import displacement
from subslide.kernels.hyperbolicity import judged
from subslide.kernels.jit import inlined, launch
from subslide.kernels.measures import RowSpan
from subslide.kernels.reduce import extremes, weighted_sum
from subslide.kernels.row import edges, film_edges, grain_edges, water_edges


@inlined
def sample(s, c, mesh, watch, thresholds, low, high, wet, now, row):
    """Write one sample into `row`, by the columns of `samples`.

    Cells outside low..high-1 are still, those outside [wet[0], wet[1]) without grains.
    """
    row[samples.TIME] = now
    for m in range(samples.FRONTS):
        row[samples.FRONT + m] = front_position(c.h2, c.h2, watch.beside, wet[1], thresholds[m], s.dx)
    row[samples.GAUGE] = displacement(c.eta, c.eta, watch.level, watch.beside, s.dx)
    start, stop = watch.start, watch.stop
    span = RowSpan(low, high, wet[0], wet[1], start, start, min(watch.beyond, stop), stop)
    measures.fill(s, c, mesh, watch, span, row, samples.MEASURED)


@inlined
def rim_depth(h2, watch):
    """Return the largest depth of grains where a front leaves."""
    left = max(h2[watch.rim_left], h2[watch.rim_left + 1]) if watch.rim_left else 0.0
    right = max(h2[watch.rim_right], h2[watch.rim_right + 1]) if watch.rim_right else 0.0
    return max(left, right)


@inlined
def grains_beyond(h2, weight, watch, start, stop):
    """Return the volume of grains beyond where a front leaves, of the columns start..stop-1 that have any."""
    left = weighted_sum(h2, weight, start, min(stop, watch.rim_left)) if watch.rim_left else 0.0
    right = weighted_sum(h2, weight, max(start, watch.rim_right + 2), stop) if watch.rim_right else 0.0
    return left + right


@inlined
def survey(s, c, active):
    """Fill what a step derives from the cells that the last one may have changed."""
    first, last, wet_first, wet_last = active
    low, high = split(first, last, wet_first, wet_last)
    water_cell_speeds(s, c, first, low)
    cell_speeds(s, c, low, high)
    water_cell_speeds(s, c, high, last)


@inlined
def step(s, c, left, right, fx, terms, mesh, active, end_kind, film, dt, acts):
    """Advance the active cells by dt: faces, stuck edges, fluxes, limits, update.

    active: padded columns [first, last) and those with grains; end_kind: what the left end is, see `boundary`; film:
    whether water may be thin over steps of grains; acts: how long friction does, see `clock.friction_time`.
    """
    first, last, wet_first, wet_last = active
    n = c.h1.shape[0]
    start = max(first - GHOSTS, 0)  # of cells without ghosts; edge k is before cell k
    end = min(last - GHOSTS, n - 2 * GHOSTS)
    wet_start, wet_end = split(start, end, wet_first - GHOSTS, wet_last - GHOSTS)
    if s.order != 1:
        low, high = split(start, end + 2, wet_first - GHOSTS, wet_last - GHOSTS + 1)
        faces(s, c, left, right, terms, mesh.source, None, low, high, dt)
        water_faces(s, c, left, right, terms, mesh.source, start, low, dt)
        water_faces(s, c, left, right, terms, mesh.source, high, end + 2, dt)
    low, high = split(start, end + 1, wet_first - GHOSTS, wet_last - GHOSTS)
    fill_stuck(s, c, fx, None, low, high, dt)
    if s.layers == 1:
        grain_edges(s, fx, right, left, BEFORE, low, high)
    else:
        slow, fast = (c.slow_x, c.slow_x), (c.fast_x, c.fast_x)
        edges(s, fx, slow, fast, right, left, BEFORE, 1, low, high)
        if film:
            film_edges(s, fx, right, left, BEFORE, 1, low, high)
        water_edges(s, fx, slow, fast, right, left, BEFORE, 1, start, low)
        water_edges(s, fx, slow, fast, right, left, BEFORE, 1, high, end + 1)
    fill_terms(s, c, fx, terms, mesh, None, start, end, wet_start, wet_end, end_kind, dt)
    update(s, c, fx, terms, mesh, None, start, end, wet_start, wet_end, dt, acts)


@inlined
def advance(s, c, left, right, fx, terms, mesh, walls, watch, thresholds, track):
    """Advance from clock[NOW] to clock[STOP], or until clock[REST_FROM] and rest, or until a run cannot go on.

    One sample is written before each step and one at the end, from samples[counters[SAMPLES]] on; counters[OUTCOME]
    says why the loop ended. `walls`: what the (left, right) ends are, see `boundary`.
    """
    clock, counters = track.clock, track.counters
    n = counters[k.SAMPLES]
    cells = c.h1.shape[0]
    alone = water_may_be_alone(s)
    first = wet_first = 0
    last = wet_last = cells
    whole = True
    code = k.RUNNING
    while code == k.RUNNING:
        fill_ghosts(c, walls[0], walls[1])
        survey(s, c, (first, last, wet_first, wet_last))
        still = watch.still1, watch.still2
        low, high = moved_span(c.h1, c.u1, c.v1, c.h2, c.u2, c.v2, still, first, last)
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
        row = track.samples[n]
        sample(s, c, mesh, watch, thresholds, low, high, wet, now, row)
        least1, shallowest, square2, pace = extremes(c.h1, c.h2, c.square2, c.pace, low, high)
        n += 1
        grains = row[samples.GRAINS] - grains_beyond(c.h2, mesh.weight, watch, wet[0], wet[1])
        at_edge = rim_depth(c.h2, watch) >= thresholds[0] or grains < watch.least_grains
        full = n == track.samples.shape[0]
        code = k.outcome(clock, samples.is_finite(row), min(least1, shallowest), square2, at_edge, full)
        code = judged(s, code, row[samples.COMPLEX])
        if code == k.RUNNING and ((walls[0] == OPEN and first == 0) or (walls[1] == OPEN and last == cells)):
            code = k.NO_ROOM  # on the open sea no wave gets to an end
        if code == k.RUNNING:
            pace = max(pace, max(c.pace[0], c.pace[cells - 1]))
            film = may_overtop(s, least1, s.dx)
            stable = k.stable_step(s, k.starting_pace(s, clock, film, pace), clock[k.STOP] - now)
            if stable < k.SMALLEST_STEP * s.dx:
                code = k.COLLAPSED
            else:
                taken = k.next_step(now, clock[k.STOP], stable)
                dt = type(s.r)(taken)
                active = (first, last, wet_first, wet_last)
                if k.friction_is_even(s, clock):
                    slow_down(s, c, type(s.r)(k.ahead(clock, taken)))
                acts = type(s.r)(k.friction_time(s, clock, taken))
                step(s, c, left, right, fx, terms, mesh, active, walls[0], film, dt, acts)
                clock[k.NOW] = k.after(now, taken, dt, clock[k.STOP])
    counters[k.SAMPLES] = n
    counters[k.OUTCOME] = code


@inlined
def advance_on(s, c, left, right, fx, terms, mesh, walls, watch, thresholds, track):
    """Run `advance` to each stop of the clock, from the sample that it ended with at the one before."""
    again = True
    while again:
        advance(s, c, left, right, fx, terms, mesh, walls, watch, thresholds, track)
        again = k.goes_on(track.clock, track.counters)
        if again:
            track.counters[k.SAMPLES] -= 1


@launch
def advance_axial(s, c, left, right, fx, terms, mesh, walls, watch, thresholds, track):
    """Run `advance_on` in a parallel region of one, where arrays are known not to overlap; see `jit.launch`."""
    for _ in prange(1):
        advance_on(s, c, left, right, fx, terms, mesh, walls, watch, thresholds, track)
