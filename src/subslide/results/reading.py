"""Tables of a study as they are read: held against their module and the study's runs, whatever their checksum says."""

import operator
import os
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from subslide import catalogue
from subslide.files import RecordError
from subslide.keys import words
from subslide.naming import FINISHED
from subslide.keys.values import FLOATS, INTEGERS, RUN_KEYS, STANDS_FOR
from subslide.points import options_text
from subslide.results.listing import AGAIN, StudyRun

if TYPE_CHECKING:
    import pandas as pd

NUMBERS = frozenset((*FLOATS, *INTEGERS)) - set(STANDS_FOR)
"""Keys whose values are numbers alone."""

OF_EVERY_RUN = ("runs", "timing", "atlas", "series")
"""Tables with rows of every run, those of a run together, in the order of the study."""

MOST = 1e30
"""Size from which on no number of a run that ended well is one."""

MAY_BE_INFINITE = ("wave_free_until",)
"""Columns with times of what may never come."""


def table(path: Path, name: str, runs: Sequence[StudyRun]) -> "pd.DataFrame":
    """Return a table of a study.

    Parameters
    ----------
    path
        Its file, CSV or Parquet.
    name
        Its name.
    runs
        The study's runs.

    Returns
    -------
    pandas.DataFrame
        The table.

    Raises
    ------
    RecordError
        If the file is not that table of this study: one line.
    """
    import pandas as pd

    try:
        if path.suffix == ".parquet":
            rows = pd.read_parquet(path)
        else:
            with open(path, "rb") as file:
                file.seek(-min(1, path.stat().st_size), os.SEEK_END)
                if file.read() != b"\n":
                    raise ValueError("its last line is not whole")
            rows = pd.read_csv(path, keep_default_na=False, na_values=[""], low_memory=False)
        _check(rows, name, runs, even=path.suffix == ".csv")
    except (ValueError, TypeError, NotImplementedError, OSError) as error:
        what = words.cut(words.one_line(str(error)), 120)
        raise RecordError(f"{path} is not the table {name} of this study ({what}); {AGAIN}") from None
    return rows


def rows_of(path: Path, **wanted: list[str]) -> "pd.DataFrame":
    """Return the rows of a Parquet file whose columns have some of the values that are wanted; no others are held.

    Parameters
    ----------
    path
        The file.
    wanted
        Texts by column.

    Returns
    -------
    pandas.DataFrame
        The rows.

    Raises
    ------
    RecordError
        If the file is no such table: one line.
    """
    import pandas as pd

    filters = [(column, "in", values) for column, values in wanted.items()]
    try:
        return pd.read_parquet(path, filters=filters)
    except (ValueError, TypeError, KeyError, NotImplementedError, OSError) as error:
        what = words.cut(words.one_line(str(error)), 120)
        raise RecordError(f"{path} is not the table {path.stem} of this study ({what}); {AGAIN}") from None


def _check(rows: "pd.DataFrame", name: str, runs: Sequence[StudyRun], even: bool) -> None:
    """Raise a ValueError unless rows are those of a table of the study, as far as its module and the runs tell."""
    from pandas.api.types import is_numeric_dtype

    layout = catalogue.layout(name, tuple(run.point for run in runs))
    if list(rows.columns) != list(layout.columns):
        odd = [str(column) for column in rows.columns if column not in layout.columns]
        lacking = [column for column in layout.columns if column not in rows.columns]
        raise ValueError(f"columns: {', '.join((odd or lacking)[:2]) or 'their order'}")
    if len(rows) and rows.index[0] != 0:  # the names are fewer than the entries of a row
        raise ValueError("rows have more entries than there are columns")
    numbers = [column for column in layout.numbers if column not in RUN_KEYS or column in NUMBERS]
    for column in numbers:
        if len(rows) and not is_numeric_dtype(rows[column]):
            raise ValueError(f"{column}: not all entries are numbers")
    if "id" in rows:
        _check_ids(rows["id"], name, [run.id for run in runs])
    if name == "series":
        _check_samples(rows, even)
    if name == "runs":
        _check_runs(rows, runs, numbers)


def _check_ids(ids: "pd.Series", name: str, known: list[str]) -> None:
    """Raise a ValueError if there are rows of other runs than the study's, or fewer, or in another order."""
    if unknown := set(ids.dropna()) - set(known):
        raise ValueError(f"id: {min(map(str, unknown))} is no run of the study")
    first = ids[ids != ids.shift()] if name == "series" else ids
    if name in OF_EVERY_RUN and first.tolist() != known:
        raise ValueError("id: the rows are not those of each run of the study in order")


def _check_samples(rows: "pd.DataFrame", even: bool) -> None:
    """Raise a ValueError unless quantities have their samples together, at times that go on, and equally many if even."""
    changes = (rows["id"] != rows["id"].shift()) | (rows["quantity"] != rows["quantity"].shift())
    time = rows["time"].to_numpy()
    if not np.all((time >= 0) & (time < MOST) & (changes | (time >= np.roll(time, 1)))):
        raise ValueError("time: not all are times that follow each other")
    starts = np.flatnonzero(changes)
    parts = rows[["id", "quantity"]].iloc[starts].assign(count=np.diff(starts, append=len(rows)))
    uneven = parts.groupby("id")["count"].nunique() > 1
    if (even and uneven.any()) or parts.duplicated(["id", "quantity"]).any():
        raise ValueError("its quantities have not equally many samples, those of each together")


def _check_runs(rows: "pd.DataFrame", runs: Sequence[StudyRun], numbers: Sequence[str]) -> None:
    """Raise a ValueError unless rows have the values that the runs were asked with, and statuses and sizes that are."""
    for key in ("numerics", *RUN_KEYS):
        if key not in rows:
            continue
        asked = _asked(runs, key)
        given = rows[key]
        same = (
            np.isclose(given, asked, rtol=1e-9, atol=0)
            if key in NUMBERS
            else given.astype(str).to_numpy(object) == np.array(list(map(str, asked)), object)
        )
        if not np.all(same):
            run = runs[int(np.argmin(same))]
            raise ValueError(f"{key} of {run.id} is not what points.json states")
    ended = rows[rows["status"].isin(FINISHED)]
    for column in numbers:
        sizes = ended[column].abs()
        if column in MAY_BE_INFINITE:
            sizes = sizes[ended[column] < np.inf]
        if (sizes > MOST).any():
            raise ValueError(f"{column}: not all numbers are ones of a run that ended well")


def _asked(runs: Sequence[StudyRun], key: str) -> list[Any]:
    """Return what the table of runs has for a key, run by run."""
    if key == "numerics":
        return [run.numerics for run in runs]
    if key == "scene_options":
        return [options_text(run.point) for run in runs]
    stated = list(map(operator.attrgetter(f"point.{key}"), runs))
    return ["rest" if value is None else value for value in stated] if key == "t_end" else stated
