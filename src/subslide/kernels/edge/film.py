"""The water's fluxes over a step of grains that friction holds, by hydrostatic reconstruction.

A step h2_j - h2_i of grains at rest is a bed to the water. The pressure product of two_layers, on the mean depth, moves
water over a step that stands out of it, and may drive a film without end.
"""

import math

from subslide.kernels.edge.roe_matrix import roe_velocity
from subslide.kernels.jit import inlined
from subslide.kernels.viscosity import two_wave

STEEP = 4.0
"""Steps of grains that are higher than the water over this number are a bed to it."""


LOOKED_FOR = 8.0
"""Such steps are looked for where any water is less than this many times as deep as the step that friction can hold."""


@inlined
def may_overtop(s, shallowest, dx):
    """Return whether water of this least depth is so thin that some step over cells of a size may overtop it."""
    return shallowest < type(s.m)(LOOKED_FOR) * s.m * dx


@inlined
def overtops(stuck, i_h1, i_h2, j_h1, j_h2):
    """Return by how much a step of grains at rest is too high for the water at its foot or on it, else 0."""
    return stuck * (type(stuck)(STEEP) * abs(j_h2 - i_h2) - min(i_h1, j_h1))


@inlined
def film_fluxes(scheme, eta_i, u_i, h2_i, eta_j, u_j, h2_j):
    """Return (f1, m1, p1) over the sill max(h2_i, h2_j) (Audusse et al. 2004).

    Water is as deep there as its surface is above the sill, and not pushed by what stands below it: HLL of the depths
    d = max(0, eta - sill), of whose momentum flux F the cells get F - d_i^2 / 2 and F - d_j^2 / 2.

    Deviation from Eq. (8): the pressure product is that of the depths d, not of the mean depth.
    """
    real = type(u_i)
    half = real(0.5)
    sill = max(h2_i, h2_j)
    d_i = max(real(0), eta_i - sill)
    d_j = max(real(0), eta_j - sill)
    c_i = math.sqrt(d_i)
    c_j = math.sqrt(d_j)
    c = math.sqrt(half * (d_i + d_j))
    u = roe_velocity(c_i, u_i, c_j, u_j)
    s_l = min(u - c, min(u_i - c_i, u_j - c_j))
    s_r = max(u + c, max(u_i + c_i, u_j + c_j))
    a0, a1 = two_wave(scheme, s_l, s_r)
    q_i = d_i * u_i
    q_j = d_j * u_j
    square_i = half * d_i * d_i
    square_j = half * d_j * d_j
    push = square_j - square_i
    f = half * (q_i + q_j - (a0 * (d_j - d_i) + a1 * (q_j - q_i)))
    m = half * (q_i * u_i + q_j * u_j - (a0 * (q_j - q_i) + a1 * (q_j * u_j - q_i * u_i + push)))
    return f, m, push
