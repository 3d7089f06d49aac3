"""What friction leaves of a velocity in a time: Coulomb's law and, in general kernels, what another law adds to it.

Another law acts between two halves of Coulomb's, which makes both together one of second order.
"""

from subslide.kernels.arrays import is_general
from subslide.kernels.friction import COULOMB, remaining
from subslide.kernels.jit import inlined
from subslide.kernels.printed import braking


@inlined
def first_reach(s, time):
    """Return by how much Coulomb friction slows grains in a time, or the half of it that comes before another law."""
    reach = time * (type(s.r)(1) - s.r) * s.m
    if is_general(s) and s.law != COULOMB:
        return type(s.r)(0.5) * reach
    return reach


@inlined
def law_left(s, time, h2, speed):
    """Return the factor that another law leaves of a speed after that first half, then the second half of Coulomb's."""
    factor = remaining(s, time, h2, speed)
    return factor * braking(s, first_reach(s, time), factor * speed, type(speed)(0))


@inlined
def left_of(s, time, h2, speed):
    """Return the factor that all friction leaves of a speed."""
    factor = braking(s, first_reach(s, time), speed, type(speed)(0))
    if is_general(s) and s.law != COULOMB:
        factor *= law_left(s, time, h2, factor * speed)
    return factor
