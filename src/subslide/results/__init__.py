"""A finished study for those who read it: its runs, their records run by run, and its tables."""

import functools
import math
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar, overload

import numpy as np

from subslide.results.listing import Companion, StudyRun, verify
from subslide.results.of_tables import Tables
from subslide.results.opened import NotKeptError, alike, open_record, positions, trimmed  # noqa: F401

if TYPE_CHECKING:
    import xarray as xr

MOST_BYTES = 250e6
"""Size of the records from which on a study is read in more than one go."""

Solved = TypeVar("Solved", bound=StudyRun | Companion)


class Results(Tables):
    """Read-only view of a study's folder.

    Parameters
    ----------
    folder
        Folder of a study that was run, such as `results/paper`.
    """

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
        paths = map(self._record_path, {run.batch for run in runs})
        size = sum(path.stat().st_size for path in paths if path.exists())
        count = max(1, math.ceil(len(runs) / max(1, math.ceil(size / MOST_BYTES))))
        yield from (runs[first : first + count] for first in range(0, len(runs), count))

    def opened(self, batch: str, *names: str) -> tuple[dict[str, Any], dict[str, Any]]:
        """Return variables of the record of a batch, as `records.netcdf.read` does, with its file verified.

        Parameters
        ----------
        batch
            Name of the batch.
        names
            Names of the variables.

        Returns
        -------
        tuple of dict
            Variables by name, and attributes.
        """
        from subslide.records import netcdf

        verify(self._record_path(batch))
        return netcdf.read(self._record_path(batch), names, vouched=True)

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

    @functools.lru_cache(maxsize=64)  # noqa: B019 - a Results lives as long as its process
    def batch(self, batch: str) -> "xr.Dataset":
        """Return the record of a batch, verified once and then read lazily (dask)."""
        from subslide.records import netcdf

        path = self._record_path(batch)
        verify(path)
        netcdf.read(path, names=())
        return open_record(path)

    def _record_path(self, batch: str) -> Path:
        """Return the path of the record of a batch."""
        return self.folder / "records" / f"{batch}.nc"
