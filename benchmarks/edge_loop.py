"""The solver's own edge function over one-dimensional arrays: the only place that knows its arguments."""

from numba import prange

from subslide.kernels.edge.roe_matrix import Normal
from subslide.kernels.edge.two_layers import edge_fluxes
from subslide.kernels.jit import inlined, launch, part

BLOCK = 4096
"""Edges in the plain loop inside the parallel one, which alone vectorises."""


@launch
def edge_loop(s, e, out):
    """Fill the six fluxes `out` (reference.EdgeFluxes) of the edges `e` (reference.Edges) with the settings `s`."""
    n = e.h1_i.shape[0]
    blocks = (n + BLOCK - 1) // BLOCK
    for b in prange(blocks):
        first = b * BLOCK
        edges(s, e, out, first, first + BLOCK if b < blocks - 1 else n)


@inlined
def edges(s, e, out, first, last):
    """Fill the fluxes of the edges [first, last): a function of its own, as in the kernels (else numba drops it)."""
    zero = type(s.r)(0)
    start, count = part(first, last)
    for m in range(count):
        k = m + start
        out.f1[k], out.m1[k], out.p1[k], out.f2[k], out.m2[k], out.p2[k] = edge_fluxes(
            s,
            e.stuck[k] != zero,
            e.slowest[k],
            e.fastest[k],
            Normal(e.h1_i[k], e.u1_i[k], e.h2_i[k], e.u2_i[k]),
            Normal(e.h1_j[k], e.u1_j[k], e.h2_j[k], e.u2_j[k]),
            e.d_eta[k],
        )
