"""From a YAML file to a study: checked values, and the table of its points."""

import functools
from collections.abc import Collection
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from subslide.keys import schema, words
from subslide.keys.designs import MOST_POINTS
from subslide.keys.schema import ConfigError
from subslide.points import RUN_KEYS, Point
from subslide.study import choice, designs, expansion, forms, limits, whole_study
from subslide.study.designs import Design
from subslide.study.expansion import Grid
from subslide.study.yaml_files import read_yaml

MOST_KEPT_WHOLE = 2_000
"""Solved points up to which `keep: auto` keeps all of each run."""
FEWEST_CELLS = 10
AXES = ("numerics", *RUN_KEYS)
CASE_KEYS = ("design", *AXES)
COARSENING = {"cells/2": 2, "cells/4": 4}
"""Role of each companion of a run in a study with bands, and how many times fewer cells it has."""


@dataclass(frozen=True)
class Study:
    """Checked study.

    Attributes
    ----------
    name
        Name of its folder of results.
    figures
        Names of the figures to draw.
    runs
        Label of the numerics, and point, of each run, without repeats, in the order of the tables.
    bands
        Whether each run has bands, for which those on uniform grids have companions on coarser ones.
    asked
        Configuration by key, as its file states it, checked.
    designs
        Of each Saltelli design, and combination of the axes beside it: ``kind``, ``spec`` as checked, ``others`` (value
        by key of those axes), ``names`` of its inputs, and ``ids`` (scramblings, blocks, points) of its runs.
    """

    name: str
    figures: tuple[str, ...]
    runs: tuple[tuple[str, Point], ...]
    bands: bool = False
    asked: dict[str, Any] = field(default_factory=dict)
    designs: tuple[dict[str, Any], ...] = ()

    @functools.cached_property
    def points(self) -> tuple[Point, ...]:
        """Points in the order of the tables."""
        return tuple(point for _, point in self.runs)

    @functools.cached_property
    def companions(self) -> tuple[tuple[Point, str, Point], ...]:
        """Run, role and point of each companion: none without bands, else two for each run on a uniform grid."""
        return tuple(
            (point, role, point.with_values(cells=point.cells // ratio))
            for point in self.points
            if self.bands and not choice.is_fitted(point)
            for role, ratio in COARSENING.items()
        )

    @functools.cached_property
    def solved(self) -> tuple[Point, ...]:
        """Points to solve, without repeats: the runs, then those companions that are not runs as well."""
        companions = (point for *_, point in self.companions)
        return tuple({point.id: point for point in (*self.points, *companions)}.values())

    @property
    def keep(self) -> str:
        """What records keep of each run, one of `subslide.keys.kept.WORDS`; `auto` goes by the number of points."""
        if self.keep_at_least:
            return self.keep_at_least
        if len(self.solved) <= MOST_KEPT_WHOLE:
            return "all"
        return "series" if any(point.gauges for point in self.points) else "summary"

    @property
    def batch_seconds(self) -> float:
        """Seconds that a job shall work for."""
        default: float = schema.properties()["batch_seconds"]["default"]
        return float(self.asked.get("batch_seconds") or default)

    @property
    def keep_at_least(self) -> str:
        """What records must keep because the configuration says so outright; '' if it does not."""
        word = self.asked.get("keep", "auto")
        return "" if word == "auto" else str(word)


def read_study(path: Path | str) -> Study:
    """Return the checked study of a YAML file.

    Raises
    ------
    ConfigError
        If anything is wrong: one line, which begins with the path.
    """
    values = read_yaml(path)
    try:
        return make_study(values)
    except ConfigError as error:
        raise ConfigError(f"{path}: {error}") from None


def make_study(values: dict) -> Study:
    """Return the checked study of a mapping such as a YAML file holds.

    Raises
    ------
    ConfigError
        If anything is wrong: one line that names the key, its value and what is allowed.
    """
    _check_keys(values)
    if "study" not in values:
        raise ConfigError(f"study: this key is missing; allowed: {words.allowed('study')}")
    whole = whole_study.values_of(values)
    bands = whole["bands"]
    grids = _grids(values)
    _check_count(sum(grid.size for grid in grids))
    runs: dict[str, tuple[str, Point]] = {}
    listed: list[dict[str, Any]] = []
    for grid in grids:
        ids = []
        with schema.placed(grid.place):
            grid.check()
            along = grid.along()
            for label, point in expansion.points(along):
                if bands:
                    _check_coarsening(point)
                ids.append(point.id)
                runs.setdefault(point.id, (label, point))
        listed += expansion.members(grid, along, ids)
    figures = whole_study.figures_of(
        whole["figures"], [point for _, point in runs.values()], {one["kind"] for one in listed}
    )
    study = Study(whole["study"], figures, tuple(runs.values()), bands, dict(values), tuple(listed))
    alone = sum(not choice.is_fitted(point) for point in study.points) if bands else 0
    _check_count(len(runs) + alone * len(COARSENING), ", companions for bands among them")
    limits.check(study.solved, whole, "the study", study.keep)
    return study


def make_point(values: dict, names: dict[str, str] | None = None) -> Point:
    """Return the point of a mapping with one value for each key.

    Parameters
    ----------
    values
        Value by key; a list of one value stands for the value. Keys of a whole study but `cases` are checked, and
        say nothing of the point.
    names
        What messages call a key, such as the option of the command line, where that is not its name.

    Returns
    -------
    Point
        The point; defaults stand for keys that are left out.

    Raises
    ------
    ConfigError
        If anything is wrong: one line that names the key, its value and what is allowed.
    """
    _check_keys(values)
    for key in ("cases", "design"):
        if key in values:
            shown = f"{(names or {}).get(key, key)}: {words.show(values[key])}"
            raise ConfigError(f"{shown} is not allowed for one run; allowed: only in a study")
    names = names or {}
    whole = whole_study.values_of(values, names)
    single = {}
    for key, value in values.items():
        if key not in CASE_KEYS:
            continue
        value = _listed(key, value, names.get(key, key))
        if schema.is_axis(key) and isinstance(value, list):
            if len(value) != 1:
                shown = f"{names.get(key, key)}: {words.show(value)}"
                raise ConfigError(f"{shown} has {len(value)} values; allowed: one for one run")
            value = value[0]
        single[key] = schema.checked(key, value, names.get(key, key))
    point = resolve(single, names)[1]
    limits.check([point], whole, "the run")
    return point


def resolve(values: dict, names: dict[str, str] | None = None) -> tuple[str, Point]:
    """Return the label of the numerics, and the point, of single values.

    Scene options are checked here, and whether the values go with one another.

    Parameters
    ----------
    values
        Value by key, each checked for itself but the scene options.
    names
        What messages call a key, where that is not its name.

    Returns
    -------
    tuple of str and Point
        Label and point.

    Raises
    ------
    ConfigError
        If values do not go with one another: one line.
    """
    maker = expansion.Maker(values, (names or {}).get("scene_options", "scene_options"))
    return maker.point(dict(zip(values, expansion.as_held(values, values.values()), strict=True)))


def _grids(values: dict) -> list[Grid]:
    """Return the grid of each case; without `cases` the one of the file, placeless."""
    axes, chosen = _axes(values), _designs(values)
    if "cases" not in values:
        return [Grid("", axes, chosen)]
    grids = []
    for n, case in enumerate(schema.checked("cases", values["cases"])):
        place = f"cases[{n}]"
        if not isinstance(case, dict):
            shown = words.show(case)
            raise ConfigError(f"{place}: {shown} is not allowed; allowed: a mapping of keys of a run")
        with schema.placed(f"{place}."):
            _check_keys(case, CASE_KEYS)
            of_case = _designs(case)
            given = {name for design in of_case for name in design.names}
            joined = {key: axis for key, axis in axes.items() if key not in given} | _axes(case)
        ordered = {key: joined[key] for key in AXES if key in joined}
        grids.append(Grid(f"{place}.", ordered, of_case if "design" in case else chosen))
    return grids


def _designs(values: dict) -> tuple[Design, ...]:
    """Return the designs, checked, that a mapping states."""
    return tuple(designs.checked(values["design"])) if "design" in values else ()


def _axes(values: dict) -> dict[str, Any]:
    """Return the values along its axis, checked, of each key of a run that a mapping has; scene options as given."""
    return {key: _axis(key, values[key]) for key in AXES if key in values}


def _check_count(count: int, among: str = "") -> None:
    """Raise a ConfigError if a study would have too many points."""
    if count > MOST_POINTS:
        raise ConfigError(f"the grid has {count} points{among}; allowed: at most {MOST_POINTS}")


def _check_coarsening(point: Point) -> None:
    """Raise a ConfigError unless cells halve twice in a study with bands, but of a fitted grid, without companions."""
    coarsest, left = divmod(point.cells, max(COARSENING.values()))
    if (left or coarsest < FEWEST_CELLS) and not choice.is_fitted(point):
        raise ConfigError(
            f"cells: {point.cells} is not allowed with bands: true, which needs runs with cells/2 and cells/4;"
            f" allowed: a multiple of 4 from {4 * FEWEST_CELLS}"
        )


def _check_keys(values: dict, known: Collection[str] | None = None) -> None:
    """Raise a ConfigError unless every key is known: one of a study, or of `known`, those of a case."""
    known = schema.properties() if known is None else known
    for key in values:
        if key in known:
            continue
        if key in schema.properties():
            raise ConfigError(
                f"{key}: {words.show(values[key])} is not allowed within a case; allowed: only for a whole study"
            )
        hint = words.closest(key, known)
        listed = "" if hint else f"; allowed: {', '.join(known)}"
        raise ConfigError(
            f"{words.show(key)}: there is no such key (its value: {words.show(values[key])}){hint}{listed}"
        )


def _axis(key: str, value: Any) -> Any:
    """Return the values of one key along its axis, checked, without repeats; scene options as given."""
    if key == "scene_options":
        return schema.checked(key, value)
    value = _listed(key, value, key)
    if not (schema.is_axis(key) and isinstance(value, list)):
        return [schema.checked(key, value)]
    if not value:
        raise ConfigError(
            f"{key}: [] makes an empty grid; allowed: {words.allowed(key)}, or a list of at least one"
        )
    entries = [schema.checked(key, entry) for entry in value]
    return list(dict.fromkeys(entries))


def _listed(key: str, value: Any, name: str) -> Any:
    """Return the list that a form such as {linspace: [0, 1, 5]} of a numeric axis stands for; others as they are."""
    numeric = key in designs.REALS or schema.is_integer(schema.properties()[key])
    return forms.numbers(value, name) if numeric and isinstance(value, dict) else value
