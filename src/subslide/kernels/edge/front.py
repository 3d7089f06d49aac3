"""The flux of grains onto a dry bed."""

import math

from subslide.kernels.jit import inlined


@inlined
def runs_onto_dry_bed(s, stuck, h_i, h_j):
    """Return whether grains of depths h_i, h_j take the exact flux of a front through their edge."""
    return s.exact_front and not stuck and h_i != h_j and min(h_i, h_j) <= s.dry_depth


@inlined
def front_fluxes(r, h_i, u_i, h_j, u_j):
    """Return the fluxes of mass and momentum of grains that run onto a dry bed, exact for grains of gravity g (1-r).

    The edge lies in the fan of a dam break (Ritter 1892; Toro 2001, section 6.3): there u* = (w + 2 c) / 3 = sqrt(g
    (1-r) h*) where the outward velocity w is below c = sqrt(g (1-r) h), else the state of the wet side. The momentum
    flux is less half the pressure product, which acts apart.

    Deviation from the wet/dry case under Eq. (12): HLL there spreads a front at the speed of the water's waves, and it
    lags two to four times as far.
    """
    real = type(r)
    third = real(1.0 / 3.0)
    reduced = real(1) - r
    right = h_i > h_j
    h = h_i if right else h_j
    w = u_i if right else -u_j
    c = math.sqrt(reduced) * (math.sqrt(h_i) if right else math.sqrt(h_j))
    a = max(real(0), third * (w + c + c))
    fan = w < c
    u_star = a if fan else w
    h_star = a * a / reduced if fan else h
    mass = h_star * u_star
    half = real(0.5)
    push = half * reduced * (h_star * h_star - half * h * h)
    return (mass if right else -mass), mass * u_star + push
