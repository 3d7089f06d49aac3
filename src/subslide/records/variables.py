"""From solved runs to the variables of a record: one layout for one run and for a batch."""

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from subslide import naming, points
from subslide.keys.entries import ENTRIES

if TYPE_CHECKING:
    from subslide.solver.run import Run


class Variable(NamedTuple):
    """One variable of a record: names of its dimensions, its values and its attributes."""

    dims: tuple[str, ...]
    values: np.ndarray
    attrs: dict[str, Any]


PARAMETERS = tuple(
    key for key in points.RUN_KEYS if key not in ("scene_options", "model", "snapshot_times", "fields")
)
"""Keys of a run that are variables as they are; what the others asked for is told by other variables."""

WORDS = {
    "model": "geometry that was solved",
    "model_reason": "why that geometry was solved",
    "status": "how the run ended",
    "status_detail": "what ended the run, in words",
}
"""Texts that a run says of itself, by name, and their meaning."""

BESIDE = {"step": "time", "snapshot": "snapshot_time"}
"""Variable that holds the places along a dimension."""


def variables(runs: list["Run"]) -> dict[str, Variable]:
    """Return the variables of a record by name.

    Shorter runs are padded with NaN. Profiles lie on the union of the runs' grids, which match because cell centres
    are whole steps from (i + 1/2) dx.

    Parameters
    ----------
    runs
        Results of `solver.solve`, thinned (`records.thinning`).

    Raises
    ------
    ValueError
        If the runs have different cell sizes.
    """
    first, x = _shared_grid(runs)
    record = {
        "front_threshold": _variable("front_threshold", np.array(naming.FRONT_THRESHOLDS)),
        "x": _variable("x", x),
    }
    record["x"].attrs["axis"] = "X"
    record.update(_scalars(runs))
    for name in ("time", *naming.SERIES):
        record[name] = _variable(name, _padded([getattr(run, name) for run in runs]))
    record["snapshot_time"] = _variable("snapshot_time", _padded([run.snapshot_time for run in runs]))
    record.update(_profiles(runs, first, len(x)))
    for name, variable in record.items():
        if variable.dims[:1] == ("run",) and name != "id":
            beside = [BESIDE[dim] for dim in variable.dims if BESIDE.get(dim, name) != name]
            variable.attrs["coordinates"] = " ".join(["id", *beside])
    if any(name in record for name in naming.FIELDS_2D):
        record["y"] = _variable("y", x)
        record["y"].attrs["axis"] = "Y"
    return record


def _scalars(runs: list["Run"]) -> dict[str, Variable]:
    """Return the variables of one value a run, by name: its parameters, numerics and outcome."""
    record = {
        "id": Variable(("run",), _text([run.point.id for run in runs]), {"long_name": "name of the run"})
    }
    for key in PARAMETERS:
        record[key] = _parameter(key, [getattr(run.point, key) for run in runs])
    about = {"long_name": f"{ENTRIES['scene_options']['description']} (JSON)"}
    options = [points.options_text(run.point) for run in runs]
    record["scene_options"] = Variable(("run",), _text(options), about)
    for name, meaning in WORDS.items():
        if name == "status":
            record["dx"] = Variable(("run",), _column(runs, "dx"), {"units": "m", "long_name": "cell size"})
        texts = _text([getattr(run, name) for run in runs])
        record[name] = Variable(("run",), texts, {"long_name": meaning})
    record["status"].attrs["comment"] = "; ".join(f"{k}: {v}" for k, v in naming.STATUSES.items())
    for name in naming.SCALARS:
        record[name] = _variable(name, _column(runs, name))
    return record


def _shared_grid(runs: list["Run"]) -> tuple[int, np.ndarray]:
    """Return the index of the first cell, and the centres (m), of the grid that holds every run's."""
    dx = runs[0].dx
    if any(abs(run.dx - dx) > 1e-12 * dx for run in runs):
        raise ValueError("the runs of a record need one cell size")
    first = min(_offset(run) for run in runs)
    last = max(_offset(run) + len(run.x) for run in runs)
    return first, (np.arange(first, last) + 0.5) * dx


def _offset(run: "Run") -> int:
    """Return the index of a run's first cell, counted from the axis."""
    return round(float(run.x[0]) / run.dx - 0.5)


def _profiles(runs: list["Run"], first: int, cells: int) -> dict[str, Variable]:
    """Return profiles and fields, by name, on the shared grid; those that no run has are left out."""
    record = {}
    snapshots = max(len(run.snapshot_time) for run in runs)
    for name, about in {**naming.PROFILES, **naming.FIELDS_2D}.items():
        kept = [getattr(run, name) for run in runs]
        if all(values is None for values in kept):
            continue
        axes = len(about.dims) - 2
        dtype = np.float32 if name in naming.FIELDS_2D else np.float64
        joined = np.full((len(runs), snapshots, *[cells] * axes), np.nan, dtype)
        for n, (run, values) in enumerate(zip(runs, kept, strict=True)):
            if values is not None:
                inside = slice(_offset(run) - first, _offset(run) - first + len(run.x))
                place: tuple[int | slice, ...] = (n, slice(len(values)), *[inside] * axes)
                joined[place] = values
        record[name] = _variable(name, joined)
    return record


def _variable(name: str, values: np.ndarray) -> Variable:
    """Return a variable with the dimensions, unit and long name of the naming table."""
    about = naming.NAMES[name]
    attrs = {"units": about.unit, "long_name": about.long_name}
    if values.dtype.kind == "f" and name not in ("x", "y", "front_threshold"):
        attrs["_FillValue"] = values.dtype.type(np.nan)
    return Variable(about.dims, values, attrs)


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
    joined = np.full((len(arrays), *arrays[0].shape[:-1], longest), np.nan)
    for row, array in zip(joined, arrays, strict=True):
        row[..., : array.shape[-1]] = array
    return joined
