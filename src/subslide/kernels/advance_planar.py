"""The time loop in the plane: four launches a step, each over blocks of rows.

Blocks do not depend on the number of threads, nor does any result. Each launch is a function of its own: numba fuses
loops over the same range that follow each other in one function, and an update would overtake its neighbours' marks.
"""

import math

from numba import prange

from ..diagnostics.budget import row_energy, row_nonhyperbolic, row_volumes
from ..diagnostics.front import front_position
from ..diagnostics.surface import largest_displacement
from . import clock as k
from .arrays import GHOSTS
from .boundary import OPEN, join_plane
from .interlayer import judged
from .jit import driver, inlined, launch
from .planar import (
    cell_speeds,
    constant_faces,
    edges_x,
    edges_y,
    faces,
    fill_ghosts,
    fill_stuck,
    marks,
    update,
)
from .reduce import largest, smallest

BLOCK = 16
"""Rows a block: few enough to share among cores, many enough that the row before it costs little."""

PACE, SPEED2, SHALLOWEST, RIM, ROW_ETA, ROW_OUTSIDE, ROW_WATER, ROW_GRAINS, ROW_ENERGY, ROW_COMPLEX = range(
    10
)
ROW_COLUMNS = 10


@inlined
def measure_row(s, c, j, walls, probe, inside, weight, row):
    """Write what the padded row j adds to a sample into `row`."""
    level, _, start, stop, first_row, last_row, margin = probe
    ny, nx = c.h1.shape
    row[PACE] = largest(c.pace[j])
    row[SPEED2] = largest(c.speed2[j])
    row[SHALLOWEST] = min(smallest(c.h1[j]), smallest(c.h2[j]))
    row[RIM] = 0.0
    if walls[0] == OPEN:
        row[RIM] = max(row[RIM], max(c.h2[j, GHOSTS], c.h2[j, GHOSTS + 1]))
    if walls[1] == OPEN:
        row[RIM] = max(row[RIM], max(c.h2[j, nx - GHOSTS - 1], c.h2[j, nx - GHOSTS - 2]))
    if (j < GHOSTS + 2 and walls[2] == OPEN) or (j >= ny - GHOSTS - 2 and walls[3] == OPEN):
        row[RIM] = max(row[RIM], largest(c.h2[j]))
    row[ROW_ETA] = 0.0
    row[ROW_OUTSIDE] = 0.0
    if first_row <= j < last_row:
        before = largest_displacement(c.eta[j], level, start, inside[j, 0])
        beyond = largest_displacement(c.eta[j], level, inside[j, 1], stop)
        row[ROW_OUTSIDE] = max(before, beyond)
        row[ROW_ETA] = max(
            row[ROW_OUTSIDE], largest_displacement(c.eta[j], level, inside[j, 0], inside[j, 1])
        )
    row[ROW_WATER], row[ROW_GRAINS] = row_volumes(c.h1[j], c.h2[j], weight)
    row[ROW_ENERGY] = row_energy(c.h1[j], c.u1[j], c.v1[j], c.h2[j], c.u2[j], c.v2[j], weight, s.r)
    row[ROW_COMPLEX] = row_nonhyperbolic(
        c.h1[j], c.u1[j], c.v1[j], c.h2[j], c.u2[j], c.v2[j], s.r, weight.shape[0], s.dry_depth, margin
    )


@inlined
def collect(s, c, axis, thresholds, rows, now, sample):
    """Write one sample from the rows' parts, summed in the rows' order; the columns are named in `clock`."""
    sample[k.TIME] = now
    for m in range(3):
        sample[k.FRONT + m] = front_position(c.h2[axis[0]], c.h2[axis[1]], axis[2], thresholds[m], s.dx)
    for column in range(k.ETA, k.COLUMNS):
        sample[column] = 0.0
    for j in range(GHOSTS, rows.shape[0] - GHOSTS):
        sample[k.ETA] = max(sample[k.ETA], rows[j, ROW_ETA])
        sample[k.ETA_OUTSIDE] = max(sample[k.ETA_OUTSIDE], rows[j, ROW_OUTSIDE])
        sample[k.WATER] += rows[j, ROW_WATER]
        sample[k.GRAINS] += rows[j, ROW_GRAINS]
        sample[k.ENERGY] += rows[j, ROW_ENERGY]
        sample[k.COMPLEX] += rows[j, ROW_COMPLEX]


