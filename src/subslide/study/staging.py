"""What planning hands to Snakemake and to its jobs, in a folder of a study within `.snakemake`.

Planning happens whenever the Snakefile is read, for a dry run too, so it writes nowhere else. Texts are named by their
content and never change: a job has the plan of the run that started it, whatever is planned meanwhile. Whether a file
is out of date is not for its time to tell, since folders are copied and clocks are set; so each job has a small input,
its stamp: very old while what the job made is whole, and newer than that where it has to be made again.
"""

import contextlib
import json
import math
import os
import time
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

from subslide import checksums
from subslide.files import RecordError, write_text
from subslide.study import cost
from subslide.study.plan import Batch, Plan, record_path

LONG_AGO = 1
"""Time (s since 1970) of the stamp of what is whole."""

UNFINISHED = ".unfinished"
"""Folder beside records where batches of long runs keep what they have, see `solver.checkpoint`."""

ABOUT = "about"
"""Name of the array of its files that holds all that is no array, as JSON."""

LEAST = len("whole\n")
"""Size of the stamp of what is whole, or is not there, of no rank."""


class Needs(NamedTuple):
    """What a job may need: memory (MB) and time (minutes)."""

    mem_mb: int
    runtime: int


class Staged(NamedTuple):
    """A plan as jobs know it.

    Attributes
    ----------
    study
        Name of the study.
    home
        The study's folder within `.snakemake`.
    path
        The file that states the plan, named by its content.
    specs
        Path of the text of each batch, by its name.
    needs
        What the job of each batch may need, by the batch's name.
    points_file
        Path of the text of points.json.
    tables
        Names of the files of each table, by its name.
    figures
        Names of the figures.
    damaged
        Names of the batches whose records are damaged.
    """

    study: str
    home: Path
    path: Path
    specs: dict[str, Path]
    needs: dict[str, Needs]
    points_file: Path
    tables: dict[str, list[str]]
    figures: list[str]
    damaged: tuple[str, ...] = ()


def stage(plan: Plan, home: Path, tables: Mapping[str, Sequence[str]], figures: Sequence[str]) -> Staged:
    """Write a plan below a folder within `.snakemake`, and return it as jobs know it.

    Parameters
    ----------
    plan
        The plan.
    home
        The study's folder within `.snakemake`, made if need be.
    tables
        Names of the files of each table that is to be made, by its name.
    figures
        Names of the figures.

    Returns
    -------
    Staged
        Paths of its texts; those of batches that are solved are only names.
    """
    home.mkdir(parents=True, exist_ok=True)
    specs = {}
    for name, batch in plan.batches.items():
        specs[name] = home / f"batch-{batch.digest}.json"
        if batch.text:
            _write(specs[name], batch.text)
    points_file = home / f"points-{checksums.text_hash(plan.points_text)}.json"
    _write(points_file, plan.points_text)
    needs = {name: needs_of(batch, plan.keep) for name, batch in plan.batches.items()}
    about = {
        "study": plan.study,
        "specs": {name: str(path) for name, path in specs.items()},
        "needs": needs,
        "points": str(points_file),
        "tables": {name: list(files) for name, files in tables.items()},
        "figures": list(figures),
    }
    text = json.dumps(about)
    path = home / f"plan-{checksums.text_hash(text)}.json"
    _write(path, text)
    damaged = tuple(name for name, batch in plan.batches.items() if batch.damaged)
    return staged(path)._replace(damaged=damaged)


def staged(path: Path) -> Staged:
    """Return a plan that another process has staged: all that a job needs to know of its study.

    Parameters
    ----------
    path
        The file that states the plan.

    Returns
    -------
    Staged
        The plan as the other process has it, but for damage, which is that process's to mend.
    """
    about = json.loads(path.read_text(encoding="utf-8"))
    specs = {name: Path(spec) for name, spec in about["specs"].items()}
    needs = {name: Needs(*values) for name, values in about["needs"].items()}
    points_file, tables, figures = Path(about["points"]), about["tables"], about["figures"]
    return Staged(about["study"], path.parent, path, specs, needs, points_file, tables, figures)


def needs_of(batch: Batch, keep: str) -> Needs:
    """Return what the job of a batch may need: its runs are kept until all are solved; kernels may need compiling.

    Parameters
    ----------
    batch
        The batch.
    keep
        What is kept of each run.

    Returns
    -------
    Needs
        Memory and time.
    """
    costs = [cost.of(point) for point in batch.points]
    memory = max(one.memory for one in costs) + sum(one.kept(keep) for one in costs)
    minutes = sum(cost.START[keep] + one.seconds for one in costs) / 60
    return Needs(max(1000, math.ceil(memory / 1e6)), math.ceil(10 + 2 * minutes))


