"""How far a run, or a whole study, has come: one line on a terminal that is redrawn, in a log a line now and then.

Each job of a study counts the runs that have ended in a small file; the Snakemake that makes the study reads them. A
file that is missing or cut short counts as it did before.
"""

import contextlib
import logging
import os
import sys
import threading
import time
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TextIO

from subslide.points import Point

OF_JOBS, CHOOSING = ("progress", "job_info", "job_finished"), ("Select jobs to execute", "Execute ")
"""Events, and beginnings of lines, by which Snakemake tells of each job."""

OFTEN, SELDOM = 0.5, 30.0
"""Seconds between lines on a terminal, and in a log."""


def of_run(point: Point) -> Callable[[float], None]:
    """Return a function that shows on the terminal the time that a run has reached, once it has taken a while.

    Parameters
    ----------
    point
        The run.

    Returns
    -------
    callable
        It is called with the time (s) now and then.
    """
    start = last = time.monotonic()
    aim = "until rest" if point.t_end is None else f"of {point.t_end:.4g} s"

    def show(reached: float) -> None:
        nonlocal last
        now = time.monotonic()
        if now - start > 2 and now - last > OFTEN:
            last = now
            print(
                f"\r{reached:.4g} s {aim}, after {now - start:.0f} s  ", end="\r", file=sys.stderr, flush=True
            )

    return show


class Counter:
    """Counts of the runs of a job that have ended, and of those that failed, in a file.

    Parameters
    ----------
    path
        The file; None where nobody asks.
    """

    def __init__(self, path: Path | str | None):
        """Begin at none."""
        self.path, self.ended, self.failed = path, 0, 0
        self._last = time.monotonic()

    def add(self, failed: bool) -> None:
        """Set the counts one further, and write the file if that was not done a moment ago."""
        self.ended += 1
        self.failed += failed
        if time.monotonic() - self._last > OFTEN:
            self.write()

    def write(self) -> None:
        """Write the counts; where that cannot be, nobody reads them."""
        self._last = time.monotonic()
        if self.path is not None:
            with contextlib.suppress(OSError):
                Path(self.path).write_text(f"{self.ended} {self.failed}\n", encoding="utf-8")


def counter_path(home: Path, batch: str) -> Path:
    """Return the path of the counts of a batch's job.

    Parameters
    ----------
    home
        The study's folder within `.snakemake`.
    batch
        Name of the batch.

    Returns
    -------
    Path
        Where the job writes them.
    """
    return home / f"ended-{batch}"


class Reporter:
    """Lines on the progress of a study, from the counts of its jobs, until it is stopped.

    Parameters
    ----------
    home
        The study's folder within `.snakemake`.
    batches
        Points, and estimated seconds, of each batch that is to be solved, by its name.
    stream
        Where lines go.
    """

    def __init__(self, home: Path, batches: Mapping[str, tuple[int, float]], stream: TextIO | None = None):
        """Begin at none."""
        self.paths = {name: counter_path(home, name) for name in batches}
        self.batches = batches
        self.total = sum(points for points, _ in batches.values())
        self.stream = stream or sys.stderr
        self.on_terminal = self.stream.isatty() and os.environ.get("TERM") != "dumb"
        self.steps = ""
        self._counts = dict.fromkeys(batches, (0, 0))
        self._start = time.monotonic()
        self._first: tuple[float, int, float] | None = None
        self._over = threading.Event()
        self._thread = threading.Thread(target=self._watch, daemon=True)

    def start(self) -> None:
        """Remove the counts of runs before, and begin to show lines, if there is anything to solve."""
        if self.total:
            for path in self.paths.values():
                path.unlink(missing_ok=True)
            self._thread.start()

    def stop(self) -> None:
        """Write how far it has come, and no more."""
        self._over.set()
        if self._thread.is_alive():
            self._thread.join()
        if self.total:
            self._show(last=True)

    def shows(self, record: logging.LogRecord) -> bool:
        """Return whether a line of Snakemake's is shown, for which a terminal makes room.

        Not shown are those that tell that a job was chosen, begins or has ended, where there are points to solve.
        """
        event = str(getattr(record, "event", None))
        if event == "progress":
            self.steps = f"{getattr(record, 'done', 0)} of {getattr(record, 'total', 0)} jobs"
        shown = not self.total or not (event in OF_JOBS or str(record.msg).startswith(CHOOSING))
        if shown and self.on_terminal:
            self.stream.write("\r\033[K")
        return shown

    def line(self) -> str:
        """Return how far the study has come: points, pace, time left, failures, and jobs of all kinds."""
        self._read()
        ended, failed = (sum(counts) for counts in zip(*self._counts.values(), strict=True))
        now = time.monotonic()
        parts = [f"{ended:,} of {self.total:,} points"]
        done = sum(
            seconds * self._counts[name][0] / points for name, (points, seconds) in self.batches.items()
        )
        if ended and not self._first:
            self._first = (now, ended, done)  # from here on: before, jobs were starting
        since, ended_then, done_then = self._first or (now, ended, done)
        if ended_then < ended < self.total:
            left = sum(seconds for _, seconds in self.batches.values()) - done
            parts.append(f"{(ended - ended_then) / (now - since):,.3g} a second")
            parts.append(f"about {duration((now - since) * left / (done - done_then))} left")
        else:
            parts.append(f"{duration(now - self._start)}")
        parts += [f"{failed:,} failed"] if failed else []
        return ", ".join([*parts, *([self.steps] if self.steps else [])])

    def _read(self) -> None:
        """Set the counts to those of the files; what cannot be read stays as it was."""
        for name, path in self.paths.items():
            if self._counts[name][0] < self.batches[name][0]:
                with contextlib.suppress(OSError, ValueError):
                    ended, failed = map(int, path.read_text(encoding="utf-8").split())
                    self._counts[name] = min(ended, self.batches[name][0]), failed

    def _watch(self) -> None:
        """Write a line now and then, until it is over."""
        while not self._over.wait(OFTEN if self.on_terminal else SELDOM):
            self._show()

    def _show(self, last: bool = False) -> None:
        """Write a line, on a terminal in the place of the one before."""
        start, end = ("\r", "\033[K" + ("\n" if last else "")) if self.on_terminal else ("", "\n")
        with contextlib.suppress(OSError, ValueError):
            self.stream.write(f"{start}{self.line()}{end}")
            self.stream.flush()


def duration(seconds: float) -> str:
    """Return a time in words: seconds, minutes or hours."""
    for unit, name in ((3600, "h"), (60, "min")):
        if seconds >= 1.5 * unit:
            return f"{seconds / unit:.2g} {name}"
    return f"{max(seconds, 1):.0f} s"
