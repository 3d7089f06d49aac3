"""Timings of runs, apart from the table of runs: nothing there differs between two identical runs."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from subslide.study.config import Study

if TYPE_CHECKING:
    from subslide.results import Results

TITLE = "Timings"
READS = ("records",)
ABOUT = "One row a run."
COLUMNS = {
    "id": ("", "name of the run"),
    "steps": ("", "number of time steps"),
    "wall_seconds": ("s", "wall time of the time loop alone"),
    "cells_in_box": ("", "cells of the box at the end"),
    "cell_updates_per_second": ("s-1", "cells times steps over wall time"),
}
WORDS = ("id",)
MEASURED = ("steps", "wall_seconds", "model", "box_half_width", "dx")
"""Variables of records that the table follows from."""


def needs(study: Study) -> str:
    """Return '' for every study."""
    return ""


def columns(results: "Results") -> dict[str, Any]:
    """Return the entries by column, in the order of the runs."""
    runs, values = results.runs_of_study, results.values(*MEASURED)
    cells = cells_in_box([run.point.cells for run in runs], values)
    seconds = values["wall_seconds"]
    with np.errstate(divide="ignore", invalid="ignore"):
        speed = np.where(seconds > 0, cells * values["steps"] / seconds, np.nan)
    entries = ([run.id for run in runs], values["steps"], seconds, cells, speed)
    return dict(zip(COLUMNS, entries, strict=True))


def cells_in_box(asked: Sequence[int], values: Mapping[str, np.ndarray]) -> np.ndarray:
    """Return the number of cells of the box of each run at its end.

    Parameters
    ----------
    asked
        `cells` of the runs, which on a fitted grid are all.
    values
        Their MEASURED values by name.
    """
    model = values["model"].astype(str)
    fitted = np.isnan(values["dx"])
    across = np.round(np.where(fitted, 0.0, values["box_half_width"] / values["dx"])).astype(np.int64)
    kinds = [fitted, model == "quarter", model == "plane", model == "line"]
    return np.select(kinds, [np.asarray(asked), across**2, 4 * across**2, 2 * across], across)
