"""A study solved without Snakemake: the batches of its plan in processes of their own, which end with the program.

Each process is the command `subslide batch`, as a job of the workflow is: it imports nothing of the program that asked,
so no program needs a guard around its main part, and a folder that is left has the layout of the workflow's.
"""

import contextlib
import fcntl
import io
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import TextIO

import subslide
from subslide import checksums, jobs
from subslide.files import Stopped, write_text
from subslide.keys import words
from subslide.keys.schema import ConfigError
from subslide.library import given, one_run
from subslide.study import locks, notes, numbering, plan, progress, staging
from subslide.study.config import Study

LOOK = 0.05
"""Seconds between two looks at the processes."""

LEAST = 0.5
"""Seconds of runs, as estimated, below which the program solves them itself: a process takes longer to start."""

SAID = 5_000
"""Bytes of a log's end that are read for its last line."""


class BatchError(RuntimeError):
    """Process that ended without the record of its batch."""


def run(study: Study, folder: Path, cores: int, stream: TextIO | None) -> None:
    """Solve what a folder lacks of a study, and list the study's points there.

    Parameters
    ----------
    study
        The study.
    folder
        Its folder of results, made if need be; one that the workflow made is carried on, and the other way round.
    cores
        How many processes work at the same time.
    stream
        Where the line on the progress goes, see `stream_of`; None for nowhere.

    Raises
    ------
    ConfigError
        If the folder cannot be one of a study, or somebody else is at work in it.
    """
    folder = Path(os.path.abspath(folder))
    cache = folder.parent.parent / ".snakemake"
    _check_content(folder)
    plan.check_folders(folder, cache / "subslide" / study.name)
    for name in ("records", "batches", "logs"):
        (folder / name).mkdir(parents=True, exist_ok=True)
    with _alone(folder), locks.alone(study.name, folder, cache, lambda line: given.warn([], [line])):
        planned = plan.plan(study, folder, cores)
        given.warn(study.points, [*planned.faults, *notes.unkept(study.points, study.keep)])
        numbering.keep(folder, planned.next_run)
        with tempfile.TemporaryDirectory(prefix="subslide-") as home:
            staged = staging.stage(planned, Path(home), {}, ())
            staging.tidy(folder, staged, ())
            staging.forget(folder, (batch for batch in planned.batches.values() if batch.text))
            with _shown(Path(home), planned, stream) as reporter:
                if sum(seconds for _, seconds in planned.to_solve.values()) < LEAST:
                    _solve_here(folder, staged, list(planned.to_solve))
                else:
                    _solve(folder, staged, list(planned.to_solve), cores, reporter)
        write_text(folder / "points.json", planned.points_text)
        checksums.seal(folder / "points.json")


def stream_of(asked: bool) -> TextIO | None:
    """Return where the line on the progress goes: below the cell of a notebook, else to stderr.

    Parameters
    ----------
    asked
        Whether there is to be one.

    Returns
    -------
    file or None
        None without.
    """
    if not asked:
        return None
    return Cell() if type(sys.stdout).__module__.startswith("ipykernel") else sys.stderr


class Cell(io.StringIO):
    """Output of a notebook's cell, where a line takes the place of another without a terminal's orders."""

    def __init__(self) -> None:
        """Begin below nothing."""
        super().__init__()
        self.stream, self.longest = sys.stdout, 0

    def isatty(self) -> bool:
        """Return that a line may be drawn again."""
        return True

    def write(self, text: str) -> int:
        """Write a text; spaces stand for the order to clear the rest of a line."""
        line = text.removeprefix("\r").partition("\033[K")[0]
        self.longest = max(self.longest, len(line))
        return self.stream.write(text.replace("\033[K", " " * (self.longest - len(line))))

    def flush(self) -> None:
        """Write what is kept back."""
        self.stream.flush()


def _check_content(folder: Path) -> None:
    """Raise a ConfigError if a folder holds something, and is not a study's: planning tidies up in it."""
    names = {path.name for path in folder.iterdir()} if folder.is_dir() else set()
    if names and not names & {"batches", "points.json"}:
        raise ConfigError(
            f"folder: {folder} holds {words.show(min(names))}; allowed: a new folder, an empty one, or that of a study"
        )


@contextlib.contextmanager
def _alone(folder: Path) -> Iterator[None]:
    """Hold a folder for a block; ConfigError if another program solves a study in it."""
    handle = os.open(folder, os.O_RDONLY)
    try:
        try:
            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise ConfigError(
                f"folder: another program solves a study in {folder}; allowed: one at a time"
            ) from None
        except OSError:  # a file system without locks counts as one that nobody else uses
            pass
        yield
    finally:
        os.close(handle)


