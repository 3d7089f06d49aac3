"""The table of `make bench-peers`: its rows, the file, and what is printed of it beside the targets."""

import csv
import statistics
from typing import NamedTuple

TIMES = (0.08, 0.16, 0.24)
"""s: the grains are still in the box of 0.6 m, so every code has the same cells."""

END = 0.54
"""s: the paper's last time. Grains have left the box by then; subslide's has grown instead, to 0.9 m."""

TARGETS = {1: 100.0, 2: 50.0}
"""By order of subslide: cell updates a second over GeoClaw's, on 200 x 200 cells."""

TARGET_CELLS = 200
COLUMNS = ("code", "model", "order", "cells", "time", "quantity", "value", "low", "high", "unit")


class Row(NamedTuple):
    """One number: the median of its repetitions, and the least and greatest. time (s): until when, or when."""

    code: str
    model: str
    order: int
    cells: int
    time: float
    quantity: str
    value: float
    low: float
    high: float
    unit: str


def once(about, time, quantity, value, unit):
    """Return the row of a number that every repetition repeats."""
    return Row(*about, time, quantity, value, value, value, unit)


def spread(about, time, quantity, values, unit):
    """Return the row of a number that varies from repetition to repetition."""
    return Row(*about, time, quantity, statistics.median(values), min(values), max(values), unit)


def write(path, rows):
    """Nothing; the CSV file holds the rows."""
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(COLUMNS)
        for row in rows:
            writer.writerow([f"{value:.6g}" if isinstance(value, float) else value for value in row])


DIFFERENCES = f"""What differs: no code has friction here (GeoClaw and PyClaw have no Coulomb law). GeoClaw is first
order: its second order stops on complex wave speeds unless its dry tolerance is deeper than the front. Its steep place
at x = R is an entropy glitch of its solver, and shrinks with the cells. PyClaw has the grains alone, one layer, first
order. Until {TIMES[-1]} s all have the same 0.6 m box; until {END} s subslide's has grown to 0.9 m (more cells, more
seconds), while Clawpack's lets grains out. Error: relative L1 difference along x to a radial run of 1600 cells."""


def text(rows, stopped):
    """Return the table to print, the targets, and what differs."""
    value = {row[:6]: row.value for row in rows}
    at = "/".join(f"{1000 * t:.0f}" for t in TIMES)
    head = ("code", "model", "order", "cells", "until s", "seconds", "steps", "M updates/s", "over GeoClaw")
    table = [(*head, f"1 % front, mm, at {at} ms", "error %")]
    for row in rows:
        if row.quantity == "seconds" and row.time in (TIMES[-1], END):

            def get(quantity, factor=1.0, digits=0, times=(row.time,), about=row[:4]):
                found = [value.get((*about, time, quantity)) for time in times]
                return "/".join("-" if v is None else f"{factor * v:.{digits}f}" for v in found)

            table.append(
                (
                    *(str(part) for part in row[:5]),
                    f"{row.value:.3g}",
                    get("steps"),
                    get("cell_updates_per_second", 1e-6, 3),
                    get("cell_updates_per_second_over_geoclaw", 1, 1),
                    get("x_front_1_percent", 1e3, 1, TIMES) if row.time <= TIMES[-1] else "",
                    get("profile_error", 100, 1, TIMES) if row.time <= TIMES[-1] else "",
                )
            )
    widths = [max(len(line[k]) for line in table) for k in range(len(table[0]))]
    body = ["  ".join(c.rjust(w) for c, w in zip(line, widths, strict=True)).rstrip() for line in table]
    ends = [f"{name}: stopped: {why}" for name, why in stopped.items()]
    return "\n".join([*body, "", *verdicts(value), *ends, "", DIFFERENCES])


def verdicts(value):
    """Return a line for each target that was measured, until each of the two times."""
    lines = []
    for order, target in TARGETS.items():
        for time in (TIMES[-1], END):
            key = (
                "subslide",
                "two layers",
                order,
                TARGET_CELLS,
                time,
                "cell_updates_per_second_over_geoclaw",
            )
            if key in value:
                met = "met" if value[key] >= target else "not met"
                lines.append(
                    f"order {order}, {TARGET_CELLS} x {TARGET_CELLS} cells, until {time} s: {value[key]:.1f} times"
                    f" GeoClaw's cell updates a second (target {target:.0f}: {met})"
                )
    return lines
