"""The fluxes through an edge between cells without grains."""

import math

from subslide.kernels.edge.roe_matrix import roe_velocity
from subslide.kernels.jit import inlined
from subslide.kernels.viscosity import two_wave
from subslide.kernels.waves import water_speeds


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
    a0, a1 = two_wave(s.scheme, min(slow, slowest), max(fast, fastest))
    b = (h - u * u) * d_eta + (u + u) * d_q
    f = half * (q_i + q_j - (a0 * d_eta + a1 * d_q))
    m = half * (q_i * u_i + q_j * u_j - (a0 * d_q + a1 * b))
    return f, m, h * d_eta
