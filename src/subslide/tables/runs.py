"""The table of runs: a row a run, with all that was asked for and what came of it.

`COLUMNS_OF_RUN` states unit, meaning and value of each column in one place.
"""

import operator
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from subslide import naming
from subslide.keys import schema, words
from subslide.keys.values import RUN_KEYS, STANDS_FOR
from subslide.naming import FRONT_LABELS
from subslide.points import Point, options_text
from subslide.records import options, scalars
from subslide.study.config import Study
from subslide.tables import bands

if TYPE_CHECKING:
    from subslide.results import Results, StudyRun

TITLE = "Table of runs"
READS = ("records", "bands")
VARIED = "runs_varied.csv"
"""File of what varies and what came of it."""

ABOUT = f"""One row a run; nothing here differs between two identical runs. After these columns stands one for each
option of the study's scenes, such as `elongation`; empty where the run's scene has none of that name.

`{VARIED}` has of these columns the `id`, those of what was asked that are not the same for all runs, and those of what
came of it that are not all empty. What all runs share is said by any row of `runs.csv`, and by `points.json`."""


Runs = Sequence["StudyRun"]
Values = Mapping[str, np.ndarray]


class Column(NamedTuple):
    """A column: unit, meaning, and entries, a function of the study's runs and of values of their records by name."""

    unit: str
    meaning: str
    entries: Callable[[Runs, Values], Sequence[Any] | np.ndarray]


def _asked(key: str) -> Column:
    """Return the column of a key of the configuration."""
    unit, meaning = words.unit(key), schema.properties()[key]["description"]
    if key == "scene_options":
        return Column(unit, meaning, lambda runs, values: [options_text(run.point) for run in runs])
    word = STANDS_FOR.get(key)

    def entries(runs: Runs, values: Values) -> list:
        stated = list(map(operator.attrgetter(f"point.{key}"), runs))
        return stated if word is None else [word if value is None else value for value in stated]

    return Column(unit, meaning, entries)


def _recorded(name: str, unit: str, meaning: str) -> Column:
    """Return the column of a number or text of the record."""
    return Column(unit, meaning, lambda runs, values: values[name])


def _made(name: str) -> Column:
    """Return the column of a number that was made of a run's samples."""
    about = scalars.NAMES[name]
    return _recorded(name, "" if about.unit == "1" else about.unit, about.long_name)


def _length(label: str, n: int) -> Column:
    """Return the column of the length of the deposit at one threshold of the front."""
    about = (
        f"length of the deposit along +x at the end of the run; front where h2 = {label[:-2]} % of H2; empty where no"
        " grains are"
    )
    return Column("m", about, lambda runs, values: values["L_f"][:, n])


def _length_over_radius(label: str, n: int) -> Column:
    """Return the column of the same over R."""
    about = f"the same over the initial radius ({label[:-2]} % front)"
    return Column(
        "", about, lambda runs, values: values["L_f"][:, n] / np.array([run.point.radius for run in runs])
    )


def _arrest(label: str, n: int) -> Column:
    """Return the column of the time of arrest at one threshold of the front."""
    about = (
        f"time since which that front ({label[:-2]} % of H2) has been within {100 * naming.ARREST:g} % of its L_f;"
        " empty where L_f is 0 or empty, or if grains move at the end"
    )
    return Column("s", about, lambda runs, values: values["time_of_arrest"][:, n])


STATUS = "how the run ended: " + "; ".join(f"`{name}`: {text}" for name, text in naming.STATUSES.items())
REST = (
    "time since which no grain has moved (late waves may nudge a few); empty if some move at the end. Has no limit as"
    " cells shrink; the times of arrest do"
)
MOVED = "whether any grain moved, `yes` or `no`; empty if the run failed"
DEPTH = "depth of water above the column at the start, a_H H2"
HEIGHT = "height of the column at the start, a_2 R"
SCALED = "tan(delta)/a_2: with a_H and r, all that the scaled answer depends on"
WHOLE = "nonhyperbolic_cells_max"
"""Whole number, which records have as a float like the others."""

UNTOLD = ("snapshot_times", "gauges", "runout_directions", "footprints")
"""Keys without a column: what they ask for is in records alone."""

MADE = tuple(name for name in scalars.NAMES if not name.startswith(("nonhyperbolic", "hyperbolic")))

