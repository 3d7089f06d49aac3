"""The stability atlas: for each run of a study how it ended, how far it is from the converged answer, and how near the
edge it stood: loss of hyperbolicity, growth of energy, drift of volumes.

The converged answer of a run is its reference: the run of the same study that is the same column with the default
numerics on the finest grid, at least `FINER` times as fine as the run. It speaks only if it ended and, for each
quantity, if the next coarser run of the same numerics agrees with it: within `AGREES_L_F` in L_f and within
`AGREES_ETA` in the peak of max|eta| beyond R, relative.
"""

import functools
import math
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pandas as pd
import xarray as xr

from subslide import exact
from subslide.files import write_text
from subslide.keys import schema, words
from subslide.keys.schema import ConfigError
from subslide.points import RUN_KEYS, Point, from_dict, options_text
from subslide.results import Results, trimmed
from subslide.tables import _energy as energy

FINER = 2
AGREES_L_F, AGREES_ETA = 0.05, 0.25
AGREEMENT = {"L_f": AGREES_L_F, "max_abs_eta": AGREES_ETA}
"""Largest difference of the two finest runs of a reference, over its value, at which it counts as converged."""
FINISHED = ("ok", "not_at_rest")
NUMERICS = (
    *("model", "scheme", "front_flux", "wave_speeds", "order", "cells", "dtype", "cfl"),
    *("treatment", "as_printed", "friction_in_viscosity"),
)
"""Keys that say how a column is solved; runs that differ in no other key have one answer."""
ASIDE = ("snapshot_times", "fields", "quantities")
"""Keys that change neither the answer nor how it is found."""

NO_REFERENCE, REFERENCE = "no reference", "is the reference"
VARIANTS = (
    *("front_flux", "wave_speeds", "dtype", "treatment", "as_printed", "friction_in_viscosity"),
    *("friction", "cfl"),
)
"""Keys whose defaults the table of methods keeps to."""
GAINED = 0.1
"""Rise of the energy, over what the start can release, from which an answer is wrong although the run ended well."""
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
MEASURED = (
    *("energy", "water_volume", "sediment_volume", "nonhyperbolic_cells"),
    *("time", "dx", "model", "box_half_width"),
)
"""Variables of records that the table follows from."""
QUANTITIES = {"L_f": "L_f_1pc", "max_abs_eta": "max_abs_eta_outside_peak"}
"""Columns of the table of runs that are compared with the reference."""


def write(folder: Path) -> Path:
    """Path of the atlas of the study in `folder`, newly written from its records and its table of runs."""
    path = folder / "tables" / "atlas.csv"
    text = table(Results(folder)).to_csv(index=False, float_format="%.10g", lineterminator="\n")
    write_text(path, text)
    return path


def table(results: Results) -> pd.DataFrame:
    """Atlas of a study, by the columns of `COLUMNS`: a row for each run, in the order of the table of runs."""
    runs = results.runs.set_index("id")
    points = {row["id"]: _point(row) for row in results.points}
    families = {}
    for name, point in points.items():
        families.setdefault(_column(point), []).append(name)
    rows = []
    for row, run in _records(results):
        point, found = points[row["id"]], runs.loc[row["id"]]
        references = references_of(point, [(n, points[n]) for n in families[_column(point)]])
        measured = {
            **budget(point, run, found),
            **growth(point, run),
            **errors(point, row["id"], runs, references),
        }
        reasons = [measured.pop(f"why_{part}") for part in ("budget", "growth", "error")]
        shown = {key: row[key] for key in COLUMNS if key in row}
        about = {key: found[key] for key in ("status", "status_detail", "steps")}
        rows.append(
            {
                **shown,
                "scene_options": options_text(point),
                **about,
                **measured,
                "reason": "; ".join(filter(None, reasons)),
            }
        )
    return pd.DataFrame(rows, columns=list(COLUMNS))


def references_of(point: Point, family: list[tuple[str, Point]]) -> list[str]:
    """Ids of the runs of a column with the default numerics at double precision, the finest grid first.

    family: id and point of each run of the column. Empty unless the finest is at least FINER times as fine as the run.
    """
    default = {
        key: getattr(Point(), key) for key in NUMERICS if key not in ("cells", "model") and key in RUN_KEYS
    }
    known = [
        (other.cells, name)
        for name, other in family
        if all(getattr(other, key) == value for key, value in default.items())
    ]
    known.sort(reverse=True)
    if not known or (point.cells != known[0][0] and known[0][0] < FINER * point.cells):
        return []
    return [name for _, name in known]


