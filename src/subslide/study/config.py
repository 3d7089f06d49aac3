"""From a YAML file to a study: checked values, and the table of its points."""

import contextlib
import itertools
import math
from collections.abc import Collection, Iterator
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

from subslide.keys import schema, words
from subslide.keys.schema import ConfigError
from subslide.points import RUN_KEYS, Point, from_dict
from subslide.study import checking, choice, cost, scene_options, together, whole_study
from subslide.study.yaml_files import read_yaml

MOST_POINTS = 200_000
MOST_KEPT_WHOLE = 2_000
"""Solved points up to which `keep: auto` keeps all of each run."""
FEWEST_CELLS = 10
CASE_KEYS = ("numerics", *RUN_KEYS)
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
    """

    name: str
    figures: tuple[str, ...]
    runs: tuple[tuple[str, Point], ...]
    bands: bool = False
    asked: dict[str, Any] = field(default_factory=dict)

    @property
    def points(self) -> tuple[Point, ...]:
        """Points in the order of the tables."""
        return tuple(point for _, point in self.runs)

    @property
    def companions(self) -> tuple[tuple[Point, str, Point], ...]:
        """Run, role and point of each companion: none without bands, else two for each run on a uniform grid."""
        return tuple(
            (point, role, point.with_values(cells=point.cells // ratio))
            for point in self.points
            if self.bands and not choice.is_fitted(point)
            for role, ratio in COARSENING.items()
        )

    @cached_property
    def solved(self) -> tuple[Point, ...]:
        """Points to solve, without repeats: the runs, then those companions that are not runs as well."""
        companions = (point for *_, point in self.companions)
        return tuple({point.id: point for point in (*self.points, *companions)}.values())

    @property
    def keep(self) -> str:
        """What records keep of each run, one of `subslide.keys.kept.WORDS`; `auto` goes by the number of points."""
        if self.keep_at_least:
            return self.keep_at_least
        return "all" if len(self.solved) <= MOST_KEPT_WHOLE else "summary"

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
    _check_count(sum(map(_count, (axes for _, axes in grids))))
    runs: dict[str, tuple[str, Point]] = {}
    for place, axes in grids:
        with _named(place):
            for label, point in _product(axes, bands):
                runs.setdefault(point.id, (label, point))
    figures = whole_study.figures_of(whole["figures"], [point for _, point in runs.values()])
    study = Study(whole["study"], figures, tuple(runs.values()), bands, dict(values))
    alone = sum(not choice.is_fitted(point) for point in study.points) if bands else 0
    _check_count(len(runs) + alone * len(COARSENING), ", companions for bands among them")
    cost.check(study.solved, whole, "the study")
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
    if "cases" in values:
        raise ConfigError(
            f"cases: {words.show(values['cases'])} is not allowed for one run; allowed: only in a study"
        )
    names = names or {}
    whole = whole_study.values_of(values, names)
    single = {}
    for key, value in values.items():
        if key not in CASE_KEYS:
            continue
        if schema.is_axis(key) and isinstance(value, list):
            if len(value) != 1:
                shown = f"{names.get(key, key)}: {words.show(value)}"
                raise ConfigError(f"{shown} has {len(value)} values; allowed: one for one run")
            value = value[0]
        single[key] = schema.checked(key, value, names.get(key, key))
    point = resolve(single, names)[1]
    cost.check([point], whole, "the run")
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
    values = dict(values)
    name = (names or {}).get("scene_options", "scene_options")
    scene, given = values.get("scene", Point.scene), values.get("scene_options", {})
    values["scene_options"] = scene_options.checked(scene, given, name)
    label = values.pop("numerics", schema.properties()["numerics"]["default"])
    point = from_dict({**schema.properties()["numerics"]["presets"][label], **values})
    together.check(point)
    checking.mark(point)
    return label, point


def _grids(values: dict) -> list[tuple[str, dict[str, Any]]]:
    """Return the place in messages, and the axes by key, of each case; without `cases` of the one grid, placeless."""
    shared = _axes(values)
    if "cases" not in values:
        return [("", shared)]
    grids = []
    for n, case in enumerate(schema.checked("cases", values["cases"])):
        place = f"cases[{n}]"
        if not isinstance(case, dict):
            shown = words.show(case)
            raise ConfigError(f"{place}: {shown} is not allowed; allowed: a mapping of keys of a run")
        with _named(f"{place}."):
            _check_keys(case, CASE_KEYS)
            axes = {**shared, **_axes(case)}
        grids.append((f"{place}.", {key: axes[key] for key in CASE_KEYS if key in axes}))
    return grids


def _axes(values: dict) -> dict[str, Any]:
    """Return the values along its axis, checked, of each key of a run that a mapping has; scene options as given."""
    return {key: _axis(key, values[key]) for key in CASE_KEYS if key in values}


def _count(axes: dict[str, Any]) -> int:
    """Return the number of combinations of axes, none of which is made."""
    return math.prod(
        scene_options.count(values) if key == "scene_options" else len(values) for key, values in axes.items()
    )


def _check_count(count: int, among: str = "") -> None:
    """Raise a ConfigError if a study would have too many points."""
    if count > MOST_POINTS:
        raise ConfigError(f"the grid has {count} points{among}; allowed: at most {MOST_POINTS}")


def _product(axes: dict[str, Any], bands: bool) -> Iterator[tuple[str, Point]]:
    """Give the label of the numerics, and the point, of each combination of axes.

    bands: cells must halve twice, but of a fitted grid, which has no companions.
    """
    if "scene_options" in axes:
        axes = {**axes, "scene_options": scene_options.along_axes(axes["scene_options"])}
    for combination in itertools.product(*axes.values()):
        label, point = resolve(dict(zip(axes, combination, strict=True)))
        coarsest, left = divmod(point.cells, max(COARSENING.values()))
        if bands and (left or coarsest < FEWEST_CELLS) and not choice.is_fitted(point):
            raise ConfigError(
                f"cells: {point.cells} is not allowed with bands: true, which needs runs with cells/2 and cells/4;"
                f" allowed: a multiple of 4 from {4 * FEWEST_CELLS}"
            )
        yield label, point


@contextlib.contextmanager
def _named(place: str) -> Iterator[None]:
    """Put the place of a key before the message, which begins with the key, of a ConfigError raised in this context."""
    try:
        yield
    except ConfigError as error:
        raise ConfigError(f"{place}{error}") from None


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
    if not (schema.is_axis(key) and isinstance(value, list)):
        return [schema.checked(key, value)]
    if not value:
        raise ConfigError(
            f"{key}: [] makes an empty grid; allowed: {words.allowed(key)}, or a list of at least one"
        )
    entries = [schema.checked(key, entry) for entry in value]
    return list(dict.fromkeys(entries))
