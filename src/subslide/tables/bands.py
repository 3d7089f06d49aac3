"""Bands of a study: what is measured on each of a run's three grids, and the rows that compare them.

A run's companions have half and a quarter of its cells, and are otherwise the same; a run on a fitted grid has none.
"""

import math
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from subslide.keys.schema import ConfigError
from subslide.naming import FINISHED, FRONT_LABELS
from subslide.points import Point
from subslide.records import gauge
from subslide.study import choice
from subslide.study.config import COARSENING, Study
from subslide.tables import _calibration as calibration
from subslide.tables import _convergence as convergence
from subslide.tables import _fitted_bands as fitted
from subslide.tables._convergence import FORMAL_ORDER, Estimate

if TYPE_CHECKING:
    from subslide.results import Companion, Results, StudyRun

TITLE = "Bands of discretisation error"
READS = ("records",)
COLUMNS = {
    "id": ("", "name of the run"),
    "quantity": ("", "what is compared, see above"),
    "time": ("s", "elapsed time since release; empty for a quantity of the run as a whole"),
    "value": ("m", "value of the run itself; a time in s"),
    "value_2": ("m", "value of its companion with cells/2; empty on a fitted grid"),
    "value_4": ("m", "value of its companion with cells/4; empty on a fitted grid"),
    "order": ("", "observed order of convergence p; empty where it cannot be told"),
    "limit": ("m", "Richardson's estimate of the value on ever finer grids; empty unless converging"),
    "band": (
        "m",
        "half-width of the band of discretisation error about `value`, of a time in s; empty where none is known",
    ),
    "convergence": (
        "",
        f"`{convergence.CONVERGING}`, `{convergence.NOT_CONVERGED}` or `{convergence.NO_LIMIT}`: what three grids say;"
        f" `{convergence.ONE_GRID}` on a fitted grid",
    ),
    "calibrated": ("", "whether the run is like those at which bands were calibrated"),
}
WORDS = ("id", "quantity", "convergence")
WAVES = ("max_abs_eta", "max_abs_eta_outside")
PEAKS = tuple(f"{name}_peak" for name in (*WAVES, "eta_gauge"))
ARRESTS = tuple(f"time_of_arrest_{label}" for label in FRONT_LABELS)
"""Times, which have bands on fitted grids alone."""

ONCE = (
    *(f"L_f_{label}" for label in FRONT_LABELS),
    *PEAKS,
    *ARRESTS,
)
"""Quantities of a run as a whole; the others are taken at the times of its snapshots."""

LIMITLESS = tuple(f"{name}_peak" for name in WAVES)
"""Quantities without a limit: at the start the surface leaps beside the column, and waves meet on the axis."""

QUANTITIES = {
    **{f"L_f_{t}": f"final length of the deposit ({t[:-2]} % front)" for t in FRONT_LABELS},
    "max_abs_eta_peak": "largest displacement of the water surface over all time",
    "max_abs_eta_outside_peak": "the same beyond R",
    "eta_gauge_peak": gauge.MEANING,
    **{
        name: f"time of arrest (s) of the {label[:-2]} % front, on a fitted grid alone"
        for name, label in zip(ARRESTS, FRONT_LABELS, strict=True)
    },
    **{f"x_front_{t}": f"front at the times of the snapshots ({t[:-2]} % front)" for t in FRONT_LABELS},
    "max_abs_eta": "largest displacement of the water surface at the times of the snapshots",
    "max_abs_eta_outside": "the same beyond R",
}
SUMMARY = ("limit", "band", "convergence")
SUMMARIES = {name: ("band",) if name in ARRESTS else SUMMARY for name in ONCE}
"""Columns that the table of runs repeats, by quantity of a run as a whole."""

MEASURED = ("time", "x_front", "L_f", "time_of_arrest", *WAVES, *PEAKS, "snapshot_time", "status")
"""Variables of records that are compared."""


def about() -> str:
    """Return what the documentation says of the table: how its estimates are made, and its quantities."""
    quantities = "\n".join(f"- `{name}`: {text}" for name, text in QUANTITIES.items())
    low = convergence.LOWEST_ORDER
    return f"""One row for each run, quantity and time, in studies with `bands: true` only. Each run has two companions,
equal but for their coarser grids, which have no rows elsewhere. From the values f1 (the run), f2 (cells/2) and f3
(cells/4) follow the observed order p = log2((f3 - f2)/(f2 - f1)) and the limit f1 + (f1 - f2)/(2^p - 1) of Richardson's
extrapolation.

The band is read off at columns whose answer a much finer grid gave ([bands.md](bands.md) has the method, and how many
of other columns' answers it held): a number of cells for a front, which errs by about as many whatever the grid, and
for a wave the largest of three parts, of |f1 - f2|, of |f2 - f3| and of the value. A run unlike those columns (another
scene, solver or friction law, or beyond their range) is not `calibrated`: there the band is no less than Richardson's,
1.25 |f1 - f2|/(2^p - 1), the grid convergence index times the value (Roache 1994; Celik et al. 2008). Bands estimate
the error of discretisation alone, and say nothing of the model's own error, its parameters, or the threshold that
defines a front.

`{convergence.NOT_CONVERGED}`: the differences of three grids change sign, grow, or shrink with an order below {low}, so
that there is no limit to state, or one of the three runs failed, and there is no band either. Where f1 and f2 agree to
round-off the limit is f1 and no order is given. `{convergence.NO_LIMIT}`: finer grids give ever larger values, so that
no number stands for the answer. Times are those of the run's `snapshot_times` after the start.

A run on a fitted grid has no companions (`{convergence.ONE_GRID}`), no limit and no order: its band is a share of the
value, read off at columns too, which depends on cells, a_H and r; it is at least {fitted.OUTSIDE:g} times as wide
where the run is not `calibrated`.

Quantities:

{quantities}"""


