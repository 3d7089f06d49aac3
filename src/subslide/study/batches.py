"""Batches: points that one process solves into one record, and the file that states them, with whole points."""

import json
import math
from collections.abc import Iterable
from pathlib import Path

from subslide.keys import words
from subslide.keys.schema import ConfigError
from subslide.points import Point, paper_times, to_dict
from subslide.study import checking, choice
from subslide.study.yaml_files import read_text

SECONDS = (2.0, 60.0)
"""Least and greatest estimated cost of a batch: starting a process costs a second; a lost batch at most a minute."""

SECONDS_PER_CELL = {"axial": 2.5e-8, "planar": 9e-8}
"""Of one step and order of accuracy, on one core."""

PARTS = 16
"""Batches that a set of new points makes if their cost allows it."""

MOST_POINTS, MOST_BYTES = 250, 256e6
"""Limits of one record."""

MOST_BATCH_BYTES = 100_000_000
"""Size from which on a file is no batch."""


def spec_text(points: Iterable[Point]) -> str:
    """Return the text of the file that states a batch, from its points in order."""
    rows = [{"id": point.id, **to_dict(point)} for point in points]
    return json.dumps({"points": rows}, indent=1, allow_nan=False) + "\n"


def read_batch(spec: Path | str) -> list[Point]:
    """Return the points of a batch file.

    Raises
    ------
    ConfigError
        If it is no batch file, a value is not allowed, or a point does not have its id: one line, which begins with
        the path.
    """
    text = read_text(spec, MOST_BATCH_BYTES)
    try:
        batch = json.loads(text)
        rows, kernels = batch["points"], batch.get("kernels")  # which the version before this one stated
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError) as error:
        raise ConfigError(f"{spec}: not a batch file ({type(error).__name__}: {error})") from None
    if not (isinstance(rows, list) and rows):
        raise ConfigError(f"{spec}: points: {words.show(rows)} is not allowed; allowed: a list of points")
    if kernels is not None and kernels not in choice.all_kernels():
        hint = words.closest(kernels, choice.all_kernels())
        raise ConfigError(f"{spec}: kernels: {words.show(kernels)}: there are none of that name{hint}")
    points = []
    for number, row in enumerate(rows):
        try:
            point = checking.point_of_row(row)
        except ConfigError as error:
            raise ConfigError(f"{spec}: points[{number}]: {error}") from None
        if point.id != row["id"]:
            raise ConfigError(
                f"{spec}: the values of {words.show(row['id'])} belong to {point.id}; was the file edited?"
            )
        points.append(point)
    return points


def split(points: list[Point]) -> list[list[Point]]:
    """Return batches of points: one cell size and one set of kernels in each, balanced by estimated cost.

    The number of cores has no say, so that the files of a study do not depend on it.
    """
    groups: dict[tuple, list[Point]] = {}
    for point in points:
        groups.setdefault((choice.kernels(point), point.dx, point.fields), []).append(point)
    total = sum(cost(point) for point in points)
    target = min(max(total / PARTS, SECONDS[0]), SECONDS[1])
    return [batch for group in groups.values() for batch in _balanced(group, target)]


def cost(point: Point) -> float:
    """Return the estimated seconds of a run on one core: cells times steps, and a start.

    A step is limited by the fastest wave, sqrt(g (H1 + H2)), over the paper's time unless the run has one of its own.
    """
    half = point.cells / 2
    cells, kind = {"quarter": (half**2, "planar"), "plane": (4 * half**2, "planar")}.get(
        choice.of(point).model, (half, "axial")
    )
    seconds = point.t_end or paper_times(point.radius)[-1]
    steps = seconds * point.wave_speed / (point.cfl * point.dx) * (2 if kind == "planar" else 1)
    return 0.005 + SECONDS_PER_CELL[kind] * cells * steps * point.order


def _balanced(points: list[Point], target: float) -> list[list[Point]]:
    """Return points in bins of about `target` seconds each: the costliest first, into the least filled bin."""
    total = sum(cost(point) for point in points)
    size = sum(_bytes(point) for point in points)
    bins = max(math.ceil(total / target), math.ceil(len(points) / MOST_POINTS), math.ceil(size / MOST_BYTES))
    bins = min(bins, len(points))
    filled = [0.0] * bins
    members: list[list[int]] = [[] for _ in range(bins)]
    for n in sorted(range(len(points)), key=lambda n: (-cost(points[n]), n)):
        least = min(range(bins), key=lambda b: (filled[b], len(members[b]), b))
        filled[least] += cost(points[n])
        members[least].append(n)
    return [[points[n] for n in sorted(bin_)] for bin_ in members]


def _bytes(point: Point) -> float:
    """Return the estimated bytes of a run in a record."""
    across = point.cells * 1.2
    return 80.0 * 2.4 * across + (5 * 2 * 4 * across**2 if point.fields else 0)
