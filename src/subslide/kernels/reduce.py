"""Largest and smallest of a part of a row."""

from .jit import maximum, part


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
