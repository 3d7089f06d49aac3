"""Sobol' indices of front and wave against time."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from subslide.sensitivity import indices as sobol
from subslide.tables import _answers, _saltelli, indices
from subslide.tables._saltelli import needs as needs

if TYPE_CHECKING:
    from subslide.results import Results

TITLE = "Sobol' indices against time"
READS = ("records", "runs", "indices")
FLOAT_FORMAT = "%.6g"
COLUMNS = {
    **_saltelli.COLUMNS,
    "output": ("", "answer, see above"),
    "time": ("", "time since release over R / sqrt(g H2)"),
    **indices.OF_INDEX,
    "variance": ("", "variance of the output at that time, failed runs with the mean of all others"),
}
WORDS = ("inputs", "others", "output", "kind", "input", "other")


def about() -> str:
    """Return what the documentation says of the table: its outputs."""
    outputs = "\n".join(f"- `{name}`: {text}" for name, text in _answers.IN_TIME.items())
    return f"""One row for each Saltelli design, output, time and index; see indices.csv for kinds and bands. Times at
which an output is the same in all runs have no indices.

Outputs:

{outputs}"""


def table(results: "Results") -> Iterator[dict]:
    """Give the rows, by column: a design after the other, all indices of an output and time together."""
    listed = _answers.in_time(results)
    well = _answers.ended_well(results)
    for design in _saltelli.designs(results):
        for answer in _saltelli.answers(design, listed):
            first = {**design.first, "output": answer.name}
            reached = ~np.isnan(answer.values[well[design.runs]]).any(axis=0)
            result = sobol.indices(answer.values, answer.half_widths, design.inputs)
            for at in np.flatnonzero(reached & np.isfinite(result.estimate[0])).tolist():
                variance = float(np.nanvar(answer.values[..., at]))
                for n in range(len(result.estimate)):
                    row = indices.of_index(design.names, result, n, at)
                    yield {**first, "time": float(_answers.TIMES[at]), **row, "variance": variance}
