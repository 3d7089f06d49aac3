"""One step in the plane, as work on rows of ny x nx square cells (y first).

Edge (j, k) of `fx` lies between the padded cells k + 1 and k + 2 of the padded row j + 2; `fy` likewise along y.
Rows are worked on in blocks so that the states at faces stay in a core's cache.
"""

from .arrays import GHOSTS, Side, is_general
from .boundary import WALL, copied_after, copied_before
from .edge import edge_fluxes
from .friction import COULOMB, further
from .friction.coulomb import drive, holds
from .interlayer import FRICTION, rub
from .jit import inlined
from .positivity import limit, share
from .printed import braking, carried
from .reconstruct import depth_slopes, grain_slopes, mc, rates
from .velocity import norm, velocity
from .waves import chosen_outer_speeds


@inlined
def copy_cell(c, j, i, ghost_j, ghost_i, flip_u, flip_v):
    """Copy a cell's state into a ghost, with the velocity along x or y reversed."""
    c.h1[ghost_j, ghost_i] = c.h1[j, i]
    c.h2[ghost_j, ghost_i] = c.h2[j, i]
    c.u1[ghost_j, ghost_i] = -c.u1[j, i] if flip_u else c.u1[j, i]
    c.u2[ghost_j, ghost_i] = -c.u2[j, i] if flip_u else c.u2[j, i]
    c.v1[ghost_j, ghost_i] = -c.v1[j, i] if flip_v else c.v1[j, i]
    c.v2[ghost_j, ghost_i] = -c.v2[j, i] if flip_v else c.v2[j, i]


@inlined
def fill_ghosts(c, walls):
    """Set the ghost cells; `walls` says what (left, right, bottom, top) are, see `boundary`."""
    ny, nx = c.h1.shape
    left, right, bottom, top = walls
    for g in range(GHOSTS):
        for j in range(GHOSTS, ny - GHOSTS):
            copy_cell(c, j, copied_before(left, g, nx), j, GHOSTS - 1 - g, left == WALL, False)
            copy_cell(c, j, copied_after(right, g, nx), j, nx - GHOSTS + g, right == WALL, False)
    for g in range(GHOSTS):
        for i in range(nx):
            copy_cell(c, copied_before(bottom, g, ny), i, GHOSTS - 1 - g, i, False, bottom == WALL)
            copy_cell(c, copied_after(top, g, ny), i, ny - GHOSTS + g, i, False, top == WALL)


@inlined
def cell_speeds(s, c, j):
    """Fill eta, |u2|, the outer wave speeds and the pace of the padded row j."""
    for i in range(c.h1.shape[1]):
        h1 = c.h1[j, i]
        h2 = c.h2[j, i]
        c.eta[j, i] = h1 + h2
        c.speed2[j, i] = norm(c.u2[j, i], c.v2[j, i])
        slow_x, fast_x = chosen_outer_speeds(s, h1, c.u1[j, i], h2, c.u2[j, i])
        slow_y, fast_y = chosen_outer_speeds(s, h1, c.v1[j, i], h2, c.v2[j, i])
        c.slow_x[j, i] = slow_x
        c.fast_x[j, i] = fast_x
        c.slow_y[j, i] = slow_y
        c.fast_y[j, i] = fast_y
        c.pace[j, i] = max(fast_x, -slow_x) + max(fast_y, -slow_y)


@inlined
def constant_faces(c, j, left, right, lower, upper, b, u):
    """First order: the states at all four faces of the padded row j are the cell's."""
    for i in range(1, c.h1.shape[1] - 1):
        left.eta[b, i] = right.eta[b, i] = lower.eta[b, i] = upper.eta[u, i] = c.eta[j, i]
        left.h1[b, i] = right.h1[b, i] = lower.h1[b, i] = upper.h1[u, i] = c.h1[j, i]
        left.u1[b, i] = right.u1[b, i] = lower.u1[b, i] = upper.u1[u, i] = c.u1[j, i]
        left.v1[b, i] = right.v1[b, i] = lower.v1[b, i] = upper.v1[u, i] = c.v1[j, i]
        left.h2[b, i] = right.h2[b, i] = lower.h2[b, i] = upper.h2[u, i] = c.h2[j, i]
        left.u2[b, i] = right.u2[b, i] = lower.u2[b, i] = upper.u2[u, i] = c.u2[j, i]
        left.v2[b, i] = right.v2[b, i] = lower.v2[b, i] = upper.v2[u, i] = c.v2[j, i]


