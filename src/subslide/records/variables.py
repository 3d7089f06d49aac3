"""From solved runs to the variables of a record: one layout for one run and for a batch."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from subslide import naming, points
from subslide.keys import measured
from subslide.keys.entries import ENTRIES
from subslide.records import measures, options, scalars

if TYPE_CHECKING:
    from subslide.solver.run import Run


class Variable(NamedTuple):
    """One variable of a record: names of its dimensions, its values and its attributes."""

    dims: tuple[str, ...]
    values: np.ndarray
    attrs: dict[str, Any]


ASKED_ALONE = ("model", "grid", "snapshot_times", *measured.ENTRIES)
"""Keys of a run that are no variables: what came of them is told by others."""

PARAMETERS = tuple(key for key in points.RUN_KEYS if key not in ("scene_options", *ASKED_ALONE))
"""Keys of a run that are variables as they are; what the others asked for is told by other variables."""

WORDS = {
    "model": "geometry that was solved",
    "model_reason": "why that geometry was solved",
    "grid": "grid that was solved on",
    "grid_reason": "why that grid was solved on",
    "status": "how the run ended",
    "status_detail": "what ended the run, in words",
}
"""Texts that a run says of itself, by name, and their meaning."""

SOLVED = ("model", "grid")
"""Those that stand for a key of the study."""

BESIDE = {"step": "time", "snapshot": "snapshot_time", "cell": "x", "gauge": "gauge_x gauge_y"}
"""Variables that hold the places along a dimension."""


SELECTING = ("id", "a_H", "a_2", "r", "delta")
"""Coordinates of a run that each of its variables names; `status` names all, and readers take them from any."""


def variables(runs: list["Run"], first: int = 0) -> dict[str, Variable]:
    """Return the variables of a record by name.

    Shorter runs are padded with NaN. Profiles of runs of one cell size lie on the union of their grids, which match
    because cell centres are whole steps from (i + 1/2) dx. Of any other runs each has positions of its own, snapshot by
    snapshot, along the dimension `cell`.

    Parameters
    ----------
    runs
        Results of `solver.solve`, thinned (`records.thinning`).
    first
        Number of the first run within its study; the others follow.

    Returns
    -------
    dict
        Variables by name.

    Raises
    ------
    ValueError
        If a run that keeps fields over the plane does not share its grid with the others.
    """
    inside, places = _no_grid(runs) or _shared_grid(runs) or _grids_apart(runs)
    record = {
        "run": _numbers("run", len(runs), first),
        "front_threshold": _variable("front_threshold", np.array(naming.FRONT_THRESHOLDS)),
        **places,
    }
    stated = _asked(runs)
    record |= stated | _scalars(runs)
    for name in ("time", *(name for name in naming.SERIES if hasattr(runs[0], name))):
        record[name] = _variable(name, _padded([getattr(run, name) for run in runs]))
    record["snapshot_time"] = _variable("snapshot_time", _padded([run.snapshot_time for run in runs]))
    if places:
        record.update(_profiles(runs, inside, places["x"].dims[-1]))
    for name, (dims, values) in measures.arrays(
        runs, inside, places["x"].dims[-1] if places else "x"
    ).items():
        record[name] = _variable(name, values, dims)
    for name, variable in record.items():
        if variable.dims[:1] == ("run",) and name not in ("run", *stated):
            beside = [BESIDE[dim] for dim in variable.dims if name not in BESIDE.get(dim, name).split()]
            chosen = [key for key in (stated if name == "status" else SELECTING) if key in stated]
            variable.attrs["coordinates"] = " ".join([*chosen, *beside])
    for dim in ("step", "snapshot", "cell", "gauge"):
        sizes = [
            variable.values.shape[variable.dims.index(dim)]
            for variable in record.values()
            if dim in variable.dims
        ]
        if sizes:
            record[dim] = _numbers(dim, sizes[0])
    if any("y" in variable.dims for variable in record.values()):
        record["y"] = _variable("y", places["x"].values)
    return record


def _asked(runs: list["Run"]) -> dict[str, Variable]:
    """Return the coordinates of the runs, by name: their ids, keys of the study, and options of their scenes.

    Any key may be an axis of the study, or become one: so all are coordinates, lest records of a study differ in them.
    """
    record = {
        "id": Variable(("run",), _text([run.point.id for run in runs]), {"long_name": "name of the run"})
    }
    for key in PARAMETERS:
        record[key] = _parameter(key, [getattr(run.point, key) for run in runs])
    about = {"long_name": f"{ENTRIES['scene_options']['description']} (JSON)"}
    stated = [points.options_text(run.point) for run in runs]
    record["scene_options"] = Variable(("run",), _text(stated), about)
    for name, option in options.of([run.point for run in runs]).items():
        values = np.array(option.values, float) if option.is_number else _text(option.values)
        record[name] = Variable(("run",), values, {"long_name": option.about})
    for name in SOLVED:
        texts = _text([getattr(run, name) for run in runs])
        record[name] = Variable(("run",), texts, {"long_name": WORDS[name]})
    return record


def _scalars(runs: list["Run"]) -> dict[str, Variable]:
    """Return the variables of one value a run, by name, that tell what came of it."""
    record: dict[str, Variable] = {}
    for name in (name for name in WORDS if name not in SOLVED):
        if name == "status":
            record["dx"] = Variable(("run",), _column(runs, "dx"), {"units": "m", "long_name": "cell size"})
        texts = _text([getattr(run, name) for run in runs])
        record[name] = Variable(("run",), texts, {"long_name": WORDS[name]})
    record["status"].attrs["comment"] = "; ".join(f"{k}: {v}" for k, v in naming.STATUSES.items())
    for name in naming.SCALARS:
        record[name] = _variable(name, _column(runs, name))
    made = [scalars.of(run) for run in runs]
    for name, meant in scalars.NAMES.items():
        values = np.array([of_run[name] for of_run in made], float)
        attrs = {"units": meant.unit, "long_name": meant.long_name, "_FillValue": np.nan}
        record[name] = Variable(meant.dims, values, attrs)
    return record


def _no_grid(runs: list["Run"]) -> tuple[list[slice], dict[str, Variable]] | None:
    """Return no places of cells for runs whose profiles are not kept; None for others."""
    return None if any(run.x.size for run in runs) else ([], {})


def _shared_grid(runs: list["Run"]) -> tuple[list[slice], dict[str, Variable]] | None:
    """Return where each run's cells lie on the uniform grid that holds them all, and its centres; None without one."""
    dx = runs[0].dx
    if not all(run.width is None and abs(run.dx - dx) <= 1e-12 * dx for run in runs):
        return None
    starts = [round(float(run.x[0]) / run.dx - 0.5) for run in runs]  # cells from the axis
    ends = [start + len(run.x) for start, run in zip(starts, runs, strict=True)]
    first = min(starts)
    inside = [slice(start - first, end - first) for start, end in zip(starts, ends, strict=True)]
    return inside, {"x": _variable("x", (np.arange(first, max(ends)) + 0.5) * dx)}


