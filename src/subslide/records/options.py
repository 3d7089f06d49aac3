"""Options of scenes as columns of runs: a value of each run whose scene has the option."""

import functools
from collections.abc import Sequence
from typing import Any, NamedTuple

from subslide import naming, scenes
from subslide.points import RUN_KEYS, Point

TAKEN = frozenset((*naming.NAMES, *RUN_KEYS, "id", "m", "run"))
"""Names that mean something else in records and tables: such an option is called `option_NAME`."""


class Option(NamedTuple):
    """One option of scenes: its values, what they mean, and whether they are numbers.

    Attributes
    ----------
    values
        Value of each run; of one whose scene has no such option NaN, or '' if it is no number.
    about
        Which scenes have it, and what it is.
    is_number
        Whether every scene that has it, of all there are, says that it is a number.
    """

    values: list[Any]
    about: str
    is_number: bool


@functools.cache
def described(names: tuple[str, ...]) -> dict[str, tuple[str, bool]]:
    """Return what the options of some scenes are, and whether they are numbers, by the name of their column.

    Parameters
    ----------
    names
        Names of the scenes.

    Returns
    -------
    dict
        By the name of each column what it is in each scene, and whether it is a number in all scenes that there are:
        so that it is so in each record of a study.
    """
    words: dict[str, list[str]] = {}
    for scene in names:
        for name, about in scenes.load(scene).OPTIONS.items():
            words.setdefault(name, []).append(f"{scene}: {about['description']}")
    return {column(name): ("; ".join(said), _is_number(name)) for name, said in words.items()}


def column(name: str) -> str:
    """Return what the column of an option is called."""
    return f"option_{name}" if name in TAKEN else name


def scenes_of(points: Sequence[Point]) -> tuple[str, ...]:
    """Return the names of the scenes of some points, sorted."""
    return tuple(sorted({point.scene for point in points}))


def of(points: Sequence[Point]) -> dict[str, Option]:
    """Return the options of the scenes of some points, by the name of their column.

    Parameters
    ----------
    points
        The points.

    Returns
    -------
    dict
        In the order of the scenes, and of the options of each; none of scenes without options.
    """
    present = scenes_of(points)
    stated = [
        {column(name): value for name, value in scenes.options(point).items()}
        for point in (points if described(present) else ())
    ]
    return {
        name: Option([values.get(name, float("nan") if number else "") for values in stated], about, number)
        for name, (about, number) in described(present).items()
    }


@functools.cache
def _is_number(name: str) -> bool:
    """Return whether an option of that name is a number in every scene that has it."""
    entries = [scenes.load(scene).OPTIONS.get(name, {}) for scene in scenes.NAMES]
    kinds = [
        entry.get("type", "") if "enum" not in entry else _kind(entry["enum"]) for entry in entries if entry
    ]
    return all(kind in ("number", "integer") for kind in kinds)


def _kind(allowed: Sequence[Any]) -> str:
    """Return the kind of a choice: a number if all that is allowed are."""
    return "number" if all(isinstance(value, int | float) for value in allowed) else "string"
