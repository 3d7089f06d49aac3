"""Series of every run, tidy: a row for each sample of each quantity."""

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from subslide import naming
from subslide.naming import FRONT_LABELS
from subslide.records import thinning
from subslide.study import cost
from subslide.study.config import Study

if TYPE_CHECKING:
    from subslide.points import Point
    from subslide.records.variables import Variable
    from subslide.results import Results, StudyRun

TITLE = "Series"
READS = ("records",)
COLUMNS = {
    "id": ("", "name of the run"),
    "time": ("s", "elapsed time since release"),
    "quantity": ("", "what was sampled, see above"),
    "value": ("", "its value, in the unit of the quantity"),
}
WORDS = ("id", "quantity")
QUANTITIES = {
    **{f"x_front_{t}": ("m", f"x_front at the {t[:-2]} % front") for t in FRONT_LABELS},
    **{
        name: ("" if field.unit == "1" else field.unit, field.long_name)
        for name, field in naming.SERIES.items()
        if name != "x_front"
    },
}
"""Unit and meaning of each quantity."""

FRONTS = {f"x_front_{label}": n for label, n in FRONT_LABELS.items()}
"""Place of each threshold by the name of its quantity."""

MOST_CSV = 100e6
"""Estimated bytes from which on the table is Parquet."""

CSV_BYTES = 6.2
"""Bytes of CSV for each that the series are estimated at: what the paper's study has."""

RUNS_IN_A_GROUP = 1000
"""Runs whose rows are one group of a Parquet file."""


def about() -> str:
    """Return what the documentation says of the table: when it has which format, and its quantities."""
    quantities = "\n".join(
        f"- `{name}`{f' ({unit})' if unit else ''}: {meaning}" for name, (unit, meaning) in QUANTITIES.items()
    )
    return f"""One row a sample, and a sample each time step (of runs of more than {thinning.LONGEST} steps those that
keep every extreme; see docs/records.md). A quantity that a run lacks has no rows. Where CSV would take more than some
{MOST_CSV / 1e6:g} MB, such as of 40 resolved runs, it is `series.parquet` instead. Of runs of which a summary is kept
that has for each quantity samples of its own, between which straight lines give the others.

Quantities:

{quantities}"""


def needs(study: Study) -> str:
    """Return '' for every study."""
    return ""


def filename(points: Sequence["Point"], keep: str) -> str:
    """Return the name of the file in a study of such runs: by the size that it would have as CSV."""
    form, size = "summary" if keep == "summary" else "series", 0.0
    for point in points:
        size += CSV_BYTES * cost.of(point).kept(form)
        if size > MOST_CSV:
            return "series.parquet"
    return "series.csv"


def table(results: "Results") -> Iterator[dict]:
    """Give the rows, by column, in the order of the runs."""
    for name, time, values in samples(results):
        for quantity, entries in values.items():
            for instant, value in zip(time, entries, strict=True):
                yield {"id": name, "time": instant, "quantity": quantity, "value": value}


def samples(results: "Results") -> Iterator[tuple[str, np.ndarray, dict[str, np.ndarray]]]:
    """Give each run's id, times (s) and samples by quantity; quantities it lacks are left out."""
    for run, record in results.each("time", *naming.SERIES):
        values = {f"x_front_{label}": record["x_front"][n] for label, n in FRONT_LABELS.items()}
        values.update((name, record[name]) for name in QUANTITIES if name in record)
        known = {name: entries for name, entries in values.items() if np.isfinite(entries).any()}
        yield run.id, record["time"], known


def write(path: Path, results: "Results") -> None:
    """Write the table run by run: if it is large as Parquet, else as CSV with ten digits."""
    name = filename([run.point for run in results.runs_of_study], results.keep)
    (_write_csv if name == "series.csv" else _write_parquet)(path, results)


def _write_csv(path: Path, results: "Results") -> None:
    """Write the table as CSV."""
    with open(path, "w", encoding="utf-8", newline="") as file:
        file.write(",".join(COLUMNS) + "\n")
        for name, time, values in samples(results):
            starts = [f"{name},{instant:.10g}," for instant in time.tolist()]
            for quantity, entries in values.items():
                ends = ("" if value != value else f"{value:.10g}" for value in entries.tolist())
                file.writelines(f"{start}{quantity},{end}\n" for start, end in zip(starts, ends, strict=True))


