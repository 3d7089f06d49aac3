"""Pouliquen's friction (Pouliquen 1999, in the form of Mangeney-Castelnau et al. 2003).

mu = tan(delta) + (tan(delta_2) - tan(delta)) exp(-(h2 / l) sqrt(g h2) / |u|), l = L / beta: delta in deep and slow
flow, delta_2 in thin and fast flow. At rest it is Coulomb's law with delta.
"""

import math

from subslide.kernels.jit import inlined


@inlined
def pouliquen(reach, depths, h2, speed):
    """Return the factor that friction beyond Coulomb's at delta leaves of a velocity.

    `reach` is dt (1-r) (tan(delta_2) - tan(delta)) / a_2, and `depths` is H2 / l, in scaled variables.
    """
    real = type(speed)
    if speed <= real(0):
        return real(1)
    change = reach * math.exp(-depths * h2 * math.sqrt(h2) / speed)
    return max(real(0), real(1) - change / speed)
