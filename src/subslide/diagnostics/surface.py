"""The disturbance of the water surface."""

from ..kernels.jit import maximum


@maximum
def largest_displacement(eta, level, start, stop):
    """Return max |eta - level| over a row's cells start..stop-1."""
    largest = abs(level - level)
    for i in range(start, stop):
        largest = max(largest, abs(eta[i] - level))
    return largest
