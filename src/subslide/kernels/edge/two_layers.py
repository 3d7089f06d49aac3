"""The fluxes through an edge between cells with water and grains: D- of Eq. (8) with Q of Eq. (9)."""

from subslide.kernels.arrays import is_general
from subslide.kernels.edge.front import front_fluxes, runs_onto_dry_bed
from subslide.kernels.edge.roe_matrix import (
    Jump,
    cubic_polynomial,
    jump,
    parts,
    polynomial,
    roe_matrix,
    times,
)
from subslide.kernels.edge.stuck import by_weight, sees_friction
from subslide.kernels.hyperbolicity import takes_hll
from subslide.kernels.jit import inlined
from subslide.kernels.viscosity import IFCP, alpha, cubic, hll, is_cubic
from subslide.kernels.viscosity.rusanov import largest
from subslide.kernels.waves import edge_waves


@inlined
def edge_fluxes(s, stuck, slowest, fastest, i, j, d_eta):
    """Return (f1, m1, p1, f2, m2, p2): for each layer the flux of mass, of momentum, and the pressure product.

    `i` and `j` (`Normal`) are the states on both sides. The pressure products g h1 d(h1+h2) and g h2 d(r h1 + h2) are
    exact for the straight path. `slowest` and `fastest` bound the wave speeds in both cells, `d_eta` is the jump of
    h1 + h2. `stuck`: grains at rest that friction holds; no grain passes the edge then.

    Deviation from S_L and S_R under Eq. (10): printed are the slowest speed of K_i and ij, and the fastest of K_j and
    ij. HLL keeps depths non-negative with these too, but of 240 runs of thin films of water 14 end as
    step_collapse, and 8 with the bounds of i, j and ij.

    Deviation from Eq. (8): printed is Q (d + A^-1 S) at every edge. With S on the right of Eq. (1) the sign is minus,
    and A^-1 S takes the distance d_ij. It is taken in closed form (see `edge.stuck`), where friction holds the grains:
    on moving ones it would drain thin cells.

    Deviation from the wet/dry case under Eq. (12): HLL, with IFCP Rusanov's constant, is taken also where a layer parts
    faster than its two sound speeds. Linearised about the mean of -u and u, the parabola of IFCP vanishes there, and
    the cells run dry.
    """
    real = type(d_eta)
    half = real(0.5)
    zero = real(0)
    q1_i, q1_j = i.h1 * i.u1, j.h1 * j.u1
    q2_i, q2_j = i.h2 * i.u2, j.h2 * j.u2
    a = roe_matrix(s.r, i, j)
    waves = edge_waves(s, a, slowest, fastest)
    torn = parts(a, i, j)
    dry = torn or min(min(i.h1, j.h1), min(i.h2, j.h2)) <= s.dry_depth
    plain = takes_hll(s, dry, a.h1, a.u1, a.h2, a.u2)
    coefficients = alpha(s, waves, dry)
    if torn and s.scheme == IFCP:  # the solver that knows no dry edge; without the division of HLL
        coefficients = largest(waves.s_l, waves.s_r), zero, zero
    if plain:
        coefficients = hll(waves, dry)

    d = jump(i, j, d_eta)
    holds = stuck and sees_friction(s)
    seen = Jump(d_eta if holds else d.h1, d.q1, zero if holds else d.h2, d.q2)
    ad = times(a, seen)
    aad = times(a, ad)
    q_d = polynomial(coefficients, seen, ad, aad)

    f2 = half * (q2_i + q2_j - q_d.h2)
    m2 = half * (q2_i * i.u2 + q2_j * j.u2 - q_d.q2)
    front = runs_onto_dry_bed(s, stuck, i.h2, j.h2)
    f2_front, m2_front = front_fluxes(s.r, i.h2, i.u2, j.h2, j.u2)
    f2 = f2_front if front else f2
    m2 = m2_front if front else m2
    f2 = zero if holds else f2  # no grain passes a stuck edge
    # both layers get what the scheme gives their sum, so that a flat surface over a front stays flat
    both = coefficients[0] * (seen.h1 + seen.h2) + coefficients[1] * (d.q1 + d.q2)
    lost1 = both - (q2_i + q2_j - (f2 + f2)) if front else q_d.h1
    lost_q1 = q_d.q1
    if is_general(s) and is_cubic(s.scheme) and not dry and not plain:
        q_d = cubic_polynomial(cubic(s.scheme, waves), a, seen, ad, aad)
        lost1 = q_d.h1
        lost_q1 = q_d.q1
        f2 = zero if holds else half * (q2_i + q2_j - q_d.h2)
        m2 = half * (q2_i * i.u2 + q2_j * j.u2 - q_d.q2)

    f1 = half * (q1_i + q1_j - lost1)
    m1 = half * (q1_i * i.u1 + q1_j * j.u1 - lost_q1)
    d_head = s.r * d.h1 + d.h2
    m2 = by_weight(i.h2, j.h2, d_head) if holds else m2  # nor does their momentum
    return f1, m1, a.h1 * d_eta, f2, m2, a.h2 * d_head
