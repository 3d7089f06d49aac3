"""The cheapest choice of numerics for an error that is small enough, beside the paper's method at the same error."""

import math
from typing import TYPE_CHECKING

from subslide.study.config import Study
from subslide.tables import work_precision as runs_of
from subslide.tables._problems import METHOD

if TYPE_CHECKING:
    import pandas as pd

    from subslide.results import Results

TITLE = "Cheapest choices of numerics"
READS = ("work_precision",)
FLOAT_FORMAT = "%.8g"

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
WORDS = ("quantity", "numerics", "id", "paper_reaches")


def about() -> str:
    """Return what the documentation says of the table."""
    targets = ", ".join(f"{100 * target:g}" for target in TARGETS)
    return f"""One row for each column, quantity, error that is asked for ({targets} %) and choice, of the runs in
work_precision.csv: the cheapest run whose `sure_error` is no larger. No value is interpolated between runs."""


def needs(study: Study) -> str:
    """Return '' for a study with a sweep of numerics."""
    return runs_of.needs(study)


def table(results: "Results") -> list[dict]:
    """Return the rows, by column: one for each problem, quantity, target and kind of numerics."""
    return chosen(results.table("work_precision"))


def text(results: "Results") -> str:
    """Return the cheapest choices, and the paper's method beside the default numerics, as lines to read."""
    from subslide.tables import _choices

    return _choices.text(results.table("work_precision"), results.table("cheapest"))


def chosen(runs: "pd.DataFrame") -> list[dict]:
    """Return the rows, by column, of a table of errors and seconds."""
    rows = []
    for place, group in runs.groupby([*runs_of.PLACE, "quantity"], sort=False):
        about_column = dict(zip((*runs_of.PLACE, "quantity"), place, strict=True))
        every = group.to_dict("records")
        kinds = {"any": every, "default": [row for row in every if row["method"] == "default"]}
        paper = [row for row in every if row["method"] == "paper"]
        rows += [
            {**about_column, "target": target, "numerics": name, **choice(among, paper, target)}
            for target in TARGETS
            for name, among in kinds.items()
        ]
    return rows


def choice(rows: list[dict], paper: list[dict], target: float) -> dict:
    """Return the cheapest row that is accurate enough, and what the paper's method takes for it; empty without one."""
    best = runs_of.cheapest(rows, target)
    if best is None:
        return {}
    entries = {key: best[key] for key in ("id", *METHOD, "cells", "seconds", "sure_error")}
    equal = runs_of.cheapest(paper, target)
    known = [row for row in paper if math.isfinite(row["sure_error"])]
    beside = equal or max(known, key=lambda row: row["cells"], default=None)
    if beside:
        entries |= {f"paper_{key}": beside[key] for key in ("cells", "seconds")}
        entries |= {"paper_error": beside["sure_error"], "paper_reaches": equal is not None}
        entries["factor"] = beside["seconds"] / best["seconds"]
    return entries
