"""What is done where wave speeds are complex.

Shallow layers that shear too hard are not hyperbolic: linear waves of every length grow, the shorter the faster
(`exact.shear`), where real layers would mix. `real` goes on with the real part of the complex pair, `hll` takes the
viscosity of HLL at such edges, which needs no inner speeds, `friction` lets the layers of such cells rub on each
other, and `stop` ends the run.
"""

import numpy as np

from subslide.kernels.arrays import GHOSTS, is_general
from subslide.kernels.clock import NEGATIVE, NOT_FINITE, SHEARED
from subslide.kernels.jit import inlined
from subslide.kernels.waves import discriminant
from subslide.keys.names import TREATMENTS, flags

FLAGS = flags(TREATMENTS)
HLL_THERE, RUB, STOP = FLAGS["hll"], FLAGS["friction"], FLAGS["stop"]

HALVINGS = 60
"""Of the share of a shear that is hyperbolic: more than the digits of a double."""


@inlined
def is_complex(h1, h2, shear_squared, r):
    """Return whether a pair of wave speeds is complex, beyond round-off."""
    real = type(h1)
    return discriminant(h1, h2, shear_squared, r) < real(-64) * np.finfo(real).eps


@inlined
def takes_hll(s, dry, h1, u1, h2, u2):
    """Return whether an edge with these means gets the viscosity of HLL because its speeds are complex."""
    if is_general(s) and s.treatment == HLL_THERE and not dry:
        return is_complex(h1, h2, (u1 - u2) * (u1 - u2), s.r)
    return False


@inlined
def hyperbolic_share(h1, h2, shear_squared, r):
    """Return the largest share of a shear with complex speeds that has real ones, by bisection on the discriminant.

    Without shear they are real, and from there on the verdict changes once (see `exact.shear.critical_shear`).
    """
    real = type(h1)
    low = real(0)
    high = real(1)
    for _ in range(HALVINGS):
        middle = real(0.5) * (low + high)
        lost = discriminant(h1, h2, middle * middle * shear_squared, r) < real(0)
        high = middle if lost else high
        low = low if lost else middle
    return low


@inlined
def rub(s, h1, u1, v1, h2, u2, v2):
    """Bring the cells of a padded row whose speeds are complex back to the boundary of hyperbolicity.

    Friction between the layers is as strong as that takes within the step (Castro, Fernandez-Nieto, Gonzalez-Vida and
    Pares 2011; Sarno et al. 2017) and keeps r h1 u1 + h2 u2.
    """
    one = type(s.r)(1)
    for i in range(GHOSTS, h1.shape[0] - GHOSTS):
        du = u1[i] - u2[i]
        dv = v1[i] - v2[i]
        square = du * du + dv * dv
        if min(h1[i], h2[i]) > s.dry_depth and is_complex(h1[i], h2[i], square, s.r):
            taken = (one - hyperbolic_share(h1[i], h2[i], square, s.r)) / (s.r * h1[i] + h2[i])
            u1[i] -= taken * h2[i] * du
            v1[i] -= taken * h2[i] * dv
            u2[i] += taken * s.r * h1[i] * du
            v2[i] += taken * s.r * h1[i] * dv


@inlined
def judged(s, code, complex_cells):
    """Return the outcome `code` of a step, or that the run stops because speeds are complex in any cell."""
    broken = code in (NOT_FINITE, NEGATIVE)
    if is_general(s) and s.treatment == STOP and complex_cells > 0.0 and not broken:
        return SHEARED
    return code
