"""Series of every run, tidy: a row for each sample of each quantity."""

import itertools
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from subslide import naming
from subslide.naming import FRONT_LABELS
from subslide.records import thinning
from subslide.study.config import Study

if TYPE_CHECKING:
    from subslide.results import Results

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

MOST_RUNS_IN_CSV = 1000
RUNS_IN_A_GROUP = 250
"""Runs whose rows are one group of a Parquet file."""


def about() -> str:
    """Return what the documentation says of the table: when it has which format, and its quantities."""
    quantities = "\n".join(
        f"- `{name}`{f' ({unit})' if unit else ''}: {meaning}" for name, (unit, meaning) in QUANTITIES.items()
    )
    return f"""One row a sample, and a sample each time step (of runs of more than {thinning.LONGEST} steps those that
keep every extreme; see docs/records.md). A quantity that a run lacks has no rows. Above {MOST_RUNS_IN_CSV} runs it is
`series.parquet` instead.

Quantities:

{quantities}"""


def needs(study: Study) -> str:
    """Return '' for every study."""
    return ""


def filename(runs: int) -> str:
    """Return the name of the file in a study of so many runs."""
    return "series.csv" if runs <= MOST_RUNS_IN_CSV else "series.parquet"


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
    """Write the table run by run: in a study of many runs as Parquet, else as CSV with ten digits."""
    many = filename(len(results.runs_of_study)) != "series.csv"
    (_write_parquet if many else _write_csv)(path, results)


def _write_csv(path: Path, results: "Results") -> None:
    """Write the table as CSV."""
    with open(path, "w", encoding="utf-8", newline="") as file:
        file.write(",".join(COLUMNS) + "\n")
        for name, time, values in samples(results):
            starts = [f"{name},{instant:.10g}," for instant in time.tolist()]
            for quantity, entries in values.items():
                ends = ("" if value != value else f"{value:.10g}" for value in entries.tolist())
                file.writelines(f"{start}{quantity},{end}\n" for start, end in zip(starts, ends, strict=True))


def _write_parquet(path: Path, results: "Results") -> None:
    """Write the table as Parquet."""
    import pyarrow as pa
    import pyarrow.parquet as pq

    layout = pa.schema(
        [("id", pa.string()), ("time", pa.float64()), ("quantity", pa.string()), ("value", pa.float64())]
    )
    with pq.ParquetWriter(path, layout) as writer:
        runs = samples(results)
        while group := list(itertools.islice(runs, RUNS_IN_A_GROUP)):
            columns = (
                [name for name, time, values in group for _ in range(len(time) * len(values))],
                np.concatenate([np.tile(time, len(values)) for _, time, values in group]),
                [quantity for _, time, values in group for quantity in values for _ in range(len(time))],
                np.concatenate([entries for _, _, values in group for entries in values.values()]),
            )
            writer.write_table(pa.table(dict(zip(COLUMNS, columns, strict=True)), schema=layout))
