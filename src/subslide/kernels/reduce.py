"""Largest, smallest and sum of a part of a row."""

import numpy as np

from subslide.kernels.jit import maximum, part, summed


@maximum
def largest(row, start, stop):
    """Return the largest of 0 and the entries start..stop-1."""
    top = type(row[0])(0)
    first, count = part(start, stop)
    for k in range(count):
        top = max(top, row[k + first])
    return top


@maximum
def smallest(row, start, stop):
    """Return the smallest of 0 and the entries start..stop-1."""
    bottom = type(row[0])(0)
    first, count = part(start, stop)
    for k in range(count):
        bottom = min(bottom, row[k + first])
    return bottom


@maximum
def extremes(h1, h2, square2, pace, start, stop):
    """Return the smallest h1, that of 0 and h2, the largest |u2|^2 and the largest pace of cells start..stop-1.

    The smallest h1 is infinite without any.
    """
    zero = type(h1[0])(0)
    least = type(h1[0])(np.inf)
    shallowest = zero
    square = zero
    fastest = zero
    first, count = part(start, stop)
    for k in range(count):
        i = k + first
        least = min(least, h1[i])
        shallowest = min(shallowest, h2[i])
        square = max(square, square2[i])
        fastest = max(fastest, pace[i])
    return least, shallowest, square, fastest


@summed
def weighted_sum(row, weight, start, stop):
    """Return the sum of the entries start..stop-1, each times its weight."""
    total = 0.0
    first, count = part(start, stop)
    for k in range(count):
        total += weight[k + first] * row[k + first]
    return total
