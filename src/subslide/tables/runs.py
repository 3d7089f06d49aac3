"""The table of runs: a row a run, with all that was asked for and what came of it.

`COLUMNS_OF_RUN` states unit, meaning and value of each column in one place.
"""

import math
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from subslide import naming
from subslide.keys import names, schema, words
from subslide.naming import FRONT_LABELS
from subslide.points import PAPER_BOX, RUN_KEYS, options_text
from subslide.study.config import Study
from subslide.tables import _energy as energy
from subslide.tables import _gauge as gauge
from subslide.tables import bands

if TYPE_CHECKING:
    from subslide.results import Results, StudyRun

TITLE = "Table of runs"
READS = ("records", "bands")
ABOUT = "One row a run; nothing here differs between two identical runs."


class Column(NamedTuple):
    """A column: its unit, its meaning, and its value, a function of a run and of the variables of its record."""

    unit: str
    meaning: str
    value: Callable[["StudyRun", dict[str, Any]], Any]


def _asked(key: str) -> Column:
    """Return the column of a key of the configuration."""
    unit, meaning = words.unit(key), schema.properties()[key]["description"]
    if key == "scene_options":
        return Column(unit, meaning, lambda run, record: options_text(run.point))
    if key == "t_end":
        return Column(
            unit, meaning, lambda run, record: "rest" if run.point.t_end is None else run.point.t_end
        )
    return Column(unit, meaning, lambda run, record: getattr(run.point, key))


def _recorded(name: str, unit: str, meaning: str) -> Column:
    """Return the column of a number or text of the record."""
    return Column(unit, meaning, lambda run, record: record[name])


def _length(label: str, n: int) -> Column:
    """Return the column of the length of the deposit at one threshold of the front."""
    about = (
        f"length of the deposit along +x at the end of the run; front where h2 = {label[:-2]} % of H2; empty where no"
        " grains are"
    )
    return Column("m", about, lambda run, record: record["L_f"][n])


def _length_over_radius(label: str, n: int) -> Column:
    """Return the column of the same over R."""
    about = f"the same over the initial radius ({label[:-2]} % front)"
    return Column("", about, lambda run, record: record["L_f"][n] / run.point.radius)


def _arrest(label: str, n: int) -> Column:
    """Return the column of the time of arrest at one threshold of the front."""
    about = (
        f"time since which that front ({label[:-2]} % of H2) has been within {100 * naming.ARREST:g} % of its L_f;"
        " empty where L_f is 0 or empty, or if grains move at the end"
    )
    return Column("s", about, lambda run, record: record["time_of_arrest"][n])


def _peak(name: str, meaning: str) -> Column:
    """Return the column of the largest value of a series."""
    return Column("m", meaning, lambda run, record: peak(record[name], record["time"])[0])


def _peak_time(name: str) -> Column:
    """Return the column of the time of the largest value of a series."""
    return Column("s", "time of that peak", lambda run, record: peak(record[name], record["time"])[1])


def _volume_error(name: str, meaning: str) -> Column:
    """Return the column of how much a volume changes."""
    return Column(
        "", meaning, lambda run, record: relative_change(record[name][: samples_inside(run, record)])
    )


STATUS = "how the run ended: " + "; ".join(f"`{name}`: {text}" for name, text in naming.STATUSES.items())
REST = (
    "time since which no grain has moved (late waves may nudge a few); empty if some move at the end. Has no limit as"
    " cells shrink; the times of arrest do"
)
MOVED = "whether any grain moved, `yes` or `no`; empty if the run failed"
MARGIN = (
    "smallest margin to complex wave speeds at any time, a discriminant: 1 at rest, below 0 where complex"
)
WATCHED = (
    "largest displacement of the water surface, within 4.2553 R along x and y, over all time; where waves meet on the"
    " axis it has no limit as cells shrink"
)
OUTSIDE = (
    "the same beyond x = R, where waves are not focused; often the jump at the start, or the sharp head of a wave: it"
    " converges slowly, `eta_gauge_peak` does not"
)
KEPT = "largest relative change of the volume of grains while nothing can have left the box"
RISE = (
    "largest rise of the energy after any moment, over what the start can release (its energy less that of flat layers"
    f" at rest); of an open box until `wave_free_until`. Above {energy.GAINED:g} the answer is wrong in any status"
)
SCALED = "tan(delta)/a_2: with a_H and r, all that the scaled answer depends on"
LOST = "most cells, at any one time, where the wave speeds are complex"

