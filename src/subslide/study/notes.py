"""What is said once of runs that are safe but not what was meant: beyond what was tried, too coarse, or half unheard.

Beside `cautions`, whose regions the stability atlas found unsafe. Imports no kernels.
"""

import collections
from collections.abc import Callable, Iterable, Mapping
from typing import Any, NamedTuple

from subslide import catalogue
from subslide.keys import kept, words
from subslide.keys.entries import ENTRIES
from subslide.keys.values import default_of
from subslide.points import Point
from subslide.study import choice
from subslide.study.cautions import Region

VOUCHED = {"a_H": (0.5, 10), "a_2": (0.3, 1.5), "r": (0, 0.8), "delta": (20, 40)}
"""Range of the columns, by key, for which README.md says what error to expect."""
COARSEST = 0.2
"""Cell size over R of a column above which L_f errs by up to 16 to 29 % (below it by up to 13 %; 25 columns)."""
FEWEST_FITTED = 24
"""Cells of a fitted grid below which L_f errs by more than 1.6 % (316 columns: 24 cells 1.6 %, 16 cells 5.2 %)."""
COLUMNS = ("cylinder", "ellipse", "columns")
"""Scenes of columns with upright sides."""


def _beyond(point: Point) -> bool:
    """Return whether a column lies outside the range that the README vouches for."""
    inside = (low <= getattr(point, key) <= high for key, (low, high) in VOUCHED.items())
    return point.scene == "cylinder" and not all(inside)


def _stands(point: Point) -> bool:
    """Return whether friction holds even the side of a column, which no grid makes steeper than 1 / dx."""
    holds = point.friction_number * point.scaled_dx >= 1 and not choice.is_fitted(point)
    return point.scene in COLUMNS and point.friction != "pouliquen" and holds


NOTES = (
    Region(
        "range",
        _beyond,
        "what error to expect is known for "
        + ", ".join(f"{key} {low:g} to {high:g}" for key, (low, high) in VOUCHED.items())
        + "; elsewhere it may be larger",
        "a study with bands: true, which estimates the error of each run",
        {"a_2": 0.07, "delta": 40, "cells": 200},
        {"a_2": 0.56},
        "",
    ),
    Region(
        "coarse grid",
        lambda point: point.scene in COLUMNS and not choice.is_fitted(point) and point.scaled_dx > COARSEST,
        f"with cells of more than {COARSEST:g} R the length of the deposit errs by up to a third",
        "cells: 100 or more",
        {"cells": 20, "a_2": 1.2},
        {"cells": 100},
        "",
    ),
    Region(
        "coarse fitted grid",
        lambda point: choice.is_fitted(point) and point.cells < FEWEST_FITTED,
        f"with fewer than {FEWEST_FITTED} cells the length of the deposit errs by up to several percent",
        "cells: 48",
        {"grid": "fitted", "cells": 10, "a_H": 0.5, "a_2": 1.5, "r": 0.8, "delta": 20},
        {"grid": "fitted", "cells": 48},
        "",
    ),
    Region(
        "no wave",
        lambda point: choice.is_fitted(point) and point.quantities != "grains",
        "a fitted grid does not resolve waves: max|eta|, the gauge and the surface are missing, not wrong",
        "grid: uniform for waves, or quantities: grains",
        {"grid": "fitted", "cells": 48},
        {"grid": "uniform"},
        "",
    ),
    Region(
        "standing column",
        _stands,
        "on this grid friction holds the upright side of the column, and no grain can move",
        "more cells, or a smaller delta",
        {"a_2": 0.02, "delta": 30, "cells": 100},
        {"cells": 1000},
        "",
    ),
)


class Unheard(NamedTuple):
    """A key that some runs do not heed: where, and why."""

    key: str
    where: Callable[[Point], bool]
    reason: str


def _alone(point: Point) -> bool:
    """Return whether grains are solved alone."""
    return choice.of(point).model == "one-layer"


