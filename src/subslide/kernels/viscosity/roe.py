"""Roe's solver: Q = |A|, the polynomial of degree three through |S| at the four wave speeds of A; HLL at dry edges."""

import math

from subslide.kernels.jit import inlined
from subslide.kernels.viscosity.hll import alpha  # noqa: F401 - where a layer is dry

EXACT_FRONT = True
"""Grains run onto a dry bed with the exact flux of grains alone, if `front_flux` is exact."""


@inlined
def cubic(waves):
    """Return alpha0..3 of |A|.

    The outer speeds of a fan that opens are raised by its half-width (Harten and Hyman 1983), or a transonic one would
    stay a jump.
    """
    slow, fast = waves.slow, waves.fast
    w = math.sqrt(max(waves.half_width_squared, type(slow)(0)))
    at_slow = max(abs(slow), slow - waves.slowest)
    at_fast = max(abs(fast), waves.fastest - fast)
    low = max(slow, min(fast, waves.centre - w))
    high = max(slow, min(fast, waves.centre + w))
    return roe(slow, low, high, fast, at_slow, at_fast)


@inlined
def roe(slow, low, high, fast, at_slow, at_fast):
    """Return alpha0..3 of the polynomial through (slow, at_slow), (low, |low|), (high, |high|), (fast, at_fast).

    The speeds are in order; a complex pair counts with its real part, twice (a double node: the slope there is the
    sign). `at_slow` and `at_fast` are the sizes of the outer speeds, or more where an entropy fix asks for it. The
    mean of both orders of the nodes, so that a mirrored edge has mirrored bits.
    """
    at_slow = min(at_slow, abs(low) + (low - slow))  # no slope is beyond +-1
    at_fast = min(at_fast, abs(high) + (fast - high))
    a0, a1, a2, a3 = newton_form(slow, low, high, fast, at_slow, at_fast)
    b0, b1, b2, b3 = newton_form(-fast, -high, -low, -slow, at_fast, at_slow)
    half = type(slow)(0.5)
    return half * (a0 + b0), half * (a1 - b1), half * (a2 + b2), half * (a3 - b3)


@inlined
def newton_form(x1, x2, x3, x4, y1, y4):
    """Return the coefficients of the interpolating polynomial, by divided differences that no coincidence spoils."""
    y2 = abs(x2)
    y3 = abs(x3)
    s12 = slope(x1, x2, y1, y2)
    s23 = slope(x2, x3, y2, y3)
    s34 = slope(x3, x4, y3, y4)
    s123 = quotient(s23 - s12, x3 - x1)
    s234 = quotient(s34 - s23, x4 - x2)
    a3 = quotient(s234 - s123, x4 - x1)
    a2 = s123 - a3 * (x1 + x2 + x3)
    a1 = s12 - s123 * (x1 + x2) + a3 * (x1 * x2 + x1 * x3 + x2 * x3)
    a0 = y1 - s12 * x1 + s123 * x1 * x2 - a3 * x1 * x2 * x3
    return a0, a1, a2, a3


@inlined
def slope(x, y, at_x, at_y):
    """Return the divided difference of sizes at x <= y, which is never beyond +-1; the sign where they coincide."""
    real = type(x)
    one = real(1)
    sign = -one if x < real(0) else one
    return max(-one, min(one, (at_y - at_x) / (y - x))) if y > x else sign


@inlined
def quotient(difference, distance):
    """Return difference / distance, 0 where there is no distance."""
    real = type(distance)
    return difference / distance if distance > real(0) else real(0)
