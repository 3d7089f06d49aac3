"""The time loop in one dimension: all steps of a segment in one launch, since a launch costs as much as a step."""

import math

from numba import prange

from ..diagnostics.budget import row_energy, row_nonhyperbolic, row_volumes
from ..diagnostics.front import front_position
from ..diagnostics.surface import largest_displacement
from . import clock as k
from .arrays import GHOSTS
from .axial import cell_speeds, edges, faces, fill_ghosts, fill_stuck, grain_edges, marks, update
from .boundary import OPEN
from .interlayer import judged
from .jit import inlined, launch
from .reduce import largest, smallest


@inlined
def sample(s, c, weight, thresholds, probe, now, row):
    """Write one sample into `row`; the columns are named in `clock`."""
    level, _, beside, beyond, start, stop, margin = probe
    n = weight.shape[0]
    row[k.TIME] = now
    for m in range(3):
        row[k.FRONT + m] = front_position(c.h2, c.h2, beside, thresholds[m], s.dx)
    row[k.ETA] = largest_displacement(c.eta, level, start, stop)
    row[k.ETA_OUTSIDE] = largest_displacement(c.eta, level, beyond, stop)
    row[k.WATER], row[k.GRAINS] = row_volumes(c.h1, c.h2, weight)
    row[k.ENERGY] = row_energy(c.h1, c.u1, c.v1, c.h2, c.u2, c.v2, weight, s.r)
    row[k.COMPLEX] = (
        0.0
        if s.layers == 1
        else row_nonhyperbolic(c.h1, c.u1, c.v1, c.h2, c.u2, c.v2, s.r, n, s.dry_depth, margin)
    )


@inlined
def rim_depth(h2, walls):
    """Return the largest depth of grains in the last two cells before an open end."""
    n = h2.shape[0]
    left = 0.0 if walls[0] != OPEN else max(h2[GHOSTS], h2[GHOSTS + 1])
    right = 0.0 if walls[1] != OPEN else max(h2[n - GHOSTS - 1], h2[n - GHOSTS - 2])
    return max(left, right)


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
    says why the loop ended. `weight` (n) is the volume of a cell per depth, `source` (n + 4) is -1 / (2 radius) for
    round scenes; `walls` says what the (left, right) end is, see `boundary`; `probe` is (level, volume of grains
    below which too much has left the box, padded column beside the axis, first beyond R, columns [start, stop) of the
    initial box, margin of the discriminant).
    """
    for _ in prange(1):
        real = type(s.r)
        least_grains = probe[1]
        n = counters[k.SAMPLES]
        code = k.RUNNING
        while code == k.RUNNING:
            fill_ghosts(c, walls[0], walls[1])
            cell_speeds(s, c)
            now = clock[k.NOW]
            row = samples[n]
            sample(s, c, weight, thresholds, probe, now, row)
            finite = math.isfinite(row[k.ENERGY]) and math.isfinite(row[k.WATER] + row[k.GRAINS])
            shallowest = min(smallest(c.h1), smallest(c.h2))
            rim = rim_depth(c.h2, walls)
            n += 1
            code = k.outcome(
                clock,
                finite,
                shallowest,
                largest(c.speed2),
                rim >= thresholds[0] or row[k.GRAINS] < least_grains,
                n == samples.shape[0],
            )
            code = judged(s, code, row[k.COMPLEX])
            if code == k.RUNNING:
                pace = largest(c.pace)
                stop = clock[k.STOP]
                stable = s.cfl * s.dx / pace if pace > real(0) else real(stop - now)
                if stable < k.SMALLEST_STEP * s.dx:
                    code = k.COLLAPSED
                else:
                    step = k.next_step(now, stop, stable)
                    dt = real(step)
                    faces(s, c, left, right, mk, real(0.5) * dt / s.dx, source, dt)
                    fill_stuck(s, c, fx, dt)
                    if s.layers == 1:
                        grain_edges(s, left, right, fx)
                    else:
                        edges(s, c, left, right, fx)
                    marks(s, c, fx, mk, area, inverse_volume, walls[0], dt)
                    update(s, c, fx, mk, area, inverse_volume, dt)
                    clock[k.NOW] = stop if now + step >= stop else now + dt
        counters[k.SAMPLES] = n
        counters[k.OUTCOME] = code
