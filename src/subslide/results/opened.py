"""Records as xarray opens them: whole, alike, or one run of one."""

import os
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from subslide.files import RecordError
from subslide.keys.schema import ConfigError
from subslide.records import options, thinning
from subslide.results.listing import AGAIN

if TYPE_CHECKING:
    import xarray as xr


class NotKeptError(RecordError):
    """A record that is as it should be, but was made without the profiles that are asked for."""


def open_record(path: Path | str, lazily: bool = True) -> "xr.Dataset":
    """Return the dataset of a record, with times as plain seconds.

    Parameters
    ----------
    path
        The record.
    lazily
        Whether its variables are lazy arrays (dask); else each is read whole when it is asked for.

    Returns
    -------
    xarray.Dataset
        The record.

    Raises
    ------
    ConfigError
        If NetCDF cannot open its path.
    """
    import xarray as xr

    if "\\" in os.path.abspath(path):
        raise ConfigError(f"{path}: NetCDF takes '\\' for '/'; allowed: a path, and folders, without backslashes")
    return xr.open_dataset(path, engine="netcdf4", chunks={} if lazily else None, decode_times=False)


def are_on_one_grid(records: Sequence["xr.Dataset"]) -> bool:
    """Return whether all records have profiles on uniform cells of one size, or none has any.

    Parameters
    ----------
    records
        Datasets of records.

    Returns
    -------
    bool
        False where joining them takes `alike`.
    """
    dims = {tuple(dim for dim in ("x", "cell") if dim in record.dims) for record in records}
    sizes = {size for record in records for size in np.unique(record["dx"].values).tolist()}
    return dims == {()} or (dims == {("x",)} and len(sizes) == 1)


def alike(record: "xr.Dataset") -> "xr.Dataset":
    """Return a record that can be joined with records of any grid, scene, `keep` or measure: profiles along `cell`.

    It is what `xarray.open_mfdataset` takes as `preprocess` for a study of unlike records.

    Parameters
    ----------
    record
        Dataset of a record.

    Returns
    -------
    xarray.Dataset
        The same with positions `x` (run, snapshot, cell) and widths `cell_width` (run, snapshot, cell) of cells, if it
        has profiles, and without fields of the plane. These, places of gauges and options of scenes are no coordinates,
        since other records may lack them.
    """
    import xarray as xr

    named = options.described(tuple(sorted({str(scene) for scene in record["scene"].values})))
    some = (*named, "gauge_x", "gauge_y", *(["x"] if "cell" in record.dims else ()))
    record = record.reset_coords([name for name in some if name in record.coords]).set_coords("snapshot_time")
    if "x" not in record.dims:
        return record
    sizes = {"run": record.sizes["run"], "snapshot": record.sizes["snapshot"], "cell": record.sizes["x"]}
    x, dx = record["x"].variable, record["dx"].variable.compute()
    fields = [name for name, variable in record.variables.items() if "y" in variable.dims]
    record = record.drop_vars(["x", *fields]).rename_dims(x="cell")
    places = {
        "x": xr.Variable("cell", x.values, x.attrs).set_dims(sizes),
        "cell_width": dx.set_dims(sizes).transpose(*sizes),
    }
    return record.assign(places).assign_coords(cell=np.arange(sizes["cell"], dtype=np.int32))


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
