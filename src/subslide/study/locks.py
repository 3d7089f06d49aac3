"""Who is at work on a study: locks of the system, which end with the process that holds them.

Snakemake's own lock is a file, which stays after a kill. So each Snakemake of a study also holds a lock of the system
while it lives, and each job one on the folder of records: where nobody holds them, Snakemake's lock is a dead one's.
"""

import contextlib
import fcntl
import json
import os
import time
from collections.abc import Callable, Iterator
from pathlib import Path

from subslide.keys.schema import ConfigError

PATIENCE = 10.0
"""Seconds to wait for a Snakemake of the same study, such as a dry run, to end."""

_held: list[int] = []
"""Locks that this process holds until it ends."""


def hold(home: Path) -> None:
    """Hold the lock of those that plan a study until this process ends.

    Parameters
    ----------
    home
        The study's folder within `.snakemake`, which is there.
    """
    handle = os.open(home / "alive", os.O_RDWR | os.O_CREAT)
    _locked(handle, fcntl.LOCK_SH)
    _held.append(handle)


def sign(home: Path) -> None:
    """Write who makes the study that a folder within `.snakemake` belongs to, for the message to others."""
    (home / "alive").write_text(f"{os.getpid()}\n")


@contextlib.contextmanager
def at_work(folder: Path) -> Iterator[None]:
    """Hold the lock of jobs that write into a folder, within a block."""
    handle = os.open(folder, os.O_RDONLY)
    try:
        _locked(handle, fcntl.LOCK_SH)
        yield
    finally:
        os.close(handle)


@contextlib.contextmanager
def alone(study: str, results: Path, cache: Path, say: Callable[[str], object]) -> Iterator[None]:
    """Hold a study for a block, with no run of it and no job at work.

    Parameters
    ----------
    study
        Name of the study.
    results
        Its folder of results.
    cache
        The folder `.snakemake`.
    say
        Function that is called with a line if jobs of a killed run have to be waited for.

    Yields
    ------
    None
        Nothing.

    Raises
    ------
    ConfigError
        If another run of the study is at work.
    """
    handle = None
    try:
        if cache.is_dir():
            alive = cache / "subslide" / study / "alive"
            alive.parent.mkdir(parents=True, exist_ok=True)
            handle = os.open(alive, os.O_RDWR | os.O_CREAT)
            until = time.monotonic() + PATIENCE
            while not _locked(handle, fcntl.LOCK_EX | fcntl.LOCK_NB):
                if time.monotonic() > until:
                    process = alive.read_text(errors="replace").strip()
                    raise ConfigError(
                        f"study: '{study}' is being made by another run, process {process}; allowed: one run at a time"
                    )
                time.sleep(0.2)
        _wait_for_jobs(results / "records", say)
        yield
    finally:
        if handle is not None:
            os.close(handle)


def unlock(study: str, results: Path, cache: Path, say: Callable[[str], object]) -> None:
    """Remove what the lock of Snakemake that a killed run left holds of a study.

    Parameters
    ----------
    study, results, cache, say
        As for `alone`.

    Raises
    ------
    ConfigError
        If another run of the study is at work.
    """
    if not cache.is_dir():
        return
    with alone(study, results, cache, say):
        for path in (cache / "locks").glob("*.lock"):
            if _of_study(path.read_bytes(), results):
                path.unlink()
        _forget_damaged(cache)


def _of_study(lock: bytes, results: Path) -> bool:
    """Return whether a lock of Snakemake holds files of a study, or nothing that Snakemake can read."""
    try:
        return any(Path(line).is_relative_to(results) for line in lock.decode().splitlines())
    except UnicodeDecodeError:
        return True


def _forget_damaged(cache: Path) -> None:
    """Remove what Snakemake remembers of a job and cannot read: without it, it goes by stamps and times."""
    for name in ("metadata", "incomplete"):
        for path in (cache / name).rglob("*"):
            if path.is_file():
                try:
                    remembered = isinstance(json.loads(path.read_bytes()), dict)
                except ValueError:
                    remembered = name == "incomplete" and not path.read_bytes()
                if not remembered:
                    path.unlink()


def _wait_for_jobs(records: Path, say: Callable[[str], object]) -> None:
    """Wait until no job writes records any more."""
    if not records.is_dir():
        return
    handle = os.open(records, os.O_RDONLY)
    try:
        if not _locked(handle, fcntl.LOCK_EX | fcntl.LOCK_NB):
            say(f"waiting for the jobs of a killed run, which still write into {records}")
            _locked(handle, fcntl.LOCK_EX)
    finally:
        os.close(handle)


def _locked(handle: int, kind: int) -> bool:
    """Return whether a lock was taken; a file system without locks counts as one that nobody else uses."""
    try:
        fcntl.flock(handle, kind)
    except BlockingIOError:
        return False
    except OSError:
        return True
    return True
