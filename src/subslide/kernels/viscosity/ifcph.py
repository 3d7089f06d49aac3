"""IFCPH, the paper's solver: IFCP, and HLL where a layer is dry on either side of the edge."""

from subslide.kernels.jit import inlined
from subslide.kernels.viscosity.hll import alpha as hll
from subslide.kernels.viscosity.ifcp import alpha as ifcp

EXACT_FRONT = True
"""Grains run onto a dry bed with the exact flux of grains alone, if `front_flux` is exact."""


@inlined
def alpha(waves, dry):
    """Return alpha0..2: Eq. (10), or those of HLL below Eq. (12) at wet/dry edges.

    Deviation from the wet/dry case under Eq. (12): a layer is dry up to `Settings.dry_depth`, where print has zero.
    In thinner films velocities are cut off, and the inner speeds mean nothing.
    """
    a0, a1, a2 = ifcp(waves, dry)
    b0, b1, b2 = hll(waves, dry)
    return (b0 if dry else a0), (b1 if dry else a1), (b2 if dry else a2)
