"""One step in one dimension: a line, or a radius (round scenes), of n cells.

Cells, faces and edges are numbered as drawn in `arrays`. Loops over start..stop-1 count from the smallest index that
they need.
"""

from subslide.kernels.arrays import BEFORE, GHOSTS, is_general
from subslide.kernels.boundary import WALL, copied_after, copied_before, join
from subslide.kernels.edge.stuck import is_stuck
from subslide.kernels.friction import COULOMB
from subslide.kernels.friction.coulomb import head
from subslide.kernels.hyperbolicity import RUB, rub
from subslide.kernels.jit import inlined, part
from subslide.kernels.motion import gained, gap_at, grown, normal, over_width
from subslide.kernels.positivity import limit, reference, share
from subslide.kernels.printed import braking
from subslide.kernels.slowing import first_reach, law_left, left_of
from subslide.kernels.velocity import velocity
from subslide.kernels.waves import chosen_bounds, grain_speeds, water_speeds


@inlined
def fill_ghosts(c, left, right):
    """Set the ghost cells; `left` and `right` say what the ends are, see `boundary`."""
    n = c.h1.shape[0]
    for g in range(GHOSTS):
        copy_cell(c, copied_before(left, g, n), GHOSTS - 1 - g, left == WALL)
        copy_cell(c, copied_after(right, g, n), n - GHOSTS + g, right == WALL)


@inlined
def copy_cell(c, source, ghost, mirrored):
    """Copy a cell's state, with its velocities reversed if `mirrored`."""
    c.h1[ghost] = c.h1[source]
    c.h2[ghost] = c.h2[source]
    c.u1[ghost] = -c.u1[source] if mirrored else c.u1[source]
    c.u2[ghost] = -c.u2[source] if mirrored else c.u2[source]


@inlined
def cell_speeds(s, c, start, stop):
    """Fill what a step derives from the state of cells: sums, squares, wave speeds and the pace."""
    first, count = part(start, stop)
    if s.layers == 1:
        for k in range(count):
            i = k + first
            c.eta[i] = c.h2[i]
            c.head2[i] = c.h2[i]
            c.square2[i] = c.u2[i] * c.u2[i]
            slow, fast = grain_speeds(c.h2[i], c.u2[i])
            c.pace[i] = max(fast, -slow)
    else:
        for k in range(count):
            i = k + first
            c.eta[i] = c.h1[i] + c.h2[i]
            c.head2[i] = head(s.r, c.eta[i], c.h2[i])
            c.square2[i] = c.u2[i] * c.u2[i]
            slow, fast = chosen_bounds(s, c.h1[i], c.u1[i], c.h2[i], c.u2[i])
            c.slow_x[i] = slow
            c.fast_x[i] = fast
            c.pace[i] = max(fast, -slow)


@inlined
def water_cell_speeds(s, c, start, stop):
    """Fill the same for cells without grains."""
    first, count = part(start, stop)
    for k in range(count):
        i = k + first
        c.eta[i] = c.h1[i]
        c.head2[i] = s.r * c.h1[i]
        slow, fast = water_speeds(c.h1[i], c.u1[i])
        c.slow_x[i] = slow
        c.fast_x[i] = fast
        c.pace[i] = max(fast, -slow)


@inlined
def fill_stuck(s, c, fx, motion, start, stop, dt):
    """Fill `stuck` of the edges start..stop-1: where friction holds the grains on both sides at rest."""
    first, count = part(start, stop)
    for m in range(count):
        k = m + first
        i = k + BEFORE
        push = c.head2[i + 1] - c.head2[i]
        gap = gap_at(motion, k, s.dx)
        fx.stuck[k] = is_stuck(s, dt, gap, c.square2[i], c.square2[i + 1], push * push)


@inlined
def outflow_share(f, h, mesh, motion, dry_depth, dt, k):
    """Return the fraction of its outflow that a layer can feed in the cell between the edges k and k + 1."""
    zero = type(dt)(0)
    leaving = mesh.area[k + 1] * max(zero, f[k + 1]) - mesh.area[k] * min(zero, f[k])
    return share(grown(motion, k, h[k + GHOSTS]), dt * mesh.inverse_volume[k] * leaving, dry_depth)


