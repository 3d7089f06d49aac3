"""Batches of a study: which one solves which point, as a ledger on the disk.

The ledger only grows, so no solved point is ever solved again because of points that came later, and it is written by
the process that plans, never by its jobs.

Each batch is one file, `batches/NNNN.json`, with whole points; the union of the files is the ledger, and a
point that two of them hold belongs to the first.
"""

import json
import math
import os
import uuid
from collections.abc import Iterable
from pathlib import Path
from typing import NamedTuple

from subslide.files import file_hash, write_json
from subslide.keys import words
from subslide.keys.schema import ConfigError
from subslide.points import Point, to_dict
from subslide.study import checking, choice
from subslide.study.config import Study
from subslide.study.cost import disk as _bytes
from subslide.study.cost import seconds as cost
from subslide.study.yaml_files import read_text

SECONDS = (2.0, 60.0)
"""Least and greatest estimated cost of a batch: starting a process costs a second; a lost batch at most a minute."""

PARTS = 16
"""Batches that a set of new points makes if their cost allows it."""

MOST_POINTS, MOST_BYTES = 250, 256e6
"""Limits of one record."""

MOST_BATCH_BYTES = 100_000_000


class Plan(NamedTuple):
    """Kernels, as 'model:dtype[:general]', of each batch that a study's points are in, by the batch's name."""

    batches: dict[str, str]


class LedgerError(RuntimeError):
    """A ledger that lacks points, read by a process that may not extend it."""


def plan(study: Study, folder: Path, extend: bool) -> Plan:
    """Return the plan of a study.

    Parameters
    ----------
    study
        The study.
    folder
        Its folder of results.
    extend
        Whether new points get batches, and `points.json` states the runs and their order; only the process that plans
        may do so.

    Returns
    -------
    Plan
        The batches that hold the study's points.

    Raises
    ------
    LedgerError
        If a point is in no batch and the ledger may not be extended.
    """
    owner, kernels = read(folder)
    solved = study.solved
    new = [point for point in solved if point.id not in owner]
    if new and not extend:
        raise LedgerError(f"{folder}: {len(new)} points are in no batch; run the study from its main process")
    while new:
        _append(folder, split(new))
        owner, kernels = read(folder)
        new = [point for point in solved if point.id not in owner]
    if extend:
        folder.mkdir(parents=True, exist_ok=True)
        write_json(folder / "points.json", _index(study, owner))
    return Plan({batch: kernels[batch] for batch in sorted({owner[point.id] for point in solved})})


def _index(study: Study, owner: dict[str, str]) -> dict:
    """Return what points.json holds: the runs in the order of the tables and, apart, the companions for bands.

    A companion states the id of its run (`of`) and its role; a point that is companion of two runs is there twice.
    """
    index = {
        "study": study.name,
        "points": [
            {"id": point.id, "batch": owner[point.id], "numerics": label, **to_dict(point)}
            for label, point in study.runs
        ],
    }
    if study.bands:
        index["companions"] = [
            {"id": point.id, "of": run.id, "role": role, "batch": owner[point.id], **to_dict(point)}
            for run, role, point in study.companions
        ]
    return index


def read(folder: Path) -> tuple[dict[str, str], dict[str, str]]:
    """Return the name of the batch of each point's id, and the kernels of each batch.

    A file that cannot be read counts as empty: its points come anew.
    """
    owner: dict[str, str] = {}
    kernels: dict[str, str] = {}
    for path in sorted((folder / "batches").glob("[0-9]*.json")):
        try:
            batch = json.loads(path.read_text(encoding="utf-8"))
            ids, kernels[path.stem] = [row["id"] for row in batch["points"]], batch["kernels"]
        except (OSError, ValueError, KeyError, TypeError):
            continue
        for name in ids:
            owner.setdefault(name, path.stem)
    return owner, kernels


