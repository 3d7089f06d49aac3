"""Timings of runs, apart from the table of runs: nothing there differs between two identical runs."""

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

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
MEASURED = ("steps", "wall_seconds", "model", "box_half_width", "dx", "x")
"""Variables of records that the table follows from."""


def needs(study: Study) -> str:
    """Return '' for every study."""
    return ""


def table(results: "Results") -> Iterator[dict]:
    """Give the rows, by column, in the order of the runs."""
    for run, record in results.each(*MEASURED):
        steps, seconds, cells = int(record["steps"]), float(record["wall_seconds"]), cells_in_box(record)
        speed = cells * steps / seconds if seconds > 0 else math.nan
        yield dict(zip(COLUMNS, (run.id, steps, seconds, cells, speed), strict=True))


def cells_in_box(record: dict) -> int:
    """Return the number of cells of a run's box at its end."""
    if record["x"].ndim > 1:
        return record["x"].shape[1]
    across = round(float(record["box_half_width"] / record["dx"]))
    return {"quarter": across**2, "plane": 4 * across**2, "line": 2 * across}.get(record["model"], across)
