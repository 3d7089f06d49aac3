"""What figures say: symbols, units that read well, values with both, what runs share and which of them failed."""

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from subslide import naming

if TYPE_CHECKING:
    import pandas as pd

THRESHOLD = naming.FRONT_THRESHOLDS[0]
"""Depth that defines the front in figures, as a fraction of H2."""
THRESHOLD_LABEL = next(iter(naming.FRONT_LABELS))
"""Its label in names of columns and series, such as `L_f_1pc`."""
FRONT = f"front where $h_2$ = {THRESHOLD:.0%} of $H_2$"
ORDERS = {1: "first-order", 2: "second-order"}
SYMBOLS = {
    "a_H": "$a_H$",
    "a_2": "$a_2$",
    "r": "$r$",
    "delta": "$\\delta$",
    "radius": "$R$",
    "x": "$x$",
    "time": "$t$",
    "h2": "$h_2$",
    "eta": "$\\eta$",
    "x_front": "$x_\\mathrm{front}$",
    "L_f": "$L_f$",
    "max_abs_eta": "max$\\,|\\eta|$",
}
"""Symbols of `subslide.naming` as print sets them."""


class Unit(NamedTuple):
    """A unit of an axis, and how many of it the SI unit holds."""

    name: str
    factor: float


class Units(NamedTuple):
    """Units of the two axes of a series: of time, and of its values."""

    time: Unit
    value: Unit


def length_unit(*values: Any) -> Unit:
    """Return the unit in which lengths (m) up to the largest of `values` read best."""
    return _unit(values, ((0.1, "mm", 1e3), (1.0, "cm", 1e2), (5e3, "m", 1.0), (np.inf, "km", 1e-3)))


def time_unit(*values: Any) -> Unit:
    """Return the unit in which times (s) up to the largest of `values` read best."""
    return _unit(values, ((2.5, "ms", 1e3), (np.inf, "s", 1.0)))


def _unit(values: tuple, choices: tuple) -> Unit:
    """Return the first unit of `choices` (limit, name, factor) whose limit is above every finite value."""
    finite = [float(np.nanmax(np.abs(v))) for v in values if np.isfinite(v).any()]
    largest = max(finite, default=0.0)
    return next(Unit(name, factor) for below, name, factor in choices if largest < below)


def label(name: str, unit: Unit) -> str:
    """Return the text of an axis: symbol and unit."""
    return f"{SYMBOLS[name]} ({unit.name})"


def number(value: Any) -> str:
    """Return a parameter's value as a reader writes it."""
    return f"{value:.4g}" if isinstance(value, float | int | np.number) else str(value)


def equation(name: str, value: Any) -> str:
    """Return 'symbol = value', with the unit where there is one."""
    return f"{SYMBOLS.get(name, name)} = {number(value)}" + ("°" if name == "delta" else "")


def values(key: str, column: "pd.Series") -> str:
    """Return 'symbol = value, value, ...' with up to five of the values in a column."""
    texts = [number(value) for value in sorted(column.unique(), key=str)]
    return f"{SYMBOLS.get(key, key)} = {', '.join(texts[:5])}{', ...' if len(texts) > 5 else ''}"


def panel(k: int, text: str) -> str:
    """Return the title of panel `k`."""
    return f"({chr(97 + k)}) {text}"


def moment(time: float, unit: Unit) -> str:
    """Return 't = ...' with its unit, of a time (s)."""
    return f"{SYMBOLS['time']} = {time * unit.factor:.4g} {unit.name}"


def shared(runs: "pd.DataFrame", by: Iterable[str] = ()) -> str:
    """Return the column that all runs share, in words; without keys of `by`, which they do not share."""
    row = runs.iloc[0]
    words = [equation(key, row[key]) for key in ("a_2", "delta") if key not in by]
    radius = length_unit(row["radius"])
    return ", ".join([*words, f"$R$ = {row['radius'] * radius.factor:.4g} {radius.name}"])


def solver(runs: "pd.DataFrame") -> str:
    """Return how the runs were solved, in words."""
    row = runs.iloc[0]
    cell = length_unit(row["dx"])
    fitted = row["resolved_grid"] == "fitted"
    cells = (
        f"{row['cells']} fitted cells" if fitted else f"cells of {row['dx'] * cell.factor:.3g} {cell.name}"
    )
    scheme = f"{ORDERS[int(row['order'])]} {str(row['scheme']).upper()}"
    models = ", ".join(sorted(runs["resolved_model"].astype(str).unique()))
    return f"{scheme}, {cells} ({models})"


def trouble(
    runs: "pd.DataFrame", by: tuple[str, ...] = ("a_H", "r"), most: int = 6, cross: str = ""
) -> list[str]:
    """Return notes on the runs that did not end as they should: which, their status and what it means.

    Parameters
    ----------
    runs
        Rows of the table of runs.
    by
        Keys that tell the runs apart.
    most
        How many runs to name of each status; the rest are counted.
    cross
        What the figure does where a failed run ends, such as '× ends its curve'.
    """
    notes = []
    for status, rows in runs[runs["status"] != "ok"].groupby("status", sort=False):
        which = ["(" + ", ".join(equation(key, row[key]) for key in by) + ")" for _, row in rows.iterrows()]
        more = f" and {len(which) - most} more" if len(which) > most else ""
        meaning = naming.STATUSES.get(status, "see the status in the table of runs")
        end = f"; {cross}" if cross and status not in naming.FINISHED else ""
        notes.append(f"Status {status} ({meaning}{end}): {', '.join(which[:most])}{more}.")
    return notes
