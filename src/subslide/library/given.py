"""Keys as a program gives them: numbers of numpy, arrays, ranges and paths as what a configuration would state."""

import os
import sys
import warnings
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

from subslide.keys import words
from subslide.keys.schema import ConfigError
from subslide.points import Point
from subslide.study import cautions, notes

if TYPE_CHECKING:
    import xarray as xr

FIRST = (
    *(
        "status",
        "status_detail",
        "L_f",
        "time_of_arrest",
        "time_at_rest",
        "max_abs_eta_peak",
        "eta_gauge_peak",
    ),
    *("x_front", "max_abs_eta", "max_abs_eta_outside", "eta_gauge", "h2", "eta"),
)
"""Variables of a data set that are shown first."""

HOME = os.path.dirname(os.path.abspath(__file__))
"""Folder of the modules whose lines no warning names."""


class Caution(UserWarning):
    """Warning on runs that are unsafe, or not what was meant: what the command line says on stderr."""


def plain(value: Any) -> Any:
    """Return a value as a YAML file would give it.

    Parameters
    ----------
    value
        Numbers, texts, lists and mappings, of Python, numpy, pandas or xarray.

    Returns
    -------
    object
        The same of Python's own numbers, texts, lists and dictionaries; what is none of these stays as it is.
    """
    if isinstance(value, Mapping):
        return {plain(key): plain(inner) for key, inner in value.items()}
    if isinstance(value, list | tuple | range):
        return [plain(inner) for inner in value]
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    for name in ("to_numpy", "tolist"):
        if not isinstance(value, type) and hasattr(value, name):
            value = getattr(value, name)()
    return value


def mapping(values: Any, what: str) -> dict[str, Any]:
    """Return the values of a study by key as `plain` has them.

    Parameters
    ----------
    values
        What a program gives.
    what
        What the message calls it.

    Returns
    -------
    dict
        Values by key.

    Raises
    ------
    ConfigError
        If they are no mapping, or nested without end.
    """
    if not isinstance(values, Mapping):
        raise ConfigError(
            f"{what}: {words.show(values)} is not allowed; allowed: a mapping of keys of a study"
        )
    try:
        return dict(plain(values))
    except RecursionError:
        raise ConfigError(
            f"{what}: a value is within itself, or nested too deep; allowed: lists of values"
        ) from None


def warn(points: Iterable[Point], more: Iterable[str] = ()) -> None:
    """Say as warnings, once of each unsafe region and note, that it fits some of the points.

    Parameters
    ----------
    points
        Runs that are to be solved.
    more
        Other lines to say.
    """
    points = list(points)
    for line in (*cautions.cautions(points), *notes.notes(points), *more):
        warnings.warn(words.printable(line), Caution, stacklevel=_caller())


def outcome_first(data: "xr.Dataset") -> "xr.Dataset":
    """Return a data set whose variables stand in the order in which a notebook shows them best.

    Parameters
    ----------
    data
        A run, or a study.

    Returns
    -------
    xarray.Dataset
        The same: how it ended, how far it ran and what waves it made come first.
    """
    return data[sorted(data.data_vars, key=lambda name: FIRST.index(name) if name in FIRST else len(FIRST))]


def _caller() -> int:
    """Return how many calls, from that of `warn` on, lie between a warning and the program which called the library."""
    frame, level = sys._getframe(1), 1
    while frame.f_back is not None and frame.f_code.co_filename.startswith(HOME):
        frame, level = frame.f_back, level + 1
    return level
