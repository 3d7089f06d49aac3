"""Batches: points that one process solves into one record, and the file that states them, with whole points."""

import heapq
import json
import math
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

from subslide.keys import kept, measured, words
from subslide.keys.schema import ConfigError
from subslide.points import Point
from subslide.study import choice, cost, numbering, pace, rows
from subslide.study.yaml_files import read_text

PROCESS = 1.2
"""Seconds that a job takes to start and to end, beside its runs."""

LEAST = 2.5
"""Seconds of runs below which a job is not worth its start, if there are others."""

MOST_POINTS = {"all": 250, "series": 1_000, "summary": 20_000}
"""Most runs of one record, by what is kept of each."""

MOST_BYTES = 256e6
"""Estimated size from which on there are several records."""

MOST_BATCH_BYTES = 100_000_000
"""Size from which on a file is no batch."""


class Spec(NamedTuple):
    """What a batch file states: points in order, what is kept of each run, and the number of the first."""

    points: list[Point]
    keep: str
    first: int = 0


def spec_text(points: Iterable[Point], keep: str = "all", first: int = 0) -> str:
    """Return the text of the file that states a batch.

    Parameters
    ----------
    points
        Its points, in order.
    keep
        What is kept of each run, one of `subslide.keys.kept.WORDS`.
    first
        Number of the first run within its study; the others follow.

    Returns
    -------
    str
        JSON.
    """
    return rows.text(
        {"keep": keep, numbering.KEY: first}, {"points": (({"id": point.id}, point) for point in points)}
    )


def read_batch(spec: Path | str) -> Spec:
    """Return what a batch file states; one of an older version keeps all, and numbers its runs from 0.

    Parameters
    ----------
    spec
        Path of the file.

    Returns
    -------
    Spec
        Its points, each checked, what is kept of each run, and the number of the first.

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
        keep, first = batch.get("keep", "all"), batch.get(numbering.KEY, 0)
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
    if not numbering.is_first(first, len(listed)):
        raise ConfigError(
            f"{spec}: {numbering.KEY}: {words.show(first)} is not allowed; allowed: a whole number from 0"
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
    return Spec(list(points.values()), keep, first)


class Sharing(NamedTuple):
    """How points are shared out to jobs.

    Attributes
    ----------
    keep
        What is kept of each run, one of `subslide.keys.kept.WORDS`.
    seconds
        How long a job shall work (the key `batch_seconds`).
    cores
        How many jobs work at the same time.
    pace
        Seconds that runs have taken on this machine over those estimated, by kind of run (`study.pace`).
    """

    keep: str = "all"
    seconds: float = 30.0
    cores: int = 2
    pace: Mapping[str, float] = {}

    def cost(self, point: Point) -> float:
        """Return the seconds that a run is taken to need on this machine."""
        return cost.seconds(point, self.keep) * self.pace.get(pace.kind(point, self.keep), 1.0)


ALONE = Sharing()
"""Points of a study without a say, on a machine of unknown pace."""


def split(points: Sequence[Point], sharing: Sharing = ALONE) -> list[list[Point]]:
    """Return batches of points, the costliest first, so that cores which work on them end together.

    One set of kernels has each batch and, where profiles are kept, one cell size: a record of unlike sizes repeats the
    places of cells at each snapshot (default runs on 200, 400 and 800 cells take a third more bytes in one than in
    three). No answer depends on which batch a point is in.

    Parameters
    ----------
    points
        Points that are to be solved.
    sharing
        How they are shared out.

    Returns
    -------
    list of list of Point
        Points of each batch, in the order in which they were given.
    """
    groups: dict[tuple, list[Point]] = {}
    for point in points:
        size = 0.0 if sharing.keep != "all" or choice.is_fitted(point) else point.dx
        groups.setdefault(
            (choice.kernels(point), size, *(getattr(point, key) for key in measured.ENTRIES)), []
        ).append(point)
    costs = {name: [sharing.cost(point) for point in group] for name, group in groups.items()}
    even = sum(map(sum, costs.values())) / sharing.cores
    target = min(max(even if len(groups) == 1 else even / 2, LEAST), sharing.seconds)
    batches = []
    for name, group in groups.items():
        for places in _bins(group, costs[name], target, sharing):
            batches.append((sum(costs[name][n] for n in places), [group[n] for n in places]))
    batches.sort(key=lambda batch: -batch[0])
    ends, seconds, end = [0.0] * sharing.cores, 0.0, 0.0
    for seconds, _ in batches:
        end = ends[0] + seconds
        heapq.heapreplace(ends, end)
    if (
        end == max(ends) and seconds > 2 * LEAST
    ):  # cores would wait for the last batch: each takes a part of it
        _, last = batches.pop()
        batches += [(0.0, part) for n in range(sharing.cores) if (part := last[n :: sharing.cores])]
    return [batch for _, batch in batches]


def of_one_record(points: Sequence[Point], keep: str) -> tuple[Point, ...]:
    """Return those points of a batch which one record may hold: all, unless more is kept of each than it was made for.

    Parameters
    ----------
    points
        Points of the batch.
    keep
        What is kept of each run, one of `subslide.keys.kept.WORDS`.

    Returns
    -------
    tuple of Point
        The first batch that they are split into, however long a job may work.
    """
    return tuple(split(points, Sharing(keep, math.inf, 1))[0])


def _bins(points: list[Point], costs: list[float], target: float, sharing: Sharing) -> list[list[int]]:
    """Return the places of points in bins of about `target` seconds: the costliest first, into the least filled bin.

    Where every core gets several bins, the last round is one of two halves, so that cores end together though
    estimates are not exact.
    """
    total, size = sum(costs), sum(cost.of(point).kept(sharing.keep) for point in points)
    rounds = total / target / sharing.cores
    count = math.ceil(rounds) * sharing.cores if rounds > 1.1 else math.ceil(total / target - 0.1)
    halves = 2 * sharing.cores if rounds > 2 else 0
    count = max(
        count + halves // 2, math.ceil(len(points) / MOST_POINTS[sharing.keep]), math.ceil(size / MOST_BYTES)
    )
    count = min(count, len(points))
    filled = [(total / count / 2 if number >= count - halves else 0.0, 0, number) for number in range(count)]
    heapq.heapify(filled)
    members: list[list[int]] = [[] for _ in range(count)]
    for place in sorted(range(len(points)), key=lambda place: (-costs[place], place)):
        seconds, held, number = heapq.heappop(filled)
        members[number].append(place)
        if held + 1 < MOST_POINTS[sharing.keep] or len(filled) == 0:
            heapq.heappush(filled, (seconds + costs[place], held + 1, number))
    return [sorted(places) for places in members if places]
