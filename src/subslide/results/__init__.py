"""A finished study for those who read it: its runs, their records run by run, and its tables."""

import csv
import functools
import math
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar, overload

import numpy as np

from subslide import catalogue
from subslide.keys.schema import ConfigError
from subslide.results import reading
from subslide.results.listing import Companion, Listing, StudyRun, listed, verify
from subslide.results.opened import NotKeptError, open_record, positions, trimmed  # noqa: F401

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr

MOST_BYTES = 250e6
"""Size of the records from which on a study is read in more than one go."""

Solved = TypeVar("Solved", bound=StudyRun | Companion)


class Results:
    """Read-only view of a study's folder.

    Parameters
    ----------
    folder
        Folder of a study that was run, such as `results/paper`.
    """

    def __init__(self, folder: Path | str):
        """Keep the folder; nothing is read before it is asked for."""
        self.folder = Path(folder)

    @functools.cached_property
    def runs_of_study(self) -> tuple[StudyRun, ...]:
        """Return the runs in the order of the tables; ConfigError if the folder is none of a study."""
        return self._listed.runs

    @functools.cached_property
    def companions(self) -> tuple[Companion, ...]:
        """Return the coarser runs that those on uniform grids have in a study with bands; none without."""
        return self._listed.companions

    @property
    def has_bands(self) -> bool:
        """Return whether the study was made with `bands: true`."""
        return self._listed.has_bands

    @property
    def asked(self) -> dict[str, Any]:
        """Return the study's configuration by key, as its file states it; empty for one of the version before."""
        return self._listed.asked

    @property
    def designs(self) -> tuple[dict[str, Any], ...]:
        """Return what points.json says of each Saltelli design: see `study.config.Study.designs`."""
        return self._listed.designs

    @functools.cached_property
    def _listed(self) -> Listing:
        """Return what points.json states."""
        return listed(self.folder)

    @overload
    def each(self, *names: str, among: None = None) -> Iterator[tuple[StudyRun, dict[str, Any]]]: ...

    @overload
    def each(self, *names: str, among: Iterable[Solved]) -> Iterator[tuple[Solved, dict[str, Any]]]: ...

    def each(
        self, *names: str, among: Iterable[StudyRun | Companion] | None = None
    ) -> Iterator[tuple[StudyRun | Companion, dict[str, Any]]]:
        """Give each run with variables of its record.

        Every batch is read and verified once, or, where the records are large, once for each of a few parts of the
        study, so that what is in memory stays small.

        Parameters
        ----------
        names
            Names of the variables; what a record lacks is left out.
        among
            Runs or companions to read; without it the runs of the study, in the order of its tables.

        Yields
        ------
        tuple
            The run, and its variables by name: NumPy arrays, text or numbers, without the dimension `run` and without
            the padding that other runs of its batch need.

        Raises
        ------
        RecordError
            If a record is missing or damaged, or lacks the run.
        """
        from subslide.records import by_run

        for part in self.parts(among):
            held: dict[str, dict[str, Any]] = {}
            for batch in dict.fromkeys(run.batch for run in part):
                ids = {run.id for run in part if run.batch == batch}
                path = self._record_path(batch)
                verify(path)
                held |= by_run.read(path, ids, names)
            yield from ((run, held[run.id]) for run in part)

    @overload
    def parts(self, among: None = None) -> Iterator[list[StudyRun]]: ...

    @overload
    def parts(self, among: Iterable[Solved] | None) -> Iterator[list[Solved]]: ...

    def parts(self, among: Iterable[StudyRun | Companion] | None = None) -> Iterator[list]:
        """Give runs in parts, in their order, so that the records of each take no more than MOST_BYTES."""
        runs = list(self.runs_of_study if among is None else among)
        paths = {self._record_path(run.batch) for run in runs}
        size = sum(path.stat().st_size for path in paths if path.exists())
        count = max(1, math.ceil(len(runs) / max(1, math.ceil(size / MOST_BYTES))))
        yield from (runs[first : first + count] for first in range(0, len(runs), count))

    def opened(self, batch: str) -> tuple[dict[str, Any], dict[str, Any]]:
        """Return the variables and attributes of the record of a batch, verified, see `records.netcdf.read`."""
        from subslide.records import netcdf

        verify(self._record_path(batch))
        return netcdf.read(self._record_path(batch))

    def values(self, *names: str) -> dict[str, np.ndarray]:
        """Return numbers and texts of every run, of whole batches at once.

        Every batch is read and verified once, and nothing else of it stays in memory.

        Parameters
        ----------
        names
            Names of variables that hold one value a run, or some, such as one for each threshold.

        Returns
        -------
        dict
            Arrays by name, whose first axis is the runs of the study in the order of its tables.

        Raises
        ------
        RecordError
            If a record is missing or damaged, or lacks a run or a variable.
        """
        from subslide.records import by_run

        places: dict[str, list[int]] = {}
        for place, run in enumerate(self.runs_of_study):
            places.setdefault(run.batch, []).append(place)
        columns: dict[str, np.ndarray] = {}
        for batch, those in places.items():
            path = self._record_path(batch)
            verify(path)
            part = by_run.values(path, [self.runs_of_study[place].id for place in those], names)
            for name, entries in part.items():
                if name not in columns:
                    columns[name] = np.empty((len(self.runs_of_study), *entries.shape[1:]), entries.dtype)
                columns[name][those] = entries
        return columns

    def record(self, name: str) -> "xr.Dataset":
        """Return the record of one run by its id, loaded, without the dimension `run` and without padding.

        Raises
        ------
        KeyError
            If the study has no such run.
        RecordError
            If its record is missing or damaged, or lacks the run.
        """
        for run in self.runs_of_study:
            if run.id == name:
                return trimmed(self.batch(run.batch), name).load()
        raise KeyError(f"{name}: there is no such run in {self.folder}")

    def profiles(self, name: str) -> "xr.Dataset":
        """Return `record` of a run; NotKeptError if its study did not keep profiles."""
        record = self.record(name)
        if "h2" not in record:
            raise NotKeptError(f"profiles, which the study did not keep: keep: {record.attrs['keep']}")
        return record

    def curves(self, quantity: str, ids: Iterable[str]) -> dict[str, tuple[np.ndarray, np.ndarray]]:
        """Return times (s) and samples of a quantity of the table of series, by id, of the runs among `ids` that have it.

        Of a large study only these are read.
        """
        path, wanted = self._table_path("series"), list(ids)
        if path.suffix == ".parquet":
            rows = reading.rows_of(path, quantity=[quantity], id=wanted)
        else:
            rows = self.series[(self.series["quantity"] == quantity) & self.series["id"].isin(wanted)]
        return {
            str(key): (those["time"].to_numpy(), those["value"].to_numpy())
            for key, those in rows.groupby("id", sort=False)
        }

    @functools.lru_cache(maxsize=64)  # noqa: B019 - a Results lives as long as its process
    def batch(self, batch: str) -> "xr.Dataset":
        """Return the record of a batch, verified once and then read lazily (dask)."""
        from subslide.records import netcdf

        path = self._record_path(batch)
        verify(path)
        netcdf.read(path)
        return open_record(path)

    def _record_path(self, batch: str) -> Path:
        """Return the path of the record of a batch."""
        return self.folder / "records" / f"{batch}.nc"

    def table(self, name: str) -> "pd.DataFrame":
        """Return a table of the study by its name, as it was last written.

        Raises
        ------
        ConfigError
            If the study's folder has no such table.
        RecordError
            If the table is not as it was written, or not that of this study.
        """
        return reading.table(self._table_path(name), name, self.runs_of_study)

    def lines(self, name: str) -> list[dict[str, str]]:
        """Return the rows of a table that is CSV as text by column; faults are those of `table`."""
        path = self._table_path(name)
        reading.table(path, name, self.runs_of_study)
        with open(path, newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def _table_path(self, name: str) -> Path:
        """Return the path of a table that is there."""
        paths = [self.folder / "tables" / f"{name}.{kind}" for kind in ("parquet", "csv")]
        for path in paths:
            if path.is_file():
                verify(path)
                return path
        raise ConfigError(
            f"{paths[-1]}: there is no such file; allowed: the folder of a study with this table"
        )

    @functools.cached_property
    def runs(self) -> "pd.DataFrame":
        """Return the table of runs, one row a run."""
        return self.table("runs")

    @functools.cached_property
    def series(self) -> "pd.DataFrame":
        """Return the tidy table of series: id, time (s), quantity, value."""
        return self.table("series")

    @functools.cached_property
    def bands(self) -> "pd.DataFrame":
        """Return the tidy table of bands, a row for each run, quantity and time; empty for a study without bands."""
        return self.table("bands") if self.has_bands else _empty("bands")

    @functools.cached_property
    def errors(self) -> "pd.DataFrame":
        """Return the table of errors against exact solutions, of a study that has any."""
        return self.table("errors")

    @functools.cached_property
    def work_precision(self) -> "pd.DataFrame":
        """Return the table of errors and seconds; empty for a study without a sweep of numerics."""
        try:
            return self.table("work_precision")
        except ConfigError:
            return _empty("work_precision")

    @functools.cached_property
    def atlas(self) -> "pd.DataFrame":
        """Return the stability atlas, one row a run, of a study that draws it."""
        return self.table("atlas")

    @functools.cached_property
    def cfl(self) -> "pd.DataFrame":
        """Return the Courant numbers that were tried, of a study that draws the atlas."""
        return self.table("cfl")

    def select(self, **values: Any) -> "pd.DataFrame":
        """Return the rows of the table of runs whose columns equal the given values; numbers to nine digits."""
        import pandas as pd

        chosen = np.ones(len(self.runs), bool)
        for column, value in values.items():
            entries = self.runs[column]
            number = pd.api.types.is_numeric_dtype(entries) and not isinstance(value, str)
            chosen &= (
                np.isclose(entries, value, rtol=1e-9, atol=1e-12) if number else (entries == value).to_numpy()
            )
        return self.runs[chosen]


def _empty(name: str) -> "pd.DataFrame":
    """Return a table without rows, by the columns of its module."""
    import pandas as pd

    return pd.DataFrame(columns=catalogue.layout(name).columns)