@inlined
def put(low, high, b, u, i, state, slopes):
    """Write the states half a cell either side of `state` into row b of `low` and row u of `high`."""
    half = type(state.h1)(0.5)
    low.eta[b, i] = state.eta - half * slopes.eta
    low.h1[b, i] = state.h1 - half * slopes.h1
    low.u1[b, i] = state.u1 - half * slopes.u1
    low.v1[b, i] = state.v1 - half * slopes.v1
    low.h2[b, i] = state.h2 - half * slopes.h2
    low.u2[b, i] = state.u2 - half * slopes.u2
    low.v2[b, i] = state.v2 - half * slopes.v2
    high.eta[u, i] = state.eta + half * slopes.eta
    high.h1[u, i] = state.h1 + half * slopes.h1
    high.u1[u, i] = state.u1 + half * slopes.u1
    high.v1[u, i] = state.v1 + half * slopes.v1
    high.h2[u, i] = state.h2 + half * slopes.h2
    high.u2[u, i] = state.u2 + half * slopes.u2
    high.v2[u, i] = state.v2 + half * slopes.v2


@inlined
def faces(s, c, mk, j, left, right, lower, upper, b, u, dt):
    """Second order: the states at the four faces of the padded row j, half a step on, and the inner pressure products.

    They go to row b of `left`, `right`, `lower` and row u of `upper`. Grains that friction can stop are not
    accelerated in the half step; moving ones feel no friction in it (more accurate on coarse grids, measured).
    """
    real = type(s.r)
    zero = real(0)
    ratio = real(0.5) * dt / s.dx
    static = (real(1) - s.r) * s.friction
    for i in range(1, c.h1.shape[1] - 1):
        h1, u1, v1 = c.h1[j, i], c.u1[j, i], c.v1[j, i]
        h2, u2, v2 = c.h2[j, i], c.u2[j, i], c.v2[j, i]
        moving = c.speed2[j, i] > dt * static
        x_h2, x_u2 = grain_slopes(
            s.r, s.dry_depth, moving, c.h2[j, i - 1], c.u2[j, i - 1], h2, u2, c.h2[j, i + 1], c.u2[j, i + 1]
        )
        y_h2, y_v2 = grain_slopes(
            s.r, s.dry_depth, moving, c.h2[j - 1, i], c.v2[j - 1, i], h2, v2, c.h2[j + 1, i], c.v2[j + 1, i]
        )
        x = Side(
            mc(c.eta[j, i] - c.eta[j, i - 1], c.eta[j, i + 1] - c.eta[j, i]),
            zero,
            mc(u1 - c.u1[j, i - 1], c.u1[j, i + 1] - u1),
            mc(v1 - c.v1[j, i - 1], c.v1[j, i + 1] - v1),
            x_h2,
            x_u2,
            mc(v2 - c.v2[j, i - 1], c.v2[j, i + 1] - v2),
        )
        y = Side(
            mc(c.eta[j, i] - c.eta[j - 1, i], c.eta[j + 1, i] - c.eta[j, i]),
            zero,
            mc(u1 - c.u1[j - 1, i], c.u1[j + 1, i] - u1),
            mc(v1 - c.v1[j - 1, i], c.v1[j + 1, i] - v1),
            y_h2,
            mc(u2 - c.u2[j - 1, i], c.u2[j + 1, i] - u2),
            y_v2,
        )
        xe, x1, x2 = depth_slopes(h1, h2, x.eta, x.h2)
        ye, y1, y2 = depth_slopes(h1, h2, y.eta, y.h2)
        ax1, au1, ax2, au2 = rates(s.r, h1, u1, h2, u2, xe, x1, x2, x.u1, x.u2)
        ay1, av1, ay2, av2 = rates(s.r, h1, v1, h2, v2, ye, y1, y2, y.v1, y.v2)
        still = holds(dt * static, s.dx * static, c.speed2[j, i], norm(au2, av2))
        change1 = max(-h1, ratio * (ax1 + ay1))
        change2 = max(-h2, ratio * (ax2 + ay2))
        m_h1 = h1 + change1
        m_h2 = h2 + change2
        m_eta = c.eta[j, i] + change1 + change2
        m_u1 = u1 + ratio * (au1 - v1 * y.u1)
        m_v1 = v1 + ratio * (av1 - u1 * x.v1)
        m_u2 = u2 + (zero if still else ratio * (au2 - v2 * y.u2))
        m_v2 = v2 + (zero if still else ratio * (av2 - u2 * x.v2))
        xe, x1, x2 = depth_slopes(m_h1, m_h2, xe, x2)
        ye, y1, y2 = depth_slopes(m_h1, m_h2, ye, y2)
        middle = Side(m_eta, m_h1, m_u1, m_v1, m_h2, m_u2, m_v2)
        put(left, right, b, b, i, middle, Side(xe, x1, x.u1, x.v1, x2, x.u2, x.v2))
        put(lower, upper, b, u, i, middle, Side(ye, y1, y.u1, y.v1, y2, y.u2, y.v2))
        mk.inner_p1x[j, i] = m_h1 * xe
        mk.inner_p2x[j, i] = m_h2 * (s.r * x1 + x2)
        mk.inner_p1y[j, i] = m_h1 * ye
        mk.inner_p2y[j, i] = m_h2 * (s.r * y1 + y2)


