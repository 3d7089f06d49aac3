"""The stability atlas: how each run ended, how far it is from the converged answer, and how near the edge it stood.

The edge is loss of hyperbolicity, growth of energy, and drift of volumes.

The converged answer of a run is its reference: the run of the same study that is the same column with the default
numerics on the finest grid, at least `FINER` times as fine as the run. It speaks only if it ended and, for each
quantity, if the next coarser run of the same numerics agrees with it: within `AGREES_L_F` in L_f and within
`AGREES_ETA` in the peak of max|eta| beyond R, relative.
"""

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from subslide import exact
from subslide.keys import names, schema, words
from subslide.naming import FINISHED
from subslide.points import RUN_KEYS, Point, options_text
from subslide.study.config import Study
from subslide.tables import _by_method
from subslide.tables._prose import with_constants

if TYPE_CHECKING:
    import pandas as pd

    from subslide.results import Results

TITLE = "Stability atlas"
READS = ("records", "runs")
FLOAT_FORMAT = "%.10g"
FINER = 2
AGREES_L_F, AGREES_ETA = 0.05, 0.25
AGREEMENT = {"L_f": AGREES_L_F, "max_abs_eta": AGREES_ETA}
"""Largest difference of the two finest runs of a reference, over its value, at which it counts as converged."""
NUMERICS = schema.with_role("method")
"""Keys that say how a column is solved; runs that differ in no other key have one answer."""
ASIDE = schema.with_role("output")
"""Keys that change neither the answer nor how it is found."""
NO_REFERENCE, REFERENCE = "no reference", "is the reference"
COLUMNS = {
    "id": ("", "name of the run"),
    **{
        key: (words.unit(key), schema.properties()[key]["description"])
        for key in RUN_KEYS
        if key not in ASIDE
    },
    "status": ("", "how the run ended; see runs.csv"),
    "status_detail": ("", "what ended the run, in words"),
    "steps": ("", "number of time steps"),
    "L_f_error": ("", "L_f (1 % front) against the reference's, relative"),
    "max_abs_eta_error": ("", "peak of max|eta| beyond R against the reference's, relative"),
    "reference": ("", "id of the reference; empty if the study has none"),
    "reference_L_f_change": ("", "how far the next coarser run of the reference is from it in L_f, relative"),
    "reference_max_abs_eta_change": ("", "the same in the peak of max|eta| beyond R"),
    "nonhyperbolic_length": (
        "",
        "largest extent, at one time, of cells whose wave speeds are complex: cells times dx over R; in the plane the"
        " root of their area, over R",
    ),
    "nonhyperbolic_time": ("", "share of the time steps with such a cell"),
    "hyperbolic_margin": ("", "`hyperbolic_margin_min` of runs.csv; empty for one layer"),
    "energy_rise": (
        "",
        "largest rise of the energy after any moment, over what the start can release: its energy less that of flat"
        " layers at rest",
    ),
    "growth_rate": ("s-1", "rate at which the wave of the scene shear grows, from its snapshots"),
    "growth_rate_theory": ("s-1", "the same by linear theory"),
    "volume_drift": (
        "",
        "largest relative change of the volume of grains or water while nothing can have left the box",
    ),
    "reason": ("", "why entries are empty, or why the run is not judged"),
}
WORDS = ("id", "status", "status_detail", "reference", "reason")
NO_GROWTH = {"growth_rate": math.nan, "growth_rate_theory": math.nan, "why_growth": ""}
MEASURED = (
    *("energy_rise", "nonhyperbolic_cells_max", "nonhyperbolic_time"),
    *("dx", "model", "wave_free_until"),
)
"""Variables of records that the table follows from."""
PROFILES = ("x", "h2", "snapshot_time")
"""Variables of records that rates of growth follow from."""
QUANTITIES = {"L_f": "L_f_1pc", "max_abs_eta": "max_abs_eta_outside_peak"}
"""Columns of the table of runs that are compared with the reference."""


def about() -> str:
    """Return what the documentation says of the table: what a reference is."""
    return f"In studies with figures of stability.\n\n{with_constants(__doc__, globals())}"


def needs(study: Study) -> str:
    """Return '' for a study with figures of stability."""
    return "" if any(name.startswith("stability_") for name in study.figures) else "figures of stability"


def table(results: "Results") -> list[dict]:
    """Return the rows, by column, in the order of the table of runs."""
    runs = results.runs.set_index("id")
    families: dict[tuple, list[tuple[str, Point]]] = {}
    for run in results.runs_of_study:
        families.setdefault(_column(run.point), []).append((run.id, run.point))
    grown = _growths(results)
    rows = []
    for run, record in results.each(*MEASURED):
        point, outcome = run.point, runs.loc[run.id]
        references = references_of(point, families[_column(point)])
        measured = {
            **budget(point, record, outcome),
            **grown.get(run.id, NO_GROWTH),
            **errors(point, run.id, runs, references),
        }
        reasons = [measured.pop(f"why_{part}") for part in ("budget", "growth", "error")]
        asked = {key: getattr(point, key) for key in RUN_KEYS if key not in ASIDE}
        asked |= {
            "scene_options": options_text(point),
            "t_end": "rest" if point.t_end is None else point.t_end,
        }
        ended = {key: outcome[key] for key in ("status", "status_detail", "steps")}
        reason = "; ".join(filter(None, reasons))
        rows.append({"id": run.id, **asked, **ended, **measured, "reason": reason})
    return rows


