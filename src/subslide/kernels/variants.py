"""Viscosities of one edge that three coefficients do not describe; only the general kernels hold them."""

import math

from .jit import inlined
from .viscosity.hll import hll
from .viscosity.roe import roe


@inlined
def roe_viscosity(a, slow, fast, centre, half_width_squared, slowest, fastest, jumps):
    """Return |A| d. `a` is (u1, h1 - u1^2, h1, u2, h2 - u2^2, r h2); `jumps` are d, A d and A^2 d without repeats.

    The outer speeds of a fan that opens are raised by its half-width (Harten and Hyman 1983), or a transonic one would
    stay a jump.
    """
    u1, k1, h1, u2, k2, rh2 = a
    e1, d_q1, e3, d_q2, b2, b4, c2, c4 = jumps
    w = math.sqrt(max(half_width_squared, type(u1)(0)))
    at_slow = max(abs(slow), slow - slowest)
    at_fast = max(abs(fast), fastest - fast)
    low = max(slow, min(fast, centre - w))
    high = max(slow, min(fast, centre + w))
    a0, a1, a2, a3 = roe(slow, low, high, fast, at_slow, at_fast)
    g2 = k1 * b2 + (u1 + u1) * c2 + h1 * b4
    g4 = rh2 * b2 + k2 * b4 + (u2 + u2) * c4
    return (
        a0 * e1 + a1 * d_q1 + a2 * b2 + a3 * c2,
        a0 * d_q1 + a1 * b2 + a2 * c2 + a3 * g2,
        a0 * e3 + a1 * d_q2 + a2 * b4 + a3 * c4,
        a0 * d_q2 + a1 * b4 + a2 * c4 + a3 * g4,
    )


@inlined
def spreading_grains(r, dry_depth, h_i, u_i, h_j, u_j, u, d_h, d_q, d_m):
    """Return the viscosity of the grains' mass and momentum at their edge: HLL with the grains' own speeds.

    Under water grains spread like a dam break of gravity g (1-r), far slower than the waves of the water: the speeds
    are u -+ sqrt(g (1-r) h), and u + 2 sqrt(g (1-r) h) into a dry cell. `d_m` is the jump of the momentum flux.
    """
    real = type(r)
    reduced = real(1) - r
    c_i = math.sqrt(reduced * h_i)
    c_j = math.sqrt(reduced * h_j)
    c = math.sqrt(real(0.5) * reduced * (h_i + h_j))
    s_l = u_j - c_j - c_j if h_i <= dry_depth else min(u - c, u_i - c_i)
    s_r = u_i + c_i + c_i if h_j <= dry_depth else max(u + c, u_j + c_j)
    a0, a1, _ = hll(s_l, s_r)
    return a0 * d_h + a1 * d_q, a0 * d_q + a1 * d_m