FRONTS = tuple(
    name
    for name in ENTRIES["scheme"]["enum"]
    if catalogue.literals("kernels/viscosity", name).get("EXACT_FRONT")
)
"""Riemann solvers that let grains run onto a dry bed with the exact flux of a front."""

UNHEARD = (
    Unheard(
        "front_flux",
        lambda point: point.scheme not in FRONTS,
        f"only scheme: {' and '.join(FRONTS)} have an exact flux; the others take HLL's, or Rusanov's, at any front",
    ),
    Unheard(
        "scheme",
        lambda point: _alone(point) and point.scheme in ("ifcp", "roe"),
        "grains alone have two waves, so that ifcp is hll there, and roe is ifcph",
    ),
    Unheard("wave_speeds", _alone, "grains alone have exact speeds in closed form"),
    Unheard(
        "treatment",
        lambda point: _alone(point) or point.r == 0 or (point.treatment == "hll" and point.scheme == "hll"),
        "speeds of grains alone, or at r = 0, are never complex, and scheme: hll is HLL already",
    ),
    Unheard("xi", lambda point: point.friction != "voellmy", "only friction: voellmy has it"),
    *(
        Unheard(key, lambda point: point.friction != "pouliquen", "only friction: pouliquen has it")
        for key in ("delta_2", "pouliquen_length")
    ),
)
"""Keys that some values of others leave without effect, where they are not at their defaults."""


def notes(points: Iterable[Point]) -> list[str]:
    """Return the lines to say of points, one for each note that fits any, with how many of several it fits.

    Parameters
    ----------
    points
        Runs.

    Returns
    -------
    list of str
        Lines, in the form of `cautions.cautions`.
    """
    points = list(points)
    lines = []
    for note in NOTES:
        count = sum(map(note.holds, points))
        if count:
            lines.append(
                f"caution, {note.name} ({_who(count, points)}): {note.reason}. Choose {note.advice}."
            )
    for key, where, reason in UNHEARD:
        deaf = [point for point in points if getattr(point, key) != default_of(key) and where(point)]
        if deaf:
            value = words.show(getattr(deaf[0], key))
            lines.append(
                f"caution, without effect ({_who(len(deaf), points)}): {key}, such as {value}: {reason}."
            )
    chosen = collections.Counter(
        (choice.of(point).grid, choice.of(point).grid_reason) for point in points if point.grid == "auto"
    )
    for (grid, reason), count in chosen.items():
        lines.append(f"note, grid ({_who(count, points)}): {grid} ({reason}).")
    return lines


def _who(count: int, points: list[Point]) -> str:
    """Return which of the points are spoken of, in words."""
    return f"{count} of {len(points)} runs" if len(points) > 1 else "this run"


def left_out(values: Mapping[str, Any]) -> list[str]:
    """Return a line for each key of a study that one run is given in vain.

    Parameters
    ----------
    values
        Values of the run, checked.

    Returns
    -------
    list of str
        Lines.
    """
    vain = ["bands: true"] * (values.get("bands") is True)
    vain += [f"keep: {word}" for word in [values.get("keep", "all")] if word not in ("auto", "all")]
    return [f"{what} has no meaning for one run and is left out" for what in vain]


def unkept(points: Iterable[Point], keep: str) -> list[str]:
    """Return a line if a study asks for quantities that its records do not keep.

    Parameters
    ----------
    points
        The runs.
    keep
        What is kept of each, one of `subslide.keys.kept.WORDS`.

    Returns
    -------
    list of str
        One line, or none.
    """
    lost = [key for key in kept.LACKING[keep] if any(getattr(point, key) for point in points)]
    enough = next(word for word in kept.WORDS if not {*kept.LACKING[word]} & {*lost})
    line = f"keep: {keep} leaves out what is asked for by {' and '.join(lost)}; keep: {enough} has it"
    return [line] if lost else []