@inlined
def central_push(r, c, j, i, step_j, step_i):
    """Return half the driving jump between the cells either side of (j, i)."""
    d_eta = c.eta[j + step_j, i + step_i] - c.eta[j - step_j, i - step_i]
    d_h2 = c.h2[j + step_j, i + step_i] - c.h2[j - step_j, i - step_i]
    return type(r)(0.5) * drive(r, d_eta, d_h2)


@inlined
def fill_stuck(s, c, j, stuck, start_j, start_i, step_j, step_i, dt):
    """Fill row j of `stuck`, 1 for edges that friction holds; steps (0, 1) for edges along x and (1, 0) along y.

    The driving force is a vector: its part along the edge is the mean of the central jumps in both cells. (With the
    normal part alone a cell on a slope across the grid could be too steep to stop, yet pass nothing on.)
    """
    real = type(s.r)
    static = (real(1) - s.r) * s.friction
    p = j + start_j
    n = p + step_j
    for k in range(stuck.shape[1]):
        i = k + start_i
        m = i + step_i
        normal = drive(s.r, c.eta[n, m] - c.eta[p, i], c.h2[n, m] - c.h2[p, i])
        along = central_push(s.r, c, p, i, step_i, step_j) + central_push(s.r, c, n, m, step_i, step_j)
        push = norm(normal, real(0.5) * along)
        held = holds(dt * static, s.dx * static, max(c.speed2[p, i], c.speed2[n, m]), push)
        stuck[j, k] = real(1) if held else real(0)


