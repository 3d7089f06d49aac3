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


def thresholds(model: Model) -> tuple[float, ...]:
    """Return the front's thresholds in the working precision."""
    real = type(model.level)
    return tuple(real(value) for value in FRONT_THRESHOLDS)


def start_threads(threads: int) -> None:
    """Make this many threads solve, as far as numba has them; ConfigError if its threading layer cannot be used."""
    try:
        numba.set_num_threads(max(1, min(threads, numba.config.NUMBA_NUM_THREADS)))
    except (ImportError, RuntimeError, ValueError):
        layer = os.environ.get("NUMBA_THREADING_LAYER", "default")
        raise ConfigError(
            f"NUMBA_THREADING_LAYER: {layer} cannot be used; allowed: default, workqueue, or omp or tbb if installed"
        ) from None


def warm_up(model: Model) -> None:
    """Compile the time loop (or load it) with a segment of no length, which changes nothing but derived values."""
    track = Track(k.started(), np.empty((2, samples.COLUMNS)), np.zeros(2, np.int64))
    code = type(model), type(model.settings), type(model.level)
    if code in _loaded:
        model.advance(thresholds(model), track)
        return
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


def advance_to(
    model: Model, clock: np.ndarray, chunks: list[np.ndarray], look: Callable[[float], object]
) -> tuple[int, float]:
    """Run the loop until it ends, and keep its samples, one for each instant.

    A loop that starts again samples its first instant again, so the last sample before it is dropped.

    Parameters
    ----------
    model
        What is run.
    clock
        Scaled times, see `kernels.clock`; the loop moves it on.
    chunks
        Arrays (samples, columns), which get those of this loop.
    look
        Function that is called now and then with the seconds that this loop has taken, when model, clock and samples
        are what it can go on from.

    Returns
    -------
    tuple of int and float
        Why the loop ended, see `kernels.clock`, and the seconds that it took.
    """
    wall, step = 0.0, model.cells.h1.size / CELLS_A_SECOND
    while True:
        size = int(max(FEWEST, min(CHUNK, LAUNCH / max(step, 1e-9))))
        track = Track(clock, np.empty((size, samples.COLUMNS)), np.zeros(2, np.int64))
        started = time.perf_counter()
        model.advance(thresholds(model), track)
        taken = time.perf_counter() - started
        wall, step = wall + taken, taken / int(track.counters[k.SAMPLES])
        if chunks:
            chunks[-1] = chunks[-1][:-1]
        chunks.append(track.samples[: track.counters[k.SAMPLES]])
        look(wall)
        if track.counters[k.OUTCOME] == k.NO_ROOM:
            model.make_room(float(clock[k.NOW]))
        elif track.counters[k.OUTCOME] != k.FULL:
            return int(track.counters[k.OUTCOME]), wall
