"""The plan of a study: which batch solves which point, from what its folder holds. Nothing is written here.

The ledger of a study is the folder ``batches``: one file for each batch that was solved, ``NNNN.json``, or
``NNNNpK.json`` for what a job had solved when it was stopped, with whole points. A job writes it after its record, so
what was planned and never solved leaves no trace, and is planned anew. A batch keeps its name, and its record if that
is whole, was made by these sources and from this batch; else it is solved again for those of its points that are still
asked for.
"""

import collections
import json
import os
import re
from pathlib import Path
from typing import Any, NamedTuple

from subslide import checksums, source_hash
from subslide.checksums import text_hash
from subslide.files import RecordError
from subslide.keys import kept
from subslide.keys.schema import ConfigError
from subslide.points import Point, from_dict
from subslide.study import cost, numbering, pace, rows
from subslide.study.batches import MOST_BATCH_BYTES, Sharing, of_one_record, spec_text, split
from subslide.study.config import Study

NAME = re.compile(r"\d{4,9}(p\d{1,4})?")
"""Names of batches: numbers, and the parts of those that were stopped."""

FOLDERS = ("", "records", "batches", "tables", "figures", "logs", "benchmarks", "damaged")
"""Folders of a study, from its own."""

WHOLE = ("", False)
"""State of a record that is as its batch asks."""

OUTDATED = "were made by other sources"
"""Fault of a whole record that is not of these sources."""

POORER = "keep less of each run than is asked for"
"""Fault of a whole record of a poorer `keep` than the configuration says outright."""

VOUCHED = ("", POORER)
"""Faults, or none, of records that were made of their batch's file by these sources."""


class Batch(NamedTuple):
    """One batch of a plan.

    Attributes
    ----------
    name
        Its name.
    points
        Points of the study that it holds.
    digest
        Hash of the text that states it.
    text
        That text if the batch is to be solved, else ''.
    fault
        Why it is to be solved though the ledger has it, or ''.
    damaged
        Whether it has a record whose bytes have changed.
    """

    name: str
    points: tuple[Point, ...]
    digest: str
    text: str = ""
    fault: str = ""
    damaged: bool = False


class Plan(NamedTuple):
    """Name of a study, what it keeps of each run, batches that hold its points by name, the text of points.json.

    And the number of a run that comes next, once those of its batches have theirs.
    """

    study: str
    keep: str
    batches: dict[str, Batch]
    points_text: str
    next_run: int

    @property
    def to_solve(self) -> dict[str, tuple[int, float]]:
        """Number of points, and estimated seconds, of each batch that is to be solved, by its name."""
        return {
            name: (len(batch.points), sum(cost.seconds(point, self.keep) for point in batch.points))
            for name, batch in self.batches.items()
            if batch.text
        }

    @property
    def faults(self) -> list[str]:
        """Lines on batches that are solved again: those of damaged or missing records, and how many are outdated."""
        again = [batch for batch in self.batches.values() if batch.fault]
        counts = collections.Counter(batch.fault for batch in again if batch.fault in (OUTDATED, POORER))
        return [
            *(f"{one.fault}: batch {one.name} is solved again" for one in again if one.fault not in counts),
            *(f"{count} batches {fault}: they are solved again" for fault, count in counts.items()),
        ]


def record_path(folder: Path, name: str) -> Path:
    """Return the path of the record of a batch.

    Parameters
    ----------
    folder
        Folder of the study.
    name
        Name of the batch.

    Returns
    -------
    Path
        Where the record is, or will be.
    """
    return folder / "records" / f"{name}.nc"


def plan(study: Study, folder: Path, cores: int = 2) -> Plan:
    """Return the plan of a study.

    Parameters
    ----------
    study
        The study.
    folder
        Its folder of results, which may be missing.
    cores
        How many jobs will work at the same time, which says how new points are shared out to them.

    Returns
    -------
    Plan
        Its batches: those whose records are whole, those to solve again, and those to solve.
    """
    asked = {point.id: point for point in study.solved}
    stated = {}
    next_run = numbering.kept(folder)
    for path in ledger_files(folder):
        if entry := _entry(path, record_path(folder, path.stem), asked, study.keep_at_least):
            stated[path.stem] = entry
            next_run = max(next_run, entry.first + entry.runs)
    owner: dict[str, str] = {}
    for name in sorted(stated, key=lambda name: (stated[name].state != WHOLE, name)):
        for id_ in stated[name].ids:
            owner.setdefault(id_, name)
    batches = {}
    for name, entry in stated.items():
        points = tuple(asked[id_] for id_ in entry.ids if owner[id_] == name)
        if points and entry.state == WHOLE:
            batches[name] = Batch(name, points, entry.digest)
        elif points:
            points = of_one_record(points, study.keep)
            again = bool(entry.first) and len(points) == entry.runs  # the same runs have the same numbers
            first = entry.first if again else next_run
            next_run += 0 if again else len(points)
            batches[name] = _to_solve(name, spec_text(points, study.keep, first), points, *entry.state)
    owner = {point.id: name for name, batch in batches.items() for point in batch.points}
    new = [point for point in asked.values() if point.id not in owner]
    sharing = Sharing(study.keep, study.batch_seconds, cores, pace.known())
    last = max((int(path.stem.partition("p")[0]) for path in ledger_files(folder)), default=0)
    for number, unsolved in enumerate(split(new, sharing), last + 1):
        text = spec_text(unsolved, study.keep, next_run)
        batches[f"{number:04d}"] = _to_solve(f"{number:04d}", text, tuple(unsolved))
        next_run += len(unsolved)
    owner |= {point.id: batch.name for batch in batches.values() for point in batch.points}
    return Plan(study.name, study.keep, dict(sorted(batches.items())), _index(study, owner), next_run)


