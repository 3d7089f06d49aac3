"""Pouliquen's friction (Pouliquen 1999, in the form of Mangeney-Castelnau et al. 2003).

mu = tan(delta) + (tan(delta_2) - tan(delta)) exp(-(h2 / l) sqrt(g h2) / |u|), l = L / beta: delta in deep and slow
flow, delta_2 in thin and fast flow. At rest it is Coulomb's law with delta.
"""

import math

from subslide.kernels.jit import inlined


def scaled(point):
    """Return (tan(delta_2) - tan(delta)) / a_2, and H2 / l."""
    rise = math.tan(math.radians(point.delta_2)) - math.tan(math.radians(point.delta))
    return rise / point.a_2, point.column_height / point.pouliquen_length


@inlined
def remaining(s, dt, h2, speed):
    """Return the factor that friction beyond Coulomb's at delta leaves of a velocity."""
    real = type(speed)
    if speed <= real(0):
        return real(1)
    reach = dt * (real(1) - s.r) * s.law_1
    exponent = min(s.law_2 * h2 * math.sqrt(h2) / speed, real(80))
    change = reach * math.exp(-exponent) / speed
    change /= real(1) + real(0.5) * change * exponent  # as fast as at half the change, by the slope
    return max(real(0), real(1) - change)
