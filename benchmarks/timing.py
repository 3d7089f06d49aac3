"""Fair times on a machine that others use too: candidates take turns, and their ratios are formed within a turn."""

import statistics
import time
from typing import NamedTuple


class Spread(NamedTuple):
    """Median and extremes of repetitions."""

    median: float
    low: float
    high: float


def spread(values):
    """Return the `Spread` of some numbers."""
    return Spread(statistics.median(values), min(values), max(values))


def rate_of(work, count, seconds=0.1):
    """Return a function that gives `count` over the mean seconds of `work()`, called for about that long."""
    work()
    started = time.perf_counter()
    work()
    calls = max(1, round(seconds / max(time.perf_counter() - started, 1e-7)))

    def rate():
        started = time.perf_counter()
        for _ in range(calls):
            work()
        return calls * count / (time.perf_counter() - started)

    return rate


def take_turns(rates, rounds, reference=None):
    """Return {name: [rate of each round]}, and under (name, reference) its ratios to the reference.

    rates: {name: function that measures and returns a rate}. The reference, one of the names, is measured before and
    after every candidate, and a ratio is to the mean of these two.
    """
    measured = {name: [] for name in rates}
    if reference:
        measured |= {(name, reference): [] for name in rates if name != reference}
    for _ in range(rounds):
        before = rates[reference]() if reference else None
        for name, rate in rates.items():
            if name == reference:
                continue
            measured[name].append(rate())
            if reference:
                after = rates[reference]()
                measured[name, reference].append(measured[name][-1] / (0.5 * (before + after)))
                measured[reference] += [before, after]
                before = after
    return measured


def ratio(measured, name, other):
    """Return the `Spread` of rate over rate, round by round."""
    return spread([a / b for a, b in zip(measured[name], measured[other], strict=True)])