COLUMNS_OF_RUN = {
    "id": Column("", "name of the run; depends on its values alone", lambda run, record: run.id),
    "numerics": Column(
        "", "named set of numerics that the study asked for", lambda run, record: run.numerics
    ),
    **{key: _asked(key) for key in RUN_KEYS if key != "snapshot_times"},
    "m": Column("", SCALED, lambda run, record: run.point.friction_number),
    "resolved_model": _recorded("model", "", "geometry that was solved; `model` is what was asked for"),
    "resolved_grid": _recorded("grid", "", "grid that was solved on, `uniform` or `fitted`"),
    "dx": _recorded("dx", "m", "cell size; empty on a fitted grid"),
    "status": _recorded("status", "", STATUS),
    "status_detail": _recorded("status_detail", "", "what ended the run, in words"),
    "steps": _recorded("steps", "", "number of time steps"),
    "time_at_rest": _recorded("time_at_rest", "s", REST),
    "moved": Column("", MOVED, lambda run, record: moved(record)),
    "box_half_width": _recorded(
        "box_half_width", "m", "half-width of the box at the end, and of the paper's on an open sea"
    ),
    "wave_free_until": _recorded("wave_free_until", "s", naming.SCALARS["wave_free_until"].long_name),
    **{f"L_f_{label}": _length(label, n) for label, n in FRONT_LABELS.items()},
    **{f"L_f_{label}_over_R": _length_over_radius(label, n) for label, n in FRONT_LABELS.items()},
    **{f"time_of_arrest_{label}": _arrest(label, n) for label, n in FRONT_LABELS.items()},
    "max_abs_eta_peak": _peak("max_abs_eta", WATCHED),
    "max_abs_eta_peak_time": _peak_time("max_abs_eta"),
    "max_abs_eta_outside_peak": _peak("max_abs_eta_outside", OUTSIDE),
    "max_abs_eta_outside_peak_time": _peak_time("max_abs_eta_outside"),
    "eta_gauge_peak": Column(
        "m", gauge.MEANING, lambda run, record: gauge.peak(run.point, record["time"], record["eta_gauge"])[0]
    ),
    "eta_gauge_peak_time": Column(
        "s",
        "middle of that time",
        lambda run, record: gauge.peak(run.point, record["time"], record["eta_gauge"])[1],
    ),
    "sediment_volume_error": _volume_error("sediment_volume", KEPT),
    "water_volume_error": _volume_error("water_volume", "the same for water"),
    "energy_rise": Column("", RISE, lambda run, record: energy_rise(run, record)),
    "nonhyperbolic_cells_max": Column(
        "", LOST, lambda run, record: int(np.nan_to_num(record["nonhyperbolic_cells"]).max())
    ),
    "hyperbolic_margin_min": Column(
        "", MARGIN, lambda run, record: np.fmin.reduce(record["hyperbolic_margin"])
    ),
}
COLUMNS = {
    **{name: (column.unit, column.meaning) for name, column in COLUMNS_OF_RUN.items()},
    **{
        f"{name}_{part}": (
            "s" if name in bands.ARRESTS else bands.COLUMNS[part][0],
            f"`{part}` of {name} in bands.csv; empty without bands",
        )
        for name, parts in bands.SUMMARIES.items()
        for part in parts
    },
}
WORDS = (
    *("id", "numerics", "resolved_model", "resolved_grid", "status", "status_detail", "moved"),
    *(f"{name}_convergence" for name, parts in bands.SUMMARIES.items() if "convergence" in parts),
)
MEASURED = (
    *(
        "model",
        "grid",
        "dx",
        "status",
        "status_detail",
        "steps",
        "time_at_rest",
        "box_half_width",
        "L_f",
        "time",
    ),
    *("time_of_arrest", "wave_free_until", "energy", "max_abs_eta", "max_abs_eta_outside", "eta_gauge"),
    *("sediment_volume", "water_volume"),
    *("nonhyperbolic_cells", "hyperbolic_margin"),
)
"""Variables of records that the table follows from."""


def needs(study: Study) -> str:
    """Return '' for every study."""
    return ""


def table(results: "Results") -> Iterator[dict]:
    """Give the rows, by column, in the order of the study; those of bands are as the table of bands has them."""
    of_bands = bands.summaries(results)
    for run, record in results.each(*MEASURED):
        row = {name: column.value(run, record) for name, column in COLUMNS_OF_RUN.items()}
        yield row | of_bands.get(run.id, {})


def samples_inside(run: "StudyRun", record: dict) -> int:
    """Return the number of samples up to which nothing can have left the box.

    A step carries a change `order` cells at most. Nothing ever leaves a closed box, a sea or a fitted grid, and every
    sample counts.
    """
    closed = run.point.boundary not in names.LEAVING or record["grid"] == "fitted"
    if closed or record["wave_free_until"] == math.inf:
        return len(record["time"])
    radius = run.point.radius
    cells = (min(PAPER_BOX * radius, float(record["box_half_width"])) - radius) / float(record["dx"])
    return max(1, int(cells / run.point.order) - 1)


def energy_rise(run: "StudyRun", record: dict) -> float:
    """Return the largest rise of a run's energy over what can be released, while none passes an open edge."""
    inside = ~(record["time"] > record["wave_free_until"])
    series = (record[name][inside] for name in ("energy", "water_volume", "sediment_volume"))
    return energy.rise(run.point, record["model"], float(record["box_half_width"]), *series)


def moved(record: dict) -> str:
    """Return whether any grain of a run moved, `yes` or `no`; '' if it failed."""
    if record["status"] not in naming.FINISHED:
        return ""
    return "no" if record["time_at_rest"] == 0 else "yes"


def peak(values: np.ndarray, time: np.ndarray) -> tuple[float, float]:
    """Return the largest value of a series, and when it was first reached; NaN if there is none."""
    if not np.isfinite(values).any():
        return math.nan, math.nan
    place = int(np.nanargmax(values))
    return float(values[place]), float(time[place])


def relative_change(values: np.ndarray) -> float:
    """Return the largest relative change of a series since its start; NaN if there is none."""
    with np.errstate(invalid="ignore", divide="ignore"):
        changes = np.abs(values / values[0] - 1)
    return float(np.nanmax(changes)) if np.isfinite(changes).any() else math.nan