@inlined
def edges_x(s, c, j, left, right, b, fx):
    """Fill the fluxes through the edges along row j of `fx` (padded row j + 2) from row b of the face states."""
    zero = type(s.r)(0)
    p = j + GHOSTS
    for k in range(fx.f1.shape[1]):
        i = k + GHOSTS - 1
        n = i + 1
        f1, m1, p1, f2, m2, p2 = edge_fluxes(
            s,
            fx.stuck[j, k] != zero,
            min(c.slow_x[p, i], c.slow_x[p, n]),
            max(c.fast_x[p, i], c.fast_x[p, n]),
            right.h1[b, i],
            right.u1[b, i],
            right.h2[b, i],
            right.u2[b, i],
            left.h1[b, n],
            left.u1[b, n],
            left.h2[b, n],
            left.u2[b, n],
            left.eta[b, n] - right.eta[b, i],
        )
        fx.f1[j, k], fx.m1[j, k], fx.p1[j, k] = f1, m1, p1
        fx.f2[j, k], fx.m2[j, k], fx.p2[j, k] = f2, m2, p2
        fx.t1[j, k] = f1 * carried(s, f1, left.h1[b, n], right.v1[b, i], left.h1[b, n], left.v1[b, n])
        fx.t2[j, k] = f2 * carried(s, f2, right.h2[b, i], right.v2[b, i], left.h2[b, n], left.v2[b, n])


@inlined
def edges_y(s, c, j, lower, upper, b, u, fy):
    """Fill row j of `fy`, between the padded rows j + 1 (its upper faces, row u) and j + 2 (its lower faces, row b)."""
    zero = type(s.r)(0)
    p = j + GHOSTS - 1
    n = p + 1
    for k in range(fy.f1.shape[1]):
        i = k + GHOSTS
        f1, m1, p1, f2, m2, p2 = edge_fluxes(
            s,
            fy.stuck[j, k] != zero,
            min(c.slow_y[p, i], c.slow_y[n, i]),
            max(c.fast_y[p, i], c.fast_y[n, i]),
            upper.h1[u, i],
            upper.v1[u, i],
            upper.h2[u, i],
            upper.v2[u, i],
            lower.h1[b, i],
            lower.v1[b, i],
            lower.h2[b, i],
            lower.v2[b, i],
            lower.eta[b, i] - upper.eta[u, i],
        )
        fy.f1[j, k], fy.m1[j, k], fy.p1[j, k] = f1, m1, p1
        fy.f2[j, k], fy.m2[j, k], fy.p2[j, k] = f2, m2, p2
        fy.t1[j, k] = f1 * carried(s, f1, lower.h1[b, i], upper.u1[u, i], lower.h1[b, i], lower.u1[b, i])
        fy.t2[j, k] = f2 * carried(s, f2, upper.h2[u, i], upper.u2[u, i], lower.h2[b, i], lower.u2[b, i])


@inlined
def outflow(fx, fy, j, k):
    """Return what leaves cell (j, k) through its four edges, given the mass fluxes along x and y."""
    zero = type(fx[0, 0])(0)
    along_x = max(zero, fx[j, k + 1]) - min(zero, fx[j, k])
    return along_x + (max(zero, fy[j + 1, k]) - min(zero, fy[j, k]))


@inlined
def marks(s, c, fx, fy, mk, j, dt):
    """Fill `Marks` of row j (padded row j + 2)."""
    ratio = dt / s.dx
    p = j + GHOSTS
    for k in range(fy.f1.shape[1]):
        i = k + GHOSTS
        mk.keep1[p, i] = share(c.h1[p, i], ratio * outflow(fx.f1, fy.f1, j, k), s.dry_depth)
        mk.keep2[p, i] = share(c.h2[p, i], ratio * outflow(fx.f2, fy.f2, j, k), s.dry_depth)
        mk.held[p, i] = min(min(fx.stuck[j, k], fx.stuck[j, k + 1]), min(fy.stuck[j, k], fy.stuck[j + 1, k]))


