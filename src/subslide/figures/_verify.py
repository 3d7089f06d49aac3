"""Cases of verification, as figures draw them."""

import json
from typing import TYPE_CHECKING, Any

import pandas as pd

from subslide.figures import _style

if TYPE_CHECKING:
    from subslide.results import Results

NAMES = {
    "standing_wave": "standing wave",
    "dam_break": "dam break",
    "riemann": "coupled dam break",
    "paraboloid": "paraboloid",
}


def cases(results: "Results") -> dict[str, pd.DataFrame]:
    """Return the rows of the table of errors of each case with an exact profile, at its last time, on uniform grids.

    Parameters
    ----------
    results
        The study.

    Returns
    -------
    dict
        For each case by its name: a row for each run.

    Raises
    ------
    NoRunsError
        If there is no such case.
    """
    table, runs = results.errors, results.runs
    sized = runs["id"][runs["dx"].notna()]  # cells of a fitted grid have no one size
    table = table[table["id"].isin(sized)]
    table = table[table["quantity"].isin(["h2", "eta"]) & table["scene"].isin(list(NAMES))]
    if table.empty:
        raise _style.NoRunsError("a scene with an exact profile")
    rows_by_case = {}
    for (scene, model, options), rows in table.groupby(["scene", "model", "options"], sort=False):
        rows = rows[rows["time"] == rows["time"].max()]
        rows = rows[rows["quantity"] == rows["quantity"].iloc[0]]
        rows_by_case[words(scene, model, json.loads(options))] = rows
    return rows_by_case


def words(scene: str, model: str, options: dict[str, Any]) -> str:
    """Return the name of a case."""
    if scene == "standing_wave":
        shape = "on a line" if options["shape"] == "line" else "round"
        return f"{options['kind']} wave, {shape}"
    if scene == "dam_break":
        name = "Stoker" if options["downstream"] > 0 else "Ritter"
        return f"{name}, {'water' if options['layer'] == 'water' else covered(model)}"
    return f"{NAMES[scene]}, {covered(model)}"


def covered(model: str) -> str:
    """Return whether grains lie under water, in words."""
    return "grains alone" if model == "one-layer" else "under water"


def sizes_of_cells(results: "Results", rows: pd.DataFrame) -> pd.DataFrame:
    """Return the rows with `dx` (m) of each run."""
    return pd.merge(rows, results.runs[["id", "dx"]], on="id")
