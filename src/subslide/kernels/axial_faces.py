"""Second order on a line or a radius: the states at both faces of cells, by MUSCL-Hancock (see `reconstruct`)."""

from subslide.kernels.friction.coulomb import holds
from subslide.kernels.jit import inlined, part, unsigned
from subslide.kernels.motion import centre_drift, share_of_width, width_at
from subslide.kernels.reconstruct import depth_slopes, grain_slopes, mc, rates


@inlined
def faces(s, c, left, right, terms, source, motion, start, stop, dt):
    """Fill the states at both faces of cells, half a step on, and the pressure products across them: second order.

    `source` is `Mesh.source`. In cells that move the half step is seen by one who moves with their centres. Grains that
    friction can stop are not accelerated in the half step; moving ones feel no friction in it (more accurate on coarse
    grids, measured).
    """
    real = type(s.r)
    half = real(0.5)
    zero = real(0)
    static = (real(1) - s.r) * s.m
    reach = dt * static
    first, count = part(start, stop)
    for k in range(count):
        i = k + first + 1
        h1 = c.h1[i]
        u1 = c.u1[i]
        h2 = c.h2[i]
        u2 = c.u2[i]
        width = width_at(motion, i, s.dx)
        ratio = share_of_width(motion, i, half * dt, s.dx)
        drift = centre_drift(motion, i, zero)
        s_u1 = mc(u1 - c.u1[i - 1], c.u1[i + 1] - u1, motion, i)
        moving = c.square2[i] > reach * reach
        s_h2, s_u2 = grain_slopes(
            s.r, s.dry_depth, moving, c.h2[i - 1], c.u2[i - 1], h2, u2, c.h2[i + 1], c.u2[i + 1], motion, i
        )
        s_eta, s_h1, s_h2 = depth_slopes(
            h1,
            h2,
            mc(c.eta[i] - c.eta[i - 1], c.eta[i + 1] - c.eta[i], motion, i),
            s_h2,
        )
        d_h1, d_u1, d_h2, d_u2 = rates(s.r, h1, u1 - drift, h2, u2 - drift, s_eta, s_h1, s_h2, s_u1, s_u2)
        change1 = max(-h1, ratio * d_h1 + dt * source[i] * h1 * u1)
        change2 = max(-h2, ratio * d_h2 + dt * source[i] * h2 * u2)
        still = holds(reach, width * static, c.square2[i], d_u2 * d_u2)
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
        terms.inner_p1x[i] = m_h1 * t_eta
        terms.inner_p2x[i] = m_h2 * (s.r * t_h1 + t_h2)


@inlined
def water_faces(s, c, left, right, terms, source, start, stop, dt):
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
        terms.inner_p1x[i] = m_h1 * s_eta
