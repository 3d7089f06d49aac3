"""The front of the grains along an axis."""

from subslide.kernels.arrays import GHOSTS
from subslide.kernels.jit import inlined


@inlined
def front_position(h, other, start, stop, threshold, dx, motion=None):
    """Return the farthest distance where the mean depth of two padded rows is `threshold`, between cell centres.

    `start` is the padded index of the first cell beyond the axis, whose centre is at dx / 2 unless cells move; 0 where
    no cell reaches the threshold. From `stop` on there are no grains.
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
    return distance(motion, i, start, fraction, dx)


@inlined
def distance(motion, i, start, fraction, dx):
    """Return the place a fraction of the way from the centre of padded cell i to the next one."""
    real = type(dx)
    if motion is None:
        return (real(i - start) + real(0.5) + fraction) * dx
    k = i - GHOSTS
    here = 0.5 * (motion.edges[k] + motion.edges[k + 1])
    last = min(k + 2, motion.edges.shape[0] - 1)
    return here + fraction * (0.5 * (motion.edges[k + 1] + motion.edges[last]) - here)
