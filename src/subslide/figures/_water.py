"""Runs that have a water surface, and when waves reach the edge of the box."""

import numpy as np

BOX = 0.3 / 0.0705
"""Half-width of the paper's box over R: where displacements of the surface are watched."""
NOT_CONVERGED = (
    "Not converged: at first order with cells of 3 mm the paper's columns raise waves about two to three times too low "
    "beyond $R$ at 80 and 160 ms; where they meet on the axis the peak is lower still and grows with resolution."
)


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
    """Return when (s) the first wave, from R at sqrt(g (H1 + H2)), is at the edge of the box."""
    depth = row["a_2"] * row["radius"] * (1 + row["a_H"])
    return (BOX - 1) * row["radius"] / np.sqrt(row["g"] * depth)