COLUMNS_OF_RUN = {
    "id": Column(
        "", "name of the run; depends on its values alone", lambda runs, values: [run.id for run in runs]
    ),
    "numerics": Column(
        "",
        "named set of numerics that the study asked for",
        lambda runs, values: [run.numerics for run in runs],
    ),
    **{key: _asked(key) for key in RUN_KEYS if key not in UNTOLD},
    "H1": Column("m", DEPTH, lambda runs, values: [run.point.a_H * run.point.column_height for run in runs]),
    "H2": Column("m", HEIGHT, lambda runs, values: [run.point.column_height for run in runs]),
    "m": Column("", SCALED, lambda runs, values: [run.point.friction_number for run in runs]),
    "resolved_model": _recorded("model", "", "geometry that was solved; `model` is what was asked for"),
    "resolved_grid": _recorded("grid", "", "grid that was solved on, `uniform` or `fitted`"),
    "dx": _recorded("dx", "m", "cell size; empty on a fitted grid"),
    "status": _recorded("status", "", STATUS),
    "status_detail": _recorded("status_detail", "", "what ended the run, in words"),
    "steps": _recorded("steps", "", "number of time steps"),
    "time_at_rest": _recorded("time_at_rest", "s", REST),
    "moved": Column("", MOVED, lambda runs, values: moved(values["status"], values["time_at_rest"])),
    "box_half_width": _recorded(
        "box_half_width", "m", "half-width of the box at the end, and of the paper's on an open sea"
    ),
    "wave_free_until": _recorded("wave_free_until", "s", naming.SCALARS["wave_free_until"].long_name),
    "L_f": _length(next(iter(FRONT_LABELS)), 0),
    **{f"L_f_{label}": _length(label, n) for label, n in FRONT_LABELS.items()},
    **{f"L_f_{label}_over_R": _length_over_radius(label, n) for label, n in FRONT_LABELS.items()},
    **{f"time_of_arrest_{label}": _arrest(label, n) for label, n in FRONT_LABELS.items()},
    **{name: _made(name) for name in MADE},
    WHOLE: Column("", scalars.NAMES[WHOLE].long_name, lambda runs, values: values[WHOLE].astype(np.int64)),
    "hyperbolic_margin_min": _made("hyperbolic_margin_min"),
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
    *("model", "grid", "dx", "status", "status_detail", "steps", "time_at_rest", "box_half_width"),
    *("wave_free_until", "L_f", "time_of_arrest", *MADE, WHOLE, "hyperbolic_margin_min"),
)
"""Variables of records that the table follows from."""

ASKED = ("numerics", *RUN_KEYS, "H1", "H2", "m", "resolved_model", "resolved_grid", "dx")
"""Columns that follow from what was asked."""


def needs(study: Study) -> str:
    """Return '' for every study."""
    return ""


def columns(results: "Results") -> dict[str, Sequence[Any] | np.ndarray]:
    """Return the entries by column, in the order of the study; those of bands are as the table of bands has them."""
    runs, values = results.runs_of_study, results.values(*MEASURED)
    entries = {name: column.entries(runs, values) for name, column in COLUMNS_OF_RUN.items()}
    of_bands = bands.summaries(results)
    for name in COLUMNS:
        if name not in entries:
            entries[name] = (
                [of_bands.get(run.id, {}).get(name) for run in runs] if of_bands else [None] * len(runs)
            )
    return entries | {name: option.values for name, option in options.of([run.point for run in runs]).items()}


def more(points: Sequence[Point]) -> dict[str, tuple[str, str]]:
    """Return the columns of the options of a study's scenes, with their meaning; their units are in it."""
    return {name: ("", about) for name, (about, _) in options.described(options.scenes_of(points)).items()}


def varied(entries: Mapping[str, Sequence[Any] | np.ndarray]) -> list[str]:
    """Return the columns of VARIED: what varies, and what came of it.

    Parameters
    ----------
    entries
        Entries by column.

    Returns
    -------
    list of str
        Names of columns.
    """
    asked = {*ASKED, *entries.keys() - COLUMNS.keys()}
    return [name for name, of in entries.items() if not (_is_one(of) if name in asked else _is_empty(of))]


def _is_one(entries: Sequence[Any] | np.ndarray) -> bool:
    """Return whether all entries of a column are the same, missing ones too."""
    first = entries[0]
    return all(entry == first or (entry != entry and first != first) for entry in entries)


def _is_empty(entries: Sequence[Any] | np.ndarray) -> bool:
    """Return whether no entry of a column says anything."""
    return all(entry is None or entry != entry or entry == "" for entry in entries)


BESIDE = {VARIED: varied}


def moved(status: np.ndarray, rested: np.ndarray) -> list[str]:
    """Return whether any grain of each run moved, `yes` or `no`; '' if it failed.

    Parameters
    ----------
    status, rested
        Status, and time since which no grain has moved, of each run.
    """
    ended = zip(status.tolist(), rested.tolist(), strict=True)
    return ["" if how not in naming.FINISHED else "no" if time == 0 else "yes" for how, time in ended]
