"""Second order in the plane: the states at a cell's four faces."""

from subslide.kernels.arrays import Side
from subslide.kernels.friction.coulomb import holds
from subslide.kernels.jit import inlined, part
from subslide.kernels.reconstruct import depth_slopes, grain_slopes, mc, rates


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
def faces(s, c, terms, j, sides, b, u, start, stop, dt):
    """Fill the states at the four faces of the padded row j, half a step on, and the inner pressure products.

    They go to row b of `left`, `right`, `lower` and row u of `upper`, the four `sides`. Grains that friction can stop
    are not accelerated in the half step; moving ones feel no friction in it (more accurate on coarse grids, measured).
    """
    left, right, lower, upper = sides
    real = type(s.r)
    zero = real(0)
    ratio = real(0.5) * dt / s.dx
    static = (real(1) - s.r) * s.m
    reach = dt * static
    first, count = part(start, stop)
    for k in range(count):
        i = k + first + 1
        h1, u1, v1 = c.h1[j, i], c.u1[j, i], c.v1[j, i]
        h2, u2, v2 = c.h2[j, i], c.u2[j, i], c.v2[j, i]
        moving = c.square2[j, i] > reach * reach
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
        still = holds(reach, s.dx * static, c.square2[j, i], au2 * au2 + av2 * av2)
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
        terms.inner_p1x[j, i] = m_h1 * xe
        terms.inner_p2x[j, i] = m_h2 * (s.r * x1 + x2)
        terms.inner_p1y[j, i] = m_h1 * ye
        terms.inner_p2y[j, i] = m_h2 * (s.r * y1 + y2)
