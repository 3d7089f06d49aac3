"""One step in one dimension: a line, or a radius (round scenes), of n cells.

Edge k lies between the padded cells k + 1 and k + 2. `area` (n + 1) is the size of an edge and `inverse_volume` (n)
one over the size of a cell: radius and 1 / (radius dx) for round scenes, 1 and 1 / dx on a line.
"""

from .arrays import GHOSTS, is_general
from .boundary import WALL, copied_after, copied_before, join
from .edge import edge_fluxes, grain_edge_fluxes
from .friction import COULOMB, further
from .friction.coulomb import drive, holds
from .interlayer import FRICTION, rub
from .jit import inlined
from .positivity import limit, share
from .printed import braking
from .reconstruct import depth_slopes, grain_slopes, mc, rates
from .velocity import velocity
from .waves import chosen_outer_speeds, grain_speeds


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
def cell_speeds(s, c):
    """Fill eta, |u2|, the outer wave speeds and the pace of every cell."""
    if s.layers == 1:
        for i in range(c.h1.shape[0]):
            c.eta[i] = c.h2[i]
            c.speed2[i] = abs(c.u2[i])
            slow, fast = grain_speeds(c.h2[i], c.u2[i])
            c.pace[i] = max(fast, -slow)
    else:
        for i in range(c.h1.shape[0]):
            c.eta[i] = c.h1[i] + c.h2[i]
            c.speed2[i] = abs(c.u2[i])
            slow, fast = chosen_outer_speeds(s, c.h1[i], c.u1[i], c.h2[i], c.u2[i])
            c.slow_x[i] = slow
            c.fast_x[i] = fast
            c.pace[i] = max(fast, -slow)


@inlined
def faces(s, c, left, right, mk, ratio, source, dt):
    """Fill the states at the left and right face of each cell and the pressure products across it.

    `ratio` is dt / (2 dx); `source` (n + 4) is -1 / (2 radius) for round scenes, 0 on a line. Grains that friction
    can stop are not accelerated in the half step; moving ones feel no friction in it (more accurate on coarse grids,
    measured).
    """
    real = type(s.r)
    half = real(0.5)
    zero = real(0)
    if s.order == 1:
        for i in range(1, c.h1.shape[0] - 1):
            left.eta[i] = right.eta[i] = c.eta[i]
            left.h1[i] = right.h1[i] = c.h1[i]
            left.u1[i] = right.u1[i] = c.u1[i]
            left.h2[i] = right.h2[i] = c.h2[i]
            left.u2[i] = right.u2[i] = c.u2[i]
        return
    static = (real(1) - s.r) * s.friction
    reach = dt * static
    slope_bound = s.dx * static
    for i in range(1, c.h1.shape[0] - 1):
        h1 = c.h1[i]
        u1 = c.u1[i]
        h2 = c.h2[i]
        u2 = c.u2[i]
        s_u1 = mc(u1 - c.u1[i - 1], c.u1[i + 1] - u1)
        moving = c.speed2[i] > reach
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
        still = holds(reach, slope_bound, c.speed2[i], abs(d_u2))
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
def fill_stuck(s, c, fx, dt):
    """Mark the edges where friction holds the grains on both sides at rest."""
    real = type(s.r)
    static = (real(1) - s.r) * s.friction
    for k in range(fx.stuck.shape[0]):
        i = k + GHOSTS - 1
        j = i + 1
        push = drive(s.r, c.eta[j] - c.eta[i], c.h2[j] - c.h2[i])
        held = holds(dt * static, s.dx * static, max(c.speed2[i], c.speed2[j]), abs(push))
        fx.stuck[k] = real(1) if held else real(0)


@inlined
def grain_edges(s, left, right, fx):
    """Fill the fluxes of every edge for grains alone."""
    zero = type(s.r)(0)
    for k in range(fx.f2.shape[0]):
        i = k + GHOSTS - 1
        j = i + 1
        fx.f2[k], fx.m2[k], fx.p2[k] = grain_edge_fluxes(
            s, fx.stuck[k] != zero, right.h2[i], right.u2[i], left.h2[j], left.u2[j]
        )


@inlined
def edges(s, c, left, right, fx):
    """Fill the fluxes of every edge, from the right face of the cell before it and the left face of the one after."""
    zero = type(s.r)(0)
    for k in range(fx.f1.shape[0]):
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
def marks(s, c, fx, mk, area, inverse_volume, left, dt):
    """Fill `Marks` of every cell but the ghosts, whose `keep` stays 1 unless they stand for other cells."""
    zero = type(s.r)(0)
    for k in range(inverse_volume.shape[0]):
        i = k + GHOSTS
        scale = dt * inverse_volume[k]
        out1 = scale * (area[k + 1] * max(zero, fx.f1[k + 1]) - area[k] * min(zero, fx.f1[k]))
        out2 = scale * (area[k + 1] * max(zero, fx.f2[k + 1]) - area[k] * min(zero, fx.f2[k]))
        mk.keep1[i] = share(c.h1[i], out1, s.dry_depth)
        mk.keep2[i] = share(c.h2[i], out2, s.dry_depth)
        mk.held[i] = min(fx.stuck[k], fx.stuck[k + 1])
    join(mk.keep1, left)
    join(mk.keep2, left)


@inlined
def update(s, c, fx, mk, area, inverse_volume, dt):
    """Advance every cell by dt: fluxes, pressure, then Coulomb friction."""
    real = type(s.r)
    half = real(0.5)
    reach = dt * (real(1) - s.r) * s.friction
    ratio = dt / s.dx
    for k in range(inverse_volume.shape[0]):
        i = k + GHOSTS
        before = area[k] * dt * inverse_volume[k]
        after = area[k + 1] * dt * inverse_volume[k]
        before1 = before * limit(fx.f1[k], mk.keep1[i - 1], mk.keep1[i])
        after1 = after * limit(fx.f1[k + 1], mk.keep1[i], mk.keep1[i + 1])
        before2 = before * limit(fx.f2[k], mk.keep2[i - 1], mk.keep2[i])
        after2 = after * limit(fx.f2[k + 1], mk.keep2[i], mk.keep2[i + 1])
        push1 = ratio * (half * (fx.p1[k] + fx.p1[k + 1]) + mk.inner_p1x[i])
        push2 = ratio * (half * (fx.p2[k] + fx.p2[k + 1]) + mk.inner_p2x[i])
        h1 = c.h1[i] + (before1 * fx.f1[k] - after1 * fx.f1[k + 1])
        h2 = c.h2[i] + (before2 * fx.f2[k] - after2 * fx.f2[k + 1])
        q1 = c.h1[i] * c.u1[i] + (before1 * fx.m1[k] - after1 * fx.m1[k + 1]) - push1
        q2 = c.h2[i] * c.u2[i] + (before2 * fx.m2[k] - after2 * fx.m2[k + 1]) - push2
        u2 = velocity(q2, h2, s.dry_depth)
        c.h1[i] = h1
        c.h2[i] = h2
        c.u1[i] = velocity(q1, h1, s.dry_depth)
        c.u2[i] = u2 * braking(s, reach, abs(u2), mk.held[i])
    if is_general(s) and s.law != COULOMB:
        for i in range(GHOSTS, GHOSTS + inverse_volume.shape[0]):
            c.u2[i] *= further(s, dt, c.h2[i], abs(c.u2[i]))
    if is_general(s) and s.treatment == FRICTION:
        rub(s, c.h1, c.u1, c.v1, c.h2, c.u2, c.v2)
