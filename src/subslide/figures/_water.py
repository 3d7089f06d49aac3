"""Runs that have a water surface, and when waves reach the edge of the box."""

from collections.abc import Iterable
from functools import partial
from typing import TYPE_CHECKING

import numpy as np
import pandas as pd

from subslide.figures import _kinds, _slices, _words

if TYPE_CHECKING:
    from subslide.results import Results

REFLECTED = "0.94"
"""Shade of what the edge of the box may have a part in."""

OUTSIDE = "max_abs_eta_outside"


def wet(runs: pd.DataFrame) -> tuple[pd.DataFrame, list[str]]:
    """Return (runs with water, notes on those without: a model of the grains alone has no surface)."""
    dry = runs["resolved_model"].astype(str) == "one-layer"
    note = f"{dry.sum()} runs of the grains alone (one layer) have no water surface and are not shown."
    return runs[~dry], [note] if dry.any() else []


def buoyant(runs: pd.DataFrame) -> tuple[pd.DataFrame, list[str]]:
    """Return (runs with r > 0 if there are any, note): the paper shows no weightless water (r = 0)."""
    if (runs["r"] > 0).any() and (runs["r"] == 0).any():
        note = "r = 0 (water without weight) is left out as in the paper; the table of runs has it."
        return runs[runs["r"] > 0], [note]
    return runs, []


def reflected(where: str, runs: pd.DataFrame) -> list[str]:
    """Return the note on what is marked, in words, as waves are at the open edge of the box of any of the runs."""
    text = "waves from the grains have been at the open edge of the box; what comes back from it has a part"
    return [f"{where}: {text}."] if np.isfinite(runs["wave_free_until"]).any() else []


def convergence(
    results: "Results", kinds: list[_kinds.Kind], times: Iterable[float], unit: _words.Unit
) -> list[str]:
    """Return the notes on how far waves are from converged, in numbers of these runs.

    Parameters
    ----------
    results
        The study.
    kinds
        Kinds of numerics that the figure draws.
    times
        Times (s) at which to compare them.
    unit
        Unit of times in the notes.
    """
    notes = _kinds.note(kinds, ("max_abs_eta", OUTSIDE), "values")
    ratios = {time: _kinds.ratios(kinds, partial(_heights, results, time=time)) for time in times}
    words = [f"{_kinds.percent(*r)} at {_words.moment(time, unit)}" for time, r in ratios.items() if r]
    if words:
        notes.append(
            "Beyond $R$ and for $r>0$, the height of waves with the paper's numerics is, of the resolved, "
            f"{' and '.join(words)}."
        )
    elif any(_slices.first_order(kind.runs) for kind in kinds):
        notes.append(
            "Not converged: at first order waves are too low, by an amount that needs a finer answer to tell."
        )
    return notes


def beside(results: "Results", chosen: _slices.Slice, times: Iterable[float], unit: _words.Unit) -> list[str]:
    """Return the notes on the convergence of waves in a figure that draws one kind of numerics alone.

    With the paper's numerics and a resolved answer in the study, they are compared.

    Parameters
    ----------
    results
        The study.
    chosen
        The slice that the figure draws.
    times
        Times (s) at which to compare.
    unit
        Unit of times in the notes.
    """
    keep = {"a_H": chosen.runs["a_H"].unique(), "r": chosen.runs["r"].unique()}
    kinds = _kinds.of(results, **keep) if "paper" in set(chosen.runs["numerics"]) else []
    if len(kinds) < 2:
        kinds = [_kinds.Kind("", chosen, results.bands[:0])]
    return [one for one in convergence(results, kinds, times, unit) if not one.startswith("Bars")]


def _heights(results: "Results", kind: _kinds.Kind, time: float) -> pd.Series:
    """Return max|eta| (m) beyond R at a time (s) by (a_H, r), of runs with water and r > 0."""
    runs, _ = wet(kind.runs[kind.runs["r"] > 0])
    curves = _slices.curves(results, runs, OUTSIDE)
    heights = {
        (row["a_H"], row["r"]): np.interp(time, *curves[row["id"]], right=np.nan)
        for _, row in runs.iterrows()
        if row["id"] in curves
    }
    return pd.Series(heights, dtype=float)
