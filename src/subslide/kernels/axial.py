"""One step in one dimension: a line, or a radius (round scenes), of n cells.

Edge k lies between the padded cells k + 1 and k + 2. `area` (n + 1) is the size of an edge and `inverse_volume` (n)
one over the size of a cell: radius and 1 / (radius dx) for round scenes, 1 and 1 / dx on a line. Loops over
start..stop-1 count from the smallest index that they need.
"""

from subslide.kernels.arrays import GHOSTS, is_general
from subslide.kernels.boundary import WALL, copied_after, copied_before, join
from subslide.kernels.edge import edge_fluxes, grain_edge_fluxes, water_edge_fluxes
from subslide.kernels.friction import COULOMB, further
from subslide.kernels.friction.coulomb import head, holds
from subslide.kernels.hyperbolicity import FRICTION, rub
from subslide.kernels.jit import inlined, part, unsigned
from subslide.kernels.positivity import limit, share
from subslide.kernels.printed import braking
from subslide.kernels.reconstruct import depth_slopes, grain_slopes, mc, rates
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
def faces(s, c, left, right, mk, source, start, stop, dt):
    """Second order: the states at both faces of cells, half a step on, and the pressure products across them.

    `source` (n + 4) is -1 / (2 radius) for round scenes, 0 on a line. Grains that friction
    can stop are not accelerated in the half step; moving ones feel no friction in it (more accurate on coarse grids,
    measured).
    """
    real = type(s.r)
    half = real(0.5)
    zero = real(0)
    ratio = half * dt / s.dx
    static = (real(1) - s.r) * s.friction
    reach = dt * static
    first, count = part(start, stop)
    for k in range(count):
        i = k + first + 1
        h1 = c.h1[i]
        u1 = c.u1[i]
        h2 = c.h2[i]
        u2 = c.u2[i]
        s_u1 = mc(u1 - c.u1[i - 1], c.u1[i + 1] - u1)
        moving = c.square2[i] > reach * reach
        s_h2, s_u2 = grain_slopes(
            s.r, s.dry_depth, moving, c.h2[i - 1], c.u2[i - 1], h2, u2, c.h2[i + 1], c.u2[i + 1]
        )
        s_eta, s_h1, s_h2 = depth_slopes(
            h1,
            h2,
            mc(c.eta[i] - c.eta[i - 1], c.eta[i + 1] - c.eta[i]),
            s_h2,
        )
        d_h1, d_u1, d_h2, d_u2 = rates(s.r, h1, u1, h2, u2, s_eta, s_h1, s_h2, s_u1, s_u2)
        change1 = max(-h1, ratio * d_h1 + dt * source[i] * h1 * u1)
        change2 = max(-h2, ratio * d_h2 + dt * source[i] * h2 * u2)
        still = holds(reach, s.dx * static, c.square2[i], d_u2 * d_u2)
        m_h1 = h1 + change1
        m_h2 = h2 + change2
        m_u1 = u1 + ratio * d_u1
        m_u2 = u2 + (zero if still else ratio * d_u2)
        m_eta = c.eta[i] + change1 + change2
        t_eta, t_h1, t_h2 = depth_slopes(m_h1, m_h2, s_eta, s_h2)
        left.eta[i] = m_eta - half * t_eta
        right.eta[i] = m_eta + half * t_eta
        left.h1[i] = m_h1 - half * t_h1
        right.h1[i] = m_h1 + half * t_h1
        left.h2[i] = m_h2 - half * t_h2
        right.h2[i] = m_h2 + half * t_h2
        left.u1[i] = m_u1 - half * s_u1
        right.u1[i] = m_u1 + half * s_u1
        left.u2[i] = m_u2 - half * s_u2
        right.u2[i] = m_u2 + half * s_u2
        mk.inner_p1x[i] = m_h1 * t_eta
        mk.inner_p2x[i] = m_h2 * (s.r * t_h1 + t_h2)


@inlined
def water_faces(s, c, left, right, mk, source, start, stop, dt):
    """Fill the same of the water in cells without grains; see `faces`."""
    half = type(s.r)(0.5)
    zero = type(s.r)(0)
    ratio = half * dt / s.dx
    first, count = part(start, stop)
    for k in range(count):
        i = unsigned(k + first + 1)
        before = unsigned(k + first)
        after = unsigned(k + first + 2)
        h1 = c.h1[i]
        u1 = c.u1[i]
        s_u1 = mc(u1 - c.u1[before], c.u1[after] - u1)
        s_eta, s_h1, _ = depth_slopes(h1, zero, mc(c.eta[i] - c.eta[before], c.eta[after] - c.eta[i]), zero)
        change = max(-h1, -ratio * (u1 * s_h1 + h1 * s_u1) + dt * source[i] * h1 * u1)
        m_h1 = h1 + change
        m_u1 = u1 - ratio * (u1 * s_u1 + s_eta)
        m_eta = c.eta[i] + change
        s_eta, s_h1, _ = depth_slopes(m_h1, zero, s_eta, zero)
        left.eta[i] = m_eta - half * s_eta
        right.eta[i] = m_eta + half * s_eta
        left.h1[i] = m_h1 - half * s_h1
        right.h1[i] = m_h1 + half * s_h1
        left.u1[i] = m_u1 - half * s_u1
        right.u1[i] = m_u1 + half * s_u1
        mk.inner_p1x[i] = m_h1 * s_eta


@inlined
def fill_stuck(s, c, fx, start, stop, dt):
    """Mark the edges start..stop-1 where friction holds the grains on both sides at rest."""
    real = type(s.r)
    static = (real(1) - s.r) * s.friction
    first, count = part(start, stop)
    for m in range(count):
        k = m + first
        i = k + GHOSTS - 1
        push = c.head2[i + 1] - c.head2[i]
        held = holds(dt * static, s.dx * static, max(c.square2[i], c.square2[i + 1]), push * push)
        fx.stuck[k] = real(1) if held else real(0)


