"""Whether a point, however it was made, is one that a study could ask for."""

from typing import Any

from subslide.keys import schema, words
from subslide.keys.schema import ConfigError
from subslide.keys.values import RUN_KEYS, STANDS_FOR
from subslide.points import Point, from_dict
from subslide.study import scene_options, together

MARK = "_checked"
"""Attribute of points that have been checked; no value of theirs can change afterwards."""


def mark(point: Point) -> None:
    """Set the mark of a point that has been checked."""
    vars(point)[MARK] = True


def check_point(point: Point) -> None:
    """Check a point as a file of a study would be, once: one that was read from a study costs no time.

    Parameters
    ----------
    point
        Point of any values, such as `Point(order=2, t_end=0.5)` by hand.

    Raises
    ------
    ConfigError
        If a value is out of range or of the wrong type, or values do not go with one another: one line.
    """
    if MARK in vars(point):
        return
    for key in RUN_KEYS:
        value = getattr(point, key)
        if value is not None or key not in STANDS_FOR:  # None stands for the word that is the default
            schema.checked(key, _as_stated(key, value))
    _check_whole(point)


def point_of_row(row: Any) -> Point:
    """Return the point of a row of a batch file, which states every key.

    Parameters
    ----------
    row
        Value by key of a run, and the point's id.

    Returns
    -------
    Point
        The point, checked; whether it has that id is not.

    Raises
    ------
    ConfigError
        If a key is missing or one too many, or a value is not allowed: one line.
    """
    if not isinstance(row, dict):
        raise ConfigError(f"{words.show(row)} is no point; allowed: a mapping with every key of a run")
    keys = ("id", *RUN_KEYS)
    for key in (*keys, *row):
        if key not in row:
            raise ConfigError(f"{key}: this key is missing")
        if key not in keys:
            raise ConfigError(f"{words.show(key)}: there is no such key{words.closest(key, keys)}")
    point = from_dict({key: schema.checked(key, row[key]) for key in RUN_KEYS})
    _check_whole(point)
    return point


def _check_whole(point: Point) -> None:
    """Check what no value tells alone, and mark the point."""
    scene_options.checked(point.scene, dict(point.scene_options), "scene_options")
    together.check(point)
    mark(point)


def _as_stated(key: str, value: Any) -> Any:
    """Return a value of a point as a file would state it."""
    try:
        return {"scene_options": dict, "snapshot_times": list}.get(key, lambda same: same)(value)
    except (TypeError, ValueError):
        return value
