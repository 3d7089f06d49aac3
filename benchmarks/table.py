"""The table of results: one row a number, tidy, and the few that the project has set itself as targets."""

import csv
from pathlib import Path
from typing import NamedTuple

from timing import Spread


class Row(NamedTuple):
    """One number and what it was measured on; empty where it does not apply."""

    benchmark: str
    quantity: str
    value: float
    unit: str = "1"
    model: str = ""
    order: int | str = ""
    scheme: str = ""
    dtype: str = ""
    cells: int | str = ""
    threads: int | str = 1


COLUMNS = ("benchmark", "model", "order", "scheme", "dtype", "cells", "threads", "quantity", "value", "unit")


def rows_of(benchmark, quantity, value, unit="1", **about):
    """Return the rows of one number: a `Spread` gives its median, and its extremes as `_low` and `_high`."""
    if not isinstance(value, Spread):
        return [Row(benchmark, quantity, float(value), unit, **about)]
    return [
        Row(benchmark, quantity + ending, float(number), unit, **about)
        for ending, number in zip(("", "_low", "_high"), value, strict=True)
    ]


def write(path, rows):
    """Nothing; the CSV file holds the rows."""
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(COLUMNS)
        for row in rows:
            values = row._asdict() | {"value": f"{row.value:.6g}"}
            writer.writerow([values[column] for column in COLUMNS])


class Criterion(NamedTuple):
    """A target: which row it is about, the number to reach (or to stay below), and whether more or less is better."""

    text: str
    quantity: str
    about: dict
    target: float
    at_least: bool = True


def about(**values):
    """Return what a row must be about, the paper's scheme unless said otherwise."""
    return {"scheme": "ifcph"} | values


CRITERIA = (
    Criterion(
        "plane, first order, float64, 400 x 400: edges/s of the time loop over C",
        "over_c",
        about(model="plane", order=1, dtype="float64", cells=400),
        0.6,
    ),
    Criterion(
        "plane, second order, float64, 400 x 400: edges/s of the time loop over C",
        "over_c",
        about(model="plane", order=2, dtype="float64", cells=400),
        0.3,
    ),
    Criterion(
        "plane, first order, 400 x 400: float32 over float64",
        "over_float64",
        about(model="plane", order=1, dtype="float32", cells=400),
        1.5,
    ),
    Criterion(
        "plane, second order, 400 x 400: float32 over float64",
        "over_float64",
        about(model="plane", order=2, dtype="float32", cells=400),
        1.5,
    ),
    Criterion(
        "radial, second order, float64, cells 200: edges/s of the time loop over C",
        "over_c",
        about(model="radial", order=2, dtype="float64", cells=200),
        0.45,
    ),
    Criterion(
        "plane, second order, 1600 x 1600: 2 threads over 1",
        "speed_up",
        about(model="plane", order=2, dtype="float64", cells=1600, threads=2),
        1.7,
    ),
    Criterion(
        "`subslide run` of a radial point, warm, new process (s)",
        "start_up_run",
        {"model": "radial"},
        1.0,
        at_least=False,
    ),
)


def verdicts(rows):
    """Return [(criterion, `Spread` or None where it was not measured)]."""
    found = []
    for criterion in CRITERIA:
        values = {
            row.quantity: row.value
            for row in rows
            if row.quantity.startswith(criterion.quantity)
            and all(getattr(row, key) == value for key, value in criterion.about.items())
        }
        names = [criterion.quantity + ending for ending in ("", "_low", "_high")]
        found.append((criterion, Spread(*(values[name] for name in names)) if names[0] in values else None))
    return found


def criteria_text(rows):
    """Return the table of targets as lines of text: criterion, measured (lowest to highest), target."""
    lines = [("criterion", "measured", "target", "")]
    for criterion, value in verdicts(rows):
        sign = ">=" if criterion.at_least else "<"
        measured, verdict = "not measured", ""
        if value is not None:
            measured = f"{value.median:.3g} ({value.low:.3g} to {value.high:.3g})"
            reached = (value.median >= criterion.target) == criterion.at_least
            verdict = "reached" if reached else "MISSED"
        lines.append((criterion.text, measured, f"{sign} {criterion.target:g}", verdict))
    widths = [max(len(line[column]) for line in lines) for column in range(4)]
    return "\n".join(
        "  ".join(cell.ljust(width) for cell, width in zip(line, widths, strict=True)).rstrip()
        for line in lines
    )


def folder(path):
    """Return the folder, made if need be."""
    path = Path(path)
    path.mkdir(parents=True, exist_ok=True)
    return path
