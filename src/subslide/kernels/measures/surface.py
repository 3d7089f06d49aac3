"""The disturbance of the water surface."""

from subslide.kernels.jit import maximum, part


@maximum
def largest_displacement(eta, level, start, stop):
    """Return max |eta - level| over a row's cells start..stop-1."""
    largest = abs(level - level)
    first, count = part(start, stop)
    for k in range(count):
        i = k + first
        largest = max(largest, abs(eta[i] - level))
    return largest