@inlined
def grain_edges(s, left, right, fx, start, stop):
    """Fill the fluxes of the edges start..stop-1 for grains alone."""
    zero = type(s.r)(0)
    first, count = part(start, stop)
    for m in range(count):
        k = m + first
        i = k + GHOSTS - 1
        j = i + 1
        fx.f2[k], fx.m2[k], fx.p2[k] = grain_edge_fluxes(
            s, fx.stuck[k] != zero, right.h2[i], right.u2[i], left.h2[j], left.u2[j]
        )


@inlined
def edges(s, c, left, right, fx, start, stop):
    """Fill the fluxes of the edges start..stop-1, from the right face of the cell before and the left one after."""
    zero = type(s.r)(0)
    first, count = part(start, stop)
    for m in range(count):
        k = m + first
        i = k + GHOSTS - 1
        j = i + 1
        fx.f1[k], fx.m1[k], fx.p1[k], fx.f2[k], fx.m2[k], fx.p2[k] = edge_fluxes(
            s,
            fx.stuck[k] != zero,
            min(c.slow_x[i], c.slow_x[j]),
            max(c.fast_x[i], c.fast_x[j]),
            right.h1[i],
            right.u1[i],
            right.h2[i],
            right.u2[i],
            left.h1[j],
            left.u1[j],
            left.h2[j],
            left.u2[j],
            left.eta[j] - right.eta[i],
        )


@inlined
def water_edges(s, c, left, right, fx, start, stop):
    """Fill the water's fluxes of the edges start..stop-1, where no side has grains."""
    first, count = part(start, stop)
    for m in range(count):
        k = unsigned(m + first)
        i = unsigned(m + first + GHOSTS - 1)
        j = unsigned(m + first + GHOSTS)
        fx.f1[k], fx.m1[k], fx.p1[k] = water_edge_fluxes(
            s,
            min(c.slow_x[i], c.slow_x[j]),
            max(c.fast_x[i], c.fast_x[j]),
            right.h1[i],
            right.u1[i],
            left.h1[j],
            left.u1[j],
            left.eta[j] - right.eta[i],
        )


@inlined
def outflow_share(f, h, area, inverse_volume, dry_depth, dt, k):
    """Return the fraction of its outflow that a layer can feed in cell k (padded k + 2)."""
    zero = type(dt)(0)
    out = dt * inverse_volume[k] * (area[k + 1] * max(zero, f[k + 1]) - area[k] * min(zero, f[k]))
    return share(h[k + GHOSTS], out, dry_depth)


@inlined
def marks(s, c, fx, mk, area, inverse_volume, start, stop, low, high, left, dt):
    """Fill `Marks` of cells, those of grains in low..high-1; `keep` of ghosts stays 1 unless they stand for others."""
    first, count = part(start, stop)
    for m in range(count):
        k = m + first
        mk.keep1[k + GHOSTS] = outflow_share(fx.f1, c.h1, area, inverse_volume, s.dry_depth, dt, k)
    first, count = part(low, high)
    for m in range(count):
        k = m + first
        mk.keep2[k + GHOSTS] = outflow_share(fx.f2, c.h2, area, inverse_volume, s.dry_depth, dt, k)
        mk.held[k + GHOSTS] = min(fx.stuck[k], fx.stuck[k + 1])
    join(mk.keep1, left)
    join(mk.keep2, left)


@inlined
def advance_layer(s, h, u, f, m, p, keep, inner, area, inverse_volume, dt, k):
    """Return a layer's depth and momentum in cell k (padded k + 2) after a step."""
    i = k + GHOSTS
    before = area[k] * dt * inverse_volume[k] * limit(f[k], keep[i - 1], keep[i])
    after = area[k + 1] * dt * inverse_volume[k] * limit(f[k + 1], keep[i], keep[i + 1])
    push = dt / s.dx * (type(dt)(0.5) * (p[k] + p[k + 1]) + inner[i])
    depth = h[i] + (before * f[k] - after * f[k + 1])
    return depth, h[i] * u[i] + (before * m[k] - after * m[k + 1]) - push


@inlined
def update(s, c, fx, mk, area, inverse_volume, start, stop, low, high, dt):
    """Advance cells by dt, grains in low..high-1: fluxes, pressure, then Coulomb friction."""
    reach = dt * (type(s.r)(1) - s.r) * s.friction
    first, count = part(start, stop)
    for m in range(count):
        k = m + first
        h, q = advance_layer(
            s, c.h1, c.u1, fx.f1, fx.m1, fx.p1, mk.keep1, mk.inner_p1x, area, inverse_volume, dt, k
        )
        c.h1[k + GHOSTS] = h
        c.u1[k + GHOSTS] = velocity(q, h, s.dry_depth)
    first, count = part(low, high)
    for m in range(count):
        k = m + first
        h, q = advance_layer(
            s, c.h2, c.u2, fx.f2, fx.m2, fx.p2, mk.keep2, mk.inner_p2x, area, inverse_volume, dt, k
        )
        u = velocity(q, h, s.dry_depth)
        c.h2[k + GHOSTS] = h
        c.u2[k + GHOSTS] = u * braking(s, reach, abs(u), mk.held[k + GHOSTS])
    if is_general(s) and s.law != COULOMB:
        for i in range(low + GHOSTS, high + GHOSTS):
            c.u2[i] *= further(s, dt, c.h2[i], abs(c.u2[i]))
    if is_general(s) and s.treatment == FRICTION:
        rub(s, c.h1, c.u1, c.v1, c.h2, c.u2, c.v2)
