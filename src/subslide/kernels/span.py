"""Where something can move: the cells that differ from still water, and those that a step may change around them.

A cell that is still, with still cells as far as a step reaches, has no flux through any edge: leaving it alone changes
not a bit of any answer. Still is the state of the box's last cell at the start, at rest. In the plane each padded row
has its span.
"""

from .arrays import GHOSTS
from .jit import inlined

FIRST, LAST, LOW, HIGH = range(4)
"""Columns of `spans`: the cells [first, last) that steps work on, which only grow; [low, high) those not still now."""


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
def reached(first, last, low, high, n):
    """Return [first, last) grown to what a step may change about [low, high), with ghosts where it nears the edge."""
    if low >= high:
        return first, last
    first = min(first, low - GHOSTS)
    last = max(last, high + GHOSTS)
    return (0 if first < 2 * GHOSTS else first), (n if last > n - 2 * GHOSTS else last)


@inlined
def widen(spans, n):
    """Grow the span of every padded row (of n cells) to what the next step may change."""
    rows = spans.shape[0]
    for j in range(GHOSTS, rows - GHOSTS):
        for m in range(j - GHOSTS, j + GHOSTS + 1):
            first, last = reached(spans[j, FIRST], spans[j, LAST], spans[m, LOW], spans[m, HIGH], n)
            spans[j, FIRST] = first
            spans[j, LAST] = last
    for g in range(GHOSTS):
        for ghost, source in ((g, GHOSTS), (rows - 1 - g, rows - GHOSTS - 1)):
            inner = source + 1 if ghost < source else source - 1
            spans[ghost, FIRST] = min(spans[source, FIRST], spans[inner, FIRST])
            spans[ghost, LAST] = max(spans[source, LAST], spans[inner, LAST])


@inlined
def joint(spans, first_row, last_row, before, after, n):
    """Return the span that holds those of the rows first_row..last_row, its ends shifted, within [0, n)."""
    first = spans[first_row, FIRST]
    last = spans[first_row, LAST]
    for j in range(first_row + 1, last_row + 1):
        first = min(first, spans[j, FIRST])
        last = max(last, spans[j, LAST])
    return max(first + before, 0), min(last + after, n)
