"""Runs that have a water surface, and when waves reach the edge of the box."""

import numpy as np
import pandas as pd

from subslide import points
from subslide.figures import _kinds, _slices, _words

OUTSIDE = "max_abs_eta_outside"


def wet(runs):
    """Return (runs with water, notes on those without: a model of the grains alone has no surface)."""
    dry = runs["resolved_model"].astype(str) == "one-layer"
    note = f"{dry.sum()} runs of the grains alone (one layer) have no water surface and are not shown."
    return runs[~dry], [note] if dry.any() else []


def buoyant(runs):
    """Return (runs with r > 0 if there are any, note): the paper shows no weightless water (r = 0)."""
    if (runs["r"] > 0).any() and (runs["r"] == 0).any():
        note = "r = 0 (water without weight) is left out as in the paper; the table of runs has it."
        return runs[runs["r"] > 0], [note]
    return runs, []


def edge_time(row):
    """Return when (s) the first wave of a run is at the edge of the paper's box."""
    return points.edge_time(row["a_H"], row["a_2"], row["radius"], row["g"])


def convergence(results, found, times, unit):
    """Return the notes on how far waves are from converged at some times (s), in numbers of these runs."""
    notes = _kinds.note(found, ("max_abs_eta", OUTSIDE), "values")
    ratios = {time: _kinds.ratios(found, lambda kind, t=time: _heights(results, kind, t)) for time in times}
    words = [f"{_kinds.percent(*r)} at {_words.moment(time, unit)}" for time, r in ratios.items() if r]
    if words:
        notes.append(
            "Beyond $R$ and for $r>0$, the height of waves with the paper's numerics is, of the resolved, "
            f"{' and '.join(words)}."
        )
    elif any(_slices.first_order(kind.runs) for kind in found):
        notes.append(
            "Not converged: at first order waves are too low, by an amount that needs a finer answer to tell."
        )
    return notes


def beside(results, chosen, times, unit):
    """Return the notes on the convergence of waves in a figure that draws one kind of numerics alone.

    chosen: the slice it draws. With the paper's numerics and a resolved answer in the study, they are compared.
    """
    keep = {"a_H": chosen.runs["a_H"].unique(), "r": chosen.runs["r"].unique()}
    found = _kinds.kinds(results, **keep) if "paper" in set(chosen.runs["numerics"]) else []
    if len(found) < 2:
        found = [_kinds.Kind("", chosen, results.bands[:0])]
    return [one for one in convergence(results, found, times, unit) if not one.startswith("Bars")]


def _heights(results, kind, time):
    """Return max|eta| (m) beyond R at a time (s) by (a_H, r), of runs with water and r > 0."""
    runs, _ = wet(kind.runs[kind.runs["r"] > 0])
    curves = _slices.curves(results, runs, OUTSIDE)
    heights = {
        (row["a_H"], row["r"]): np.interp(time, *curves[row["id"]], right=np.nan)
        for _, row in runs.iterrows()
        if row["id"] in curves
    }
    return pd.Series(heights, dtype=float)
