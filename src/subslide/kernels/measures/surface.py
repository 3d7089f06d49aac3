"""The disturbance of the water surface in the watched region."""

from subslide.kernels.jit import inlined, maximum, part
from subslide.kernels.measures._series import LARGEST, Series

SERIES = {
    "max_abs_eta": Series(LARGEST, lambda column, si: column * si.height, layers=2, wave=True),
    "max_abs_eta_outside": Series(LARGEST, lambda column, si: column * si.height, layers=2, wave=True),
}


@inlined
def measure(s, c, mesh, watch, span):
    """Return the largest displacement of the surface in a row, and that beyond R."""
    before = largest_displacement(c.eta, watch.level, span.start, span.inside_start)
    beyond = largest_displacement(c.eta, watch.level, span.inside_stop, span.stop)
    outside = float(max(max(before, beyond), at_ends(c.eta, watch, span)))
    inside = float(largest_displacement(c.eta, watch.level, span.inside_start, span.inside_stop))
    return max(outside, inside), outside


@inlined
def at_ends(eta, watch, span):
    """Return |eta - level| at those ends of the watched region that lie between two cells of a row: of their mean."""
    if watch.split == 0 or span.start >= span.stop:
        return abs(watch.level - watch.level)
    half = type(watch.level)(0.5)
    right = abs(half * (eta[span.stop - 1] + eta[span.stop]) - watch.level)
    left = abs(half * (eta[span.start - 1] + eta[span.start]) - watch.level)
    return max(left, right) if span.start < watch.beside else right


@maximum
def largest_between(lower, upper, level, start, stop):
    """Return max |eta - level| between two rows, of the means of their cells start..stop-1."""
    half = type(level)(0.5)
    largest = abs(level - level)
    first, count = part(start, stop)
    for k in range(count):
        i = k + first
        largest = max(largest, abs(half * (lower[i] + upper[i]) - level))
    return largest


@maximum
def largest_displacement(eta, level, start, stop):
    """Return max |eta - level| over a row's cells start..stop-1."""
    largest = abs(level - level)
    first, count = part(start, stop)
    for k in range(count):
        i = k + first
        largest = max(largest, abs(eta[i] - level))
    return largest