def check_folders(folder: Path, home: Path) -> None:
    """Check that nothing else stands where a study has its folders.

    Parameters
    ----------
    folder, home
        The study's folder of results, and that within `.snakemake`.

    Raises
    ------
    ConfigError
        If something does, one line that says what to move; or if its path has a backslash.
    """
    for path in (folder.parent, *(folder / name for name in FOLDERS), *reversed(home.parents[:2]), home):
        if (path.exists() or path.is_symlink()) and not path.is_dir():
            raise ConfigError(f"{path} is a file where a folder of the study belongs: move it away")
    if "\\" in os.path.abspath(folder):  # the library of NetCDF takes it for a slash
        raise ConfigError(
            f"{os.path.abspath(folder)}: a backslash in the path of a study; allowed: any other character"
        )
    if (home / "alive").is_dir():
        raise ConfigError(f"{home / 'alive'} is a folder where a file belongs: move it away")


class _Entry(NamedTuple):
    """One file of the ledger: the ids that are asked for, in order, the hash of its bytes, and how its record is.

    And the number of its first run, 0 if it states none, and how many it has.
    """

    ids: list[str]
    digest: str
    state: tuple[str, bool]
    first: int
    runs: int


def _to_solve(
    name: str, text: str, points: tuple[Point, ...], fault: str = "", damaged: bool = False
) -> Batch:
    """Return a batch that is to be solved, with the text that states it."""
    return Batch(name, points, text_hash(text), text, fault, damaged)


def ledger_files(folder: Path) -> list[Path]:
    """Return the files of the ledger; backups and whatever else lies beside them are none.

    Parameters
    ----------
    folder
        Folder of the study.

    Returns
    -------
    list of Path
        The files, by name.
    """
    home = folder / "batches"
    entries = home.iterdir() if home.is_dir() else ()
    return sorted(path for path in entries if path.suffix == ".json" and NAME.fullmatch(path.stem))


def _entry(path: Path, record: Path, asked: dict[str, Point], keep: str) -> _Entry | None:
    """Return what a file of the ledger states, and how its record is; what that must keep of each run, or ''.

    A file that cannot be read, or states other values of a point than its id stands for, counts as not there: its
    points come anew. One that its record vouches for was written by these sources, with its ids.
    """
    try:
        if not path.is_file() or path.stat().st_size > MOST_BATCH_BYTES:
            return None
        text = path.read_text(encoding="utf-8")
        batch = json.loads(text)
        stated = {row["id"]: row for row in batch["points"]}
        ids = [id_ for id_ in stated if id_ in asked]
        kept_of_each = batch.get("keep", "all")
        digest = text_hash(text)
        state = _state(record, digest, POORER if kept.is_less(kept_of_each, keep) else "")
        shared = batch.get(rows.SHARED, {})
        first = batch.get(numbering.KEY, 0)
        if state[0] not in VOUCHED and not all(_states({**shared, **stated[id_]}, id_) for id_ in ids):
            return None
    except (OSError, ValueError, KeyError, TypeError, AttributeError, OverflowError, RecursionError):
        return None
    return _Entry(ids, digest, state, first if numbering.is_first(first, len(stated)) else 0, len(stated))


def _states(row: dict, id_: str) -> bool:
    """Return whether a row of the ledger states every key of a run, and the values that its id stands for."""
    values = {key: value for key, value in row.items() if key != "id"}
    return set(values) == rows.KEYS and from_dict(values).id == id_


def _state(record: Path, digest: str, poorer: str) -> tuple[str, bool]:
    """Return why a record does not hold what its batch states, by these sources, and whether its bytes changed.

    poorer: why a record that does is not enough, or ''.
    """
    try:
        notes = checksums.verify(record)
    except RecordError as error:
        return str(error), record.is_file()
    if notes.get("batch") != digest:
        return f"{record} was not made from this batch", False
    return (poorer if notes.get("sources") == source_hash() else OUTDATED), False


def _index(study: Study, owner: dict[str, str]) -> str:
    """Return the text of points.json: what was asked, the runs in the order of the tables and companions for bands.

    A companion states the id of its run (`of`) and its role; a point that is companion of two runs is there twice.
    """
    head: dict[str, Any] = {"study": study.name, "keep": study.keep, "asked": study.asked}
    if study.designs:
        head["designs"] = study.designs
    sections: dict[str, list] = {
        "points": [
            ({"id": point.id, "batch": owner[point.id], "numerics": label}, point)
            for label, point in study.runs
        ]
    }
    if study.bands:
        sections["companions"] = [
            ({"id": point.id, "of": run.id, "role": role, "batch": owner[point.id]}, point)
            for run, role, point in study.companions
        ]
    return rows.text(head, sections)
