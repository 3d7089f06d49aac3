"""What an emulator learns of a run, over R, H2 and sqrt(R / (g a_2))."""

import math
from collections.abc import Callable

import numpy as np

from subslide.emulator.coordinates import GRAINS, WATER
from subslide.naming import FRONT_LABELS
from subslide.points import Point
from subslide.study import choice

FRONT_NODES = (0.02, 0.05, 0.1, 0.2, 0.3, 0.45, 0.6, 0.8, 1.0, 1.15, 1.3, 1.6, 2.0)
"""Times t m sqrt(1-r), scaled, at which fronts are learned: friction stops all of them at about 1.8. Before the first a
front leaves R; between them a monotone cubic goes."""

TIMES = (0.25, 0.5, 0.75, 1.0, 1.25, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0, 5.0)
"""Scaled times at which max|eta| is learned, and all series are told."""

WINDOWS = {
    "crest_1": (1, 0.0, 2.5),
    "crest_2": (1, 2.5, math.inf),
    "trough_1": (-1, 0.0, 2.4),
    "trough_2": (-1, 2.4, math.inf),
}
"""Parts of the wave at the gauge: up or down, from and until when, in R / sqrt(g (H1 + H2)). The largest is the peak,
which changes from one to another with a kink; each by itself is smooth."""

LENGTHS = tuple(f"L_f_{label}" for label in FRONT_LABELS)
ARRESTS = tuple(f"time_of_arrest_{label}" for label in FRONT_LABELS)
FRONTS = tuple(f"x_front_{label}" for label in FRONT_LABELS)
SURFACE = "max_abs_eta"
PEAK = "eta_gauge_peak"

LEARNED: dict[str, tuple[str, tuple[str, ...]]] = {
    "fronts": (GRAINS, (*LENGTHS, *(f"{name}@{n}" for name in FRONTS for n in range(len(FRONT_NODES))))),
    "arrest": (GRAINS, ARRESTS),
    "gauge": (WATER, tuple(WINDOWS)),
    "surface": (WATER, tuple(f"{SURFACE}@{n}" for n in range(len(TIMES)))),
}
"""Coordinates and quantities of each group: those of one have one kernel."""

QUANTITIES = (*LENGTHS, *FRONTS, *ARRESTS, PEAK, SURFACE)
"""What an emulator predicts."""

MOST = {"surface": 512}
"""Columns that a group keeps at most: what max|eta| errs by comes of kinks, which more columns hardly mend."""

POOLED = ("fronts", "arrest")
"""Groups whose errors on one grid jump from column to column, so that one smooth slope over 1/cells does for all."""

NEEDED = {
    "fitted": ("time", "x_front", "L_f", "time_of_arrest", "status"),
    "uniform": ("time", "max_abs_eta", "eta_gauge", "status"),
}
"""Variables of a record that are read, by its grid."""

Record = dict[str, np.ndarray]


def front_clock(r: np.ndarray | float, m: np.ndarray | float) -> np.ndarray | float:
    """Return by what a scaled time is multiplied for the clock of FRONT_NODES.

    Parameters
    ----------
    r, m
        Ratio of densities, and friction number.

    Returns
    -------
    ndarray or float
        m sqrt(1-r).
    """
    return m * (1 - r) ** 0.5


def measure(point: Point, record: Record) -> dict[str, float]:
    """Return what is learned of a run, by quantity; NaN where it did not last long enough.

    Parameters
    ----------
    point
        The run's.
    record
        Variables NEEDED of it, by name.

    Returns
    -------
    dict
        Scaled values: of grains on a fitted grid, of water on a uniform one.
    """
    values = (_of_grains if choice.is_fitted(point) else _of_water)(point, record)
    return {name: float(value) for name, value in values.items()}


def _of_grains(point: Point, record: Record) -> dict[str, float]:
    """Return lengths, times of arrest, and fronts at the nodes."""
    values = {name: record["L_f"][n] / point.radius for n, name in enumerate(LENGTHS)}
    values |= {name: record["time_of_arrest"][n] / point.time_scale for n, name in enumerate(ARRESTS)}
    clock = record["time"] / point.time_scale * front_clock(point.r, point.friction_number)
    for k, name in enumerate(FRONTS):
        places = np.interp(FRONT_NODES, clock, record["x_front"][k] / point.radius)
        values |= {f"{name}@{n}": place for n, place in enumerate(places)}
    return values


def _of_water(point: Point, record: Record) -> dict[str, float]:
    """Return the parts of the wave at the gauge, and the largest displacement at TIMES."""
    time = record["time"]
    span = point.radius / point.wave_speed
    volume = np.append(
        0.0, np.cumsum((record["eta_gauge"][1:] + record["eta_gauge"][:-1]) / 2 * np.diff(time))
    )
    starts = time[time <= time[-1] - span]
    mean = (np.interp(starts + span, time, volume) - volume[: len(starts)]) / span / point.column_height
    middle = starts / span + 0.5
    values = {
        name: np.max(sign * mean[(middle >= first) & (middle < last)], initial=-math.inf)
        for name, (sign, first, last) in WINDOWS.items()
    }
    at = np.array(TIMES) * point.time_scale
    heights = np.interp(at, time, record["max_abs_eta"] / point.column_height, right=math.nan)
    values |= {f"{SURFACE}@{n}": height for n, height in enumerate(heights)}
    return {name: value if math.isfinite(value) else math.nan for name, value in values.items()}


Measure = Callable[[Point, Record], dict[str, float]]
