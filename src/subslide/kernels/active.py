"""Where something can move: the cells that differ from still water, and those that a step may change around them.

A cell that is still, with still cells as far as a step reaches, has no flux through any edge: leaving it alone changes
not a bit of any answer. Still is the state of the box's last cell at the start, at rest. Where there are no grains, a
step needs the water's fluxes alone, which are the same bits for less. In the plane each padded row has its spans.
"""

from subslide.kernels.arrays import GHOSTS, is_general
from subslide.kernels.jit import inlined
from subslide.kernels.viscosity import IFCP

FIRST, LAST, LOW, HIGH, WET_FIRST, WET_LAST, WET_LOW, WET_HIGH = range(8)
"""Columns of `spans`: the cells [first, last) that steps work on, which only grow; [low, high) those not still now; the
same of cells with grains."""

SPANS = 8


@inlined
def water_may_be_alone(s):
    """Return whether cells without grains are solved as water alone: with the solvers that are HLL or Rusanov there."""
    return not is_general(s) and s.layers == 2 and s.scheme != IFCP


@inlined
def is_still(h1, u1, v1, h2, u2, v2, still, i):
    """Return whether cell i of a row has the depths `still` and no velocity; what is not a number is not still."""
    at_rest = u1[i] == 0 and v1[i] == 0 and u2[i] == 0 and v2[i] == 0
    return at_rest and h1[i] == still[0] and h2[i] == still[1]


@inlined
def moved_span(h1, u1, v1, h2, u2, v2, still, start, stop):
    """Return [low, high), the smallest span of a row's cells start..stop-1 that holds all that are not still."""
    low = start
    while low < stop and is_still(h1, u1, v1, h2, u2, v2, still, low):
        low += 1
    high = max(low, stop)
    while high > low and is_still(h1, u1, v1, h2, u2, v2, still, high - 1):
        high -= 1
    return low, high


@inlined
def wet_span(h, dry_depth, start, stop):
    """Return [low, high), the smallest span of a row's cells start..stop-1 that holds all deeper than `dry_depth`."""
    low = start
    while low < stop and h[low] <= dry_depth:
        low += 1
    high = max(low, stop)
    while high > low and h[high - 1] <= dry_depth:
        high -= 1
    return low, high


@inlined
def reached(first, last, low, high, n, lanes):
    """Return [first, last) grown to what a step may change about [low, high).

    Whole vectors, so that loops leave nothing to be done one by one, and the ghosts too where it nears an edge.
    """
    if low >= high:
        return first, last
    first = min(first, (low - 2 * GHOSTS) // lanes * lanes + GHOSTS)
    last = max(last, (high + lanes - 1) // lanes * lanes + GHOSTS)
    return (0 if first < 2 * GHOSTS else first), (n if last > n - 2 * GHOSTS else last)


@inlined
def grain_span(h2, u2, v2, start, stop):
    """Return [low, high), the smallest span of a row's cells start..stop-1 that holds all with grains."""
    low = start
    while low < stop and h2[low] == 0 and u2[low] == 0 and v2[low] == 0:
        low += 1
    high = max(low, stop)
    while high > low and h2[high - 1] == 0 and u2[high - 1] == 0 and v2[high - 1] == 0:
        high -= 1
    return low, high


@inlined
def widen(spans, n, lanes, alone, joined):
    """Grow the spans of every padded row (of n cells) to what the next step may change.

    alone: see `water_may_be_alone`. joined: whether what leaves at one end comes in at the other.
    """
    rows = spans.shape[0]
    if joined:
        spans[:, FIRST] = spans[:, WET_FIRST] = 0
        spans[:, LAST] = spans[:, WET_LAST] = n
        return
    for j in range(GHOSTS, rows - GHOSTS):
        here = spans[j]
        for m in range(j - GHOSTS, j + GHOSTS + 1):
            near = spans[m]
            here[FIRST], here[LAST] = reached(here[FIRST], here[LAST], near[LOW], near[HIGH], n, lanes)
            low, high = (near[WET_LOW], near[WET_HIGH]) if alone else (near[LOW], near[HIGH])
            here[WET_FIRST], here[WET_LAST] = reached(here[WET_FIRST], here[WET_LAST], low, high, n, lanes)
    for g in range(GHOSTS):
        for ghost, source in ((g, GHOSTS), (rows - 1 - g, rows - GHOSTS - 1)):
            inner = source + 1 if ghost < source else source - 1
            for first, last in ((FIRST, LAST), (WET_FIRST, WET_LAST)):
                spans[ghost, first] = min(spans[source, first], spans[inner, first])
                spans[ghost, last] = max(spans[source, last], spans[inner, last])


@inlined
def split(start, stop, low, high):
    """Return two columns that part start..stop-1 into those before, within and after [low, high)."""
    first = min(max(low, start), max(start, stop))
    return first, max(first, min(high, stop))


@inlined
def joint(spans, first_row, last_row, before, after, n):
    """Return the span that holds those of the rows first_row..last_row, its ends shifted, within [0, n)."""
    first = spans[first_row, FIRST]
    last = spans[first_row, LAST]
    for j in range(first_row + 1, last_row + 1):
        first = min(first, spans[j, FIRST])
        last = max(last, spans[j, LAST])
    return max(first + before, 0), min(last + after, n)


@inlined
def joint_wet(spans, first_row, last_row, before, after, start, stop):
    """Return the two columns that part start..stop-1 by the grains' spans of the rows, their ends shifted."""
    low = spans[first_row, WET_FIRST]
    high = spans[first_row, WET_LAST]
    for j in range(first_row + 1, last_row + 1):
        low = min(low, spans[j, WET_FIRST])
        high = max(high, spans[j, WET_LAST])
    return split(start, stop, low + before, high + after)
