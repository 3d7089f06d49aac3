"""From solved runs to the variables and attributes of a record: one layout for one run and for a batch."""

import json
import platform
from typing import NamedTuple

import numpy as np

import subslide
from subslide import naming, points
from subslide.keys import schema
from subslide.records import thinning
from subslide.study.choice import model_reason


class Variable(NamedTuple):
    """One variable of a record: names of its dimensions, its values and its attributes."""

    dims: tuple[str, ...]
    values: np.ndarray
    attrs: dict


PROVENANCE = (
    "scheme",
    "order",
    "model",
    "model_reason",
    "cells",
    "dtype",
    "status",
    "status_detail",
    "steps",
    "wall_seconds",
)
"""Variables that a record of a single run also states as attributes."""


def variables(runs: list) -> dict[str, Variable]:
    """Variables of a record by name. runs: results of `solver.solve` that share one cell size.

    Shorter runs are padded with NaN, very long ones thinned. Profiles lie on the union of the runs' grids, which match
    because cell centres are whole steps from (i + 1/2) dx.
    """
    runs = [thinning.thinned(run) for run in runs]
    first, x = _shared_grid(runs)
    found = {
        "front_threshold": _variable("front_threshold", np.array(naming.FRONT_THRESHOLDS)),
        "x": _variable("x", x),
    }
    found["x"].attrs["axis"] = "X"
    found["id"] = Variable(("run",), _text([run.point.id for run in runs]), {"long_name": "name of the run"})
    for key in points.RUN_KEYS:
        if key not in ("scene_options", "model", "snapshot_times", "fields"):
            found[key] = _parameter(key, [getattr(run.point, key) for run in runs])
    about = schema.properties()["scene_options"]["description"]
    for name, text, values in (
        ("scene_options", f"{about} (JSON)", [points.options_text(run.point) for run in runs]),
        ("model", "geometry that was solved", [run.model for run in runs]),
        ("model_reason", "why that geometry was solved", [model_reason(run.point) for run in runs]),
    ):
        found[name] = Variable(("run",), _text(values), {"long_name": text})
    found["dx"] = Variable(("run",), _column(runs, "dx"), {"units": "m", "long_name": "cell size"})
    for name in ("status", "status_detail"):
        text = {"status": "how the run ended", "status_detail": "what ended the run, in words"}[name]
        found[name] = Variable(("run",), _text([getattr(run, name) for run in runs]), {"long_name": text})
    found["status"].attrs["comment"] = "; ".join(f"{k}: {v}" for k, v in naming.STATUSES.items())
    for name in naming.SCALARS:
        found[name] = _variable(name, _column(runs, name))
    for name in ("time", *naming.SERIES):
        found[name] = _variable(name, _padded([getattr(run, name) for run in runs]))
    found["snapshot_time"] = _variable("snapshot_time", _padded([run.snapshot_time for run in runs]))
    found.update(_profiles(runs, first, len(x)))
    for name, variable in found.items():
        if variable.dims[:1] == ("run",) and name != "id":
            times = {"step": "time", "snapshot": "snapshot_time"}
            beside = [times[dim] for dim in variable.dims if times.get(dim, name) != name]
            variable.attrs["coordinates"] = " ".join(["id", *beside])
    if any(name in found for name in naming.FIELDS_2D):
        found["y"] = _variable("y", x)
        found["y"].attrs["axis"] = "Y"
    return found


def attributes(runs: list, found: dict[str, Variable]) -> dict:
    """Global attributes of a record: conventions, provenance and, for one run, its numerics and outcome."""
    import numba

    config = [points.to_dict(run.point) for run in runs]
    attrs = {
        "Conventions": "CF-1.11",
        "title": "Collapse of submerged granular columns",
        "source": f"subslide {subslide.__version__}, two-layer Savage-Hutter model with Coulomb friction",
        "history": f"written by subslide {subslide.__version__} (sources {subslide.source_hash()})",
        "comment": "time is elapsed time since release; sample 0 is the start, then one sample each time step, none"
        f" left out of runs of up to {thinning.LONGEST} samples; longer ones keep the first {thinning.HEAD} and then"
        " the extremes of every series in each of many blocks of steps; runs with fewer samples end in NaN",
        "version": subslide.__version__,
        "source_hash": subslide.source_hash(),
        "python_version": platform.python_version(),
        "numpy_version": np.__version__,
        "numba_version": numba.__version__,
        "machine": platform.machine(),
        "config": json.dumps(config[0] if len(config) == 1 else config, allow_nan=False),
    }
    if len(runs) == 1:
        attrs.update({name: found[name].values[0] for name in PROVENANCE})
    return attrs


