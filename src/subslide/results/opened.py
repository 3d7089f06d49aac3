"""Records as xarray opens them: whole, or one run of one."""

import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from subslide.files import RecordError
from subslide.keys.schema import ConfigError
from subslide.records import thinning
from subslide.results.listing import AGAIN

if TYPE_CHECKING:
    import xarray as xr


class NotKeptError(RecordError):
    """A record that is as it should be, but was made without the profiles that are asked for."""


def open_record(path: Path | str) -> "xr.Dataset":
    """Return the dataset of a record, lazy (dask), with times as plain seconds; ConfigError if its path cannot be."""
    import xarray as xr

    if "\\" in os.path.abspath(path):
        raise ConfigError(f"{path}: NetCDF takes '\\' for '/'; allowed: a path, and folders, without backslashes")
    return xr.open_dataset(path, engine="netcdf4", chunks={}, decode_times=False)


def trimmed(data: "xr.Dataset", name: str) -> "xr.Dataset":
    """Return one run of a record, without the padding that other runs of its batch need.

    Parameters
    ----------
    data
        Dataset of the record.
    name
        Id of the run.

    Returns
    -------
    xarray.Dataset
        The same without the dimension `run`, as lazy as it was. Cells of a run on a uniform grid are at `x` (x), whatever
        its record has; on a fitted one they move, `x` (snapshot, cell), and have a `cell_width`.

    Raises
    ------
    RecordError
        If the record lacks the run.
    """
    places = np.flatnonzero(data["id"].values == name)
    if not len(places):
        raise RecordError(f"{data.encoding.get('source', 'a record')}: the record lacks the run {name}; {AGAIN}")
    one = data.isel(run=int(places[0]))
    one = one.isel(step=slice(int(np.isfinite(one["time"].values).sum())))
    one = one.isel(snapshot=slice(int(np.isfinite(one["snapshot_time"].values).sum())))
    if along := [dim for dim in ("x", "y", "cell") if dim in one.dims]:
        inside = np.isfinite(one["h2"].isel(snapshot=0).values)
        one = one.isel(dict.fromkeys(along, inside))
    if "cell" in one.dims and str(one["grid"].values) == "uniform":
        one = one.assign_coords(x=one["x"].variable[0]).swap_dims(cell="x").drop_vars(["cell_width", "cell"])
    if one.attrs.get("keep") == "summary":
        one = one.load()
        time = one["time"].values
        one = one.assign({name: one[name].copy(data=thinning.filled(time, one[name].values)) for name in thinning.SUMMARY})
    return one


def positions(record: Any, snapshot: int) -> np.ndarray:
    """Return the centres of a run's cells at a snapshot.

    Parameters
    ----------
    record
        The run's record, or its variables by name, see `Results.record` and `Results.each`.
    snapshot
        Place of the snapshot; cells of a uniform grid are always at the same.

    Returns
    -------
    ndarray
        Distances (cells) in m from the axis.
    """
    x = np.asarray(record["x"])
    return x if x.ndim == 1 else x[snapshot]