def text(results: "Results") -> str:
    """Return what the atlas says of each method, and failures that no caution speaks of."""
    return _by_method.text(results)


def references_of(point: Point, family: list[tuple[str, Point]]) -> list[str]:
    """Return the ids of the runs of a column with the default numerics at double precision, the finest grid first.

    Parameters
    ----------
    point
        The run's.
    family
        Id and point of each run of its column.

    Returns
    -------
    list of str
        Empty unless the finest is at least FINER times as fine as the run.
    """
    default = {key: getattr(Point(), key) for key in NUMERICS if key not in ("cells", "model")}
    known = [
        (other.cells, name)
        for name, other in family
        if all(getattr(other, key) == value for key, value in default.items())
    ]
    known.sort(reverse=True)
    if not known or (point.cells != known[0][0] and known[0][0] < FINER * point.cells):
        return []
    return [name for _, name in known]


def errors(point: Point, name: str, runs: "pd.DataFrame", references: list[str]) -> dict:
    """Return the entries of a row on its reference and the errors against it; `why_error` says why there are none."""
    none: dict[str, Any] = dict.fromkeys(("L_f_error", "max_abs_eta_error", "reference_L_f_change"), math.nan)
    none |= {"reference_max_abs_eta_change": math.nan, "reference": "", "why_error": ""}
    if point.scene == "shear":
        return {**none, "why_error": f"{NO_REFERENCE}: judged by its growth rate"}
    if not references:
        return {**none, "why_error": f"{NO_REFERENCE}: the study has no finer run of this column"}
    best = runs.loc[references[0]]
    entries = {**none, "reference": references[0]}
    if best["status"] not in FINISHED:
        return {**entries, "why_error": f"{NO_REFERENCE}: the finest run ended as {best['status']}"}
    if len(references) < 2:
        return {**entries, "why_error": f"{NO_REFERENCE}: it has one grid alone"}
    lost = []
    for quantity, column in QUANTITIES.items():
        change = _relative(runs.loc[references[1], column], best[column])
        entries[f"reference_{quantity}_change"] = change
        if not change <= AGREEMENT[quantity]:
            lost.append(f"{NO_REFERENCE} of {quantity}: its two finest grids differ by more than"
                        f" {AGREEMENT[quantity]:.0%}")  # fmt: skip
        elif name != references[0]:
            entries[f"{quantity}_error"] = _relative(runs.loc[name, column], best[column])
    if runs.loc[name, "status"] not in FINISHED:
        entries |= {"L_f_error": math.nan, "max_abs_eta_error": math.nan}
        lost.append(f"no answer: {runs.loc[name, 'status']}")
    elif name == references[0]:
        lost.append(REFERENCE)
    return {**entries, "why_error": "; ".join(lost)}


def budget(point: Point, record: dict, outcome: "pd.Series") -> dict:
    """Return the entries of a row on hyperbolicity, energy and volumes; `why_budget` says which are empty and why."""
    sized = math.isfinite(record["dx"])
    extent, dx = float(record["nonhyperbolic_cells_max"]), float(record["dx"]) / point.radius
    plane = record["model"] in ("quarter", "plane")
    drifts = outcome[["sediment_volume_error", "water_volume_error"]].astype(float)
    rise, why = math.nan, "no energy_rise: energy passes the open ends"
    if point.boundary not in names.LEAVING or record["wave_free_until"] == math.inf:
        rise = float(record["energy_rise"])
        why = "" if math.isfinite(rise) else "no energy_rise: the start has no energy to release"
    return {
        "nonhyperbolic_length": math.sqrt(extent) * dx if plane else extent * dx,
        "nonhyperbolic_time": float(record["nonhyperbolic_time"]),
        "hyperbolic_margin": float(outcome["hyperbolic_margin_min"]),
        "energy_rise": rise,
        "volume_drift": drifts.max(),
        "why_budget": why
        if sized
        else "; ".join(filter(None, ("no nonhyperbolic_length: cells differ", why))),
    }


def _growths(results: "Results") -> dict[str, dict]:
    """Return `growth` of each run of the scene `shear`, by id: those alone have their profiles read."""
    among = [run for run in results.runs_of_study if run.point.scene == "shear"]
    return {
        run.id: growth(run.point, record)
        for run, record in results.each(*PROFILES, among=among)
        if "h2" in record
    }


def growth(point: Point, record: dict) -> dict:
    """Return the entries of a row on the rate at which the wave of the scene `shear` grows: measured, and by theory.

    `why_growth` says why the measured one is empty.
    """
    answer = exact.load("shear")
    theory = answer.growth_rate(point)
    times, profiles = record["snapshot_time"], record["h2"]
    if len(times) < 3 or not np.isfinite(profiles).all():
        why = f"no growth_rate: {len(times)} snapshots before the run's end"
        return {**NO_GROWTH, "growth_rate_theory": theory, "why_growth": why}
    rate = answer.measured_growth(point, record["x"], times, profiles)
    return {**NO_GROWTH, "growth_rate": rate, "growth_rate_theory": theory}


def _column(point: Point) -> tuple:
    """Return what runs of the same column share: every key but those of numerics."""
    return tuple(getattr(point, key) for key in RUN_KEYS if key not in NUMERICS and key not in ASIDE)


def _relative(value: float, known: float) -> float:
    """Return the size of the difference of two numbers over the second; NaN where that is 0 or one is not known."""
    return abs(float(value) / float(known) - 1.0) if known else math.nan
