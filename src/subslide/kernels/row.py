"""Fluxes through the edges of a row, in either geometry.

`before` and `after` are the states (`Side`) whose entries k + shift and k + shift + step are beside edge k: on a line,
a radius or along x the right and left faces of one row's cells (shift BEFORE, step 1); along y the upper faces of the
row below and the lower ones of the row above (shift GHOSTS, step 0). `slow` and `fast` are pairs of rows, before and
after likewise, with the bounds of each cell's wave speeds along the normal.
"""

from subslide.kernels.edge.film import film_fluxes, overtops
from subslide.kernels.edge.grains import grain_edge_fluxes
from subslide.kernels.edge.roe_matrix import Normal
from subslide.kernels.edge.stuck import sees_friction
from subslide.kernels.edge.two_layers import edge_fluxes
from subslide.kernels.edge.water import water_edge_fluxes
from subslide.kernels.jit import inlined, maximum, part, unsigned
from subslide.kernels.motion import carried_past, past
from subslide.kernels.positivity import donor
from subslide.kernels.printed import carried


@inlined
def edges(s, f, slow, fast, before, after, shift, step, start, stop, drift=None):
    """Fill the fluxes of mass and normal momentum through the edges start..stop-1 of a row.

    drift: velocities of the edges where they move, else None: fluxes are what passes them.
    """
    zero = type(s.r)(0)
    slow_i, slow_j = slow
    fast_i, fast_j = fast
    first, count = part(start, stop)
    for m in range(count):
        k = unsigned(m + first)
        i = unsigned(m + first + shift)
        j = unsigned(m + first + shift + step)
        f1, m1, f.p1[k], f2, m2, f.p2[k] = edge_fluxes(
            s,
            f.stuck[k] != zero,
            past(drift, k, min(slow_i[i], slow_j[j])),
            past(drift, k, max(fast_i[i], fast_j[j])),
            Normal(before.h1[i], past(drift, k, before.u1[i]), before.h2[i], past(drift, k, before.u2[i])),
            Normal(after.h1[j], past(drift, k, after.u1[j]), after.h2[j], past(drift, k, after.u2[j])),
            after.eta[j] - before.eta[i],
        )
        f.f1[k], f.m1[k] = f1, carried_past(drift, k, m1, f1)
        f.f2[k], f.m2[k] = f2, carried_past(drift, k, m2, f2)


@maximum
def highest_step(stuck, before, after, shift, step, start, stop):
    """Return the most by which a step of grains at rest overtops the water beside it; 0 if none does."""
    real = type(stuck[0])
    most = real(0)
    first, count = part(start, stop)
    for m in range(count):
        k = unsigned(m + first)
        i = unsigned(m + first + shift)
        j = unsigned(m + first + shift + step)
        most = max(most, overtops(stuck[k], before.h1[i], before.h2[i], after.h1[j], after.h2[j]))
    return most


@inlined
def film_edges(s, f, before, after, shift, step, start, stop):
    """Fill the water's fluxes anew where it is thin over steps of grains at rest: few edges, of few runs."""
    zero = type(s.r)(0)
    if not sees_friction(s) or highest_step(f.stuck, before, after, shift, step, start, stop) <= zero:
        return
    for k in range(start, stop):
        i = k + shift
        j = i + step
        if overtops(f.stuck[k], before.h1[i], before.h2[i], after.h1[j], after.h2[j]) > zero:
            f.f1[k], f.m1[k], f.p1[k] = film_fluxes(
                s.scheme, before.eta[i], before.u1[i], before.h2[i], after.eta[j], after.u1[j], after.h2[j]
            )


@inlined
def water_edges(s, f, slow, fast, before, after, shift, step, start, stop):
    """Fill the water's fluxes through the edges start..stop-1 of a row where no side has grains."""
    slow_i, slow_j = slow
    fast_i, fast_j = fast
    first, count = part(start, stop)
    for m in range(count):
        k = unsigned(m + first)
        i = unsigned(m + first + shift)
        j = unsigned(m + first + shift + step)
        f.f1[k], f.m1[k], f.p1[k] = water_edge_fluxes(
            s,
            min(slow_i[i], slow_j[j]),
            max(fast_i[i], fast_j[j]),
            before.h1[i],
            before.u1[i],
            after.h1[j],
            after.u1[j],
            after.eta[j] - before.eta[i],
        )


@inlined
def grain_edges(s, f, before, after, shift, start, stop, drift=None):
    """Fill the fluxes through the edges start..stop-1 of a row of grains alone; drift as for `edges`."""
    zero = type(s.r)(0)
    first, count = part(start, stop)
    for m in range(count):
        k = m + first
        i = k + shift
        j = i + 1
        f2, m2, f.p2[k] = grain_edge_fluxes(
            s,
            f.stuck[k] != zero,
            before.h2[i],
            past(drift, k, before.u2[i]),
            after.h2[j],
            past(drift, k, after.u2[j]),
        )
        f.f2[k], f.m2[k] = f2, carried_past(drift, k, m2, f2)


@inlined
def tangential(s, f, before, after, shift, step, start, stop):
    """Fill the fluxes of tangential momentum of both layers: their mass fluxes times the velocity these carry."""
    first, count = part(start, stop)
    for m in range(count):
        k = unsigned(m + first)
        i = unsigned(m + first + shift)
        j = unsigned(m + first + shift + step)
        f1, f2 = f.f1[k], f.f2[k]
        f.t1[k] = f1 * carried(s, f1, after.h1[j], before.v1[i], after.h1[j], after.v1[j])
        f.t2[k] = f2 * carried(s, f2, before.h2[i], before.v2[i], after.h2[j], after.v2[j])


@inlined
def water_tangential(f, before, after, shift, step, start, stop):
    """Fill those of the water where no side has grains."""
    first, count = part(start, stop)
    for m in range(count):
        k = unsigned(m + first)
        i = unsigned(m + first + shift)
        j = unsigned(m + first + shift + step)
        f1 = f.f1[k]
        f.t1[k] = f1 * donor(f1, before.v1[i], after.v1[j])
