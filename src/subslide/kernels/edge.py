"""The fluxes through one edge: D-(w_i, w_j) of Eq. (8), split into what radial geometry needs apart.

State normal to the edge, scaled (g = 1): depths h1, h2 and velocities u1, u2; layer 1 is water, layer 2 grains.
"""

import math

from subslide.kernels.arrays import is_general
from subslide.kernels.hyperbolicity import takes_hll
from subslide.kernels.jit import inlined
from subslide.kernels.viscosity import ROE, RUSANOV, coefficients, hll, rusanov
from subslide.kernels.viscosity.roe import roe_viscosity
from subslide.kernels.waves import chosen_speeds, water_speeds


@inlined
def roe_velocity(root_i, u_i, root_j, u_j):
    """Return the Roe mean of two velocities, weighted by the roots of the depths; 0 between dry cells."""
    real = type(u_i)
    weight = root_i + root_j
    return (root_i * u_i + root_j * u_j) / (weight if weight > real(0) else real(1))


@inlined
def intermediate_speed(s_l, s_r, centre, half_width_squared):
    """Return S_int of Eq. (11): the largest inner speed, on the side of the larger outer speed (Eq. 12).

    A complex pair counts with its real part.
    """
    real = type(s_l)
    size = abs(centre) + math.sqrt(max(half_width_squared, real(0)))
    return math.copysign(size, s_r if abs(s_r) > abs(s_l) else s_l)


@inlined
def front_fluxes(r, h_i, u_i, root_i, h_j, u_j, root_j):
    """Return the fluxes of mass and momentum of grains that run onto a dry bed, exact for grains of gravity g (1-r).

    The edge lies in the fan of a dam break (Ritter 1892; Toro 2001, section 6.3): there u* = (w + 2 c) / 3 = sqrt(g
    (1-r) h*) where the outward velocity w is below c = sqrt(g (1-r) h), else the state of the wet side. The momentum
    flux is less half the pressure product, which acts apart. (Deviation from the paper's HLL, which spreads a front
    at the speed of the water's waves: it lags two to four times as far.)
    """
    real = type(r)
    third = real(1.0 / 3.0)
    reduced = real(1) - r
    right = h_i > h_j
    h = h_i if right else h_j
    w = u_i if right else -u_j
    c = math.sqrt(reduced) * (root_i if right else root_j)
    a = max(real(0), third * (w + c + c))
    fan = w < c
    u_star = a if fan else w
    h_star = a * a / reduced if fan else h
    mass = h_star * u_star
    half = real(0.5)
    push = half * reduced * (h_star * h_star - half * h * h)
    return (mass if right else -mass), mass * u_star + push


@inlined
def sees_friction(s):
    """Return whether the viscosity sees what friction holds; without it piles at rest creep."""
    return not is_general(s) or s.viscous_friction != 0


@inlined
def edge_fluxes(s, stuck, slowest, fastest, h1_i, u1_i, h2_i, u2_i, h1_j, u1_j, h2_j, u2_j, d_eta):
    """Return (f1, m1, p1, f2, m2, p2): for each layer the flux of mass, of momentum, and the pressure product.

    The momentum flux holds advection and viscosity; the pressure products g h1 d(h1+h2) and g h2 d(r h1 + h2),
    exact for the straight path, act half on each side. `slowest` and `fastest` bound the wave speeds in both cells
    (Deviation from the paper's S_L, S_R, which are one-sided: depths stay positive only with the bounds of i, j and
    ij). `d_eta` is the jump of h1 + h2, given so that a flat surface is exactly flat.

    `stuck`: grains at rest that friction holds. The viscosity then sees d - A^-1 S in closed form: no jump of the
    grains, and the surface's jump in place of the water's (Deviation from Eq. 8, which prints d + A^-1 S); no grain
    passes the edge.
    """
    real = type(h1_i)
    r = s.r
    half = real(0.5)
    zero = real(0)
    h1 = half * (h1_i + h1_j)
    h2 = half * (h2_i + h2_j)
    u1 = roe_velocity(math.sqrt(h1_i), u1_i, math.sqrt(h1_j), u1_j)
    root2_i = math.sqrt(h2_i)
    root2_j = math.sqrt(h2_j)
    u2 = roe_velocity(root2_i, u2_i, root2_j, u2_j)
    q1_i = h1_i * u1_i
    q1_j = h1_j * u1_j
    q2_i = h2_i * u2_i
    q2_j = h2_j * u2_j
    d_h2 = h2_j - h2_i
    d_h1 = d_eta - d_h2
    d_q1 = q1_j - q1_i
    d_q2 = q2_j - q2_i

    slow, fast, centre, half_width_squared = chosen_speeds(s, h1, u1, h2, u2)
    s_l = min(slow, slowest)
    s_r = max(fast, fastest)
    s_int = intermediate_speed(s_l, s_r, centre, half_width_squared)
    dry = min(min(h1_i, h1_j), min(h2_i, h2_j)) <= s.dry_depth
    a0, a1, a2 = coefficients(s.scheme, s_l, s_int, s_r, dry)
    plain = takes_hll(s, dry, h1, u1, h2, u2)
    if plain:
        a0, a1, a2 = hll(s_l, s_r)
    held = stuck
    stuck = held and sees_friction(s)

    e1 = d_eta if stuck else d_h1
    e3 = zero if stuck else d_h2
    k1 = h1 - u1 * u1
    k2 = h2 - u2 * u2
    b2 = k1 * e1 + (u1 + u1) * d_q1 + h1 * e3
    b4 = r * h2 * e1 + k2 * e3 + (u2 + u2) * d_q2
    c2 = k1 * d_q1 + (u1 + u1) * b2 + h1 * d_q2
    c4 = r * h2 * d_q1 + k2 * d_q2 + (u2 + u2) * b4

    f2 = half * (q2_i + q2_j - (a0 * e3 + a1 * d_q2 + a2 * b4))
    m2 = half * (q2_i * u2_i + q2_j * u2_j - (a0 * d_q2 + a1 * b4 + a2 * c4))
    front = s.exact_front and not held and h2_i != h2_j and min(h2_i, h2_j) <= s.dry_depth
    f2_front, m2_front = front_fluxes(r, h2_i, u2_i, root2_i, h2_j, u2_j, root2_j)
    f2 = f2_front if front else f2
    m2 = m2_front if front else m2
    f2 = zero if stuck else f2  # no grain passes a stuck edge
    # both layers get what the scheme gives their sum, so that a flat surface over a front stays flat
    both = a0 * (e1 + e3) + a1 * (d_q1 + d_q2)
    v1 = both - (q2_i + q2_j - (f2 + f2)) if front else a0 * e1 + a1 * d_q1 + a2 * b2
    v2 = a0 * d_q1 + a1 * b2 + a2 * c2
    if is_general(s) and s.scheme == ROE and not dry and not plain:
        a = (u1, k1, h1, u2, k2, r * h2)
        jumps = (e1, d_q1, e3, d_q2, b2, b4, c2, c4)
        v1, v2, v3, v4 = roe_viscosity(a, slow, fast, centre, half_width_squared, slowest, fastest, jumps)
        f2 = zero if stuck else half * (q2_i + q2_j - v3)
        m2 = half * (q2_i * u2_i + q2_j * u2_j - v4)

    f1 = half * (q1_i + q1_j - v1)
    m1 = half * (q1_i * u1_i + q1_j * u1_j - v2)
    p1 = h1 * d_eta
    p2 = h2 * (r * d_h1 + d_h2)
    return f1, m1, p1, f2, m2, p2


