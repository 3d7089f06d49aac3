"""Velocities from momenta, and the length of a vector."""

import math

from subslide.kernels.jit import inlined


@inlined
def velocity(q, h, thin):
    """Return q/h, smoothly cut off below the depth `thin` (a desingularised quotient)."""
    real = type(q)
    square = h * h
    total = square + max(square, thin * thin)
    return q * (h + h) / (total if total > real(0) else real(1))


@inlined
def norm(x, y):
    """Return the length of a vector in the plane."""
    return math.sqrt(x * x + y * y)
