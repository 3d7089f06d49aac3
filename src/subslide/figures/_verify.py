"""Cases of verification, as figures draw them."""

import json

import pandas as pd

from subslide.figures import _style

NAMES = {"standing_wave": "standing wave", "dam_break": "dam break", "paraboloid": "paraboloid"}


def cases(results):
    """Return {words: rows of the table of errors} of each case with an exact profile, at its last time."""
    table = results.errors
    table = table[table["quantity"].isin(["h2", "eta"]) & table["scene"].isin(list(NAMES))]
    if table.empty:
        raise _style.NoRunsError("a scene with an exact profile")
    found = {}
    for (scene, model, options), rows in table.groupby(["scene", "model", "options"], sort=False):
        rows = rows[rows["time"] == rows["time"].max()]
        rows = rows[rows["quantity"] == rows["quantity"].iloc[0]]
        found[words(scene, model, json.loads(options))] = rows
    return found


def words(scene, model, options):
    """Return the name of a case."""
    if scene == "standing_wave":
        shape = "on a line" if options["shape"] == "line" else "round"
        return f"{options['kind']} wave, {shape}"
    if scene == "dam_break":
        name = "Stoker" if options["downstream"] > 0 else "Ritter"
        return f"{name}, {'water' if options['layer'] == 'water' else covered(model)}"
    return f"{NAMES[scene]}, {covered(model)}"


def covered(model):
    """Return whether grains lie under water, in words."""
    return "grains alone" if model == "one-layer" else "under water"


def sizes_of_cells(results, rows):
    """Return the rows with `dx` (m) of each run."""
    return pd.merge(rows, results.runs[["id", "dx"]], on="id")
