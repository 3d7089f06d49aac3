"""Which runs of a study a figure shows: one value of every key that it does not vary; words for the rest."""

from typing import NamedTuple

import numpy as np
import pandas as pd

from subslide import naming
from subslide.figures import _style, _words
from subslide.naming import FINISHED

PREFERRED = {
    "scene": "cylinder",
    "scene_options": None,
    "quantities": "all",
    "friction": "coulomb",
    "xi": None,
    "delta_2": None,
    "pouliquen_length": None,
    "a_2": 0.56,
    "delta": 32.0,
    "radius": 0.0705,
    "g": 9.81,
    "numerics": "paper",
    "model": None,
    "scheme": "ifcph",
    "front_speeds": None,
    "wave_speeds": "exact",
    "treatment": "real",
    "as_printed": "none",
    "friction_in_viscosity": True,
    "order": max,
    "cells": max,
    "dtype": "float64",
    "cfl": max,
    "boundary": "open",
    "t_end": "rest",
    "fields": True,
}
"""Keys that a figure keeps fixed, in the order they are settled, and the value taken where a study has it."""
ORDERS = {1: "first-order", 2: "second-order"}
PAPER = {"a_H": (1, 2, 10), "r": (0, 0.2, 0.4, 0.6, 0.8)}
"""Values that a figure shows before others, where a study has more than it can show."""


class Slice(NamedTuple):
    """Runs that differ only in the keys a figure varies: table, what they share, notes on the rest."""

    runs: pd.DataFrame
    about: str
    notes: list[str]


def cut(results, by=("a_H", "r"), most=None, numerics=None, **wanted):
    """Return the runs that differ only in `by`, sorted by it.

    numerics: the only kind looked at, if given. wanted: for a key, the values to keep. most: for a key of `by`, how
    many values to show (evenly picked).
    """
    runs = results.runs if numerics is None else results.runs[results.runs["numerics"] == numerics]
    for key, values in wanted.items():
        runs = runs[
            np.isclose(runs[key].astype(float).to_numpy()[:, None], np.atleast_1d(values)).any(axis=1)
        ]
    if runs.empty:
        asked = (f"{k} = {' or '.join(map(_words.number, np.atleast_1d(v)))}" for k, v in wanted.items())
        raise _style.NoRunsError(", ".join(asked))
    others = []
    for key, preferred in PREFERRED.items():
        if key in by or key not in runs:
            continue
        chosen = _choice(runs[key], preferred)
        same = _same(runs[key], chosen)
        if not same.all():
            others.append(_values(key, runs.loc[~same, key]))
        runs = runs[same]
    notes = [f"Also in this study, not shown here: {'; '.join(others)}."] if others else []
    for key, count in (most or {}).items():
        values = _shown(key, runs[key].unique(), count)
        if len(values) < runs[key].nunique():
            notes.append(
                f"{len(values)} of the study's {runs[key].nunique()} values of {_words.SYMBOLS[key]} shown."
            )
        runs = runs[runs[key].isin(values)]
    return Slice(runs.sort_values(list(by), kind="stable"), _about(runs, by), notes)


def sizes(runs):
    """Return (R, H2) in m of the first run of a table; a figure's runs share them."""
    first = runs.iloc[0]
    return float(first["radius"]), float(first["a_2"] * first["radius"])


def first_order(runs):
    """Return whether any run is of first order: then lengths and waves are far from converged."""
    return bool((runs["order"] == 1).any())


def values_of(results, key):
    """Return the sorted values of a key over the study's runs."""
    return sorted(results.runs[key].unique())


def nearest(values, target):
    """Return the value nearest to `target` in ratio."""
    return min(values, key=lambda value: abs(np.log((value + 1e-9) / (target + 1e-9))))


def evenly(values, count):
    """Return at most `count` of the sorted values, the least and the greatest among them."""
    values = sorted(values)
    if len(values) <= count:
        return values
    return [values[k] for k in sorted({round(k) for k in np.linspace(0, len(values) - 1, count)})]


def _shown(key, values, count):
    """Return at most `count` values: the paper's, the least and the greatest; or evenly picked."""
    values = sorted(values)
    known = [v for v in values if v in (values[0], values[-1]) or np.isclose(v, PAPER.get(key, ())).any()]
    return evenly(known if len(values) > count and len(known) >= 3 else values, count)


def curves(results, runs, quantity):
    """Return {id: (time, value)} (s, and the quantity's unit) for the runs of a table."""
    series = results.series
    series = series[(series["quantity"] == quantity) & series["id"].isin(runs["id"])]
    return {
        key: (rows["time"].to_numpy(), rows["value"].to_numpy())
        for key, rows in series.groupby("id", sort=False)
    }


def trouble(runs, by=("a_H", "r"), most=6, mark=""):
    """Return notes on the runs that did not end as they should: which, their status and what it means.

    mark: what the figure does where a failed run ends, such as '× ends its curve'.
    """
    notes = []
    for status, rows in runs[runs["status"] != "ok"].groupby("status", sort=False):
        which = [
            "(" + ", ".join(_words.equation(key, row[key]) for key in by) + ")" for _, row in rows.iterrows()
        ]
        more = f" and {len(which) - most} more" if len(which) > most else ""
        meaning = naming.STATUSES.get(status, "see the status in the table of runs")
        end = f"; {mark}" if mark and status not in FINISHED else ""
        notes.append(f"Status {status} ({meaning}{end}): {', '.join(which[:most])}{more}.")
    return notes


def _choice(column, preferred):
    """Return the value of a column that a figure takes: the preferred one, else the one most runs have."""
    values = column.dropna().unique()
    if preferred in (max, min) and len(values):
        return preferred(values)
    if preferred not in (None, max, min) and _same(column, preferred).any():
        return preferred
    return column.value_counts(sort=False, dropna=False).idxmax()


def _same(column, value):
    """Return which entries (bool) of a column equal a value: numbers to 1e-9, anything else as text."""
    if pd.isna(value):
        return column.isna()
    if pd.api.types.is_numeric_dtype(column) and not isinstance(value, str):
        return pd.Series(
            np.isclose(column.astype(float), float(value), rtol=1e-9, equal_nan=True), column.index
        )
    return column.astype(str) == str(value)


def _values(key, column):
    values = [_words.number(value) for value in sorted(column.unique(), key=str)]
    return f"{_words.SYMBOLS.get(key, key)} = {', '.join(values[:5])}{', ...' if len(values) > 5 else ''}"


def _about(runs, by):
    """Return what the runs share, for the line below a figure's title."""
    return f"{shared(runs, by)}, {solver(runs)}"


def shared(runs, by=()):
    """Return the column that all runs share, in words."""
    row = runs.iloc[0]
    words = [_words.equation(key, row[key]) for key in ("a_2", "delta") if key not in by]
    radius = _words.length_unit(row["radius"])
    return ", ".join([*words, f"$R$ = {row['radius'] * radius.factor:.4g} {radius.name}"])


def solver(runs):
    """Return how the runs were solved, in words."""
    row = runs.iloc[0]
    cell = _words.length_unit(row["dx"])
    scheme = f"{ORDERS[int(row['order'])]} {str(row['scheme']).upper()}"
    models = ", ".join(sorted(runs["resolved_model"].astype(str).unique()))
    return f"{scheme}, cells of {row['dx'] * cell.factor:.3g} {cell.name} ({models})"
