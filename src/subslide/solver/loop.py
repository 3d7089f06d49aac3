"""The time loop, in segments from one snapshot to the next."""

import os
import sys
import threading
import time
from collections.abc import Callable

import numba
import numpy as np

from subslide.kernels import cache, samples
from subslide.kernels import clock as k
from subslide.kernels.arrays import Track
from subslide.kernels.jit import plain
from subslide.keys.schema import ConfigError
from subslide.models.model import Model
from subslide.naming import FRONT_THRESHOLDS

CHUNK, FEWEST = 512, 8
"""Most and fewest samples of a launch."""

LAUNCH = 0.3
"""Seconds that a launch is to take at most: between two of them a signal is heard, and progress shown."""

CELLS_A_SECOND = 4e6
"""How fast cells are thought to be advanced before it has been measured."""

PATIENCE = 5.0
"""Seconds in which kernels that have been compiled before are loaded."""

COMPILING = "subslide: compiling the kernels of this model, once: about a minute"
WAITING = "subslide: waiting for another process that compiles the kernels of this model: about a minute"
NOT_KEPT = "subslide: compiled kernels are not kept, so the next run compiles anew: "

_loaded: set[tuple[type, ...]] = set()
"""Compiled code that this process has used."""

goes_on = plain(k.goes_on)


def thresholds(model: Model) -> tuple[float, ...]:
    """Return the front's thresholds in the working precision."""
    real = type(model.level)
    return tuple(real(value) for value in FRONT_THRESHOLDS)


def start_threads(threads: int) -> None:
    """Make this many threads solve, as far as numba has them; ConfigError if its threading layer cannot be used."""
    try:
        wanted = max(1, min(threads, numba.config.NUMBA_NUM_THREADS))
        if numba.get_num_threads() != wanted:
            numba.set_num_threads(wanted)
    except (ImportError, RuntimeError, ValueError):
        layer = os.environ.get("NUMBA_THREADING_LAYER", "default")
        raise ConfigError(
            f"NUMBA_THREADING_LAYER: {layer} cannot be used; allowed: default, workqueue, or omp or tbb if installed"
        ) from None


def warm_up(model: Model) -> None:
    """Compile the time loop, or load it, once: by a segment of no length, which changes nothing but derived values."""
    code = type(model), type(model.settings), type(model.level)
    if code in _loaded:
        return
    track = Track(k.started(), np.empty((2, samples.COLUMNS)), np.zeros(2, np.int64))
    notice = threading.Timer(PATIENCE, lambda: _say(WAITING if cache.waiting() else COMPILING))
    notice.daemon = True
    notice.start()
    try:
        model.advance(thresholds(model), track)
    finally:
        notice.cancel()
        cache.release()
    if cache.faults:
        _say(NOT_KEPT + cache.faults[0])
        cache.faults.clear()
    _loaded.add(code)


def _say(line: str) -> None:
    """Print a line on stderr."""
    print(line, file=sys.stderr)


class Samples:
    """Samples of a run, one for each instant, in one array that grows.

    Parameters
    ----------
    before
        Samples (samples, columns) to go on from.
    """

    def __init__(self, before: np.ndarray | None = None) -> None:
        """Begin with what is there."""
        self._rows = np.empty((CHUNK, samples.COLUMNS)) if before is None else before
        self._counters = np.zeros(2, np.int64)
        self._counters[k.SAMPLES] = 0 if before is None else len(before)

    @property
    def taken(self) -> np.ndarray:
        """Samples (samples, columns), a view."""
        return self._rows[: self._counters[k.SAMPLES]]

    def track(self, clock: np.ndarray, most: int) -> Track:
        """Return the track of a launch that takes so many samples at most.

        A loop that starts again samples its first instant again, in place of the last sample before it.

        Parameters
        ----------
        clock
            Scaled times, see `kernels.clock`.
        most
            Samples.

        Returns
        -------
        Track
            Where the loop goes on.
        """
        first = max(0, int(self._counters[k.SAMPLES]) - 1)
        if first + most > len(self._rows):
            longer = np.empty((2 * len(self._rows) + most, samples.COLUMNS))
            longer[:first] = self._rows[:first]
            self._rows = longer
        self._counters[k.SAMPLES] = first
        return Track(clock, self._rows[: first + most], self._counters)


def advance_to(
    model: Model, clock: np.ndarray, kept: Samples, look: Callable[[float], object], stepwise: bool = False
) -> tuple[int, float]:
    """Run the loop until it ends, and keep its samples.

    Parameters
    ----------
    model
        What is run.
    clock
        Scaled times, see `kernels.clock`; the loop moves it on, past its stop if there are later ones.
    kept
        Gets the samples of this loop.
    look
        Function that is called now and then with the seconds that this loop has taken, when model, clock and samples
        are what it can go on from.
    stepwise
        Whether it is called after each step, which changes no answer.

    Returns
    -------
    tuple of int and float
        Why the loop ended, see `kernels.clock`, and the seconds that it took.
    """
    wall, step = 0.0, model.cells.h1.size / CELLS_A_SECOND
    depths = thresholds(model)
    while True:
        most = 2 if stepwise else int(max(FEWEST, min(CHUNK, LAUNCH / max(step, 1e-9))))
        track = kept.track(clock, most)
        first = int(track.counters[k.SAMPLES])
        started = time.perf_counter()
        model.advance(depths, track)
        seconds = time.perf_counter() - started
        samples_taken, outcome = track.counters.tolist()
        wall, step = wall + seconds, seconds / (samples_taken - first)
        look(wall)
        if outcome == k.NO_ROOM:
            model.make_room(float(clock[k.NOW]))
        elif outcome != k.FULL and not goes_on(clock, track.counters):
            return outcome, wall
