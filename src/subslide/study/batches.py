"""Batches: points that one process solves into one record, and the file that states them, with whole points."""

import json
import math
from collections.abc import Iterable
from pathlib import Path
from typing import NamedTuple

from subslide.keys import kept, words
from subslide.keys.schema import ConfigError
from subslide.points import Point
from subslide.study import choice, cost, rows
from subslide.study.yaml_files import read_text

SECONDS = (2.0, 60.0)
"""Least and greatest estimated cost of a batch: starting a process costs a second; a lost batch at most a minute."""

PARTS = 16
"""Batches that a set of new points makes if their cost allows it."""

MOST_POINTS, MOST_BYTES = 250, 256e6
"""Limits of one record."""

MOST_BATCH_BYTES = 100_000_000
"""Size from which on a file is no batch."""


class Spec(NamedTuple):
    """What a batch file states: points in order, and what is kept of each run."""

    points: list[Point]
    keep: str


def spec_text(points: Iterable[Point], keep: str = "all") -> str:
    """Return the text of the file that states a batch.

    Parameters
    ----------
    points
        Its points, in order.
    keep
        What is kept of each run, one of `subslide.keys.kept.WORDS`.

    Returns
    -------
    str
        JSON.
    """
    return rows.text({"keep": keep}, {"points": (({"id": point.id}, point) for point in points)})


def read_batch(spec: Path | str) -> Spec:
    """Return what a batch file states; one of before there was a choice keeps all.

    Parameters
    ----------
    spec
        Path of the file.

    Returns
    -------
    Spec
        Its points, each checked, and what is kept of each run.

    Raises
    ------
    ConfigError
        If it is no batch file, a value is not allowed, or a point does not have its id: one line, which begins with
        the path.
    """
    text = read_text(spec, MOST_BATCH_BYTES)
    try:
        batch = json.loads(text)
        listed, kernels = batch["points"], batch.get("kernels")  # which an older version stated
        keep = batch.get("keep", "all")
    except KeyError as error:
        raise ConfigError(f"{spec}: not a batch file: the key {error} is missing") from None
    except RecursionError:
        raise ConfigError(f"{spec}: not a batch file: nested too deep") from None
    except (ValueError, TypeError, AttributeError) as error:
        raise ConfigError(f"{spec}: not a batch file: {error}") from None
    if not (isinstance(listed, list) and listed):
        raise ConfigError(f"{spec}: points: {words.show(listed)} is not allowed; allowed: a list of points")
    if kernels is not None and kernels not in choice.all_kernels():
        hint = words.closest(kernels, choice.all_kernels())
        raise ConfigError(f"{spec}: kernels: {words.show(kernels)}: there are none of that name{hint}")
    if keep not in kept.WORDS:
        raise ConfigError(
            f"{spec}: keep: {words.show(keep)} is not allowed; allowed: {', '.join(kept.WORDS)}"
        )
    points: dict[str, Point] = {}
    try:
        reader = rows.Reader(batch, check=True)
    except ConfigError as error:
        raise ConfigError(f"{spec}: {error}") from None
    for number, row in enumerate(listed):
        try:
            point = reader.point(row)
        except ConfigError as error:
            raise ConfigError(f"{spec}: points[{number}]: {error}") from None
        if point.id in points:
            raise ConfigError(
                f"{spec}: points[{number}]: {point.id} stands there twice; allowed: each point once"
            )
        points[point.id] = point
    return Spec(list(points.values()), keep)


def split(points: list[Point]) -> list[list[Point]]:
    """Return batches of points: one cell size and one set of kernels in each, balanced by estimated cost.

    A record of unlike cell sizes repeats the places of cells at each snapshot: default runs on 200, 400 and 800 cells
    take a third more bytes in one than in three. The number of cores has no say, so that the files of a study do not
    depend on it.
    """
    groups: dict[tuple, list[Point]] = {}
    for point in points:
        size = 0.0 if choice.is_fitted(point) else point.dx
        groups.setdefault((choice.kernels(point), size, point.fields), []).append(point)
    total = sum(cost.seconds(point) for point in points)
    target = min(max(total / PARTS, SECONDS[0]), SECONDS[1])
    return [batch for group in groups.values() for batch in _balanced(group, target)]


def _balanced(points: list[Point], target: float) -> list[list[Point]]:
    """Return points in bins of about `target` seconds each: the costliest first, into the least filled bin."""
    total = sum(cost.seconds(point) for point in points)
    size = sum(cost.disk(point) for point in points)
    bins = max(math.ceil(total / target), math.ceil(len(points) / MOST_POINTS), math.ceil(size / MOST_BYTES))
    bins = min(bins, len(points))
    filled = [0.0] * bins
    members: list[list[int]] = [[] for _ in range(bins)]
    for n in sorted(range(len(points)), key=lambda n: (-cost.seconds(points[n]), n)):
        least = min(range(bins), key=lambda b: (filled[b], len(members[b]), b))
        filled[least] += cost.seconds(points[n])
        members[least].append(n)
    return [[points[n] for n in sorted(bin_)] for bin_ in members]
