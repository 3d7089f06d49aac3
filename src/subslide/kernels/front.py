"""The front of the grains along an axis."""

from subslide.kernels.arrays import GHOSTS
from subslide.kernels.jit import inlined


@inlined
def front_position(h, other, start, stop, threshold, dx):
    """Return the farthest distance where the mean depth of two padded rows is `threshold`, between cell centres.

    `start` is the padded index of the first cell beyond the axis, whose centre is at dx / 2; 0 where no cell reaches
    the threshold. From `stop` on there are no grains.
    """
    real = type(dx)
    half = real(0.5)
    i = min(stop, h.shape[0] - GHOSTS) - 1
    while i >= start and half * (h[i] + other[i]) < threshold:
        i -= 1
    if i < start:
        return real(0)
    here = half * (h[i] + other[i])
    beyond = half * (h[i + 1] + other[i + 1])
    fraction = (here - threshold) / (here - beyond) if beyond < threshold else real(0)
    return (real(i - start) + half + fraction) * dx
