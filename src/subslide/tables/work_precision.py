"""The table of errors and seconds: a row for each run and quantity of each problem of a study."""

from collections.abc import Iterator

import numpy as np
import pandas as pd
import xarray as xr

from subslide.keys.schema import ConfigError
from subslide.points import RUN_KEYS, Point, from_dict
from subslide.results import Results, trimmed
from subslide.tables import _convergence as convergence
from subslide.tables import bands
from subslide.tables._problems import METHOD, NAMES, Problem, edge_time, end_time, method, problems

TIMES = 200
"""Times, equally far apart, at which a series is compared."""
PLACE = ("a_H", "a_2", "r", "delta", "radius")
COLUMNS = {
    "id": ("", "name of the run"),
    "a_H": ("", "water depth above the column over the column's height"),
    "a_2": ("", "aspect ratio of the column"),
    "r": ("", "density of water over density of grains"),
    "delta": ("degree", "friction angle"),
    "radius": ("m", "initial radius of the column"),
    "quantity": ("", "what is compared, see below"),
    "model": ("", "geometry that was solved"),
    "scheme": ("", "Riemann solver"),
    "front_flux": ("", "flux into a dry cell"),
    "wave_speeds": ("", "wave speeds of the Riemann solver"),
    "order": ("", "order of accuracy in space and time"),
    "dtype": ("", "floating-point type of the state"),
    "cfl": ("", "Courant number"),
    "cells": ("", "cell size as a count; see config/README.md"),
    "method": (
        "",
        "`default` (on a radius) or `paper` (in the plane) where the numerics are these; else empty",
    ),
    "status": ("", "how the run ended"),
    "seconds": ("s", "wall time of the time loop alone, one timing"),
    "error": ("", "relative error; empty where the run failed"),
    "sure_error": (
        "",
        "largest error on this and every finer grid of the same numerics, and no less than `uncertainty`: a grid that"
        " is right by chance does not count; on the finest, which no other tests, also no less than what the error"
        " changed by from the next coarser",
    ),
    "truth": ("m", "what the run is compared with (of a series its mean)"),
    "uncertainty": ("", "relative half-width of the band of the truth's own discretisation error"),
    "above_uncertainty": ("", "whether `error` exceeds `uncertainty`; if not, it is not known to this digit"),
    "on_front": ("", "whether no cheaper run has a `sure_error` as small: the run is on the Pareto front"),
    "factor": (
        "",
        "`seconds` over those of the cheapest run of the default numerics with no larger `sure_error`; empty if none",
    ),
}
QUANTITIES = {
    "L_f": "length of the deposit (1 % front) at the end of the run",
    "x_front": "front (1 %) over time, to the end of the run",
    "max_abs_eta": "largest displacement of the water surface over time, until waves reach the edge of the box",
    "max_abs_eta_outside": "the same beyond R",
}
READ = ("L_f", "x_front", "max_abs_eta", "max_abs_eta_outside", "time", "status", "wall_seconds", "steps")
"""Variables of records that are read."""


def table(results: Results) -> pd.DataFrame:
    """Table by COLUMNS, sorted as the study is within each problem and quantity; ConfigError without a problem."""
    rows = {row["id"]: row for row in results.points}
    found = problems(from_dict({key: row[key] for key in RUN_KEYS}) for row in rows.values())
    if not found:
        raise ConfigError(
            f"{results.folder} has no sweep of numerics: one column in the plane and, by the default numerics, on three"
            " grids on a radius; allowed: the folder of a study such as accuracy"
        )
    batches, entries = {}, []
    for problem in found:
        runs = {}
        for point in problem.points:
            batch = rows[point.id]["batch"]
            if batch not in batches:
                batches[batch] = results.batch(batch)[list(READ)].load()
            runs[point.id] = trimmed(batches[batch], point.id)
        entries += problem_rows(problem, runs)
    return pd.DataFrame(entries, columns=list(COLUMNS))


def problem_rows(problem: Problem, runs: dict[str, xr.Dataset]) -> list[dict]:
    """Rows of one problem. runs: record of each point by its id."""
    solved = {point.id: values(point, runs[point.id]) for point in problem.points}
    found = []
    for quantity in QUANTITIES:
        truth, band = converged(problem.truth[0], quantity, *(solved[p.id][quantity] for p in problem.truth))
        rows = [
            {
                **{key: getattr(point, key) for key in PLACE},
                **dict(zip(METHOD, method(point), strict=True)),
                "id": point.id,
                "quantity": quantity,
                "cells": point.cells,
                "method": NAMES.get(method(point), ""),
                "status": str(runs[point.id]["status"].values),
                "seconds": float(runs[point.id]["wall_seconds"]),
                "error": relative(solved[point.id][quantity] - truth, truth),
                "truth": float(np.mean(truth)),
                "uncertainty": relative(band, truth),
            }
            for point in problem.points
        ]
        judge(rows)
        found += rows
    return found


