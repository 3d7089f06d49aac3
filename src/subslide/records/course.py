"""The samples that tell the course of a series: compiled loops over a run's samples."""

import math

import numpy as np

from subslide.solver.compiled import compiled


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

    Samples that are kept in any case are compared with those of other runs, so they are not rounded.

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
        exact = kept[row].copy()
        keep_samples(values, time, 0.8 * allowed, kept[row])
        for n in range(len(values)):
            values[n] = coarse(values[n], 0.0 if exact[n] else quantum) if kept[row, n] else math.nan
