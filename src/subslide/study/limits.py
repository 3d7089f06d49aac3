"""What a study costs as a whole, told before it is solved, and held to the limits that its keys set."""

import os
from collections.abc import Iterable, Mapping
from typing import NamedTuple

from subslide.keys.schema import ConfigError
from subslide.points import Point
from subslide.study.cost import START, of

AS_TABLE = 1.5
"""Bytes of a sample in tables over those in records."""


class Estimate(NamedTuple):
    """What a study costs.

    Attributes
    ----------
    points
        Number of points that are solved.
    core_hours
        Hours on one core.
    memory
        Bytes of the process that solves the largest point.
    disk
        Bytes of records and tables.
    """

    points: int
    core_hours: float
    memory: float
    disk: float

    def words(self) -> str:
        """Return the cost in words: time, memory of a job and disk."""
        seconds = self.core_hours * 3600
        units = {"seconds": 1, "minutes": 60, "hours": 3600}
        unit = max(
            (name for name in units if seconds >= units[name]), default="seconds", key=units.__getitem__
        )
        return (
            f"about {_rounded(max(seconds / units[unit], 1))} core-{unit}, {_rounded(self.memory / 1e6)} MB a job,"
            f" {_rounded(max(self.disk / 1e6, 1))} MB of records and tables"
        )


def estimate(points: Iterable[Point], keep: str = "all") -> Estimate:
    """Return what points cost together.

    Parameters
    ----------
    points
        Points, such as all that a study solves.
    keep
        What records keep of each, one of `subslide.keys.kept.WORDS`.

    Returns
    -------
    Estimate
        Sums, and the memory of the largest.
    """
    costs = [of(point) for point in points]
    series = "summary" if keep == "summary" else "series"
    bytes_ = sum(cost.kept(keep) + AS_TABLE * cost.kept(series) for cost in costs)
    time = sum(cost.seconds for cost in costs) + START[keep] * len(costs)
    return Estimate(len(costs), time / 3600, max((cost.memory for cost in costs), default=0.0), bytes_)


def check(points: Iterable[Point], limits: Mapping[str, float], what: str, keep: str = "all") -> None:
    """Check that points cost no more than is allowed.

    Parameters
    ----------
    points
        Points that are to be solved.
    limits
        Value of `max_core_hours`, `max_memory` and `max_disk`.
    what
        What messages call the points, such as "the study".
    keep
        What records keep of each.

    Raises
    ------
    ConfigError
        If they cost more: one line that names the key which allows it.
    """
    cost = estimate(points, keep)
    for key, needed, unit in (
        ("max_core_hours", cost.core_hours, "core-hours"),
        ("max_memory", cost.memory / 1e9, "GB of memory a job"),
        ("max_disk", cost.disk / 1e9, "GB on the disk"),
    ):
        if needed > limits[key]:
            raise ConfigError(
                f"{what} needs about {_rounded(needed)} {unit}; allowed: up to {key}: {limits[key]:g} (the key, or"
                f" --{key.replace('_', '-')} of run, allows more)"
            )


def _rounded(number: float) -> str:
    """Return a number to three digits, without an exponent and with commas."""
    return f"{float(f'{number:.3g}'):,g}" if number < 1e6 else f"{float(f'{number:.3g}'):,.0f}"


def usable_cores() -> int:
    """Return how many cores this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
