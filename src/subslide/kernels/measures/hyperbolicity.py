"""How many cells lost hyperbolicity, and how near the others are to losing it."""

import numpy as np

from subslide.kernels.active import wet_span
from subslide.kernels.arrays import GHOSTS
from subslide.kernels.jit import inlined, part, summed
from subslide.kernels.measures._series import SMALLEST, SUM, Series
from subslide.kernels.waves import discriminant, discriminant_without_shear

SERIES = {
    "nonhyperbolic_cells": Series(SUM, lambda column, si: column * si.copies),
    "hyperbolic_margin": Series(SMALLEST, lambda column, si: column, start=1.0, layers=2),
}


@inlined
def measure(s, c, mesh, watch, span):
    """Return the number of a row's cells with complex wave speeds, and the smallest margin; 0 and 1 for one layer."""
    lost = 0.0
    smallest = 1.0
    if s.layers == 2:
        n = c.h1.shape[0]
        start, stop = max(span.wet_low, GHOSTS), min(span.wet_high, n - GHOSTS)
        left, right = wet_span(c.h2, s.dry_depth, start, stop)
        lost, margin = row_hyperbolicity(
            c.h1, c.u1, c.v1, c.h2, c.u2, c.v2, c.ratio, s.r, s.dry_depth, watch.margin, left, right
        )
        smallest = float(margin)
    return lost, smallest


@summed
def row_hyperbolicity(h1, u1, v1, h2, u2, v2, ratio, r, dry_depth, margin, start, stop):
    """Return how many of a row's cells start..stop-1 have complex speeds along their shear, and the smallest margin.

    Cells that are wet in both layers count. The margin of a cell is its discriminant over that without shear, each
    scaled to depths and shear of order 1: 1 without shear, 0 where two speeds meet, negative where they are complex.
    Without the water's weight, at r = 0, no speed can be lost, and the margin is 1; speeds that meet there are no sign.
    `ratio` is scratch, as long as the row: a loop that finds a minimum does not vectorise, so it gets one of its own.
    """
    one = type(r)(1)
    zero = type(r)(0)
    least = margin if r > zero else type(r)(np.inf)
    lost = 0.0
    first, count = part(start, stop)
    for k in range(count):
        i = k + first
        du = u1[i] - u2[i]
        dv = v1[i] - v2[i]
        wet = min(h1[i], h2[i]) > dry_depth
        sheared = discriminant(h1[i], h2[i], du * du + dv * dv, r)
        still = discriminant_without_shear(h1[i], h2[i], r)
        judged = (still if wet else zero) > least
        share = sheared / (still if judged else one)
        ratio[i] = share if judged else one
        lost += 1.0 if (sheared if wet else one) < -margin else 0.0
    smallest = one
    for k in range(count):
        smallest = min(smallest, ratio[k + first])
    return lost, smallest
