"""What a run's samples come to: loops over them, compiled where there are many."""

import math

import numpy as np

from subslide.solver.compiled import sparing


@sparing
def peak(values: np.ndarray, time: np.ndarray) -> tuple[float, float]:
    """Return the largest of the values that are numbers, and the first time of it; NaN if none is finite.

    Parameters
    ----------
    values
        Samples (samples).
    time
        Their times (samples).

    Returns
    -------
    tuple of float
        Value and time.
    """
    place = -1
    finite = False
    for n in range(len(values)):
        finite = finite or math.isfinite(values[n])
        if not math.isnan(values[n]) and (place < 0 or values[n] > values[place]):
            place = n
    return (values[place], time[place]) if finite else (math.nan, math.nan)


@sparing
def relative_change(values: np.ndarray) -> float:
    """Return the largest relative change of values since the first; NaN if none is finite.

    Parameters
    ----------
    values
        Samples (samples).

    Returns
    -------
    float
        The change over the first value.
    """
    largest = -1.0
    finite = False
    for n in range(len(values)):
        change = abs(values[n] / values[0] - 1.0)
        finite = finite or math.isfinite(change)
        if change > largest:
            largest = change
    return largest if finite else math.nan


@sparing
def extreme(values: np.ndarray, sign: float) -> float:
    """Return the largest (sign 1) or the smallest (-1) of the values that are numbers; NaN if there is none.

    Parameters
    ----------
    values
        Samples (samples).
    sign
        1 or -1.

    Returns
    -------
    float
        The value.
    """
    kept = math.nan
    for n in range(len(values)):
        if math.isnan(kept) or sign * values[n] > sign * kept:
            kept = values[n]
    return kept


@sparing
def share_above(values: np.ndarray, bound: float) -> float:
    """Return the share of values that are above a bound.

    Parameters
    ----------
    values
        Samples (samples).
    bound
        The bound.

    Returns
    -------
    float
        From 0 to 1; what is no number counts as not above.
    """
    count = 0
    for n in range(len(values)):
        count += values[n] > bound
    return count / len(values)


@sparing
def rise(energy: np.ndarray, time: np.ndarray, until: float) -> tuple[float, float]:
    """Return the first finite energy of times up to `until`, NaN without one, and the largest rise after any.

    Parameters
    ----------
    energy, time
        Samples (samples) and their times.
    until
        Last time that counts; NaN for all.

    Returns
    -------
    tuple of float
        Energy, and its rise.
    """
    first = least = math.nan
    largest = 0.0
    for n in range(len(energy)):
        if math.isfinite(energy[n]) and not time[n] > until:
            if math.isnan(first):
                first = least = energy[n]
            least = min(least, energy[n])
            largest = max(largest, energy[n] - least)
    return first, largest


@sparing
def running_mean_peak(values: np.ndarray, time: np.ndarray, span: float) -> tuple[float, float]:
    """Return the largest size of the mean of values, linear between times, over a span, and when that span begins.

    Parameters
    ----------
    values
        Samples (samples).
    time
        Their times (samples).
    span
        Length of the mean.

    Returns
    -------
    tuple of float
        Size and time; NaN if a value is not finite, or the times are shorter than the span.
    """
    count = len(values)
    if not time[count - 1] - time[0] >= span:
        return math.nan, math.nan
    whole = np.zeros(count)
    for n in range(count):
        if not math.isfinite(values[n]):
            return math.nan, math.nan
        if n:
            step = time[n] - time[n - 1]
            whole[n] = whole[n - 1] + (values[n] + values[n - 1]) / 2 * step
    largest, when = -1.0, 0.0
    after = 0
    for n in range(count):
        if not time[n] <= time[count - 1] - span:
            break
        end = time[n] + span
        while after < count - 1 and time[after + 1] <= end:
            after += 1
        until = whole[after]
        if after < count - 1 and time[after] != end:
            slope = (whole[after + 1] - whole[after]) / (time[after + 1] - time[after])
            until = slope * (end - time[after]) + whole[after]
        mean = abs(until - whole[n]) / span
        if mean > largest:
            largest, when = mean, time[n]
    return largest, when