@inlined
def water_edge_fluxes(s, slowest, fastest, h_i, u_i, h_j, u_j, d_eta):
    """Return (f1, m1, p1) where no side has grains: the bits of `edge_fluxes` (but with IFCP), which is HLL there."""
    real = type(h_i)
    half = real(0.5)
    h = half * (h_i + h_j)
    u = roe_velocity(math.sqrt(h_i), u_i, math.sqrt(h_j), u_j)
    q_i = h_i * u_i
    q_j = h_j * u_j
    d_q = q_j - q_i
    slow, fast = water_speeds(h, u)
    s_l = min(slow, slowest)
    s_r = max(fast, fastest)
    a0, a1, _ = rusanov(s_l, s_r) if s.scheme == RUSANOV else hll(s_l, s_r)
    b = (h - u * u) * d_eta + (u + u) * d_q
    f = half * (q_i + q_j - (a0 * d_eta + a1 * d_q))
    m = half * (q_i * u_i + q_j * u_j - (a0 * d_q + a1 * b))
    return f, m, h * d_eta


@inlined
def grain_edge_fluxes(s, stuck, h_i, u_i, h_j, u_j):
    """Return (f2, m2, p2) for grains alone: exact for r = 0, where the grains do not feel the water.

    A system of two waves leaves IFCP nothing between them, so every scheme but Rusanov is HLL, with the speed of the
    edge of a dam break (u -+ 2 c) into a dry cell where the flux there is not exact.
    """
    real = type(h_i)
    half = real(0.5)
    zero = real(0)
    root_i = math.sqrt(h_i)
    root_j = math.sqrt(h_j)
    h = half * (h_i + h_j)
    u = roe_velocity(root_i, u_i, root_j, u_j)
    c = math.sqrt(h)
    s_l = min(u - c, u_i - root_i)
    s_r = max(u + c, u_j + root_j)
    s_l = u_j - root_j - root_j if h_i <= s.dry_depth else s_l
    s_r = u_i + root_i + root_i if h_j <= s.dry_depth else s_r
    a0, a1, _ = rusanov(s_l, s_r) if s.scheme == RUSANOV else hll(s_l, s_r)
    q_i = h_i * u_i
    q_j = h_j * u_j
    d_q = q_j - q_i
    held = stuck
    stuck = held and sees_friction(s)
    e = zero if stuck else h_j - h_i
    b = (h - u * u) * e + (u + u) * d_q
    f = half * (q_i + q_j - (a0 * e + a1 * d_q))
    m = half * (q_i * u_i + q_j * u_j - (a0 * d_q + a1 * b))
    front = s.exact_front and not held and h_i != h_j and min(h_i, h_j) <= s.dry_depth
    f_front, m_front = front_fluxes(zero, h_i, u_i, root_i, h_j, u_j, root_j)
    f = f_front if front else f
    return (zero if stuck else f), (m_front if front else m), h * (h_j - h_i)