def read_batch(spec: Path | str) -> list[Point]:
    """Return the points of a batch file.

    Raises
    ------
    ConfigError
        If it is no batch file, a value is not allowed, or a point does not have its id: one line, which begins with
        the path.
    """
    text = read_text(spec, MOST_BATCH_BYTES)
    try:
        batch = json.loads(text)
        rows, kernels = batch["points"], batch["kernels"]
    except KeyError as error:
        raise ConfigError(f"{spec}: not a batch file: the key {error} is missing") from None
    except RecursionError:
        raise ConfigError(f"{spec}: not a batch file: nested too deep") from None
    except (ValueError, TypeError) as error:
        raise ConfigError(f"{spec}: not a batch file: {error}") from None
    if not (isinstance(rows, list) and rows):
        raise ConfigError(f"{spec}: points: {words.show(rows)} is not allowed; allowed: a list of points")
    if kernels not in choice.all_kernels():
        hint = words.closest(kernels, choice.all_kernels())
        raise ConfigError(f"{spec}: kernels: {words.show(kernels)}: there are none of that name{hint}")
    points = []
    for number, row in enumerate(rows):
        try:
            point = checking.point_of_row(row)
        except ConfigError as error:
            raise ConfigError(f"{spec}: points[{number}]: {error}") from None
        if point.id != row["id"]:
            raise ConfigError(
                f"{spec}: the values of {words.show(row['id'])} belong to {point.id}; was the file edited?"
            )
        points.append(point)
    return points


def split(points: list[Point]) -> list[list[Point]]:
    """Return batches of points: one cell size and one set of kernels in each, balanced by estimated cost.

    The number of cores has no say, so that the files of a study do not depend on it.
    """
    groups: dict[tuple, list[Point]] = {}
    for point in points:
        groups.setdefault((choice.kernels(point), point.dx, point.fields), []).append(point)
    total = sum(cost(point) for point in points)
    target = min(max(total / PARTS, SECONDS[0]), SECONDS[1])
    return [batch for group in groups.values() for batch in _balanced(group, target)]


def damaged(folder: Path, batches: Iterable[str]) -> list[Path]:
    """Return the records whose bytes do not match the SHA-256 that was stored beside them.

    Parameters
    ----------
    folder
        Folder of a study.
    batches
        Names of the batches whose records are looked at.

    Returns
    -------
    list of Path
        Paths of the records; none of a record that is not there.
    """
    wrong = []
    for name in batches:
        record = folder / "records" / f"{name}.nc"
        stated = record.with_name(record.name + ".sha256")
        if record.exists() and stated.exists() and stated.read_text().split()[:1] != [file_hash(record)]:
            wrong.append(record)
    return wrong


def _balanced(points: list[Point], target: float) -> list[list[Point]]:
    """Return points in bins of about `target` seconds each: the costliest first, into the least filled bin."""
    total = sum(cost(point) for point in points)
    size = sum(_bytes(point) for point in points)
    bins = max(math.ceil(total / target), math.ceil(len(points) / MOST_POINTS), math.ceil(size / MOST_BYTES))
    bins = min(bins, len(points))
    filled = [0.0] * bins
    members: list[list[int]] = [[] for _ in range(bins)]
    for n in sorted(range(len(points)), key=lambda n: (-cost(points[n]), n)):
        least = min(range(bins), key=lambda b: (filled[b], len(members[b]), b))
        filled[least] += cost(points[n])
        members[least].append(n)
    return [[points[n] for n in sorted(bin_)] for bin_ in members]


def _append(folder: Path, batches: list[list[Point]]) -> None:
    """Write each batch to a new file; where another process took its number first, the rest is left out."""
    home = folder / "batches"
    home.mkdir(parents=True, exist_ok=True)
    number = max((int(path.stem) for path in home.glob("[0-9]*.json")), default=0)
    for points in batches:
        number += 1
        temporary = home / f".{uuid.uuid4().hex}.tmp"
        try:
            rows = [{"id": point.id, **to_dict(point)} for point in points]
            write_json(temporary, {"kernels": choice.kernels(points[0]), "points": rows})
            os.link(temporary, home / f"{number:04d}.json")  # fails if the name is taken, unlike a rename
        except FileExistsError:
            return
        finally:
            temporary.unlink(missing_ok=True)
