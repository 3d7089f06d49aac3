"""From a table's module to its files: whole or not there, and the same bytes for the same results."""

import contextlib
import csv
import io
import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from numbers import Integral, Real
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from subslide import checksums, source_hash, tables
from subslide.files import replacing, write_text
from subslide.study import outputs, whole_study
from subslide.study.config import Study

if TYPE_CHECKING:
    from subslide.results import Results

LINES = 2000
"""Lines of a table that are made at once."""

SPECIAL = re.compile('[,"\r\n]')
"""What an entry of CSV is quoted for, or may be."""


def lacking(name: str, results: "Results") -> str:
    """Return '' if a finished study is to have a table, else words for what it lacks.

    Parameters
    ----------
    name
        Name of the table.
    results
        The study. It does not state the figures that were asked for: those count that its runs allow.

    Returns
    -------
    str
        What the table's `needs` returns.
    """
    runs = results.runs_of_study
    kinds = {one["kind"] for one in results.designs}
    figures = whole_study.figures_of("auto", [run.point for run in runs], kinds)
    named = tuple((run.numerics, run.point) for run in runs)
    study = Study(results.folder.name, figures, named, results.has_bands, results.asked, results.designs)
    return tables.load(name).needs(study)


def write(name: str, results: "Results") -> list[Path]:
    """Write a table of a study.

    Parameters
    ----------
    name
        One of the modules of `subslide.tables`.
    results
        The study; its folder gets the files.

    Returns
    -------
    list of Path
        The files, which replace those of the table from before, in whatever format.

    Raises
    ------
    ConfigError
        If there is no such table, or the study has none of it.
    RecordError
        If a record that the table is made from is damaged.
    """
    module = tables.load(name)
    folder = results.folder / "tables"
    points = [run.point for run in results.runs_of_study]
    paths = [folder / file for file in tables.files(name, points, results.keep)]
    outputs.check_made([*paths, *map(checksums.beside, paths)], results.folder)
    if hasattr(module, "write"):
        folder.mkdir(exist_ok=True)
        with replacing(paths[0]) as temporary:
            module.write(temporary, results)
    elif hasattr(module, "columns"):
        columns = module.columns(results)
        chosen = {paths[0].name: list(tables.columns(name, points))}
        chosen |= {file: pick(columns) for file, pick in getattr(module, "BESIDE", {}).items()}
        folder.mkdir(exist_ok=True)
        with contextlib.ExitStack() as stack:
            temporaries = [stack.enter_context(replacing(folder / file)) for file in chosen]
            written = [
                stack.enter_context(open(path, "w", encoding="utf-8", newline="")) for path in temporaries
            ]
            for parts in csv_parts(columns, list(chosen.values())):
                for file, part in zip(written, parts, strict=True):
                    file.write(part)
    else:
        rows = module.table(results)
        rows = rows.to_dict("records") if hasattr(rows, "to_dict") else list(rows)
        folder.mkdir(exist_ok=True)
        write_text(paths[0], csv_text(module.COLUMNS, rows, getattr(module, "FLOAT_FORMAT", "")))
        if len(paths) > 1:
            write_text(paths[1], module.html(rows))
    remove(name, results.folder, but=paths)
    for path in paths:
        checksums.seal(path, sources=source_hash("table", name))
    return paths


def remove(name: str, folder: Path, but: Iterable[Path] = ()) -> None:
    """Remove the files of a table from a study's folder.

    Parameters
    ----------
    name
        Name of the table.
    folder
        Folder of the study.
    but
        Files that stay.
    """
    for path in (folder / "tables").glob(f"{name}.*"):
        if path not in but:
            path.unlink(missing_ok=True)


