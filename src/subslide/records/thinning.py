"""Series of bounded length: runs pad each other's series in a record, so one of a million steps must not stay whole.

A run crawls where waves blow up, and is long where r is near 1 on fine grids.
"""

import copy
from typing import TYPE_CHECKING

import numpy as np

from subslide import naming
from subslide.records import scalars

if TYPE_CHECKING:
    from subslide.solver.run import Run

LONGEST, HEAD = 10_000, 4_096
"""Most samples that a record keeps of a run, and how many of these are the run's first, one a step."""


def thinned(run: "Run") -> "Run":
    """Return the run with series (..., samples) of at most LONGEST samples; the run itself if they are no longer.

    Kept are the first HEAD and, of every block of steps after them, the samples with the least and the largest value
    of each series and the first one; so no extremum of any series is lost or moved.
    """
    scalars.of(run)  # of all samples
    count = len(run.time)
    if count <= LONGEST:
        return run
    series = np.vstack([np.atleast_2d(getattr(run, name)) for name in naming.SERIES])
    kept = places(np.nan_to_num(series, posinf=np.inf, neginf=-np.inf))
    short = copy.copy(run)
    for name in ("time", *naming.SERIES):
        setattr(short, name, getattr(run, name)[..., kept])
    return short


def places(series: np.ndarray) -> np.ndarray:
    """Return the indices, sorted, of the samples that are kept of series (number, samples), longer than LONGEST."""
    count = series.shape[1]
    blocks = np.array_split(np.arange(HEAD, count - 1), (LONGEST - HEAD - 1) // (2 * len(series) + 1))
    extremes = [
        block[0] + place(series[:, block[0] : block[-1] + 1], axis=1)
        for block in blocks
        for place in (np.argmin, np.argmax)
    ]
    starts = [block[0] for block in blocks]
    return np.unique(np.concatenate([np.arange(HEAD), starts, *extremes, [count - 1]]))