def _shared_grid(runs: list) -> tuple[int, np.ndarray]:
    """Index of the first cell, and centres (m), of the grid that holds every run's."""
    dx = runs[0].dx
    if any(abs(run.dx - dx) > 1e-12 * dx for run in runs):
        raise ValueError("the runs of a record need one cell size")
    first = min(_offset(run) for run in runs)
    last = max(_offset(run) + len(run.x) for run in runs)
    return first, (np.arange(first, last) + 0.5) * dx


def _offset(run) -> int:
    return round(float(run.x[0]) / run.dx - 0.5)


def _profiles(runs: list, first: int, cells: int) -> dict[str, Variable]:
    """Profiles and fields, by name, on the shared grid; those that no run has are left out."""
    found = {}
    snapshots = max(len(run.snapshot_time) for run in runs)
    for name, field in {**naming.PROFILES, **naming.FIELDS_2D}.items():
        kept = [getattr(run, name) for run in runs]
        if all(values is None for values in kept):
            continue
        axes = len(field.dims) - 2
        dtype = np.float32 if name in naming.FIELDS_2D else np.float64
        joined = np.full((len(runs), snapshots, *[cells] * axes), np.nan, dtype)
        for n, (run, values) in enumerate(zip(runs, kept, strict=True)):
            if values is not None:
                inside = slice(_offset(run) - first, _offset(run) - first + len(run.x))
                joined[(n, slice(len(values)), *[inside] * axes)] = values
        found[name] = _variable(name, joined)
    return found


def _variable(name: str, values: np.ndarray) -> Variable:
    """Variable with the dimensions, unit and long name of the naming table."""
    tables = (
        naming.PARAMETERS,
        naming.SERIES,
        naming.PROFILES,
        naming.FIELDS_2D,
        naming.SCALARS,
        naming.COORDINATES,
    )
    field = next(table[name] for table in tables if name in table)
    attrs = {"units": field.unit, "long_name": field.long_name}
    if values.dtype.kind == "f" and name not in ("x", "y", "front_threshold"):
        attrs["_FillValue"] = values.dtype.type(np.nan)
    return Variable(field.dims, values, attrs)


def _parameter(key: str, values: list) -> Variable:
    """Variable (run) of a key of the configuration, described as the schema does."""
    if key in naming.PARAMETERS:
        return _variable(key, np.array(values, float))
    about = schema.properties()[key]
    attrs = {"long_name": about["description"]}
    if isinstance(values[0], str):
        return Variable(("run",), _text(values), attrs)
    if "unit" in about:
        attrs["units"] = about["unit"]
    if isinstance(values[0], int):
        return Variable(("run",), np.array(values, np.int32), attrs)
    return Variable(("run",), np.array([np.nan if v is None else v for v in values], float), attrs)


def _column(runs: list, name: str) -> np.ndarray:
    values = np.array([getattr(run, name) for run in runs])
    return values.astype(np.int32 if values.dtype.kind in "iu" else np.float64)


def _text(values: list[str]) -> np.ndarray:
    return np.array([str(value) for value in values], dtype=object)


def _padded(arrays: list[np.ndarray]) -> np.ndarray:
    """Arrays stacked along a new first axis, the last axis padded with NaN to the longest."""
    longest = max(array.shape[-1] for array in arrays)
    joined = np.full((len(arrays), *arrays[0].shape[:-1], longest), np.nan)
    for row, array in zip(joined, arrays, strict=True):
        row[..., : array.shape[-1]] = array
    return joined
