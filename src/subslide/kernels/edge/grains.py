"""The fluxes through an edge of grains alone: exact for r = 0, where the grains do not feel the water."""

import math

from subslide.kernels.edge.front import front_fluxes, runs_onto_dry_bed
from subslide.kernels.edge.roe_matrix import roe_velocity
from subslide.kernels.edge.stuck import by_weight, sees_friction
from subslide.kernels.jit import inlined
from subslide.kernels.viscosity import two_wave


@inlined
def grain_edge_fluxes(s, stuck, h_i, u_i, h_j, u_j):
    """Return (f2, m2, p2) for grains alone.

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
    a0, a1 = two_wave(s.scheme, s_l, s_r)
    q_i = h_i * u_i
    q_j = h_j * u_j
    d_q = q_j - q_i
    holds = stuck and sees_friction(s)
    e = zero if holds else h_j - h_i
    b = (h - u * u) * e + (u + u) * d_q
    f = half * (q_i + q_j - (a0 * e + a1 * d_q))
    m = half * (q_i * u_i + q_j * u_j - (a0 * d_q + a1 * b))
    front = runs_onto_dry_bed(s, stuck, h_i, h_j)
    f_front, m_front = front_fluxes(zero, h_i, u_i, h_j, u_j)
    f = f_front if front else f
    m = by_weight(h_i, h_j, h_j - h_i) if holds else m
    return (zero if holds else f), (m_front if front else m), h * (h_j - h_i)
