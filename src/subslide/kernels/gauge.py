"""The surface of the water at the gauge, on the axis beyond the column."""

from subslide.kernels.arrays import GHOSTS
from subslide.kernels.jit import inlined
from subslide.naming import GAUGE


@inlined
def displacement(eta, other, level, beside, dx):
    """Return the mean displacement of two padded rows at the distance GAUGE, linear between cell centres.

    `beside` is the padded index of the first cell beyond the axis, whose centre is at dx / 2. A box that ends before
    the gauge has none: there the last two cells stand for it, so that nothing outside the arrays is read.
    """
    real = type(dx)
    half = real(0.5)
    place = real(GAUGE) / dx - half
    i = min(beside + int(place), eta.shape[0] - GHOSTS - 2)
    here = half * (eta[i] + other[i]) - level
    beyond = half * (eta[i + 1] + other[i + 1]) - level
    return here + (place - real(int(place))) * (beyond - here)
