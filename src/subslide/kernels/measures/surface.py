"""The disturbance of the water surface in the watched region."""

from subslide.kernels.jit import inlined, maximum, part
from subslide.kernels.measures._series import LARGEST, Series

SERIES = {
    "max_abs_eta": Series(LARGEST, lambda column, si: column * si.height, layers=2),
    "max_abs_eta_outside": Series(LARGEST, lambda column, si: column * si.height, layers=2),
}


@inlined
def measure(s, c, mesh, watch, span):
    """Return the largest displacement of the surface in a row, and that beyond R."""
    before = largest_displacement(c.eta, watch.level, span.start, span.inside_start)
    beyond = largest_displacement(c.eta, watch.level, span.inside_stop, span.stop)
    outside = float(max(before, beyond))
    inside = float(largest_displacement(c.eta, watch.level, span.inside_start, span.inside_stop))
    return max(outside, inside), outside


@maximum
def largest_displacement(eta, level, start, stop):
    """Return max |eta - level| over a row's cells start..stop-1."""
    largest = abs(level - level)
    first, count = part(start, stop)
    for k in range(count):
        i = k + first
        largest = max(largest, abs(eta[i] - level))
    return largest
