"""The time loop on a fitted grid: a radius, or the right half of a line, whose cells go with the grains (see `motion`).

Every cell is solved in every step, since waves cross so few of them at once. Loops run over the cells, or over the
edges after them: whole vectors, if `cells` is.
"""

import numpy as np
from numba import prange

from subslide.kernels import clock as k
from subslide.kernels import measures, samples
from subslide.kernels.active import grain_span
from subslide.kernels.arrays import BEFORE, GHOSTS, is_general
from subslide.kernels.axial import cell_speeds, fill_ghosts, fill_stuck, fill_terms, slow_down, update
from subslide.kernels.axial_faces import faces
from subslide.kernels.boundary import WALL
from subslide.kernels.edge.film import may_overtop
from subslide.kernels.front import front_position
from subslide.kernels.hyperbolicity import STOP, judged
from subslide.kernels.jit import inlined, launch
from subslide.kernels.measures import RowSpan
from subslide.kernels.motion import arrive, place, relative_pace, sweep
from subslide.kernels.reduce import extremes
from subslide.kernels.row import edges, film_edges, grain_edges

OFTEN = 8
"""Steps after which volumes, energy and hyperbolicity are measured; fronts are in each."""


@inlined
def sample(s, c, mesh, motion, watch, thresholds, wet, now, row):
    """Write time and fronts into `row`, by the columns of `samples`; the others are not known."""
    row[:] = np.nan
    row[samples.TIME] = now
    for m in range(samples.FRONTS):
        row[samples.FRONT + m] = front_position(c.h2, c.h2, watch.beside, wet[1], thresholds[m], s.dx, motion)


@inlined
def measure(s, c, mesh, watch, wet, row):
    """Write what is measured of a state into `row`; no surface is watched, so that its columns mean nothing."""
    cells = c.h1.shape[0]
    span = RowSpan(GHOSTS, cells - GHOSTS, wet[0], wet[1], GHOSTS, GHOSTS, GHOSTS, GHOSTS)
    measures.fill(s, c, mesh, watch, span, row, samples.MEASURED)


@inlined
def mirror(c):
    """Give the ghosts beside both ends what follows from the state of the mirrored cells."""
    last = c.h1.shape[0] - GHOSTS
    for ghost, source in ((GHOSTS - 1, GHOSTS), (last, last - 1)):
        c.eta[ghost] = c.eta[source]
        c.head2[ghost] = c.head2[source]
        c.square2[ghost] = c.square2[source]
        c.slow_x[ghost] = -c.fast_x[source]
        c.fast_x[ghost] = -c.slow_x[source]


@inlined
def mirror_face(face, ghost, other, source):
    """Give a face of a ghost the mirrored state of the face of a cell at the same wall."""
    face.eta[ghost] = other.eta[source]
    face.h1[ghost] = other.h1[source]
    face.h2[ghost] = other.h2[source]
    face.u1[ghost] = -other.u1[source]
    face.u2[ghost] = -other.u2[source]


@inlined
def fluxes(s, c, left, right, fx, drift, film, first, stop):
    """Fill the fluxes through the edges first..stop-1."""
    if s.layers == 1:
        grain_edges(s, fx, right, left, BEFORE, first, stop, drift)
    else:
        slow, fast = (c.slow_x, c.slow_x), (c.fast_x, c.fast_x)
        edges(s, fx, slow, fast, right, left, BEFORE, 1, first, stop, drift)
        if film:
            film_edges(s, fx, right, left, BEFORE, 1, first, stop)


@inlined
def step(s, c, left, right, fx, terms, mesh, motion, moves, film, dt, acts):
    """Advance all cells by dt; see `advance_axial.step`. moves: whether any edge does, so that none is stuck."""
    n = c.h1.shape[0] - 2 * GHOSTS
    if s.order != 1:
        faces(s, c, left, right, terms, mesh.source, motion, BEFORE, n + BEFORE, dt)
        mirror_face(right, GHOSTS - 1, left, GHOSTS)
        mirror_face(left, n + GHOSTS, right, n + GHOSTS - 1)
    if not moves:
        fill_stuck(s, c, fx, motion, 0, n + 1, dt)
    fluxes(s, c, left, right, fx, motion.drift, film, 1, n + 1)
    if motion.radial == 0.0:  # no area is at the axis of a round scene
        fluxes(s, c, left, right, fx, motion.drift, film, 0, 1)
    fill_terms(s, c, fx, terms, mesh, motion, 0, n, 0, n, WALL, dt)
    update(s, c, fx, terms, mesh, motion, 0, n, 0, n, dt, acts)


