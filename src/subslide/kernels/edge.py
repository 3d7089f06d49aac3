"""The fluxes through one edge: D-(w_i, w_j) of Eq. (8), split into what radial geometry needs apart.

State normal to the edge, scaled (g = 1): depths h1, h2 and velocities u1, u2; layer 1 is water, layer 2 grains.
"""

import math

from .arrays import is_general
from .jit import inlined
from .viscosity import ROE, RUSANOV, coefficients, hll, rusanov
from .viscosity.roe import roe_viscosity
from .waves import chosen_speeds


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
def front_coefficients(r, dry_depth, h_i, u_i, root_i, h_j, u_j, root_j, h, u):
    """Return alpha0 and alpha1 of HLL with the speeds of grains alone, of gravity g (1-r), at a dry edge.

    Under water grains spread far slower than waves of the water run: u -+ sqrt(g (1-r) h), and u + 2 sqrt(g (1-r) h)
    into a dry cell (Deviation from the paper's HLL, which spreads a front at the speed of the water's waves: it lags
    two to four times as far). The water's viscosity is then what the system's HLL gives to both layers together less
    the grains' part, so that a flat surface stays flat.
    """
    real = type(r)
    root = math.sqrt(real(1) - r)
    c_i = root * root_i
    c_j = root * root_j
    c = root * math.sqrt(h)
    s_l = u_j - (c_j + c_j) if h_i <= dry_depth else min(u - c, u_i - c_i)
    s_r = u_i + (c_i + c_i) if h_j <= dry_depth else max(u + c, u_j + c_j)
    a0, a1, _ = hll(s_l, s_r)
    return a0, a1


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

    e1 = d_eta if stuck else d_h1
    e3 = zero if stuck else d_h2
    k1 = h1 - u1 * u1
    k2 = h2 - u2 * u2
    b2 = k1 * e1 + (u1 + u1) * d_q1 + h1 * e3
    b4 = r * h2 * e1 + k2 * e3 + (u2 + u2) * d_q2
    c2 = k1 * d_q1 + (u1 + u1) * b2 + h1 * d_q2
    c4 = r * h2 * d_q1 + k2 * d_q2 + (u2 + u2) * b4

    v2 = a0 * d_q1 + a1 * b2 + a2 * c2
    front = s.own_front and min(h2_i, h2_j) <= s.dry_depth
    g0, g1 = front_coefficients(r, s.dry_depth, h2_i, u2_i, root2_i, h2_j, u2_j, root2_j, h2, u2)
    g0 = g0 if front else a0
    g1 = g1 if front else a1
    g2 = zero if front else a2
    v3 = g0 * e3 + g1 * d_q2 + g2 * b4
    v1 = (a0 * (e1 + e3) + a1 * (d_q1 + d_q2) - v3) if front else a0 * e1 + a1 * d_q1 + a2 * b2
    v4 = g0 * d_q2 + g1 * b4 + g2 * c4
    if is_general(s) and s.scheme == ROE and not dry:
        a = (u1, k1, h1, u2, k2, r * h2)
        jumps = (e1, d_q1, e3, d_q2, b2, b4, c2, c4)
        v1, v2, v3, v4 = roe_viscosity(a, slow, fast, centre, half_width_squared, slowest, fastest, jumps)

    f1 = half * (q1_i + q1_j - v1)
    m1 = half * (q1_i * u1_i + q1_j * u1_j - v2)
    f2 = half * (q2_i + q2_j - v3)
    m2 = half * (q2_i * u2_i + q2_j * u2_j - v4)
    p1 = h1 * d_eta
    p2 = h2 * (r * d_h1 + d_h2)
    return f1, m1, p1, (zero if stuck else f2), m2, p2


@inlined
def grain_edge_fluxes(scheme, dry_depth, stuck, h_i, u_i, h_j, u_j):
    """Return (f2, m2, p2) for grains alone: exact for r = 0, where the grains do not feel the water.

    A system of two waves leaves IFCP nothing between them, so every scheme but Rusanov is HLL, with the speed of the
    edge of a dam break (u -+ 2 c) into a dry cell.
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
    s_l = u_j - root_j - root_j if h_i <= dry_depth else s_l
    s_r = u_i + root_i + root_i if h_j <= dry_depth else s_r
    a0, a1, _ = rusanov(s_l, s_r) if scheme == RUSANOV else hll(s_l, s_r)
    q_i = h_i * u_i
    q_j = h_j * u_j
    d_q = q_j - q_i
    e = zero if stuck else h_j - h_i
    b = (h - u * u) * e + (u + u) * d_q
    f = half * (q_i + q_j - (a0 * e + a1 * d_q))
    m = half * (q_i * u_i + q_j * u_j - (a0 * d_q + a1 * b))
    return (zero if stuck else f), m, h * (h_j - h_i)
