"""Batches: points that one process solves into one record, and the file that states them, with whole points."""

import json
import math
from collections.abc import Iterable
from pathlib import Path

from subslide import scenes
from subslide.keys.schema import ConfigError
from subslide.points import Point, from_dict, paper_times, to_dict
from subslide.study import choice

SECONDS = (2.0, 60.0)
"""Least and greatest estimated cost of a batch: starting a process costs a second; a lost batch at most a minute."""

SECONDS_PER_CELL = {"axial": 2.5e-8, "planar": 9e-8}
"""Of one step and order of accuracy, on one core."""

PARTS = 16
"""Batches that a set of new points makes if their cost allows it."""

MOST_POINTS, MOST_BYTES = 250, 256e6
"""Limits of one record."""

MOST_SPEC_BYTES = 100_000_000
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
        If it is no batch file, a point does not have its id, or its scene cannot be made.
    """
    try:
        rows = json.loads(Path(spec).read_text(encoding="utf-8"))["points"]
        points = {row.pop("id"): from_dict(row) for row in rows}
    except FileNotFoundError:
        raise ConfigError(f"{spec}: there is no such file") from None
    except (OSError, ValueError, KeyError, TypeError, AttributeError) as error:
        raise ConfigError(f"{spec}: not a batch file ({type(error).__name__}: {error})") from None
    for name, point in points.items():
        if point.id != name:
            raise ConfigError(f"{spec}: the values of {name} belong to {point.id}; was the file edited?")
        try:
            scenes.check(point)
        except ConfigError as error:
            raise ConfigError(f"{spec}: {name}: {error}") from None
    return list(points.values())


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
