"""Which runs of a study solve one column with many numerics, and which of these are its truth."""

import json
from collections.abc import Iterable
from typing import NamedTuple

from subslide import points
from subslide.keys import schema
from subslide.points import Point, from_dict, paper_times, to_dict
from subslide.study import choice
from subslide.study.config import COARSENING

METHOD = tuple(key for key in schema.with_role("method") if key != "cells")
"""Keys of a method: all numerics but the cells."""
APART = schema.with_role("method", "output")
"""Keys in which runs of one problem may differ."""


class Problem(NamedTuple):
    """One column: the points of its runs, and those of the three grids, the finest first, that give the truth."""

    points: tuple[Point, ...]
    truth: tuple[Point, ...]


def method(point: Point) -> tuple:
    """Return the values of METHOD of a point, with the model and the grid that are solved."""
    chosen = choice.of(point)
    return tuple(getattr(chosen if key in ("model", "grid") else point, key) for key in METHOD)


DEFAULT = method(Point())
"""Default numerics, which solve a round column on its radius."""
PAPER = method(from_dict({**schema.properties()["numerics"]["presets"]["paper"], "model": "plane"}))
"""The source paper's method, in the plane as the paper has it."""
FITTED = method(Point(grid="fitted"))
"""Default numerics on a fitted grid."""
NAMES = {DEFAULT: "default", PAPER: "paper", FITTED: "fitted"}
PLANES = ("quarter", "plane")


def problems(among: Iterable[Point]) -> list[Problem]:
    """Return the problems among some points.

    A problem is a column with runs in the plane and, by the default numerics, on three grids on a radius of which each
    has twice the cells of the next.
    """
    groups: dict[str, list[Point]] = {}
    among = list(among)
    if not any(choice.of(point).model in PLANES for point in among):
        return []
    for point in among:
        if point.scene == "cylinder":
            groups.setdefault(_physics(point), []).append(point)
    columns = [Problem(tuple(group), _truth(group)) for group in groups.values()]
    return [one for one in columns if one.truth and any(choice.of(p).model in PLANES for p in one.points)]


def _truth(group: list[Point]) -> tuple[Point, ...]:
    """Return the points of the three finest grids of the default numerics that halve twice; none without."""
    grids = {point.cells: point for point in group if method(point) == DEFAULT}
    for cells in sorted(grids, reverse=True):
        wanted = [cells / ratio for ratio in (1, *COARSENING.values())]
        if all(n in grids for n in wanted):
            return tuple(grids[n] for n in wanted)
    return ()


def _physics(point: Point) -> str:
    """Return a text that is equal for points of one problem."""
    return json.dumps(
        {key: value for key, value in to_dict(point).items() if key not in APART}, sort_keys=True
    )


def end_time(point: Point) -> float:
    """Return the time (s) until which fronts are compared: the run's end, or the paper's last one for rest."""
    return point.t_end or paper_times(point.radius)[-1]


def edge_time(point: Point) -> float:
    """Return the time (s) up to which waves are compared: the first is at the edge of the paper's box, or the run ends.

    From then on the edge has a part, and it is round on a radius but square in the plane.
    """
    return min(points.edge_time(point.a_H, point.a_2, point.radius, point.g), end_time(point))