class Flat(NamedTuple):
    """Samples of some runs in one row: their times and values, and where those of each run begin and end.

    Attributes
    ----------
    time, value
        Run by run, and of each quantity by quantity, as in QUANTITIES.
    counts
        How many they are, by the id of the run (quantities).
    start
        Where they begin, by the id of the run.
    """

    time: np.ndarray
    value: np.ndarray
    counts: dict[str, np.ndarray]
    start: dict[str, int]


def flattened(variables: "Mapping[str, Variable]", ids: Sequence[str], thinned: bool) -> Flat:
    """Return the samples of some runs of a record.

    Parameters
    ----------
    variables
        The record's, by name.
    ids
        Ids of the runs.
    thinned
        Whether it is a summary, where what is missing is no sample.

    Returns
    -------
    Flat
        Samples of the quantities that a run has.
    """
    known = {name: place for place, name in enumerate(variables["id"].values)}
    places = [known[name] for name in ids]
    time = variables["time"].values[places]
    values = np.full((len(places), len(QUANTITIES), time.shape[1]), np.nan, time.dtype)
    for n, name in enumerate(QUANTITIES):
        if name in FRONTS:
            values[:, n] = variables["x_front"].values[places, FRONTS[name]]
        elif name in variables:
            values[:, n] = variables[name].values[places]
    there = np.logical_not(np.isnan(values)) if thinned else np.isfinite(time)[:, None]
    taken = np.logical_and(there, np.any(np.isfinite(values), axis=2, keepdims=True))
    values[np.isinf(values)] = np.nan
    counts = taken.sum(axis=2)
    ends = np.cumsum(counts.sum(axis=1))
    return Flat(
        np.broadcast_to(time[:, None], values.shape)[taken],
        values[taken],
        dict(zip(ids, counts, strict=True)),
        dict(zip(ids, [0, *ends.tolist()], strict=False)),
    )


def _write_parquet(path: Path, results: "Results") -> None:
    """Write the table as Parquet: of a summary the samples that each quantity has of its own."""
    import pyarrow as pa
    import pyarrow.parquet as pq

    layout = pa.schema(
        [("id", pa.string()), ("time", pa.float64()), ("quantity", pa.string()), ("value", pa.float64())]
    )
    names = pa.array(list(QUANTITIES))
    with pq.ParquetWriter(path, layout, compression="zstd") as writer:
        for part in results.parts():
            flat = {}
            for batch in dict.fromkeys(run.batch for run in part):
                variables, attrs = results.opened(batch, "id", "time", *naming.SERIES)
                ids = [run.id for run in part if run.batch == batch]
                flat[batch] = flattened(variables, ids, attrs.get("keep") == "summary")
            for first in range(0, len(part), RUNS_IN_A_GROUP):
                group = part[first : first + RUNS_IN_A_GROUP]
                counts = np.stack([flat[run.batch].counts[run.id] for run in group])
                time, value = (
                    np.concatenate(each) for each in zip(*(_of(flat, run) for run in group), strict=True)
                )
                of_run = np.repeat(np.arange(len(group), dtype=np.int32), counts.sum(axis=1))
                of_name = np.repeat(
                    np.tile(np.arange(len(names), dtype=np.int32), len(group)), counts.ravel()
                )
                columns = {
                    "id": pa.DictionaryArray.from_arrays(of_run, pa.array([run.id for run in group])),
                    "time": time.astype(float),
                    "quantity": pa.DictionaryArray.from_arrays(of_name, names),
                    "value": value.astype(float),
                }
                writer.write_table(pa.table(columns).cast(layout))


def _of(flat: dict[str, Flat], run: "StudyRun") -> tuple[np.ndarray, np.ndarray]:
    """Return the times and values of a run."""
    samples = flat[run.batch]
    start = samples.start[run.id]
    part = slice(start, start + int(samples.counts[run.id].sum()))
    return samples.time[part], samples.value[part]
