"""Answers of a study's runs that indices, main effects and laws are of: scaled, with the half-widths of their bands."""

from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from subslide.naming import ARREST
from subslide.points import Point
from subslide.study import choice
from subslide.study.config import COARSENING
from subslide.tables import _calibration as calibration
from subslide.tables import _convergence as convergence
from subslide.tables import _fitted_bands as fitted

if TYPE_CHECKING:
    from subslide.results import Companion, Results, StudyRun

LENGTH, PEAK, ARRESTED = "L_f_1pc", "eta_gauge_peak", "time_of_arrest_1pc"
FRONT, WAVE = "x_front_1pc", "max_abs_eta"
ONCE = {
    LENGTH: "length of the deposit (1 % front) over R",
    PEAK: "peak of the wave at the gauge, see runs.csv, over H2",
    ARRESTED: f"time since which the 1 % front has been within {100 * ARREST:g} % of its L_f, over R / sqrt(g H2)",
}
IN_TIME = {
    FRONT: "1 % front over R; of a run that has come to rest its last place",
    WAVE: "largest displacement of the water surface over H2, up to the time that every run reaches",
}
TIMES = np.arange(1, 41) / 5
"""Times over R / sqrt(g H2) at which series are taken."""


class Answer(NamedTuple):
    """An answer of all runs of a study, and the half-widths of its bands, arrays (runs, ...) in the order of the runs.

    Not a number where a run failed, or has no band; no array of half-widths in a study without bands.
    """

    name: str
    values: np.ndarray
    half_widths: np.ndarray | None


def ended_well(results: "Results") -> np.ndarray:
    """Return which runs came to their end, in their order."""
    return (results.runs["status"] == "ok").to_numpy()


def once(results: "Results") -> list[Answer]:
    """Return the answers of each run as a whole, without those that no run has.

    Bands are those of runs.csv. A time of arrest on a uniform grid has none there: its half-width is the larger
    difference between neighbours among its three grids, several times its error.
    """
    rows, well = results.runs, ended_well(results)
    points = [run.point for run in results.runs_of_study]
    scales = {
        LENGTH: np.array([point.radius for point in points]),
        PEAK: np.array([point.column_height for point in points]),
        ARRESTED: np.array([point.time_scale for point in points]),
    }
    answers = []
    for name, scale in scales.items():
        values = np.where(well, rows[name].to_numpy(float), np.nan) / scale
        if np.isnan(values).all():
            continue
        half_widths = None
        if results.has_bands:
            half_widths = rows[f"{name}_band"].to_numpy(float)
            if name == ARRESTED:
                half_widths = np.where(np.isnan(half_widths), _between_grids(results), half_widths)
            half_widths = _without_gaps(half_widths / scale)
        answers.append(Answer(name, values, half_widths))
    return answers


def in_time(results: "Results") -> list[Answer]:
    """Return the answers at TIMES, arrays (runs, times), without those that no run has."""
    runs = results.runs_of_study
    well = ended_well(results)
    front = np.full((len(runs), len(TIMES)), np.nan)
    wave = front.copy()
    places = {run.id: n for n, run in enumerate(runs)}
    for run, record in results.each("time", "x_front", WAVE):
        if well[n := places[run.id]]:
            front[n], wave[n] = _series(run.point, record)
    answers = []
    bands = (_of_fronts(runs, front), _of_waves(results, wave)) if results.has_bands else (None, None)
    for name, values, half_widths in zip(IN_TIME, (front, wave), bands, strict=True):
        if not np.isnan(values).all():
            answers.append(Answer(name, values, None if half_widths is None else _without_gaps(half_widths)))
    return answers


def _series(point: Point, record: dict) -> tuple[np.ndarray, np.ndarray]:
    """Return front and wave of a run at TIMES; no wave after its end."""
    time = record["time"] / point.time_scale
    front = np.interp(TIMES, time, record["x_front"][0]) / point.radius
    wave = np.interp(TIMES, time, record[WAVE], right=np.nan) / point.column_height
    return front, wave


def _between_grids(results: "Results") -> np.ndarray:
    """Return the larger difference of times of arrest between neighbours among a run's grids."""
    times = {
        one.id: float(record["time_of_arrest"][0])
        for one, record in _of_companions(results, "time_of_arrest")
    }
    fine = results.runs[ARRESTED].to_numpy(float)
    coarse = [np.array([times.get(names[role], np.nan) for names in _names(results)]) for role in COARSENING]
    return np.maximum(abs(fine - coarse[0]), abs(coarse[0] - coarse[1]))


def _of_fronts(runs: "tuple[StudyRun, ...]", front: np.ndarray) -> np.ndarray:
    """Return the half-widths of fronts at TIMES, as bands.csv has them at the times of snapshots."""
    half_widths = np.empty_like(front)
    for n, run in enumerate(runs):
        length = front[n, -1]
        if choice.is_fitted(run.point):
            moving, arrived = (
                fitted.half_width(run.point, FRONT, value, 1.0) / value for value in (0.5, 1.0)
            )
            sizes = front[n]
        else:
            moving, arrived = (
                calibration.front(run.point, "1pc", value, 1.0) / run.point.radius for value in (0.0, 1.0)
            )
            sizes = np.ones_like(front[n])
        half_widths[n] = np.where(front[n] < calibration.ARRIVED * length, moving, arrived) * sizes
    return half_widths


def _of_waves(results: "Results", wave: np.ndarray) -> np.ndarray:
    """Return the half-widths of waves at TIMES, as bands.csv has them at the times of snapshots."""
    coarse = {
        one.id: _series(one.point, record)[1]
        for one, record in _of_companions(results, "time", "x_front", WAVE)
    }
    none = np.full(len(TIMES), np.nan)
    half_widths = np.empty_like(wave)
    for n, (run, names) in enumerate(zip(results.runs_of_study, _names(results), strict=True)):
        half, quarter = (coarse.get(names.get(role, ""), none) for role in COARSENING)
        factor = calibration.WAVES[run.point.order]
        parts = (
            factor.last * abs(wave[n] - half),
            factor.before * abs(half - quarter),
            factor.cell * run.point.scaled_dx * abs(wave[n]),
        )
        half_widths[n] = np.maximum.reduce(parts)
        if not calibration.is_calibrated(run.point):
            three = (wave[n], half, quarter)
            spread = np.maximum.reduce(three) - np.minimum.reduce(three)
            half_widths[n] = np.maximum(half_widths[n], convergence.SPREAD * spread)
    return half_widths


def _of_companions(results: "Results", *names: str) -> "Iterator[tuple[Companion, dict]]":
    """Give the companions that ended well, batch by batch, with variables of their records."""
    among = sorted(results.companions, key=lambda one: one.batch)
    for one, record in results.each(*names, "status", among=among):
        if record["status"] == "ok":
            yield one, record


def _names(results: "Results") -> list[dict[str, str]]:
    """Return the ids of each run's companions by role, in the order of the runs."""
    names: dict[str, dict[str, str]] = {run.id: {} for run in results.runs_of_study}
    for one in results.companions:
        names[one.of][one.role] = one.id
    return list(names.values())


def _without_gaps(half_widths: np.ndarray) -> np.ndarray:
    """Return half-widths, the largest of the others for a run whose companions did not all end well."""
    with np.errstate(all="ignore"):
        largest = np.nanmax(half_widths, axis=0, initial=0.0)
    return np.where(np.isnan(half_widths), largest, half_widths)
