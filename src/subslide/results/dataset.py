"""A whole study as one dataset, read lazily: by run, or by its axes."""

import math
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from subslide.files import RecordError
from subslide.keys import words
from subslide.keys.schema import ConfigError
from subslide.records import options
from subslide.records.variables import PARAMETERS, SOLVED
from subslide.results import scaled
from subslide.results.listing import AGAIN, StudyRun, verify
from subslide.results.of_tables import Tables
from subslide.results.opened import alike, are_on_one_grid, open_record

if TYPE_CHECKING:
    import xarray as xr

BY = ("run", "axes")
"""What a dataset of a study may be laid out by."""

ATTRS = ("Conventions", "title", "source")
"""Attributes that all records of a study share, and its dataset has."""

CHUNK = 64e6
"""Bytes of a variable that are read at once, where its first dimension can be parted into such."""

JOINED: dict[str, Any] = {
    "data_vars": "minimal",
    "coords": "minimal",
    "compat": "override",
    "join": "outer",
    "combine_attrs": "override",
}
"""How records are joined along `run`: what is longer in others ends in missing values."""


def open_study(folder: Path | str, by: str = "run", scaled_time: int | None = None) -> "xr.Dataset":
    """Return a finished study as one dataset, whose variables are read when they are asked for (dask).

    Parameters
    ----------
    folder
        Folder of the study, such as `results/paper`.
    by
        `run`: a dimension `run`, along which keys of the study are coordinates. `axes`: a dimension for each key in
        which runs differ, such as (a_H, r), of a study whose runs are a full grid of them.
    scaled_time
        Number of samples of a common scaled time, t / sqrt(R / (g a_2)), that series are laid on, see
        `results.scaled.on_common_time`; without it they have the samples of each run, at `time`.

    Returns
    -------
    xarray.Dataset
        The runs that points.json lists, failed ones too, in the order of their numbers. Where not all have profiles, or
        not on cells of one size, these lie along `cell`, at `x` (run, snapshot, cell), and there are no fields.

    Raises
    ------
    ConfigError
        If the folder is none of a study, an argument is not allowed, or the runs are no full grid.
    RecordError
        If the study is not finished, or a file of it is damaged.
    """
    import xarray as xr

    if by not in BY:
        raise ConfigError(f"by: {words.show(by)} is not allowed; allowed: {', '.join(BY)}")
    whole = isinstance(scaled_time, int | np.integer) and not isinstance(scaled_time, bool) and scaled_time > 1
    if scaled_time is not None and not whole:
        raise ConfigError(
            f"scaled_time: {words.show(scaled_time)} is not allowed; allowed: a whole number from 2, or None"
        )
    study = Tables(folder)
    runs = study.runs_of_study
    named = options.described(options.scenes_of([run.point for run in runs]))
    parts = _parts(Path(folder), runs)
    if not are_on_one_grid(parts):
        parts = [alike(part) for part in parts]
    parts = [_with_options(part, named) for part in parts]
    some = {str(name) for part in parts for name in part.coords if not all(name in other.coords for other in parts)}
    some -= {str(name) for part in parts for name in part.dims}
    parts = [part.reset_coords([name for name in some if name in part.coords]) for part in parts]
    data = xr.concat(parts, "run", **JOINED).set_coords(list(some)).sortby("run").drop_encoding()
    data.attrs = {name: data.attrs[name] for name in ATTRS} | {"study": Path(folder).resolve().name}
    labels = {run.id: run.numerics for run in runs}
    about = {"long_name": "named set of numerics that the study asked for"}
    data = data.assign_coords(numerics=("run", np.array([labels[name] for name in data["id"].values]), about))
    if scaled_time is not None:
        data = scaled.on_common_time(data, scaled_time)
    if by == "axes":
        data = _by_axes(data, ("numerics", *PARAMETERS, *named, *SOLVED))
    return data.assign({name: _evenly(values) for name, values in data.variables.items() if values.chunks})


def _parts(folder: Path, runs: tuple[StudyRun, ...]) -> list["xr.Dataset"]:
    """Return the runs of a study that each record holds; RecordError if one lacks some, or is not as it was written."""
    wanted: dict[str, list[str]] = {}
    for run in runs:
        wanted.setdefault(run.batch, []).append(run.id)
    paths = {batch: folder / "records" / f"{batch}.nc" for batch in sorted(wanted)}
    lacking = {batch: wanted[batch] for batch, path in paths.items() if not path.is_file()}
    if lacking:
        count, first = sum(map(len, lacking.values())), next(iter(lacking.values()))
        raise RecordError(
            f"{folder} is not finished: {count} of {len(runs)} runs have no record (batch"
            f" {words.cut(', '.join(lacking), 60)}: {words.cut(', '.join(first), 60)}); {AGAIN}"
        )
    return [_part(path, wanted[batch]) for batch, path in paths.items()]