def values(point: Point, run: xr.Dataset) -> dict[str, np.ndarray]:
    """Values (m) of each quantity, one or one for each time; NaN where the run failed or ended before."""
    fine = str(run["status"].values) in ("ok", "not_at_rest")
    time = run["time"].values
    found = {"L_f": run["L_f"].values[:1], "x_front": _at(end_time(point), time, run["x_front"].values[0])}
    for name in bands.WAVES:
        found[name] = _at(edge_time(point), time, run[name].values)
    return {name: entries if fine else np.full(len(entries), np.nan) for name, entries in found.items()}


def _at(end: float, time: np.ndarray, series: np.ndarray) -> np.ndarray:
    """Series (m) at TIMES times after 0 up to `end` (s); NaN if it stops before."""
    late = time[-1] < end * (1 - 1e-9)
    wanted = end * np.arange(1, TIMES + 1) / TIMES
    return np.full(TIMES, np.nan) if late else np.interp(wanted, time, series)


def converged(point: Point, quantity: str, *grids: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Truth and half-width of its band (m), value by value, from three grids, the finest first.

    The truth is the limit of Richardson's extrapolation, or, where three values show no order, the finest of them.
    """
    scale = (1 + point.a_H) * point.a_2 * point.radius if quantity in bands.WAVES else 0.0
    found = [
        convergence.estimate(*(float(f) for f in three), bands.FORMAL_ORDER, scale=scale)
        for three in zip(*grids, strict=True)
    ]
    limits = np.array([one.limit for one in found])
    return np.where(np.isfinite(limits), limits, grids[0]), np.array([one.band for one in found])


def relative(difference: np.ndarray, truth: np.ndarray) -> float:
    """Mean of |difference| over the mean of |truth|."""
    return float(np.mean(np.abs(difference)) / np.mean(np.abs(truth)))


def judge(rows: list[dict]) -> None:
    """Nothing; rows of one problem and quantity get what follows from comparing them."""
    for family in _families(rows):
        known = [row for row in family if np.isfinite(row["error"])]
        known.sort(key=lambda row: -row["cells"])
        worst = abs(known[1]["error"] - known[0]["error"]) if len(known) > 1 else 0.0
        for row in family:
            row |= {"sure_error": np.nan, "above_uncertainty": None}
        for row in known:
            worst = max(worst, row["error"], row["uncertainty"])
            row |= {"sure_error": worst, "above_uncertainty": bool(row["error"] > row["uncertainty"])}
            if row is known[0]:
                worst = max(row["error"], row["uncertainty"])
    front = {id(row) for row in pareto(rows)}
    standard = [row for row in rows if row["method"] == "default"]
    for row in rows:
        row["on_front"] = id(row) in front
        equal = cheapest(standard, row["sure_error"])
        row["factor"] = row["seconds"] / equal["seconds"] if equal else np.nan


def _families(rows: list[dict]) -> Iterator[list[dict]]:
    """Rows that differ in their cells alone."""
    found = {}
    for row in rows:
        found.setdefault(tuple(row[key] for key in METHOD), []).append(row)
    return iter(found.values())


def reached(runs: pd.DataFrame) -> pd.DataFrame:
    """Rows of the paper's method whose error counts as it is, because no finer grid has a larger one, by cells."""
    paper = runs[runs["method"] == "paper"]
    return paper[paper["sure_error"] <= paper["error"] * (1 + 1e-6)].sort_values([*PLACE, "cells"])


def pareto(rows: list[dict]) -> list[dict]:
    """Rows than which none is both as cheap and as accurate, from the cheapest to the most accurate."""
    found = []
    known = [row for row in rows if np.isfinite(row["sure_error"])]
    for row in sorted(known, key=lambda row: (row["seconds"], row["sure_error"])):
        if row["sure_error"] < (found[-1]["sure_error"] if found else np.inf):
            found.append(row)
    return found


def cheapest(rows: list[dict], error: float) -> dict | None:
    """Row with the fewest seconds among those whose sure error is no larger; None if there is none."""
    enough = [row for row in rows if row["sure_error"] <= error]
    return min(enough, key=lambda row: row["seconds"], default=None)
