"""The Roe matrix A_ij of Eq. (8) on (h1, q1, h2, q2), as products with vectors; it is never formed.

A = |     0         1         0         0   |
    | h1 - u1^2   2 u1       h1         0   |
    |     0         0         0         1   |
    |   r h2        0     h2 - u2^2   2 u2  |
"""

import math
from typing import NamedTuple

from subslide.kernels.jit import inlined


class Normal(NamedTuple):
    """State beside an edge: depths, and velocities normal to it."""

    h1: float
    u1: float
    h2: float
    u2: float


class Jump(NamedTuple):
    """A vector of the system: jumps of depths and momenta over an edge, or a product with A."""

    h1: float
    q1: float
    h2: float
    q2: float


class RoeMatrix(NamedTuple):
    """A_ij by its entries: Roe's velocities, mean depths, h_k - u_k^2 and r h2; and c_i + c_j of each layer alone."""

    u1: float
    k1: float
    h1: float
    u2: float
    k2: float
    h2: float
    rh2: float
    pace1: float
    pace2: float


@inlined
def roe_velocity(root_i, u_i, root_j, u_j):
    """Return the Roe mean of two velocities, weighted by the roots of the depths; 0 between dry cells."""
    real = type(u_i)
    weight = root_i + root_j
    return (root_i * u_i + root_j * u_j) / (weight if weight > real(0) else real(1))


@inlined
def roe_matrix(r, i, j):
    """Return the `RoeMatrix` of the states (`Normal`) on both sides."""
    half = type(r)(0.5)
    h1 = half * (i.h1 + j.h1)
    h2 = half * (i.h2 + j.h2)
    c1_i, c1_j = math.sqrt(i.h1), math.sqrt(j.h1)
    c2_i, c2_j = math.sqrt(i.h2), math.sqrt(j.h2)
    u1 = roe_velocity(c1_i, i.u1, c1_j, j.u1)
    u2 = roe_velocity(c2_i, i.u2, c2_j, j.u2)
    pace1, pace2 = c1_i + c1_j, math.sqrt(type(r)(1) - r) * (c2_i + c2_j)
    return RoeMatrix(u1, h1 - u1 * u1, h1, u2, h2 - u2 * u2, h2, r * h2, pace1, pace2)


@inlined
def parts(a, i, j):
    """Return whether a layer parts faster than it can fill the gap: u_j - u_i > c_i + c_j, with c2^2 = (1-r) h2."""
    return max(j.u1 - i.u1 - a.pace1, j.u2 - i.u2 - a.pace2) > type(a.u1)(0)


@inlined
def times(a, d):
    """Return A d."""
    return Jump(
        d.q1,
        a.k1 * d.h1 + (a.u1 + a.u1) * d.q1 + a.h1 * d.h2,
        d.q2,
        a.rh2 * d.h1 + a.k2 * d.h2 + (a.u2 + a.u2) * d.q2,
    )


@inlined
def jump(i, j, d_eta):
    """Return w_j - w_i; `d_eta` is the jump of h1 + h2, given so that a flat surface is exactly flat."""
    d_h2 = j.h2 - i.h2
    return Jump(d_eta - d_h2, j.h1 * j.u1 - i.h1 * i.u1, d_h2, j.h2 * j.u2 - i.h2 * i.u2)


@inlined
def polynomial(alpha, d, ad, aad):
    """Return Q d = alpha0 d + alpha1 A d + alpha2 A^2 d of Eq. (9)."""
    a0, a1, a2 = alpha
    return Jump(
        a0 * d.h1 + a1 * ad.h1 + a2 * aad.h1,
        a0 * d.q1 + a1 * ad.q1 + a2 * aad.q1,
        a0 * d.h2 + a1 * ad.h2 + a2 * aad.h2,
        a0 * d.q2 + a1 * ad.q2 + a2 * aad.q2,
    )


@inlined
def cubic_polynomial(alpha, a, d, ad, aad):
    """Return Q d of a solver with a fourth coefficient, which has alpha3 A^3 d too."""
    a0, a1, a2, a3 = alpha
    aaad = times(a, aad)
    return Jump(
        a0 * d.h1 + a1 * ad.h1 + a2 * aad.h1 + a3 * aaad.h1,
        a0 * d.q1 + a1 * ad.q1 + a2 * aad.q1 + a3 * aaad.q1,
        a0 * d.h2 + a1 * ad.h2 + a2 * aad.h2 + a3 * aaad.h2,
        a0 * d.q2 + a1 * ad.q2 + a2 * aad.q2 + a3 * aaad.q2,
    )
