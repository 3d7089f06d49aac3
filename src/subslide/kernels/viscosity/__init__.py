"""Riemann solvers as polynomials of the Roe matrix (PVM methods, Castro and Fernandez-Nieto 2012).

Q = alpha0 Id + alpha1 A + alpha2 A^2 (Eq. 9), so a solver is a function from wave speeds to three numbers. One file
each; to add one, name it in SCHEMES and give it a branch in `coefficients`. Roe's polynomial has a fourth
(see `roe`).
"""

from subslide.kernels.jit import inlined
from subslide.kernels.viscosity.hll import hll
from subslide.kernels.viscosity.ifcp import ifcp
from subslide.kernels.viscosity.rusanov import rusanov

SCHEMES = {"rusanov": 0, "hll": 1, "ifcp": 2, "ifcph": 3, "roe": 4}
RUSANOV, HLL, IFCP, IFCPH, ROE = SCHEMES.values()


@inlined
def coefficients(scheme, s_l, s_int, s_r, dry):
    """Return alpha0, alpha1, alpha2 of the chosen solver; IFCPH is HLL where a layer is dry, IFCP elsewhere."""
    if scheme == RUSANOV:
        return rusanov(s_l, s_r)
    if scheme == HLL:
        return hll(s_l, s_r)
    a0, a1, a2 = ifcp(s_l, s_int, s_r)
    if scheme == IFCP:
        return a0, a1, a2
    b0, b1, b2 = hll(s_l, s_r)
    return (b0 if dry else a0), (b1 if dry else a1), (b2 if dry else a2)
