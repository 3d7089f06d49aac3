"""Series of bounded length: runs pad each other's series in a record, so one of a million steps must not stay whole.

A run crawls where waves blow up, and is long where r is near 1 on fine grids.
"""

from typing import TYPE_CHECKING

import numpy as np

from subslide import naming
from subslide.keys.kept import LACKING
from subslide.records import scalars

if TYPE_CHECKING:
    from subslide.solver.run import Run

LONGEST, HEAD = 10_000, 4_096
"""Most samples that a record keeps of a run, and how many of these are the run's first, one a step."""

OF_KEY = {"gauges": naming.GAUGES, "footprints": naming.FOOTPRINTS}
"""Quantities of `Run.measured` by the key that asks for them, of those that a record may lack."""

SUMMARY = ("x_front", "max_abs_eta", "max_abs_eta_outside", "eta_gauge")
"""Series that a summary keeps, in single precision."""

SHARE, LEAST = 1e-3, 1e-6
"""Share of the range of each of these within which a summary gives all samples, and of its largest size at least."""


ABOUT = {
    "all": f"sample 0 is the start, then one sample each time step, none left out of runs of up to {LONGEST} samples;"
    f" longer ones keep the first {HEAD} and then the extremes of every series in each of many blocks of steps",
    "summary": f"of {', '.join(SUMMARY)} there are samples between which straight lines pass those of every time step"
    f" within {SHARE:g} of the range of the series (or {LEAST:g} of its largest size), with each local extreme that"
    " stands out by more; where another series alone has a sample values are missing, and infinite is what the run does"
    f" not have; of a run that needs more than {LONGEST} samples for that, it tells those which `series` keeps;"
    " there are no profiles",
}
"""What a record says of its samples, by how much is kept."""
ABOUT["series"] = f"{ABOUT['all']}; there are no profiles"


def kept(run: "Run", keep: str) -> "Run":
    """Return a run as a record keeps it, with the numbers that follow from all of its samples.

    Parameters
    ----------
    run
        Result of `solver.solve`.
    keep
        `all`: profiles too. `series`: all samples, up to LONGEST. `summary`: samples of SUMMARY that tell their course.

    Returns
    -------
    Run
        The run itself if nothing is left out.
    """
    if keep == "all":
        return thinned(run)
    scalars.of(run)
    short = run.copied()
    snapshots, none = len(run.snapshot_time), np.empty(0)
    short.x, short.h2, short.eta = none, np.empty((snapshots, 0)), np.empty((snapshots, 0))
    short.width = short.h2_diagonal = short.h2_field = short.eta_field = None
    dropped = {name for key in LACKING[keep] for name in OF_KEY.get(key, ())}
    short.measured = {name: values for name, values in run.measured.items() if name not in dropped}
    return thinned(short) if keep == "series" else _summary(short)


def _summary(run: "Run") -> "Run":
    """Return a run with the series SUMMARY alone, thinned; it is changed."""
    from subslide.records import course

    whole = run.all_series()
    series = np.vstack([whole[name] for name in SUMMARY])
    marks = np.zeros(series.shape, bool)
    # samples at the times of snapshots, which are off by round-off
    places = np.searchsorted(run.time, run.snapshot_time * (1 - 1e-12))
    marks[:, places[places < len(run.time)]] = True
    course.summarise(series, run.time, SHARE, LEAST, marks)
    stays = marks.any(axis=0)
    if stays.sum() > LONGEST:
        return _summary(thinned(run))
    fronts, short = len(whole[SUMMARY[0]]), series[:, stays].astype(np.float32)
    named = dict(zip(SUMMARY, (short[:fronts], *short[fronts:]), strict=True))
    _replace(run, run.time[stays].astype(np.float32), named)
    return run


def filled(time: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Return a series of a summary with what straight lines give between its samples, and NaN where it has none.

    Parameters
    ----------
    time
        Times (samples).
    values
        Series (..., samples): missing between samples, infinite where there is none.

    Returns
    -------
    ndarray
        Series of that shape.
    """
    whole = np.atleast_2d(values).astype(float)
    for row in whole:
        kept = ~np.isnan(row)
        if kept.any():
            with np.errstate(invalid="ignore"):
                row[~kept] = np.interp(time[~kept], time[kept], row[kept])
    whole[~np.isfinite(whole)] = np.nan
    return whole.reshape(values.shape)


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
    stays = places(np.nan_to_num(series, posinf=np.inf, neginf=-np.inf))
    short = run.copied()
    _replace(short, run.time[stays], {name: getattr(run, name)[..., stays] for name in naming.SERIES})
    at_gauges = {name: run.measured[name][:, stays] for name in naming.GAUGES if name in run.measured}
    short.measured = run.measured | at_gauges
    return short


def _replace(run: "Run", time: np.ndarray, series: dict[str, np.ndarray]) -> None:
    """Give a run other samples, and let go of those before."""
    run.time, run.series = time, series
    for name in naming.SERIES:
        vars(run).pop(name, None)


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
