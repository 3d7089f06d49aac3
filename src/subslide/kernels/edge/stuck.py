"""Edges at which friction holds the grains of both sides at rest: what the viscosity sees there.

At rest A^-1 (0, 0, 0, s) = (-s, 0, s, 0) / (g (1-r) h2). With the friction that the grains' own slope asks for,
s d_ij = g (1-r) h2 d(h2), the d - A^-1 S d_ij of Eq. (8) is (d(h1 + h2), d(q1), 0, d(q2)).

Deviation from S_1,T and S_2,T above Eq. (4): printed with four rows, they have six, friction in the fifth and sixth.
"""

from subslide.kernels.arrays import is_general
from subslide.kernels.friction.coulomb import holds
from subslide.kernels.jit import inlined


@inlined
def sees_friction(s):
    """Return whether the viscosity sees what friction holds; without it piles at rest creep."""
    return not is_general(s) or s.viscous_friction != 0


@inlined
def by_weight(h2_i, h2_j, d_head):
    """Return the flux of momentum that makes the halves of a pressure product h2_i d / 2 and h2_j d / 2.

    Deviation from Eq. (8): half of the product on the mean depth is more than friction on a thin cell can hold, and no
    grains come with it: on a foot of 1e-5 H2 it made speeds of 200 sqrt(g H2).
    """
    return type(d_head)(0.25) * (h2_i - h2_j) * d_head


@inlined
def is_stuck(s, dt, gap, square_i, square_j, push_squared):
    """Return 1 if friction holds the grains on both sides of an edge, else 0; see `friction.coulomb.holds`.

    `gap` is the distance between the centres of both cells.
    """
    real = type(s.r)
    static = (real(1) - s.r) * s.m
    held = holds(dt * static, gap * static, max(square_i, square_j), push_squared)
    return real(1) if held else real(0)