@launch
def survey(s, c, walls, probe, inside, weight, rows):
    """Fill the wave speeds of every cell and what each row adds to a sample."""
    for j in prange(c.h1.shape[0]):
        cell_speeds(s, c, j)
        measure_row(s, c, j, walls, probe, inside, weight, rows[j])


@launch
def fill_fluxes(s, c, left, right, lower, upper, fx, fy, mk, dt):
    """Fill the fluxes of all edges, a block of rows at a time; its first row's faces below belong to the row before."""
    ny = fx.f1.shape[0]
    blocks = left.h1.shape[0]
    for b in prange(blocks):
        first = b * BLOCK
        last = first + BLOCK if b < blocks - 1 else ny + 1  # the last edge has the ghost row above it
        for j in range(first - 1, last):
            u = 2 * b + (j - first + 1) % 2
            if s.order == 1:
                constant_faces(c, j + GHOSTS, left, right, lower, upper, b, u)
            else:
                faces(s, c, mk, j + GHOSTS, left, right, lower, upper, b, u, dt)
            if first <= j < ny:
                fill_stuck(s, c, j, fx.stuck, GHOSTS, GHOSTS - 1, 0, 1, dt)
                edges_x(s, c, j, left, right, b, fx)
            if j >= first:
                fill_stuck(s, c, j, fy.stuck, GHOSTS - 1, GHOSTS, 1, 0, dt)
                edges_y(s, c, j, lower, upper, b, 4 * b + 1 - u, fy)


@launch
def fill_marks(s, c, fx, fy, mk, dt):
    """Fill `Marks` of every cell."""
    for j in prange(fx.f1.shape[0]):
        marks(s, c, fx, fy, mk, j, dt)


@launch
def update_cells(s, c, fx, fy, mk, dt):
    """Advance every cell by dt."""
    for j in prange(fx.f1.shape[0]):
        update(s, c, fx, fy, mk, j, dt)


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
    walls,
    probe,
    inside,
    axis,
    rows,
    thresholds,
    clock,
    samples,
    counters,
):
    """Advance from clock[NOW] to clock[STOP], or until clock[REST_FROM] and rest, or until a run cannot go on.

    One sample is written before each step and one at the end, from samples[counters[SAMPLES]] on; counters[OUTCOME]
    says why the loop ended. `walls` says what (left, right, bottom, top) are, see `boundary`; `weight` (nx) is a
    cell's area; `probe` is (level, volume of grains below which too much has left the box, padded columns [start,
    stop) and rows [first, last) of the initial box, margin of the discriminant); `inside` (padded rows, 2) the
    columns within R; `axis` the two padded rows beside the x axis and the first padded column beyond the y axis;
    `rows` is scratch.
    """
    n = counters[k.SAMPLES]
    code = k.RUNNING
    while code == k.RUNNING:
        fill_ghosts(c, walls)
        survey(s, c, walls, probe, inside, weight, rows)
        now = clock[k.NOW]
        sample = samples[n]
        collect(s, c, axis, thresholds, rows, now, sample)
        finite = math.isfinite(sample[k.ENERGY]) and math.isfinite(sample[k.WATER] + sample[k.GRAINS])
        n += 1
        code = k.outcome(
            clock,
            finite,
            smallest(rows[:, SHALLOWEST]),
            largest(rows[:, SPEED2]),
            largest(rows[:, RIM]) >= thresholds[0] or sample[k.GRAINS] < probe[1],
            n == samples.shape[0],
        )
        code = judged(s, code, sample[k.COMPLEX])
        if code == k.RUNNING:
            pace = largest(rows[:, PACE])
            stop = clock[k.STOP]
            stable = s.cfl * s.dx / pace if pace > 0.0 else stop - now
            if stable < k.SMALLEST_STEP * s.dx:
                code = k.COLLAPSED
            else:
                step = k.next_step(now, stop, stable)
                dt = type(s.r)(step)
                fill_fluxes(s, c, left, right, lower, upper, fx, fy, mk, dt)
                fill_marks(s, c, fx, fy, mk, dt)
                join_plane(mk.keep1, walls)
                join_plane(mk.keep2, walls)
                update_cells(s, c, fx, fy, mk, dt)
                clock[k.NOW] = stop if now + step >= stop else now + dt
    counters[k.SAMPLES] = n
    counters[k.OUTCOME] = code
