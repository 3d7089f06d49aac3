"""Bands of a study: what is measured on each of a run's three grids, and the rows that compare them.

A run's companions have half and a quarter of its cells, and are otherwise the same.
"""

import math
from collections.abc import Iterable, Iterator
from typing import NamedTuple

import numpy as np

from subslide import naming
from subslide.points import Point
from subslide.tables import _convergence as convergence

THRESHOLDS = {f"{100 * fraction:g}pc": n for n, fraction in enumerate(naming.FRONT_THRESHOLDS)}
WAVES = ("max_abs_eta", "max_abs_eta_outside")
ONCE = (*(f"L_f_{t}" for t in THRESHOLDS), *(f"{name}_peak" for name in WAVES))
"""Quantities of a run as a whole; the others are taken at the times of its snapshots."""

SUMMARY = ("limit", "band", "convergence")
"""Columns that the table of runs repeats for each quantity of a run as a whole."""

COLUMNS = {
    "id": ("", "name of the run"),
    "quantity": ("", "what is compared, see below"),
    "time": ("s", "elapsed time since release; empty for a quantity of the run as a whole"),
    "value": ("m", "value of the run itself"),
    "value_2": ("m", "value of its companion with cells/2"),
    "value_4": ("m", "value of its companion with cells/4"),
    "order": ("", "observed order of convergence p; empty where it cannot be told"),
    "limit": ("m", "Richardson's estimate of the value on ever finer grids; empty unless converging"),
    "band": ("m", "half-width of the band of discretisation error about `value`; wide where not converged"),
    "convergence": ("", f"`{convergence.CONVERGING}` or `{convergence.NOT_CONVERGED}`"),
}
QUANTITIES = {
    **{f"L_f_{t}": f"final length of the deposit ({t[:-2]} % front)" for t in THRESHOLDS},
    "max_abs_eta_peak": "largest displacement of the water surface over all time",
    "max_abs_eta_outside_peak": "the same beyond R",
    **{f"x_front_{t}": f"front at the times of the snapshots ({t[:-2]} % front)" for t in THRESHOLDS},
    "max_abs_eta": "largest displacement of the water surface at the times of the snapshots",
    "max_abs_eta_outside": "the same beyond R",
}


FORMAL_ORDER = 1.0
"""Best order of these quantities in either scheme: the column is let go with a jump, and no scheme is better than first
order at what comes of one. Measured at second order (a_H 1 and 10; r 0, 0.4 and 0.8; 234 values on 200 to 1600 cells):
the band holds the limit from 6400 cells in 94 %; Roache's index with an order up to that of the scheme did in 46 %."""


class Measured(NamedTuple):
    """Whether a run ended well, and its values (m) by quantity and time (s; None for the run as a whole)."""

    finished: bool
    values: dict[tuple[str, float | None], float]


def measure(run) -> Measured:
    """Values of a run's record (`results.trimmed`) that bands compare.

    Snapshots after the start count, but not the one that a run takes at its end, whose time depends on the grid.
    Series have a sample at every snapshot's time, so interpolation only bridges the round-off of that time.
    """
    time = run["time"].values
    series = {f"x_front_{label}": run["x_front"].values[n] for label, n in THRESHOLDS.items()}
    series.update((name, run[name].values) for name in WAVES)
    values = {(f"L_f_{label}", None): float(run["L_f"].values[n]) for label, n in THRESHOLDS.items()}
    for name in WAVES:
        values[f"{name}_peak", None] = float(np.nanmax(series[name], initial=-math.inf))
    snapshots = run["snapshot_time"].values
    snapshots = snapshots[np.isfinite(snapshots)][:-1]
    for name, entries in series.items():
        for instant in snapshots[snapshots > 0]:
            values[name, float(instant)] = float(np.interp(instant, time, entries))
    values = {key: value if math.isfinite(value) else math.nan for key, value in values.items()}
    return Measured(str(run["status"].values) in ("ok", "not_at_rest"), values)


def rows(point: Point, *grids: Measured) -> Iterator[dict]:
    """Rows of a run by column. grids: what was measured of it, and of its companions with cells/2 and cells/4.

    A quantity that a finished run does not have (water of a single layer) has no row. If one of the three did not end
    well nothing is said of convergence: a failure is no answer of a grid.
    """
    fine = grids[0]
    depth = (1 + point.a_H) * point.a_2 * point.radius
    for (quantity, time), value in fine.values.items():
        if fine.finished and math.isnan(value):
            continue
        values = [grid.values.get((quantity, time), math.nan) for grid in grids]
        found = convergence.UNKNOWN
        if all(grid.finished for grid in grids):
            scale = depth if quantity.startswith(WAVES) else 0.0
            found = convergence.estimate(*values, FORMAL_ORDER, scale=scale, dtype=point.dtype)
        entries = (point.id, quantity, time, *values, *found)
        yield dict(zip(COLUMNS, entries, strict=True))


def summaries(found: Iterable[dict]) -> dict[str, dict]:
    """Columns that the table of runs has for bands, by id of the run. found: rows of the table of bands."""
    columns = {}
    for row in found:
        if row["quantity"] in ONCE:
            parts = {f"{row['quantity']}_{part}": row[part] for part in SUMMARY}
            columns.setdefault(row["id"], {}).update(parts)
    return columns
