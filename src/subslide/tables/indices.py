"""Sobol' indices of a study: how much of each answer's variance each input, and each pair of them, explains."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from subslide.sensitivity import indices as sobol
from subslide.tables import _answers, _emulated, _saltelli
from subslide.tables._saltelli import needs as needs

if TYPE_CHECKING:
    from subslide.results import Results

TITLE = "Sobol' indices"
READS = ("records", "runs")
FLOAT_FORMAT = "%.6g"
CONVERGED = 0.05
"""Half-width of a band up to which an index counts as converged."""

KINDS = {
    "first": "share of the variance that the input explains alone",
    "total": "share that would be left if all others were known: alone, and together with any others",
    "second": "share that two inputs explain together, beyond what each does alone",
    "closed": "share that two inputs explain, alone and together: the index of both as one",
}
OF_INDEX = {
    "kind": ("", "kind of the index, see above"),
    "input": ("", "input"),
    "other": ("", "second input of a pair"),
    "estimate": ("", "the index; negative estimates of small ones are kept"),
    "low": ("", "lower end of the 95 % band: of sampling, grid error and failed runs"),
    "high": ("", "upper end"),
    "sampling": ("", "half-width for sampling alone"),
    "grid": ("", "half-width for grid error alone; empty in a study without bands"),
    "least": ("", "least index, whatever the failed runs would have answered; the estimate if none failed"),
    "most": ("", "largest index, likewise"),
}
COLUMNS = {
    **_saltelli.COLUMNS,
    "output": ("", "answer, see above"),
    **OF_INDEX,
    "emulated": (
        "",
        "the index by the emulator of the converged answer, from 16 x 512 points; empty where it knows none",
    ),
    "converged": ("", f"`yes` if low and high are at most {2 * CONVERGED:g} apart, else `no`"),
    "scramblings": ("", "independent scramblings of the design"),
    "points": ("", "points of each, N"),
    "runs": ("", "runs, scramblings (2 + 2 inputs) N"),
    "failed": ("", "ids of the runs that have no such answer"),
}
WORDS = ("inputs", "others", "output", "kind", "input", "other", "converged", "failed")


def about() -> str:
    """Return what the documentation says of the table: its kinds and outputs, and how bands are made."""
    kinds = "\n".join(f"- `{name}`: {text}" for name, text in KINDS.items())
    outputs = "\n".join(f"- `{name}`: {text}" for name, text in _answers.ONCE.items())
    return f"""One row for each Saltelli design, output and index, in studies with such a design
([sensitivity.md](sensitivity.md) has the method). Bands hold the error of sampling (from independent scramblings), that
of the grid (from the bands of the runs, in studies with `bands: true`) and what failed runs might have answered, none
of which is dropped.

Kinds of indices:

{kinds}

Outputs:

{outputs}"""


def table(results: "Results") -> Iterator[dict]:
    """Give the rows, by column: a design after the other, all indices of an output together."""
    listed = _answers.once(results)
    every = [run.point for run in results.runs_of_study]
    for design in _saltelli.designs(results):
        emulated = _emulated.estimates(design, every, [answer.name for answer in listed])
        for answer in _saltelli.answers(design, listed):
            result = sobol.indices(answer.values, answer.half_widths, design.inputs)
            scramblings, blocks, points = design.runs.shape
            size = {"scramblings": scramblings, "points": points, "runs": scramblings * blocks * points}
            failed = " ".join(dict.fromkeys(design.ids[np.isnan(answer.values)]))
            for n in range(len(result.estimate)):
                row = of_index(design.names, result, n)
                converged = "yes" if row["high"] - row["low"] <= 2 * CONVERGED else "no"
                first = {**design.first, "output": answer.name}
                if answer.name in emulated:
                    row["emulated"] = float(emulated[answer.name][n])
                yield {**first, **row, "converged": converged, **size, "failed": failed}


def of_index(names: list[str], result: sobol.Indices, n: int, *place: int) -> dict:
    """Return the columns of an index.

    Parameters
    ----------
    names
        Names of the inputs.
    result
        All indices of an output.
    n
        Which one.
    place
        Place along a series.
    """
    label = sobol.labels(len(names))[n]
    values = {
        column: float(getattr(result, column)[(n, *place)])
        for column in ("estimate", "low", "high", "sampling", "grid", "least", "most")
    }
    return {
        "kind": label.kind,
        "input": names[label.places[0]],
        "other": names[label.places[1]] if len(label.places) > 1 else None,
        **values,
    }


def text(results: "Results") -> str:
    """Return first-order and total indices with their bands, a line for each input."""
    lines = []
    for (design, inputs, output), rows in results.table("indices").groupby(
        ["design", "inputs", "output"], sort=False
    ):
        lines += ["", f"design {design} ({inputs}), {output}"]
        for kind in ("first", "total"):
            some = rows[rows["kind"] == kind]
            for _, row in some.iterrows():
                band = f"[{row['low']:6.3f}, {row['high']:6.3f}]" if np.isfinite(row["low"]) else "no band"
                lines.append(f"  {kind:6} {row['input']:6} {row['estimate']:7.3f}  {band}")
    return "\n".join(lines[1:])
