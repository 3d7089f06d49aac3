"""Largest and smallest of a row."""

from .jit import maximum


@maximum
def largest(row):
    """Return the largest entry."""
    top = row[0]
    for i in range(row.shape[0]):
        top = max(top, row[i])
    return top


@maximum
def smallest(row):
    """Return the smallest entry."""
    bottom = row[0]
    for i in range(row.shape[0]):
        bottom = min(bottom, row[i])
    return bottom
