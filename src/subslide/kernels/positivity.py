"""Depths stay non-negative by limiting what leaves a cell, never by clipping (clipping makes mass)."""

import numpy as np

from subslide.kernels.jit import inlined


@inlined
def share(depth, outflow, margin):
    """Return the fraction of its outflow that a cell can feed within a step (draining time, Bollermann et al. 2011).

    `outflow` is the depth that would leave; `margin` (a small fraction of the depth, left behind) covers round-off, but
    not that of subnormal numbers: nothing leaves a cell as shallow as the smallest normal one.

    Deviation from Eq. (6): what leaves through an edge is cut to this fraction of its donor. IFCP beside a thin cell
    can drain it thousands of times faster than any CFL number allows.
    """
    real = type(depth)
    available = max(real(0), depth - np.finfo(real).tiny) * (real(1) - margin)
    return available / outflow if outflow > available else real(1)


@inlined
def reference(before, after, keep):
    """Return the depth over which a cell's momentum is a velocity: that after a step, of a drained cell the larger.

    Deviation from Eq. (6): pressure products are not cut to what a cell can feed. Over the millionth that is left of a
    drained cell they made speeds of 3e5 sqrt(g H2), and 142 times the energy of the start.
    """
    return max(before, after) if keep < type(keep)(1) else after


@inlined
def donor(flux, before, after):
    """Return the value on the side that a flux comes from.

    Deviation from Eq. (13): the sides are printed the other way round. S* comes from the mass flux out of K_i, so that
    S* > 0 takes K_i.

    Deviation from the second line of Eq. (13): the momentum of K_j is printed over h_2,i, and is over h_2,j here.

    As an argument each is loaded whatever the flux; a load inside a condition would keep the loop scalar.
    """
    return before if flux > type(flux)(0) else after


@inlined
def limit(flux, keep_before, keep_after):
    """Return the fraction that the cell a flux comes from can feed; 1 for no flux, which no side may claim."""
    real = type(flux)
    return keep_before if flux > real(0) else (keep_after if flux < real(0) else real(1))