@inlined
def update(s, c, fx, fy, mk, j, dt):
    """Advance row j (padded row j + 2) by dt: fluxes, pressure, then Coulomb friction."""
    real = type(s.r)
    half = real(0.5)
    reach = dt * (real(1) - s.r) * s.friction
    ratio = dt / s.dx
    p = j + GHOSTS
    for k in range(fy.f1.shape[1]):
        i = k + GHOSTS
        w1 = ratio * limit(fx.f1[j, k], mk.keep1[p, i - 1], mk.keep1[p, i])
        e1 = ratio * limit(fx.f1[j, k + 1], mk.keep1[p, i], mk.keep1[p, i + 1])
        s1 = ratio * limit(fy.f1[j, k], mk.keep1[p - 1, i], mk.keep1[p, i])
        n1 = ratio * limit(fy.f1[j + 1, k], mk.keep1[p, i], mk.keep1[p + 1, i])
        w2 = ratio * limit(fx.f2[j, k], mk.keep2[p, i - 1], mk.keep2[p, i])
        e2 = ratio * limit(fx.f2[j, k + 1], mk.keep2[p, i], mk.keep2[p, i + 1])
        s2 = ratio * limit(fy.f2[j, k], mk.keep2[p - 1, i], mk.keep2[p, i])
        n2 = ratio * limit(fy.f2[j + 1, k], mk.keep2[p, i], mk.keep2[p + 1, i])
        h1 = c.h1[p, i]
        h2 = c.h2[p, i]
        new1 = h1 + ((w1 * fx.f1[j, k] - e1 * fx.f1[j, k + 1]) + (s1 * fy.f1[j, k] - n1 * fy.f1[j + 1, k]))
        new2 = h2 + ((w2 * fx.f2[j, k] - e2 * fx.f2[j, k + 1]) + (s2 * fy.f2[j, k] - n2 * fy.f2[j + 1, k]))
        gain_x1 = (w1 * fx.m1[j, k] - e1 * fx.m1[j, k + 1]) + (s1 * fy.t1[j, k] - n1 * fy.t1[j + 1, k])
        gain_y1 = (s1 * fy.m1[j, k] - n1 * fy.m1[j + 1, k]) + (w1 * fx.t1[j, k] - e1 * fx.t1[j, k + 1])
        gain_x2 = (w2 * fx.m2[j, k] - e2 * fx.m2[j, k + 1]) + (s2 * fy.t2[j, k] - n2 * fy.t2[j + 1, k])
        gain_y2 = (s2 * fy.m2[j, k] - n2 * fy.m2[j + 1, k]) + (w2 * fx.t2[j, k] - e2 * fx.t2[j, k + 1])
        push_x1 = ratio * (half * (fx.p1[j, k] + fx.p1[j, k + 1]) + mk.inner_p1x[p, i])
        push_y1 = ratio * (half * (fy.p1[j, k] + fy.p1[j + 1, k]) + mk.inner_p1y[p, i])
        push_x2 = ratio * (half * (fx.p2[j, k] + fx.p2[j, k + 1]) + mk.inner_p2x[p, i])
        push_y2 = ratio * (half * (fy.p2[j, k] + fy.p2[j + 1, k]) + mk.inner_p2y[p, i])
        u2 = velocity(h2 * c.u2[p, i] + (gain_x2 - push_x2), new2, s.dry_depth)
        v2 = velocity(h2 * c.v2[p, i] + (gain_y2 - push_y2), new2, s.dry_depth)
        factor = braking(s, reach, norm(u2, v2), mk.held[p, i])
        c.u1[p, i] = velocity(h1 * c.u1[p, i] + (gain_x1 - push_x1), new1, s.dry_depth)
        c.v1[p, i] = velocity(h1 * c.v1[p, i] + (gain_y1 - push_y1), new1, s.dry_depth)
        c.u2[p, i] = factor * u2
        c.v2[p, i] = factor * v2
        c.h1[p, i] = new1
        c.h2[p, i] = new2
    if is_general(s) and s.law != COULOMB:
        for i in range(GHOSTS, GHOSTS + fy.f1.shape[1]):
            factor = further(s, dt, c.h2[p, i], norm(c.u2[p, i], c.v2[p, i]))
            c.u2[p, i] *= factor
            c.v2[p, i] *= factor
    if is_general(s) and s.treatment == FRICTION:
        rub(s, c.h1[p], c.u1[p], c.v1[p], c.h2[p], c.u2[p], c.v2[p])