@inlined
def advance(s, c, left, right, fx, terms, mesh, motion, fan, watch, thresholds, track):
    """Advance from clock[NOW] to clock[STOP]; see `advance_axial.advance`."""
    clock, counters = track.clock, track.counters
    n = counters[k.SAMPLES]
    cells = c.h1.shape[0]
    place(mesh, motion)
    moves = True
    code = k.RUNNING
    while code == k.RUNNING:
        now = clock[k.NOW]
        fill_ghosts(c, WALL, WALL)
        cell_speeds(s, c, GHOSTS, cells - GHOSTS)
        mirror(c)
        relative_pace(s, c, motion, fan, now)
        wet = grain_span(c.h2, c.u2, c.v2, GHOSTS, cells - GHOSTS)
        row = track.samples[n]
        due = clock[k.UNMEASURED] == 0.0 or now >= clock[k.STOP] or (is_general(s) and s.treatment == STOP)
        sample(s, c, mesh, motion, watch, thresholds, wet, now, row)
        if due:
            measure(s, c, mesh, watch, wet, row)
        least1, shallowest, square2, pace = extremes(c.h1, c.h2, c.square2, c.pace, GHOSTS, cells - GHOSTS)
        n += 1
        full = n == track.samples.shape[0]
        code = k.outcome(
            clock, not due or samples.is_finite(row), min(least1, shallowest), square2, False, full
        )
        code = judged(s, code, row[samples.COMPLEX])
        if code == k.RUNNING:
            film = may_overtop(s, least1, motion.widest)
            stable = k.stable_step(s, k.starting_pace(s, clock, film, pace), clock[k.STOP] - now)
            if stable < k.SMALLEST_STEP * s.dx:
                code = k.COLLAPSED
            else:
                taken = k.next_step(now, clock[k.STOP], stable)
                dt = type(s.r)(taken)
                then = k.after(now, taken, dt, clock[k.STOP])
                if moves:
                    sweep(mesh, motion, fan, now, then - now)
                    moves = now < fan.stop
                if k.friction_is_even(s, clock):
                    slow_down(s, c, type(s.r)(k.ahead(clock, taken)))
                acts = type(s.r)(k.friction_time(s, clock, taken))
                step(s, c, left, right, fx, terms, mesh, motion, moves, film, dt, acts)
                if moves:
                    arrive(mesh, motion)
                clock[k.NOW] = then
                clock[k.UNMEASURED] = (clock[k.UNMEASURED] + 1.0) % OFTEN
        elif not due:
            measure(s, c, mesh, watch, wet, row)
            if not samples.is_finite(row):
                code = k.NOT_FINITE
    counters[k.SAMPLES] = n
    counters[k.OUTCOME] = code


@inlined
def advance_on(s, c, left, right, fx, terms, mesh, motion, fan, watch, thresholds, track):
    """Run `advance` to each stop of the clock; see `advance_axial.advance_on`."""
    again = True
    while again:
        advance(s, c, left, right, fx, terms, mesh, motion, fan, watch, thresholds, track)
        again = k.goes_on(track.clock, track.counters)
        if again:
            track.counters[k.SAMPLES] -= 1


@launch
def advance_fitted(s, c, left, right, fx, terms, mesh, motion, fan, watch, thresholds, track):
    """Run `advance_on` in a parallel region of one, where arrays are known not to overlap; see `jit.launch`."""
    for _ in prange(1):
        advance_on(s, c, left, right, fx, terms, mesh, motion, fan, watch, thresholds, track)
