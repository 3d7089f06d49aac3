"""What a run's samples come to: loops over them, compiled once for all kinds of runs."""

import hashlib
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from subslide.kernels.jit import driver


def compiled(function: Callable) -> Any:
    """Return a function compiled and kept: its name states this file, which the folder of kernels does not."""
    sources = hashlib.sha256(Path(__file__).read_bytes()).hexdigest()[:12]
    function.__qualname__ = f"{function.__name__}_{sources}"
    return driver(function)


@compiled
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


@compiled
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


@compiled
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


@compiled
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


@compiled
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


@compiled
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


@compiled
def tolerance(values: np.ndarray, share: float, least: float) -> float:
    """Return how far a summary may be from the finite samples of a series.

    Parameters
    ----------
    values
        Samples (samples).
    share
        Share of their range.
    least
        Share of their largest size that is allowed in any case.

    Returns
    -------
    float
        The distance; 0 if none is finite.
    """
    low, high = math.inf, -math.inf
    for n in range(len(values)):
        if math.isfinite(values[n]):
            low, high = min(low, values[n]), max(high, values[n])
    return max(share * (high - low), least * max(abs(low), abs(high))) if low <= high else 0.0


@compiled
def keep_samples(values: np.ndarray, time: np.ndarray, within: float, kept: np.ndarray) -> None:
    """Set in `kept` the samples between which straight lines pass all others.

    From each kept sample on, a line to the next one must pass every sample between: the slopes that do are an interval,
    which each sample narrows; the last sample whose own slope lies in all of them is kept. So are both ends of every
    gap, where values are not finite, and each local extreme that stands out by more than is allowed.

    Parameters
    ----------
    values, time
        Samples (samples), and their times.
    within
        Distance within which lines are to pass.
    kept
        Whether a sample (samples) is kept in any case; gets whether it is.
    """
    count = len(values)
    kept[0] = kept[count - 1] = True
    high = low = 0  # places of the extremes since the last one that is kept
    rising = falling = True
    for n in range(count):
        value = values[n]
        if n and math.isfinite(value) != math.isfinite(values[n - 1]):
            kept[n] = kept[n - 1] = True
            high = low = n
            rising = falling = True
        if not math.isfinite(value):
            continue
        if value > values[high]:
            high = n
        if value < values[low]:
            low = n
        if rising and values[high] - value > within:
            kept[high] = True
            low, rising, falling = n, False, True
        elif falling and value - values[low] > within:
            kept[low] = True
            high, rising, falling = n, True, False
    if rising:
        kept[high] = True
    if falling:
        kept[low] = True
    least, most = -math.inf, math.inf
    pivot, n = 0, 1
    while n < count:
        span, change = time[n] - time[pivot], values[n] - values[pivot]
        known = math.isfinite(change)
        fits = span > 0.0 and (not known or least <= change / span <= most)
        if pivot < n - 1 and (kept[n - 1] or not fits):
            kept[n - 1] = True
            pivot = n - 1
            least, most = -math.inf, math.inf
            continue
        if not fits:  # a sample at the time of the one before it
            kept[n] = True
        elif known:
            least = max(least, (change - within) / span)
            most = min(most, (change + within) / span)
        n += 1


@compiled
def coarse(value: float, quantum: float) -> float:
    """Return a number rounded to whole quanta; infinite where it is not finite.

    Parameters
    ----------
    value
        The number.
    quantum
        A power of two, or 0 for no rounding.

    Returns
    -------
    float
        The rounded number.
    """
    if not math.isfinite(value):
        return math.inf
    return np.rint(value / quantum) * quantum if quantum > 0.0 else value


@compiled
def summarise(series: np.ndarray, time: np.ndarray, share: float, least: float, kept: np.ndarray) -> None:
    """Set in `kept` which samples tell the course of each series, round these, and make all others not a number.

    Parameters
    ----------
    series
        Series (series, samples), which are changed; a kept sample that is not finite becomes infinite.
    time
        Their times (samples).
    share, least
        As of `tolerance`, within which straight lines between kept samples pass all others.
    kept
        Samples (series, samples) that are kept in any case; gets those that are.
    """
    for row in range(len(series)):
        values = series[row]
        allowed = tolerance(values, share, least)
        quantum = 2.0 ** math.floor(math.log2(allowed / 4)) if allowed > 0.0 else 0.0
        keep_samples(values, time, 0.8 * allowed, kept[row])
        for n in range(len(values)):
            values[n] = coarse(values[n], quantum) if kept[row, n] else math.nan
