"""Which runs of a study a figure shows: one value of every key that it does not vary; notes name the rest."""

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import pandas as pd

from subslide.figures import _style, _words
from subslide.keys import schema
from subslide.keys.entries import METHOD, OUTPUT, PHYSICS, PRESET, SCENE
from subslide.points import Point

if TYPE_CHECKING:
    from subslide.results import Results

MOST_FREQUENT = object()
"""Preference for the value that most runs have."""

PREFERRED = {
    "scene_options": MOST_FREQUENT,
    "numerics": "paper",
    "model": MOST_FREQUENT,
    "order": max,
    "cells": max,
    "cfl": max,
    "fields": True,
}
"""Value that a figure takes where a study has it, of the keys for which that is not the default."""

ROLES = (SCENE, OUTPUT, PHYSICS, PRESET, METHOD)
"""Roles of keys in the order they are settled: what is solved before how."""

LAST = ("boundary", "fields")
"""Keys settled after all others: the edge of the sea, or whether fields are kept, must not decide between numerics."""

PAPER = {"a_H": (1, 2, 10), "r": (0, 0.2, 0.4, 0.6, 0.8)}
"""Values that a figure shows before others, where a study has more than it can show."""


class Slice(NamedTuple):
    """Runs that differ only in the keys a figure varies: table, what they share, notes on the rest."""

    runs: pd.DataFrame
    about: str
    notes: list[str]


def settled_keys() -> list[str]:
    """Return the keys of a run, and numerics, in the order in which a figure takes one value of each."""
    keys = [key for role in ROLES for key in schema.with_role(role)]
    return sorted(keys, key=LAST.__contains__)


def preference(key: str) -> Any:
    """Return what a figure takes of a key: a value, `max` of the values, or `MOST_FREQUENT`."""
    return PREFERRED[key] if key in PREFERRED else schema.properties()[key]["default"]


def cut(
    results: "Results",
    by: tuple[str, ...] = ("a_H", "r"),
    most: dict[str, int] | None = None,
    numerics: str | None = None,
    **wanted: Any,
) -> Slice:
    """Return the runs that differ only in some keys, one run for each combination of their values.

    Parameters
    ----------
    results
        The study.
    by
        Keys that the figure varies; the runs are sorted by them.
    most
        How many values to show, at most, of a key of ``by``.
    numerics
        The only kind of numerics looked at, if given.
    **wanted
        For a key, the number or numbers to keep.

    Raises
    ------
    NoRunsError
        If no run has the values wanted.
    """
    runs = results.runs if numerics is None else results.runs[results.runs["numerics"] == numerics]
    for key, values in wanted.items():
        runs = runs[
            np.isclose(runs[key].astype(float).to_numpy()[:, None], np.atleast_1d(values)).any(axis=1)
        ]
    if runs.empty:
        asked = (f"{k} = {' or '.join(map(_words.number, np.atleast_1d(v)))}" for k, v in wanted.items())
        raise _style.NoRunsError(", ".join(asked))
    runs, others = _settled(runs, by)
    notes = [f"Also in this study, not shown here: {'; '.join(others)}."] if others else []
    for key, count in (most or {}).items():
        values = _shown(key, runs[key].unique(), count)
        if len(values) < runs[key].nunique():
            notes.append(
                f"{len(values)} of the study's {runs[key].nunique()} values of {_words.SYMBOLS[key]} shown."
            )
        runs = runs[runs[key].isin(values)]
    about = f"{_words.shared(runs, by)}, {_words.solver(runs)}"
    return Slice(runs.sort_values(list(by), kind="stable"), about, notes)


def _settled(runs: pd.DataFrame, by: tuple[str, ...]) -> tuple[pd.DataFrame, list[str]]:
    """Return the runs with one value of every key but `by`, and words for the values left out, key by key."""
    others, absent = [], []
    for key in settled_keys():
        if key in by:
            continue
        if key not in runs:
            absent.append(key)
            continue
        same = _same(runs[key], _choice(runs[key], preference(key)))
        if not same.all():
            others.append(_words.values(key, runs.loc[~same, key]))
        runs = runs[same]
    again = runs.duplicated(list(by))  # these differ in keys that the table of runs does not have
    if again.any():
        others.append(f"{again.sum()} runs that differ in {' or '.join(absent)} alone")
    return runs[~again], others


def column(row: pd.Series) -> Point:
    """Return the point that has the column and material of a row of a table of runs, all else by default."""
    keys = [key for key in schema.with_role(PHYSICS) if key in row]
    return Point(**{key: row[key] for key in keys})


def sizes(runs: pd.DataFrame) -> tuple[float, float]:
    """Return (R, H2) in m of the first run of a table; a figure's runs share them."""
    first = column(runs.iloc[0])
    return float(first.radius), float(first.column_height)


def first_order(runs: pd.DataFrame) -> bool:
    """Return whether any run is of first order: then lengths and waves are far from converged."""
    return bool((runs["order"] == 1).any())


def values_of(results: "Results", key: str) -> list:
    """Return the sorted values of a key over the study's runs."""
    return sorted(results.runs[key].unique())


def nearest(values: Iterable[float], target: float) -> float:
    """Return the value nearest to `target` in ratio."""
    return min(values, key=lambda value: abs(np.log((value + 1e-9) / (target + 1e-9))))


def evenly(values: Iterable, count: int) -> list:
    """Return at most `count` of the sorted values, the least and the greatest among them."""
    values = sorted(values)
    if len(values) <= count:
        return values
    return [values[k] for k in sorted({round(k) for k in np.linspace(0, len(values) - 1, count)})]


def curves(results: "Results", runs: pd.DataFrame, quantity: str) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    """Return the series of a quantity for the runs of a table.

    Parameters
    ----------
    results
        The study.
    runs
        Rows of its table of runs.
    quantity
        Name of the series in the table of series, such as ``max_abs_eta``.

    Returns
    -------
    dict
        For the id of each run that has the series, its times (s) and values (unit of the quantity): arrays (steps,).
    """
    return results.curves(quantity, runs["id"])


def _shown(key: str, values: Iterable, count: int) -> list:
    """Return at most `count` values: the paper's, the least and the greatest; or evenly picked."""
    values = sorted(values)
    known = [v for v in values if v in (values[0], values[-1]) or np.isclose(v, PAPER.get(key, ())).any()]
    return evenly(known if len(values) > count and len(known) >= 3 else values, count)


def _choice(entries: pd.Series, preferred: Any) -> Any:
    """Return the value of a column that a figure takes: the preferred one, else the one most runs have."""
    values = entries.dropna().unique()
    if callable(preferred) and len(values):
        return preferred(values)
    if preferred not in (max, MOST_FREQUENT) and _same(entries, preferred).any():
        return preferred
    return entries.value_counts(sort=False, dropna=False).idxmax()


def _same(entries: pd.Series, value: Any) -> pd.Series:
    """Return which entries (bool) of a column equal a value: numbers to 1e-9, anything else as text."""
    if pd.isna(value):
        return entries.isna()
    if pd.api.types.is_numeric_dtype(entries) and not isinstance(value, str):
        return pd.Series(
            np.isclose(entries.astype(float), float(value), rtol=1e-9, equal_nan=True), entries.index
        )
    return entries.astype(str) == str(value)
