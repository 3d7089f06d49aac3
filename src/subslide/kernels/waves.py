"""Wave speeds of the two-layer system, exact and without failure.

Variables are scaled (g = 1), so the squared speed of a layer alone is its depth. The speeds x solve the quartic
((x - u1)^2 - h1) ((x - u2)^2 - h2) = r h1 h2, the characteristic polynomial of A_ij in Eq. (8) of the paper.
"""

import math
from typing import NamedTuple

from subslide.kernels.arrays import is_general
from subslide.kernels.jit import inlined
from subslide.keys.names import SPEEDS, flags

APPROXIMATE = flags(SPEEDS)["approximate"]

NEWTON_STEPS = 3
"""Held by tests/numerics/test_waves.py against numpy's eigenvalues."""


class Waves(NamedTuple):
    """Wave speeds of an edge, as Riemann solvers see them."""

    s_l: float  # slowest and fastest, no less and no more than the bounds of the cells
    s_int: float  # Eq. (11)
    s_r: float
    slow: float  # outer pair of A_ij
    fast: float
    centre: float  # its inner pair is centre -+ sqrt(half_width_squared), complex where that is negative
    half_width_squared: float
    slowest: float  # bounds of the speeds in both cells
    fastest: float


@inlined
def newton(x, u1, h1, u2, h2, k):
    """Return one Newton step from `x` on ((x-u1)^2-h1)((x-u2)^2-h2) - k.

    It stays where the slope is zero, and where k is: layers that do not feel each other have speeds u -+ sqrt(h), from
    which the step starts.
    """
    real = type(x)
    d1 = x - u1
    d2 = x - u2
    a = d1 * d1 - h1
    b = d2 * d2 - h2
    slope = d1 * b + d2 * a
    moves = slope != real(0) and k != real(0)
    step = (a * b - k) / (slope + slope if moves else real(1))
    return x - (step if moves else real(0))


@inlined
def outer_bounds(h1, u1, h2, u2, r):
    """Return bounds from outside of the slowest and the fastest wave speed, always real and nearly exact.

    One Newton step from a start that is exact for equal velocities and of second order in u1 - u2: the barotropic
    speed about the mean velocity weighted by how much each layer carries of that wave. The start is held between the
    layers' own speeds (a bound from inside; beyond it the quartic is convex and rising, so Newton's method cannot
    fail and its steps come from outside) and the step by max_k(u_k + sqrt(h_k (1 + sqrt r))) (a bound from outside).
    """
    real = type(h1)
    half = real(0.5)
    spread = math.sqrt((h1 - h2) * (h1 - h2) + real(4) * r * h1 * h2)
    c = math.sqrt(half * (h1 + h2 + spread))
    w1 = half + half * (h1 - h2) / (spread if spread > real(0) else real(1))
    mean = w1 * u1 + (real(1) - w1) * u2
    c1 = math.sqrt(h1)
    c2 = math.sqrt(h2)
    stretch = math.sqrt(real(1) + math.sqrt(r))
    k = r * h1 * h2
    fast_limit = max(u1 + stretch * c1, u2 + stretch * c2)
    slow_limit = min(u1 - stretch * c1, u2 - stretch * c2)
    fast = max(mean + c, max(u1 + c1, u2 + c2))
    slow = min(mean - c, min(u1 - c1, u2 - c2))
    fast = min(newton(fast, u1, h1, u2, h2, k), fast_limit)
    slow = max(newton(slow, u1, h1, u2, h2, k), slow_limit)
    return slow, fast


@inlined
def outer_speeds(h1, u1, h2, u2, r):
    """Return the slowest and the fastest of the four wave speeds: the bounds, brought in by Newton's method."""
    slow, fast = outer_bounds(h1, u1, h2, u2, r)
    k = r * h1 * h2
    for _ in range(NEWTON_STEPS - 1):
        fast = newton(fast, u1, h1, u2, h2, k)
        slow = newton(slow, u1, h1, u2, h2, k)
    return slow, fast


@inlined
def water_speeds(h1, u1):
    """Return the outer speeds of a cell without grains, the bits of `outer_speeds` for h2 = u2 = 0."""
    c = math.sqrt(h1)
    zero = type(h1)(0)
    return min(u1 - c, zero), max(u1 + c, zero)


@inlined
def grain_speeds(h2, u2):
    """Return the two wave speeds of grains alone."""
    c = math.sqrt(h2)
    return u2 - c, u2 + c


@inlined
def inner_speeds(h1, u1, h2, u2, r, slow, fast):
    """Return the centre and half-width squared of the inner pair, from the quartic's coefficients.

    The pair is centre -+ sqrt(half-width squared); a negative square means that the pair is complex. The verdict on
    hyperbolicity is `discriminant`'s, which needs no iteration.
    """
    real = type(h1)
    outer_sum = slow + fast
    centre = u1 + u2 - real(0.5) * outer_sum
    pairs = u1 * u1 - h1 + u2 * u2 - h2 + real(4) * u1 * u2
    product = pairs - slow * fast - (centre + centre) * outer_sum
    return centre, centre * centre - product