def needs(study: Study) -> str:
    """Return '' for a study with bands."""
    return "" if study.bands else "bands: true"


def table(results: "Results") -> list[dict]:
    """Return the rows, by column, in the order of the runs; ConfigError if the study has no bands."""
    if not results.has_bands:
        raise ConfigError(f"{results.folder} has no bands; allowed: a study with bands: true")
    companions = {(one.of, one.role): one for one in results.companions}
    known: dict[str, StudyRun | Companion] = {
        **{run.id: run for run in results.runs_of_study},
        **{one.id: one for one in results.companions},
    }
    by_batch = sorted(known.values(), key=lambda one: one.batch)
    measured = {one.id: measure(one.point, record) for one, record in results.each(*MEASURED, among=by_batch)}
    compared: list[dict] = []
    for run in results.runs_of_study:
        roles = () if choice.is_fitted(run.point) else COARSENING
        names = (run.id, *(companions[run.id, role].id for role in roles))
        compared += rows(run.point, *(measured[name] for name in names))
    return compared


def summaries(results: "Results") -> dict[str, dict[str, str]]:
    """Return the columns, as text, that the table of runs has for bands, by id of the run; none without bands."""
    columns: dict[str, dict[str, str]] = {}
    for row in results.lines("bands") if results.has_bands else ():
        if row["quantity"] in ONCE:
            parts = {f"{row['quantity']}_{part}": row[part] for part in SUMMARIES[row["quantity"]]}
            columns.setdefault(row["id"], {}).update(parts)
    return columns


class Measured(NamedTuple):
    """Whether a run ended well, and its values (m, s) by quantity and time (s; None for the run as a whole)."""

    finished: bool
    values: dict[tuple[str, float | None], float]

    def length(self, quantity: str) -> float:
        """Return the last place (m) of the front that a quantity belongs to, by the threshold that ends its name."""
        return self.values[f"L_f_{quantity.rpartition('_')[2]}", None]


def measure(point: Point, record: dict) -> Measured:
    """Return the values of a run that bands compare.

    Snapshots that were asked for count, after the start; the end of a run, whose time depends on the grid, does not.
    Series have a sample at every snapshot's time, so interpolation only bridges the round-off of that time.

    Parameters
    ----------
    point
        The run's.
    record
        Variables MEASURED of it, by name.
    """
    series = {f"x_front_{label}": record["x_front"][n] for label, n in FRONT_LABELS.items()}
    series.update((name, record[name]) for name in WAVES)
    values: dict[tuple[str, float | None], float] = {
        (f"L_f_{label}", None): float(record["L_f"][n]) for label, n in FRONT_LABELS.items()
    }
    values.update(((name, None), float(record[name])) for name in PEAKS)
    values.update(((name, None), float(record["time_of_arrest"][n])) for n, name in enumerate(ARRESTS))
    instants = [time for time in record["snapshot_time"].tolist() if time > 0 and time in point.profile_times]
    for name, entries in series.items():
        for instant in instants:
            values[name, instant] = float(np.interp(instant, record["time"], entries))
    values = {key: value if math.isfinite(value) else math.nan for key, value in values.items()}
    return Measured(record["status"] in FINISHED, values)


def rows(point: Point, *grids: Measured) -> Iterator[dict]:
    """Give the rows of a run, by column.

    A quantity that a finished run does not have (water of a single layer) has no row. If one of the three did not end
    well nothing is said of convergence: a failure is no answer of a grid.

    Parameters
    ----------
    point
        The run's.
    grids
        What was measured of it and, but on a fitted grid, of its companions with cells/2 and cells/4.
    """
    fine = grids[0]
    one_grid = choice.is_fitted(point)
    alike = (fitted if one_grid else calibration).is_calibrated(point)
    for (quantity, time), value in fine.values.items():
        if (fine.finished and math.isnan(value)) or (quantity in ARRESTS and not one_grid):
            continue
        compared = [grid.values.get((quantity, time), math.nan) for grid in grids]
        estimate = convergence.LIMITLESS if quantity in LIMITLESS else convergence.UNKNOWN
        if all(grid.finished for grid in grids) and quantity not in LIMITLESS:
            estimate = (_of_one if one_grid else _of_three)(point, quantity, compared, fine)
        values = (*compared, math.nan, math.nan)[: 1 + len(COARSENING)]
        yield dict(zip(COLUMNS, (point.id, quantity, time, *values, *estimate, alike), strict=True))


def _of_one(point: Point, quantity: str, values: Sequence[float], fine: Measured) -> Estimate:
    """Return what a fitted grid says of a quantity."""
    band = fitted.half_width(point, quantity, values[0], fine.length(quantity))
    return Estimate(math.nan, math.nan, band, convergence.ONE_GRID)


def _of_three(point: Point, quantity: str, values: Sequence[float], fine: Measured) -> Estimate:
    """Return what three grids say of a quantity."""
    f1, f2, f3 = values
    scale = point.level if "eta" in quantity else 0.0
    estimate = convergence.estimate(f1, f2, f3, FORMAL_ORDER, scale=scale, dtype=point.dtype)
    band = _band(point, quantity, (f1, f2, f3), fine)
    return estimate._replace(band=band if calibration.is_calibrated(point) else max(band, estimate.band))


def _band(point: Point, quantity: str, values: tuple[float, float, float], fine: Measured) -> float:
    """Return the calibrated band (m) of a quantity from its values on three grids, NaN where any has none."""
    if not all(map(math.isfinite, values)):
        return math.nan
    if "eta" in quantity:
        return calibration.wave(point, *values)
    label = quantity.rpartition("_")[2]
    return calibration.front(point, label, values[0], fine.length(quantity))