@contextlib.contextmanager
def _shown(home: Path, planned: plan.Plan, stream: TextIO | None) -> Iterator[progress.Reporter]:
    """Give what writes the progress of a plan's batches during a block."""
    reporter = progress.Reporter(home, planned.to_solve if stream else {}, stream)
    reporter.start()
    try:
        yield reporter
    finally:
        reporter.stop()


def _solve_here(folder: Path, staged: staging.Staged, names: list[str]) -> None:
    """Solve batches, by name, in this process."""
    for name in names:
        record, ledger, counts = _outputs(folder, staged, name)
        with one_run.at_work(), open(_log(folder, name), "w", encoding="utf-8") as log:
            try:
                jobs.batch(
                    str(staged.specs[name]), 1, record, ledger, lambda line: print(line, file=log), counts
                )
            except Stopped:
                raise KeyboardInterrupt from None


def _solve(
    folder: Path, staged: staging.Staged, waiting: list[str], cores: int, reporter: progress.Reporter
) -> None:
    """Solve batches, by name, in processes; BatchError if one ends without its record, and no other works on."""
    at_work: dict[str, subprocess.Popen] = {}
    try:
        while waiting or at_work:
            while waiting and len(at_work) < cores:
                name = waiting.pop(0)
                at_work[name] = _started(folder, staged, name)
            time.sleep(LOOK)
            reporter.steps = "compiling" if any(_compiles(_log(folder, name)) for name in at_work) else ""
            for name in [name for name, process in at_work.items() if process.poll() is not None]:
                if code := _ended(at_work.pop(name)):
                    raise BatchError(f"batch {name} {_end(code)}: {_last_line(_log(folder, name))}")
    finally:
        _stop(at_work.values())


def _started(folder: Path, staged: staging.Staged, name: str) -> subprocess.Popen:
    """Return the process of a batch, started; it ends when its standard input does, so with this process."""
    record, ledger, counts = _outputs(folder, staged, name)
    spec = str(staged.specs[name])
    command = ["batch", spec, "-o", record, "--ledger", ledger, "--counts", counts, "--attended"]
    with open(_log(folder, name), "wb") as log:
        return subprocess.Popen(
            [sys.executable, "-P", "-m", "subslide", *command],
            stdin=subprocess.PIPE,
            stdout=log,
            stderr=log,
            env=_environment(),
            process_group=0,  # Ctrl-C is for this process, which stops them
        )


def _outputs(folder: Path, staged: staging.Staged, name: str) -> tuple[str, str, str]:
    """Return the paths of the record of a batch, of its file in the ledger and of its counts."""
    record, ledger = plan.record_path(folder, name), folder / "batches" / f"{name}.json"
    return str(record), str(ledger), str(progress.counter_path(staged.home, name))


def _environment() -> dict[str, str]:
    """Return the environment in which another Python has this package, also where the program has added its folder."""
    home = Path(subslide.__file__).parents[1]
    if home.name in ("site-packages", "dist-packages"):
        return dict(os.environ)
    others = os.environ.get("PYTHONPATH")
    return {**os.environ, "PYTHONPATH": os.pathsep.join([str(home), *([others] if others else [])])}


def _stop(processes: Iterable[subprocess.Popen]) -> None:
    """End processes, which keep what they have solved, and wait until they have ended."""
    processes = list(processes)
    try:
        for process in processes:
            process.terminate()
        for process in processes:
            _ended(process)
    finally:  # a second Ctrl-C
        for process in processes:
            process.kill()


def _ended(process: subprocess.Popen) -> int:
    """Return the status of a process, once it has ended; its input is closed no sooner, which it takes for our end."""
    code = process.wait()
    if process.stdin is not None:
        process.stdin.close()
    return code


def _log(folder: Path, name: str) -> Path:
    """Return the path of the log of a batch."""
    return folder / "logs" / f"batch-{name}.log"


def _end(code: int) -> str:
    """Return in words how a process ended."""
    return f"was ended by signal {-code}" if code < 0 else f"ended with status {code}"


def _compiles(log: Path) -> bool:
    """Return whether a process has said that it compiles, and nothing of a run since."""
    lines = log.read_bytes().splitlines() if log.stat().st_size < SAID else []
    return bool(lines) and all(line.startswith(b"subslide: ") and b"compil" in line for line in lines)


def _last_line(log: Path) -> str:
    """Return the last line of a log."""
    lines = log.read_bytes()[-SAID:].decode(errors="replace").split("\n")
    return next((line for line in reversed(lines) if line.strip()), "it said nothing")