@inlined
def slow_down(s, c, time):
    """Advance moving grains by friction alone for a time, before a step."""
    for i in range(c.h2.shape[0]):
        c.u2[i] *= left_of(s, time, c.h2[i], abs(c.u2[i]))
        c.square2[i] = c.u2[i] * c.u2[i]


@inlined
def fill_terms(s, c, fx, terms, mesh, motion, start, stop, low, high, left, dt):
    """Fill `CellTerms` of cells, of grains in low..high-1; `keep` of ghosts stays 1 unless they stand for others."""
    first, count = part(start, stop)
    for m in range(count):
        k = m + first
        terms.keep1[k + GHOSTS] = outflow_share(fx.f1, c.h1, mesh, motion, s.dry_depth, dt, k)
    first, count = part(low, high)
    for m in range(count):
        k = m + first
        terms.keep2[k + GHOSTS] = outflow_share(fx.f2, c.h2, mesh, motion, s.dry_depth, dt, k)
        terms.held[k + GHOSTS] = min(fx.stuck[k], fx.stuck[k + 1])
    join(terms.keep1, left)
    join(terms.keep2, left)


@inlined
def advance_layer(s, h, u, flux, keep, inner, mesh, motion, dt, k):
    """Return a layer's depth and momentum after a step, in the cell between the edges k and k + 1 (Eq. 6).

    `flux`: the layer's fluxes of mass and of momentum, and its pressure products.
    """
    f, m, p = flux
    i = k + GHOSTS
    before = mesh.area[k] * dt * mesh.inverse_volume[k] * limit(f[k], keep[i - 1], keep[i])
    after = mesh.area[k + 1] * dt * mesh.inverse_volume[k] * limit(f[k + 1], keep[i], keep[i + 1])
    push = over_width(motion, k, dt, s.dx) * (type(dt)(0.5) * (p[k] + p[k + 1]) + inner[i])
    depth = h[i] + gained(motion, k, h[i], before * f[k] - after * f[k + 1])
    q = h[i] * u[i]
    return normal(motion, depth), q + gained(motion, k, q, before * m[k] - after * m[k + 1]) - push


@inlined
def update(s, c, fx, terms, mesh, motion, start, stop, low, high, dt, acts):
    """Advance cells by dt, grains in low..high-1: fluxes, pressure, then friction.

    Friction acts for the time `acts` on grains that moved, on those at rest for dt.
    """
    still_reach, reach = first_reach(s, dt), first_reach(s, acts)
    water, grains = (fx.f1, fx.m1, fx.p1), (fx.f2, fx.m2, fx.p2)
    first, count = part(start, stop)
    for m in range(count):
        k = m + first
        h, q = advance_layer(s, c.h1, c.u1, water, terms.keep1, terms.inner_p1x, mesh, motion, dt, k)
        depth = reference(c.h1[k + GHOSTS], h, terms.keep1[k + GHOSTS])
        c.h1[k + GHOSTS] = h
        c.u1[k + GHOSTS] = velocity(q, depth, s.dry_depth)
    first, count = part(low, high)
    for m in range(count):
        k = m + first
        h, q = advance_layer(s, c.h2, c.u2, grains, terms.keep2, terms.inner_p2x, mesh, motion, dt, k)
        u = velocity(q, h, s.dry_depth)
        c.h2[k + GHOSTS] = h
        taken = reach if c.square2[k + GHOSTS] > type(dt)(0) else still_reach
        c.u2[k + GHOSTS] = u * braking(s, taken, abs(u), terms.held[k + GHOSTS])
    if is_general(s) and s.law != COULOMB:
        for i in range(low + GHOSTS, high + GHOSTS):
            c.u2[i] *= law_left(s, acts if c.square2[i] > type(dt)(0) else dt, c.h2[i], abs(c.u2[i]))
    if is_general(s) and s.treatment == RUB:
        rub(s, c.h1, c.u1, c.v1, c.h2, c.u2, c.v2)
