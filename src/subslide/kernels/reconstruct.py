"""Second order: MUSCL-Hancock with the MC limiter (van Leer 1977, 1979), one Riemann solve a step.

Reconstructed are eta = h1 + h2, the water's velocity and the Riemann invariants of the grains; never h1, so that a
flat surface over a slope stays flat.
"""

import math

from subslide.kernels.jit import inlined
from subslide.kernels.motion import central


@inlined
def mc(left, right, motion=None, i=0):
    """Return the monotonised central slope, in a cell, of the differences to its neighbours.

    `motion` and `i` say which cell it is where neighbours are of other sizes.
    """
    real = type(left)
    centre = central(motion, i, left, right)
    bound = real(2) * min(abs(left), abs(right))
    return math.copysign(min(abs(centre), bound), centre) if left * right > real(0) else real(0)


@inlined
def grain_slopes(r, dry_depth, moving, h_l, u_l, h, u, h_r, u_r, motion=None, i=0):
    """Return the slopes of the grains' depth and normal velocity, limited in u -+ 2 sqrt(g (1-r) h2) if they move.

    These invariants of grains under still water are linear in the fan behind a front, where the depth is not: the
    front lags a third less than with slopes limited in depth and velocity. A dry neighbour counts as the tip of such
    a fan. Grains at rest keep slopes of the depth: at the foot of a pile those of the root are too steep to be held.
    """
    real = type(r)
    half = real(0.5)
    reduced = real(1) - r
    c_l = two_root(reduced * h_l)
    c = two_root(reduced * h)
    c_r = two_root(reduced * h_r)
    tip_l = u - c if h_l <= dry_depth else u_l
    tip_r = u + c if h_r <= dry_depth else u_r
    rising = mc((u + c) - (tip_l + c_l), (tip_r + c_r) - (u + c), motion, i)
    falling = mc((u - c) - (tip_l - c_l), (tip_r - c_r) - (u - c), motion, i)
    s_h = half * half * c * (rising - falling) / reduced
    s_u = half * (rising + falling)
    s_still = mc(h - h_l, h_r - h, motion, i), mc(u - u_l, u_r - u, motion, i)
    return (s_h if moving else s_still[0]), (s_u if moving else s_still[1])


@inlined
def two_root(square):
    """Return twice the square root."""
    root = math.sqrt(square)
    return root + root


@inlined
def depth_slopes(h1, h2, s_eta, s_h2):
    """Return the slopes of eta, h1, h2 that keep both depths non-negative at both faces.

    Where h1 had to be limited the slope of eta becomes the sum of the layers'; elsewhere it stays as it is, since a
    sum would drift by round-off.
    """
    bound2 = h2 + h2
    s_h2 = max(-bound2, min(bound2, s_h2))
    bound1 = h1 + h1
    s_free = s_eta - s_h2
    s_h1 = max(-bound1, min(bound1, s_free))
    return (s_eta if s_h1 == s_free else s_h1 + s_h2), s_h1, s_h2


@inlined
def rates(r, h1, u1, h2, u2, s_eta, s_h1, s_h2, s_u1, s_u2):
    """Return what transport along one axis does to h1, u1, h2, u2 in unit time, without friction.

    The primitive form of Eq. (2), scaled; slopes are per cell, so the rates are per cell too.
    """
    return (
        -(u1 * s_h1 + h1 * s_u1),
        -(u1 * s_u1 + s_eta),
        -(u2 * s_h2 + h2 * s_u2),
        -(u2 * s_u2 + r * s_h1 + s_h2),
    )