def _grids_apart(runs: list["Run"]) -> tuple[list[slice], dict[str, Variable]]:
    """Return where each run's cells lie along the dimension `cell`, and their centres and widths at each snapshot."""
    whole = {name for name, about in naming.NAMES.items() if "y" in about.dims}
    if any(run.measured.get(name, getattr(run, name, None)) is not None for run in runs for name in whole):
        raise ValueError(
            "runs that keep fields over the plane need one cell size for all runs of their record"
        )
    inside = [slice(run.x.shape[-1]) for run in runs]
    widths = [run.dx if run.width is None else run.width for run in runs]
    of_runs: dict[str, list[Any]] = {"x": [run.x for run in runs], "cell_width": widths}
    places = {}
    for name, kept in of_runs.items():
        at_snapshots = [np.broadcast_to(kept[n], run.h2.shape) for n, run in enumerate(runs)]
        places[name] = _variable(name, _joined(at_snapshots, inside, _snapshots(runs)), naming.CELLS)
    return inside, places


def _snapshots(runs: list["Run"]) -> int:
    """Return the most snapshots of a run."""
    return max(len(run.snapshot_time) for run in runs)


def _profiles(runs: list["Run"], inside: list[slice], dim: str) -> dict[str, Variable]:
    """Return profiles and fields, by name, with the dimension `dim` along x; those that no run has are left out."""
    record = {}
    for name, about in {**naming.PROFILES, **naming.FIELDS_2D}.items():
        kept = [getattr(run, name) for run in runs]
        if any(values is not None for values in kept):
            joined = _joined(kept, inside, _snapshots(runs))
            record[name] = _variable(name, joined, (*about.dims[:-1], dim))
    return record


def _joined(kept: Sequence[np.ndarray | None], inside: list[slice], snapshots: int) -> np.ndarray:
    """Return arrays (snapshots, cells or cells, cells) along a new first axis, those of each run inside its cells.

    The rest is NaN, and so is all of a run that has none.
    """
    first = next(values for values in kept if values is not None)
    cells = [max(part.stop for part in inside)] * (first.ndim - 1)
    joined = np.full((len(kept), snapshots, *cells), np.nan, first.dtype)
    for of_run, values, part in zip(joined, kept, inside, strict=True):
        if values is not None:
            of_run[(slice(len(values)), *[part] * len(cells))] = values
    return joined


def _variable(name: str, values: np.ndarray, dims: tuple[str, ...] = ()) -> Variable:
    """Return a variable with the unit, long name and, unless others are given, dimensions of the naming table."""
    about = naming.NAMES[name]
    dims = dims or about.dims
    attrs = {"units": about.unit, "long_name": about.long_name}
    if values.dtype.kind == "f" and dims != (name,):
        attrs["_FillValue"] = values.dtype.type(np.nan)
    return Variable(dims, values, attrs)


def _numbers(name: str, count: int, first: int = 0) -> Variable:
    """Return the coordinate of a dimension that is a number, from the first on; int32, which any format has."""
    return _variable(name, np.arange(first, first + count, dtype=np.int32))


def _parameter(key: str, values: list) -> Variable:
    """Return the variable (run) of a key of the configuration, described as its entry does."""
    about = ENTRIES[key]
    attrs = {"long_name": about["description"]}
    if isinstance(values[0], str):
        return Variable(("run",), _text(values), attrs)
    if "unit" in about:
        attrs["units"] = about["unit"]
    if isinstance(values[0], int):
        return Variable(("run",), np.array(values, np.int32), attrs)
    return Variable(("run",), np.array([np.nan if v is None else v for v in values], float), attrs)


def _column(runs: list["Run"], name: str) -> np.ndarray:
    """Return a number of each run, as int32 or float64."""
    values = np.array([getattr(run, name) for run in runs])
    return values.astype(np.int32 if values.dtype.kind in "iu" else np.float64)


def _text(values: list) -> np.ndarray:
    """Return texts as an array of objects."""
    return np.array([str(value) for value in values], dtype=object)


def _padded(arrays: list[np.ndarray]) -> np.ndarray:
    """Return arrays stacked along a new first axis, the last axis padded with NaN to the longest."""
    longest = max(array.shape[-1] for array in arrays)
    joined = np.full((len(arrays), *arrays[0].shape[:-1], longest), np.nan, arrays[0].dtype)
    for row, array in zip(joined, arrays, strict=True):
        row[..., : array.shape[-1]] = array
    return joined
