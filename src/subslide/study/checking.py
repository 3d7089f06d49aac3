"""Whether a point, however it was made, is one that a study could ask for."""

from typing import Any

from subslide.keys import schema
from subslide.keys.values import RUN_KEYS, STANDS_FOR
from subslide.points import Point
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
    check_whole(point)


def check_whole(point: Point) -> None:
    """Check what no value tells alone, and mark the point.

    Parameters
    ----------
    point
        Point, each of whose values is allowed.

    Raises
    ------
    ConfigError
        If they do not go with one another: one line.
    """
    scene_options.checked(point.scene, dict(point.scene_options), "scene_options")
    together.check(point)
    mark(point)


def _as_stated(key: str, value: Any) -> Any:
    """Return a value of a point as a file would state it."""
    try:
        if key == "gauges":
            hash(value)
            return [list(place) for place in value]
        return {"scene_options": dict, "snapshot_times": list}.get(key, lambda same: same)(value)
    except (TypeError, ValueError):
        if key == "gauges":  # lists have no hash
            raise schema.refused(key, value, "of a Point ((x, y), ...), a tuple of tuples") from None
        return value
