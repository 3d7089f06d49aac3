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

EDGES = {
    "paper": "waves have been at the edge of the paper's box (zero gradient); what it sends back has a part in the "
    "runs that end there",
    "open": "waves have been at the edge of the box, which lets them leave but for a part in a hundred",
}
"""What is marked, in words, for each kind of edge that may have a part in the surface."""

OUTSIDE = "max_abs_eta_outside"


def wet(runs: pd.DataFrame) -> tuple[pd.DataFrame, list[str]]:
    """Return (runs with a known water surface, notes on those without: grains alone, or on a grid fitted to them)."""
    alone = runs["resolved_model"].astype(str) == "one-layer"
    fitted = (runs["resolved_grid"] == "fitted") & ~alone
    kinds = {
        "grains alone (one layer)": alone.sum(),
        "on a grid fitted to the grains": fitted.sum(),
    }
    notes = [
        f"Without a water surface: {count} of {len(runs)} runs, {why}."
        for why, count in kinds.items()
        if count
    ]
    return runs[~alone & ~fitted], notes


def buoyant(runs: pd.DataFrame) -> tuple[pd.DataFrame, list[str]]:
    """Return (runs with r > 0 if there are any, note): the paper shows no weightless water (r = 0)."""
    if (runs["r"] > 0).any() and (runs["r"] == 0).any():
        note = "r = 0 (water without weight) is left out as in the paper; the table of runs has it."
        return runs[runs["r"] > 0], [note]
    return runs, []


def reflected(where: str, runs: pd.DataFrame, until: float) -> list[str]:
    """Return the notes on what is marked, as waves are at the edge of the box of runs: one for each kind of edge.

    Parameters
    ----------
    where
        What is marked.
    runs
        Rows of the table of runs.
    until
        Last time (s) that the figure shows.
    """
    late = runs[runs["wave_free_until"] < until]
    return [f"{where}: {EDGES[edge]}." for edge in EDGES if (late["boundary"] == edge).any()]


def convergence(
    results: "Results",
    kinds: list[_kinds.Kind],
    times: Iterable[float],
    unit: _words.Unit,
    bars: bool = True,
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
    bars
        Whether the figure draws bands.
    """
    notes = _kinds.note(kinds, ("max_abs_eta", OUTSIDE), "values") if bars else []
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
