"""A finished study for those who read it: its tables as pandas, its records as xarray, opened lazily."""

import functools
import json
from pathlib import Path

import numpy as np
import pandas as pd
import xarray as xr

from subslide.keys.schema import ConfigError
from subslide.records import netcdf as records
from subslide.tables import bands


class Results:
    """Read-only view of a study's folder, such as results/paper."""

    def __init__(self, folder: Path | str):
        self.folder = Path(folder)

    @functools.cached_property
    def points(self) -> list[dict]:
        """Runs in the order of the tables: id, batch, label of the numerics, and every key of the point."""
        return self._index["points"]

    @functools.cached_property
    def companions(self) -> list[dict]:
        """Coarser runs of a study with bands: id, the run it is a companion `of`, its role, batch, and every key."""
        return self._index.get("companions", [])

    @functools.cached_property
    def _index(self) -> dict:
        """What points.json holds."""
        path = self.folder / "points.json"
        try:
            return json.loads(path.read_text(encoding="utf-8"))
        except FileNotFoundError:
            raise ConfigError(
                f"{path}: there is no such file; allowed: the folder of a study that was run"
            ) from None

    @functools.cached_property
    def runs(self) -> pd.DataFrame:
        """Table of runs (tables/runs.csv), one row a run."""
        return pd.read_csv(self.folder / "tables" / "runs.csv")

    @functools.cached_property
    def series(self) -> pd.DataFrame:
        """Tidy table of series: id, time (s), quantity, value."""
        parquet = self.folder / "tables" / "series.parquet"
        return pd.read_parquet(parquet) if parquet.exists() else pd.read_csv(parquet.with_suffix(".csv"))

    @functools.cached_property
    def bands(self) -> pd.DataFrame:
        """Tidy table of bands (tables/bands.csv): a row for each run, quantity and time; empty without bands."""
        path = self.folder / "tables" / "bands.csv"
        return pd.read_csv(path) if path.exists() else pd.DataFrame(columns=list(bands.COLUMNS))

    @functools.cached_property
    def errors(self) -> pd.DataFrame:
        """Table of errors against exact solutions (tables/errors.csv), of a study that has any."""
        return pd.read_csv(self.folder / "tables" / "errors.csv")

    @functools.cached_property
    def work_precision(self) -> pd.DataFrame:
        """Table of errors and seconds (tables/work_precision.csv); empty for a study without a sweep of numerics."""
        path = self.folder / "tables" / "work_precision.csv"
        return pd.read_csv(path) if path.exists() else pd.DataFrame()

    @functools.cached_property
    def atlas(self) -> pd.DataFrame:
        """Stability atlas (tables/atlas.csv), one row a run, of a study that draws it."""
        return pd.read_csv(self.folder / "tables" / "atlas.csv", keep_default_na=False, na_values=[""])

    @functools.cached_property
    def cfl(self) -> pd.DataFrame:
        """Courant numbers tried (tables/cfl.csv), of a study that draws the atlas."""
        return pd.read_csv(self.folder / "tables" / "cfl.csv")

    def select(self, **values) -> pd.DataFrame:
        """Rows of the table of runs whose columns equal the given values; numbers to nine digits."""
        chosen = np.ones(len(self.runs), bool)
        for column, value in values.items():
            entries = self.runs[column]
            number = pd.api.types.is_numeric_dtype(entries) and not isinstance(value, str)
            chosen &= (
                np.isclose(entries, value, rtol=1e-9, atol=1e-12) if number else (entries == value).to_numpy()
            )
        return self.runs[chosen]

    def record(self, name: str) -> xr.Dataset:
        """Record of one run by its id, loaded, without the dimension `run` and without padding."""
        for row in self.points:
            if row["id"] == name:
                return trimmed(self.batch(row["batch"]), name).load()
        raise KeyError(f"{name}: there is no such run in {self.folder}")

    @functools.lru_cache(maxsize=64)  # noqa: B019 - a Results lives as long as its process
    def batch(self, batch: str) -> xr.Dataset:
        """Record of a batch, verified once and then read lazily (dask)."""
        path = self.folder / "records" / f"{batch}.nc"
        records.read(path)
        return open_record(path)


def open_record(path: Path | str) -> xr.Dataset:
    """Dataset of a record, lazy (dask), with times as plain seconds."""
    return xr.open_dataset(path, engine="netcdf4", chunks={}, decode_times=False)


def trimmed(data: xr.Dataset, name: str) -> xr.Dataset:
    """The run called `name` of a record, without the padding that other runs of its batch need."""
    place = int(np.flatnonzero(data["id"].values == name)[0])
    one = data.isel(run=place)
    one = one.isel(step=slice(int(np.isfinite(one["time"].values).sum())))
    if "x" in one.dims:
        snapshots = int(np.isfinite(one["snapshot_time"].values).sum())
        inside = np.isfinite(one["h2"].isel(snapshot=0).values)
        one = one.isel(snapshot=slice(snapshots), **{dim: inside for dim in ("x", "y") if dim in one.dims})
    return one