def _part(path: Path, ids: list[str]) -> "xr.Dataset":
    """Return some runs of a record: what is of each run alone as it is, since it is small, and the rest as it is asked for."""
    verify(path)
    record = open_record(path, lazily=False)
    if "run" not in record.coords:
        raise RecordError(f"{path}: the record is of another version; {AGAIN}")
    known = {name: place for place, name in enumerate(record["id"].values)}
    if unknown := [name for name in ids if name not in known]:
        raise RecordError(f"{path}: the record lacks the run {unknown[0]}; {AGAIN}")
    if len(ids) < len(known):
        record = record.isel(run=sorted(known[name] for name in ids))
    parts = {}
    for name, variable in record.variables.items():
        if variable.dims in (("run",), ("run", "front_threshold")):
            values = variable.load()
            parts[name] = values.astype(str) if values.dtype.kind == "O" else values
        elif "run" in variable.dims:
            whole = {"y", "x"} if "y" in variable.dims else set(variable.dims)
            parts[name] = variable.chunk({dim: -1 if dim in whole else 1 for dim in variable.dims})
    record = record.assign(parts)
    return scaled.filled(record) if record.attrs.get("keep") == "summary" else record


def _with_options(record: "xr.Dataset", named: Mapping[str, tuple[str, bool]]) -> "xr.Dataset":
    """Return a record with a coordinate for each option of the study's scenes."""
    count = record.sizes["run"]
    lacking = {
        name: ("run", np.full(count, np.nan if number else ""), {"long_name": about})
        for name, (about, number) in named.items()
        if name not in record.variables
    }
    return record.assign_coords(lacking).set_coords(list(named))


def _by_axes(data: "xr.Dataset", keys: tuple[str, ...]) -> "xr.Dataset":
    """Return the dataset of a study with a dimension for each key in which its runs differ, in the order of the keys.

    A key that follows from those before it, such as the cells of a set of numerics, is no axis. `run` holds the numbers
    of the runs; along an axis `t_end` a run to rest is at infinity. ConfigError if the runs are no full grid.
    """
    count = data.sizes["run"]
    levels: dict[str, np.ndarray] = {}
    places: dict[str, np.ndarray] = {}
    cells = np.zeros(count, int)
    for key in keys:
        values = data[key].values
        values = np.nan_to_num(values, nan=np.inf) if values.dtype.kind == "f" else values
        known, place = np.unique(values, return_inverse=True)
        finer = np.unique(cells * len(known) + place, return_inverse=True)[1]
        if finer.max() > cells.max():
            cells, levels[key], places[key] = finer, known, place
    shape = tuple(map(len, levels.values()))
    if math.prod(shape) != count or cells.max() + 1 != count:
        grid = " x ".join(f"{len(known)} {key}" for key, known in levels.items()) or "1"
        raise ConfigError(f"by: axes is not allowed: {count} runs are no full grid of {grid}; allowed: run")
    order = np.lexsort([*reversed(places.values())]) if places else np.arange(count)
    data = data.isel(run=order)
    made: dict[str, Any] = {}
    for name, variable in data.variables.items():
        if "run" not in variable.dims or name in levels:
            made[name] = variable
            continue
        rest = [dim for dim in variable.dims if dim != "run"]
        values = variable.transpose("run", *rest).data
        if name in (*keys, "scene_options"):
            made[name] = _along(values.reshape(shape), tuple(levels), variable.attrs)
        else:
            made[name] = ((*levels, *rest), values.reshape((*shape, *values.shape[1:])), variable.attrs)
    made |= {key: (key, known, data[key].attrs) for key, known in levels.items()}
    coords = {name: made.pop(name) for name in data.coords}
    return type(data)(made, coords, data.attrs)


def _evenly(variable: "xr.Variable") -> "xr.Variable":
    """Return a lazy variable in even parts along its first dimension, as formats with chunks need them."""
    longest = variable.shape[0] if variable.ndim else 1
    part = max(1, min(longest, int(CHUNK / max(1, variable.nbytes / max(1, longest)))))
    return variable.chunk({dim: -1 if n else part for n, dim in enumerate(variable.dims)})


def _along(values: np.ndarray, axes: tuple[str, ...], attrs: Mapping[str, Any]) -> tuple:
    """Return the dimensions, values and attributes of a coordinate, without the axes along which it does not change."""
    kept = list(axes)
    for n in reversed(range(values.ndim)):
        first = np.take(values, [0], axis=n)
        same = values == first
        if values.dtype.kind == "f":
            same |= np.isnan(values) & np.isnan(first)
        if np.all(same):
            values = np.take(values, 0, axis=n)
            del kept[n]
    return kept, values, attrs