def stamp(home: Path, name: str, outputs: Iterable[Path], whole: bool, rank: int = 0) -> Path:
    """Return the stamp of a job, set so that Snakemake starts the job if its outputs are there and not whole.

    Parameters
    ----------
    home
        The study's folder within `.snakemake`.
    name
        Name of the stamp.
    outputs
        What the job makes.
    whole
        Whether that is as it should be.
    rank
        Jobs of higher rank start first: of those that could, Snakemake starts the one whose inputs are larger.

    Returns
    -------
    Path
        The stamp.
    """
    path = home / name
    times = [output.stat().st_mtime for output in outputs if output.exists()]
    if times and not whole:
        # Snakemake takes an input with the content of last time for the same, whatever its time
        path.write_text(f"{time.time_ns()}\n")
        if max(times) >= time.time():
            os.utime(path, (max(times) + 1,) * 2)
    elif (
        not path.exists()
        or path.stat().st_mtime != LONG_AGO
        or (not times and path.stat().st_size != LEAST + rank)
    ):
        path.write_text("whole\n".ljust(LEAST + rank))
        os.utime(path, (LONG_AGO, LONG_AGO))
    return path


def are_whole(paths: Iterable[Path], **notes: str) -> bool:
    """Return whether files are as they were written.

    Parameters
    ----------
    paths
        The files.
    notes
        What they must have been made from, see `checksums.seal`.

    Returns
    -------
    bool
        False also if one is missing.
    """
    try:
        return all(notes.items() <= checksums.verify(path).items() for path in paths)
    except RecordError:
        return False


def holds(path: Path, text: str) -> bool:
    """Return whether a file holds a text, with the checksum of it beside.

    Parameters
    ----------
    path
        The file.
    text
        What it should hold.

    Returns
    -------
    bool
        False also if it is missing.
    """
    try:
        checksums.verify(path)
        return path.read_text(encoding="utf-8") == text
    except (RecordError, OSError, ValueError):
        return False


def tidy(folder: Path, now: Staged, outputs: Iterable[Path]) -> None:
    """Set a study's folder in order before jobs start.

    What a killed job left half-written and what older plans staged is removed; damaged records, and folders where files
    belong, are set aside; and times in the future, which would let a job start at every call, are set to now.

    Parameters
    ----------
    folder
        The study's folder of results.
    now
        The plan whose jobs start.
    outputs
        Files that jobs make.
    """
    for path in (*(record_path(folder, name) for name in now.damaged), *filter(Path.is_dir, outputs)):
        with contextlib.suppress(OSError):
            aside = folder / "damaged" / (f"{path.name}-{time.time_ns()}" if path.is_dir() else path.name)
            aside.parent.mkdir(exist_ok=True)
            os.replace(path, aside)
    needed = {now.points_file, now.path, *now.specs.values()}
    old = {path for path in now.home.glob("*-*.json") if path not in needed}
    for path in (*folder.rglob("*"), *now.home.iterdir()):
        with contextlib.suppress(OSError):
            if path in old or (path.name.startswith(".") and path.name.endswith(".tmp")):
                path.unlink()
            elif path.stat().st_mtime > time.time():
                os.utime(path)


def forget(folder: Path, batches: Iterable[Batch]) -> None:
    """Remove what was kept of long runs that no batch is to solve any more.

    Parameters
    ----------
    folder
        The study's folder of results.
    batches
        Batches that are to be solved.
    """
    wanted = {point.id for batch in batches for point in batch.points}
    home = folder / "records" / UNFINISHED
    for path in home.glob("*.npz"):
        if wanted.isdisjoint(_ended(path) if path.stem.startswith("batch-") else {path.stem}):
            path.unlink(missing_ok=True)
    with contextlib.suppress(OSError):
        home.rmdir()


def _ended(path: Path) -> set[str]:
    """Return the ids of the runs that a file of runs which ended has; none if it is damaged."""
    import numpy as np

    try:
        with np.load(path, allow_pickle=False) as file:
            return set(json.loads(file[ABOUT].tobytes())["runs"])
    except Exception:  # numpy and zipfile raise whatever they come to
        return set()


def _write(path: Path, text: str) -> None:
    """Write a text that its name stands for, unless the file holds it."""
    with contextlib.suppress(OSError, UnicodeDecodeError):
        if path.read_text(encoding="utf-8") == text:
            return
    write_text(path, text)
