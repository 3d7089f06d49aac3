"""The cheapest choice of numerics for an error that is small enough, beside the paper's method at the same error."""

import math

import pandas as pd

from subslide.tables import work_precision as runs_of
from subslide.tables._problems import METHOD

TARGETS = (0.05, 0.02, 0.01, 0.005)
"""Errors that a user may ask for."""
COLUMNS = {
    **{key: runs_of.COLUMNS[key] for key in (*runs_of.PLACE, "quantity")},
    "target": ("", "error that is asked for; `sure_error` is no larger"),
    "numerics": (
        "",
        "`any`: the cheapest run of all; `default`: the cheapest by the default numerics on a radius",
    ),
    "id": ("", "name of that run; empty if none is accurate enough, or the truth is too uncertain to tell"),
    **{key: runs_of.COLUMNS[key] for key in (*METHOD, "cells", "seconds", "sure_error")},
    "paper_cells": (
        "",
        "cells of the cheapest run of the paper's method in the plane that is accurate enough, or of"
        " its finest run if none is",
    ),
    "paper_seconds": ("s", "wall time of that run's time loop"),
    "paper_error": ("", "`sure_error` of that run"),
    "paper_reaches": ("", "whether that run is accurate enough; if not, `factor` is a lower bound"),
    "factor": ("", "`paper_seconds` over `seconds`"),
}


def table(runs: pd.DataFrame) -> pd.DataFrame:
    """Table by COLUMNS: a row for each problem, quantity, target and kind of numerics."""
    found = []
    for place, group in runs.groupby([*runs_of.PLACE, "quantity"], sort=False):
        rows = group.to_dict("records")
        kinds = {"any": rows, "default": [row for row in rows if row["method"] == "default"]}
        paper = [row for row in rows if row["method"] == "paper"]
        for target in TARGETS:
            for name, among in kinds.items():
                about = dict(zip((*runs_of.PLACE, "quantity"), place, strict=True))
                found.append({**about, "target": target, "numerics": name, **choice(among, paper, target)})
    return pd.DataFrame(found, columns=list(COLUMNS))


def choice(rows: list[dict], paper: list[dict], target: float) -> dict:
    """Cheapest of the rows that is accurate enough, and what the paper's method takes for that; empty without one."""
    best = runs_of.cheapest(rows, target)
    if best is None:
        return {}
    found = {key: best[key] for key in ("id", *METHOD, "cells", "seconds", "sure_error")}
    equal = runs_of.cheapest(paper, target)
    known = [row for row in paper if math.isfinite(row["sure_error"])]
    beside = equal or max(known, key=lambda row: row["cells"], default=None)
    if beside:
        found |= {f"paper_{key}": beside[key] for key in ("cells", "seconds")}
        found |= {"paper_error": beside["sure_error"], "paper_reaches": equal is not None}
        found["factor"] = beside["seconds"] / best["seconds"]
    return found