def errors(point: Point, name: str, runs: pd.DataFrame, references: list[str]) -> dict:
    """Entries of a row on its reference and the errors against it; `why_error` says why there are none."""
    none = dict.fromkeys(("L_f_error", "max_abs_eta_error", "reference_L_f_change"), math.nan)
    none |= {"reference_max_abs_eta_change": math.nan, "reference": "", "why_error": ""}
    if point.scene == "shear":
        return {**none, "why_error": f"{NO_REFERENCE}: judged by its growth rate"}
    if not references:
        return {**none, "why_error": f"{NO_REFERENCE}: the study has no finer run of this column"}
    best = runs.loc[references[0]]
    found = {**none, "reference": references[0]}
    if best["status"] not in FINISHED:
        return {**found, "why_error": f"{NO_REFERENCE}: the finest run ended as {best['status']}"}
    if len(references) < 2:
        return {**found, "why_error": f"{NO_REFERENCE}: it has one grid alone"}
    lost = []
    for quantity, column in QUANTITIES.items():
        change = _relative(runs.loc[references[1], column], best[column])
        found[f"reference_{quantity}_change"] = change
        if not change <= AGREEMENT[quantity]:
            lost.append(f"{NO_REFERENCE} of {quantity}: its two finest grids differ by more than"
                        f" {AGREEMENT[quantity]:.0%}")  # fmt: skip
        elif name != references[0]:
            found[f"{quantity}_error"] = _relative(runs.loc[name, column], best[column])
    if runs.loc[name, "status"] not in FINISHED:
        found |= {"L_f_error": math.nan, "max_abs_eta_error": math.nan}
        lost.append(f"no answer: {runs.loc[name, 'status']}")
    elif name == references[0]:
        lost.append(REFERENCE)
    return {**found, "why_error": "; ".join(lost)}


def budget(point: Point, run: xr.Dataset, row: pd.Series) -> dict:
    """Entries of a row on hyperbolicity, energy and volumes; `why_budget` says which are empty and why."""
    lost = np.nan_to_num(run["nonhyperbolic_cells"].values)
    extent, dx = lost.max(), float(run["dx"]) / point.radius
    plane = str(run["model"].values) in ("quarter", "plane")
    drifts = row[["sediment_volume_error", "water_volume_error"]].astype(float)
    rise, why = math.nan, "no energy_rise: energy passes the open ends"
    if point.boundary != "open":
        series = (run[name].values for name in ("energy", "water_volume", "sediment_volume"))
        rise = energy.rise(point, str(run["model"].values), float(run["box_half_width"]), *series)
        why = "" if math.isfinite(rise) else "no energy_rise: the start has no energy to release"
    return {
        "nonhyperbolic_length": math.sqrt(extent) * dx if plane else extent * dx,
        "nonhyperbolic_time": float((lost > 0).mean()),
        "hyperbolic_margin": float(row["hyperbolic_margin_min"]),
        "energy_rise": rise,
        "volume_drift": drifts.max(),
        "why_budget": why,
    }


def growth(point: Point, run: xr.Dataset) -> dict:
    """Entries of a row on the rate at which the wave of the scene `shear` grows: measured, and by linear theory.

    `why_growth` says why the measured one is empty.
    """
    none = {"growth_rate": math.nan, "growth_rate_theory": math.nan, "why_growth": ""}
    if point.scene != "shear":
        return none
    answer = exact.load("shear")
    theory = answer.growth_rate(point)
    times = run["snapshot_time"].values
    last = np.append(np.diff(times) > 0, True)  # a run's end may be a snapshot too
    times, profiles = times[last], run["h2"].values[last]
    if len(times) < 3 or not np.isfinite(profiles).all():
        why = f"no growth_rate: {len(times)} snapshots before the run's end"
        return {**none, "growth_rate_theory": theory, "why_growth": why}
    rate = answer.measured_growth(point, run["x"].values, times, profiles)
    return {**none, "growth_rate": rate, "growth_rate_theory": theory}


def read(folder: Path) -> pd.DataFrame:
    """Atlas of a study's folder, in which empty texts are ''."""
    path = folder / "tables/atlas.csv"
    if not path.is_file():
        raise ConfigError(f"{path}: there is no such file; allowed: the folder of a study with an atlas")
    found = pd.read_csv(path)
    texts = ["status_detail", "reference", "reason"]
    return found.assign(**{name: found[name].astype(object).fillna("") for name in texts})


def _column(point: Point) -> tuple:
    """What runs of the same column share: every key but those of numerics."""
    return tuple(getattr(point, key) for key in RUN_KEYS if key not in NUMERICS and key not in ASIDE)


def _relative(value: float, known: float) -> float:
    """Size of the difference of two numbers over the second; NaN where that is 0 or one is not known."""
    return abs(float(value) / float(known) - 1.0) if known else math.nan


def _point(row: dict) -> Point:
    return from_dict({key: row[key] for key in RUN_KEYS})


def _records(results: Results) -> Iterator[tuple[dict, xr.Dataset]]:
    """Values and measured variables of each run in the order of the tables."""

    @functools.lru_cache(maxsize=16)
    def loaded(batch: str) -> xr.Dataset:
        data = results.batch(batch)
        shear = "h2" in data and (data["scene"] == "shear").any()
        return data[[*MEASURED, *(("h2", "snapshot_time") if shear else ())]].load()

    for row in results.points:
        yield row, trimmed(loaded(row["batch"]), row["id"])