@inlined
def discriminant(h1, h2, shear_squared, r):
    """Return the quartic's discriminant, scaled to depths and shear of order 1: negative where two speeds are complex.

    `shear_squared` is (u1 - u2)^2 along the normal. The outer pair is always real, so the sign decides; the quartic
    is x^4 + p x^2 + q x + s in the frame of the mean velocity.
    """
    real = type(h1)
    total = h1 + h2 + shear_squared
    scale = real(1) / (total if total > real(0) else real(1))
    a = h1 * scale
    b = h2 * scale
    d2 = real(0.25) * shear_squared * scale
    p = -(d2 + d2) - a - b
    q2 = real(4) * d2 * (b - a) * (b - a)
    s = (d2 - a) * (d2 - b) - r * a * b
    p2 = p * p
    return (
        real(16) * p2 * p2 * s
        - real(4) * p2 * p * q2
        - real(128) * p2 * s * s
        + real(144) * p * q2 * s
        - real(27) * q2 * q2
        + real(256) * s * s * s
    )


@inlined
def discriminant_without_shear(h1, h2, r):
    """Return `discriminant` for equal velocities, in closed form: 16 s (1 - 4 s)^2, s = (1-r) h1 h2 / (h1 + h2)^2."""
    real = type(h1)
    total = h1 + h2
    scale = real(1) / (total if total > real(0) else real(1))
    s = (real(1) - r) * (h1 * scale) * (h2 * scale)
    rest = real(1) - real(4) * s
    return real(16) * s * rest * rest


@inlined
def approximate_speeds(h1, u1, h2, u2, r):
    """Return the outer pair, and the centre and half-width squared of the inner pair, for r near 1 and little shear.

    Schijf and Schonfeld (1953). At rest with equal layers the outer pair is 18 % too fast at r = 0.2, the inner pair
    15 % too slow; kept to be compared.
    """
    real = type(h1)
    total = h1 + h2
    scale = real(1) / (total if total > real(0) else real(1))
    mean = (h1 * u1 + h2 * u2) * scale
    c = math.sqrt(total)
    shear = u1 - u2
    half_width_squared = h1 * h2 * scale * ((real(1) - r) - shear * shear * scale)
    return mean - c, mean + c, (h1 * u2 + h2 * u1) * scale, half_width_squared


@inlined
def chosen_bounds(s, h1, u1, h2, u2):
    """Return bounds of the slowest and the fastest wave speed, or what approximate speeds give for them."""
    if is_general(s) and s.speeds == APPROXIMATE:
        slow, fast, _, _ = approximate_speeds(h1, u1, h2, u2, s.r)
        return slow, fast
    return outer_bounds(h1, u1, h2, u2, s.r)


@inlined
def chosen_speeds(s, h1, u1, h2, u2):
    """Return the outer pair, and the centre and half-width squared of the inner pair, exact unless chosen otherwise."""
    if is_general(s) and s.speeds == APPROXIMATE:
        return approximate_speeds(h1, u1, h2, u2, s.r)
    slow, fast = outer_speeds(h1, u1, h2, u2, s.r)
    if is_general(s):  # for Roe's solver, which errs as its speeds do
        k = s.r * h1 * h2
        for _ in range(NEWTON_STEPS):
            slow = newton(slow, u1, h1, u2, h2, k)
            fast = newton(fast, u1, h1, u2, h2, k)
    centre, half_width_squared = inner_speeds(h1, u1, h2, u2, s.r, slow, fast)
    return slow, fast, centre, half_width_squared


@inlined
def intermediate_speed(s_l, s_r, centre, half_width_squared):
    """Return S_int of Eq. (11): the largest inner speed, on the side of the larger outer speed (Eq. 12).

    A complex pair counts with its real part.
    """
    real = type(s_l)
    size = abs(centre) + math.sqrt(max(half_width_squared, real(0)))
    return math.copysign(size, s_r if abs(s_r) > abs(s_l) else s_l)


@inlined
def edge_waves(s, a, slowest, fastest):
    """Return the `Waves` of an edge with the Roe matrix `a`, given bounds of the speeds in its cells."""
    slow, fast, centre, half_width_squared = chosen_speeds(s, a.h1, a.u1, a.h2, a.u2)
    s_l = min(slow, slowest)
    s_r = max(fast, fastest)
    s_int = intermediate_speed(s_l, s_r, centre, half_width_squared)
    return Waves(s_l, s_int, s_r, slow, fast, centre, half_width_squared, slowest, fastest)