def csv_text(columns: Iterable[str], rows: list[dict], float_format: str = "") -> str:
    """Return a table as CSV.

    Parameters
    ----------
    columns
        Names of the columns.
    rows
        Entries by column; what is None, not a number or left out stays empty.
    float_format
        Format of numbers, such as '%.10g', in columns that hold nothing else and not only whole ones; '' for all
        digits.

    Returns
    -------
    str
        Lines that end in a line feed, the names first.
    """
    entries = {name: [row.get(name) for row in rows] for name in columns}
    return "".join(part for (part,) in csv_parts(entries, [list(entries)], float_format))


def csv_parts(
    columns: Mapping[str, Sequence | np.ndarray], chosen: Sequence[Sequence[str]], float_format: str = ""
) -> Iterator[tuple[str, ...]]:
    """Give tables of some columns each as CSV in parts of some lines; each entry is made into text once.

    Parameters
    ----------
    columns
        Entries of each column by its name, equally many.
    chosen
        Names of the columns of each table.
    float_format
        As in `csv_text`.

    Yields
    ------
    tuple of str
        Of each table lines that end in a line feed, the names first.
    """
    number = float_format.__mod__ if float_format else repr
    needed = dict.fromkeys(name for names in chosen for name in names)
    written = {name: _writer_of(columns[name], number) for name in needed}
    count = max((len(columns[name]) for name in needed), default=0)
    yield tuple(",".join(map(_quoted, names)) + "\n" for names in chosen)
    for first in range(0, count, LINES):
        texts = {name: list(write(slice(first, first + LINES))) for name, write in written.items()}
        yield tuple(
            "\n".join(map(",".join, zip(*(texts[name] for name in names), strict=True))) + "\n"
            for names in chosen
        )


def _writer_of(
    entries: Sequence | np.ndarray, number: Callable[[float], str]
) -> Callable[[slice], Iterable[str]]:
    """Return a function that gives part of a column as texts: a whole number is one only where all are."""
    if isinstance(entries, np.ndarray) and entries.dtype.kind == "f":
        return lambda part: ["" if entry != entry else number(entry) for entry in entries[part].tolist()]
    values: list = entries.tolist() if isinstance(entries, np.ndarray) else list(entries)
    kinds = set(map(type, values))
    if kinds == {str}:
        return lambda part: _all_quoted(values[part])
    if kinds == {type(None)}:
        return lambda part: [""] * len(values[part])
    if kinds == {int}:
        return lambda part: map(str, values[part])
    if kinds == {float}:
        texts = _Texts(number)
        return lambda part: map(texts.__getitem__, values[part])
    known = [entry for entry in values if not _missing(entry)]
    if not all(isinstance(entry, Real) and not isinstance(entry, bool) for entry in known):
        return lambda part: ["" if _missing(entry) else _quoted(str(entry)) for entry in values[part]]
    if len(known) == len(values) and all(isinstance(entry, Integral) for entry in known):
        return lambda part: [str(int(entry)) for entry in values[part]]
    return lambda part: ["" if _missing(entry) else number(float(entry)) for entry in values[part]]


class _Texts(dict[float, str]):
    """Texts of numbers, each made once for those of a column of few; 0.0 and -0.0 are one key, and are made anew."""

    def __init__(self, number: Callable[[float], str]) -> None:
        """Keep the function that makes them."""
        super().__init__()
        self.number = number

    def __missing__(self, entry: float) -> str:
        """Return the text of a number, '' for what is none."""
        text = "" if entry != entry else self.number(entry)
        if entry and len(self) < LINES:
            self[entry] = text
        return text


def _all_quoted(texts: list[str]) -> list[str]:
    """Return texts as entries of CSV."""
    return [_quoted(text) for text in texts] if SPECIAL.search("\0".join(texts)) else texts


def _quoted(text: str) -> str:
    """Return a text as an entry of CSV, as the library would write it."""
    if not SPECIAL.search(text):
        return text
    line = io.StringIO()
    csv.writer(line, lineterminator="\n").writerow([text])
    return line.getvalue()[:-1]


def _missing(entry: object) -> bool:
    """Return whether an entry is None or not a number."""
    return entry is None or entry != entry
