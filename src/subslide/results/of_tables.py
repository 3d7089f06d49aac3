"""What a study's folder lists, and its tables as they were last written."""

import contextlib
import csv
import functools
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from subslide import catalogue
from subslide.files import RecordError
from subslide.keys.schema import ConfigError
from subslide.results import reading
from subslide.results.listing import Companion, Listing, StudyRun, listed, verify
from subslide.study import shown

if TYPE_CHECKING:
    import pandas as pd


class Tables:
    """Read-only view of a study's folder, but for its records.

    Parameters
    ----------
    folder
        Folder of a study that was run, such as `results/paper`.
    """

    def __init__(self, folder: Path | str):
        """Keep the folder; nothing is read before it is asked for."""
        self.folder = Path(folder)

    def __repr__(self) -> str:
        """Return the call that makes this; nothing is read."""
        return f"{type(self).__name__}({str(self.folder)!r})"

    def _repr_html_(self) -> str | None:
        """Return the study as a notebook shows it: axes, tables, and how runs ended as far as one says so."""
        try:
            runs = [(run.numerics, run.point) for run in self.runs_of_study]
        except (ConfigError, RecordError):
            return None  # so that it shows the line
        names = sorted(path.name for path in self.folder.glob("tables/*") if path.suffix != ".sha256")
        lines = [f"tables: {', '.join(names)}"] if names else []
        with contextlib.suppress(ConfigError, RecordError):
            counts = self.runs["status"].value_counts()
            lines.insert(0, ", ".join(f"{count:,} {status}" for status, count in counts.items()))
        return shown.page(str(self.folder), runs, lines)

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
    def keep(self) -> str:
        """Return what the study keeps of each run, one of `subslide.keys.kept.WORDS`."""
        return self._listed.keep

    @property
    def designs(self) -> tuple[dict[str, Any], ...]:
        """Return what points.json says of each Saltelli design: see `study.config.Study.designs`."""
        return self._listed.designs

    @functools.cached_property
    def _listed(self) -> Listing:
        """Return what points.json states."""
        return listed(self.folder)
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
        """Return the table of errors against exact solutions; empty for a study without any."""
        return self._or_empty("errors")

    @functools.cached_property
    def work_precision(self) -> "pd.DataFrame":
        """Return the table of errors and seconds; empty for a study without a sweep of numerics."""
        return self._or_empty("work_precision")

    def _or_empty(self, name: str) -> "pd.DataFrame":
        """Return a table, without rows where the study has none of it."""
        try:
            return self.table(name)
        except ConfigError:
            return _empty(name)

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

    def curves(self, quantity: str, ids: Iterable[str]) -> dict[str, tuple[np.ndarray, np.ndarray]]:
        """Return the series of some runs; of a large study no others are read.

        Parameters
        ----------
        quantity
            Name of the series in the table of series, such as ``max_abs_eta``.
        ids
            Ids of the runs.

        Returns
        -------
        dict
            Times (s) and values by the id of each run that has the series.
        """
        path, wanted = self._table_path("series"), list(ids)
        if not wanted:  # of no values Parquet cannot tell of which kind they are
            return {}
        if path.suffix == ".parquet":
            rows = reading.rows_of(path, quantity=[quantity], id=wanted)
        else:
            rows = self.series[(self.series["quantity"] == quantity) & self.series["id"].isin(wanted)]
        return {
            str(key): (those["time"].to_numpy(), those["value"].to_numpy())
            for key, those in rows.groupby("id", sort=False)
        }


def _empty(name: str) -> "pd.DataFrame":
    """Return a table without rows, by the columns of its module."""
    import pandas as pd

    return pd.DataFrame(columns=catalogue.layout(name).columns)
