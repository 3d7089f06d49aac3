"""The table of errors and seconds: a row for each run and quantity of each problem of a study."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from subslide.keys import schema, words
from subslide.keys.schema import ConfigError
from subslide.naming import FINISHED
from subslide.points import Point
from subslide.study.config import Study
from subslide.tables import _convergence as convergence
from subslide.tables._problems import METHOD, NAMES, Problem, edge_time, end_time, method, problems

if TYPE_CHECKING:
    import pandas as pd

    from subslide.results import Results

TITLE = "Error and seconds of every choice of numerics"
READS = ("records",)
FLOAT_FORMAT = "%.8g"
TIMES = 200
"""Times, equally far apart, at which a series is compared."""
PLACE = ("a_H", "a_2", "r", "delta", "radius")
COLUMNS = {
    "id": ("", "name of the run"),
    **{key: (words.unit(key), schema.properties()[key]["description"]) for key in PLACE},
    "quantity": ("", "what is compared, see above"),
    **{key: (words.unit(key), schema.properties()[key]["description"]) for key in METHOD},
    "model": ("", "geometry that was solved"),
    "cells": ("", "cell size as a count; see config/README.md"),
    "method": (
        "",
        "`default` (on a radius), `paper` (in the plane) or `fitted` (the default on a fitted grid) where the numerics"
        " are these; else empty",
    ),
    "status": ("", "how the run ended"),
    "seconds": ("s", "wall time of the time loop alone, one timing"),
    "error": (
        "",
        "relative error; empty where the run failed, is of a fitted grid and has no waves, or the truth is not known",
    ),
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
WORDS = ("id", "quantity", "method", "status", "above_uncertainty", "on_front")
QUANTITIES = {
    "L_f": "length of the deposit (1 % front) at the end of the run",
    "x_front": "front (1 %) over time, to the end of the run",
    "max_abs_eta": "largest displacement of the water surface over time, until waves reach the edge of the box",
    "max_abs_eta_outside": "the same beyond R",
}
WAVES = ("max_abs_eta", "max_abs_eta_outside")
MEASURED = ("L_f", "x_front", *WAVES, "time", "status", "wall_seconds")
"""Variables of records that the table follows from."""
NO_SWEEP = (
    "sweep of numerics: one column in the plane and, by the default numerics, on three grids on a radius;"
    " allowed: the folder of a study such as accuracy"
)


def about() -> str:
    """Return what the documentation says of the table: where it is, and its quantities."""
    quantities = "\n".join(f"- `{name}`: {text}" for name, text in QUANTITIES.items())
    return f"""One row for each run and quantity, in studies that solve a column in the plane and, by the default
numerics, on three grids on a radius of which each has twice the cells of the next. The three finest of these give the
truth: Richardson's limit, with the band of bands.csv about it. The error is the mean of |value - truth| over the mean
of the truth: of one length, or of a series at {TIMES} times. docs/work_precision.md has the reasons.

Quantities:

{quantities}"""


def needs(study: Study) -> str:
    """Return '' for a study with a sweep of numerics."""
    return "" if problems(study.points) else NO_SWEEP


def table(results: "Results") -> list[dict]:
    """Return the rows, by column, as the study is sorted within each problem and quantity.

    Raises
    ------
    ConfigError
        If the study has no sweep of numerics.
    """
    runs = {run.id: run for run in results.runs_of_study}
    columns = problems(run.point for run in runs.values())
    if not columns:
        raise ConfigError(f"{results.folder} has no {NO_SWEEP}")
    swept = [runs[point.id] for problem in columns for point in problem.points]
    records = {run.id: record for run, record in results.each(*MEASURED, among=swept)}
    return [row for problem in columns for row in problem_rows(problem, records)]


def problem_rows(problem: Problem, records: dict[str, dict]) -> list[dict]:
    """Return the rows of one problem.

    Parameters
    ----------
    problem
        The column's points, and those of its truth.
    records
        Variables MEASURED of each point, by its id.
    """
    solved = {point.id: values(point, records[point.id]) for point in problem.points}
    judged = []
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
                "status": records[point.id]["status"],
                "seconds": float(records[point.id]["wall_seconds"]),
                "error": relative(solved[point.id][quantity] - truth, truth),
                "truth": float(np.mean(truth)),
                "uncertainty": relative(band, truth),
            }
            for point in problem.points
        ]
        judge(rows)
        judged += rows
    return judged


def values(point: Point, record: dict) -> dict[str, np.ndarray]:
    """Return the values (m) of each quantity, one or one for each time; NaN where the run failed or ended before."""
    time = record["time"]
    series = {"L_f": record["L_f"][:1], "x_front": _at(end_time(point), time, record["x_front"][0])}
    series |= {name: _at(edge_time(point), time, record[name]) for name in WAVES}
    answered = record["status"] in FINISHED
    return {name: entries if answered else np.full(len(entries), np.nan) for name, entries in series.items()}


def _at(end: float, time: np.ndarray, series: np.ndarray) -> np.ndarray:
    """Return the series (m) at TIMES times after 0 up to `end` (s); NaN if it stops before."""
    late = time[-1] < end * (1 - 1e-9)
    wanted = end * np.arange(1, TIMES + 1) / TIMES
    return np.full(TIMES, np.nan) if late else np.interp(wanted, time, series)


def converged(point: Point, quantity: str, *grids: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the truth and the half-width of its band (m), value by value, from three grids, the finest first.

    The truth is the limit of Richardson's extrapolation, or, where three values show no order, the finest of them.
    """
    scale = (1 + point.a_H) * point.a_2 * point.radius if quantity in WAVES else 0.0
    estimates = [
        convergence.estimate(float(f1), float(f2), float(f3), convergence.FORMAL_ORDER, scale=scale)
        for f1, f2, f3 in zip(*grids, strict=True)
    ]
    limits = np.array([one.limit for one in estimates])
    return np.where(np.isfinite(limits), limits, grids[0]), np.array([one.band for one in estimates])


def relative(difference: np.ndarray, truth: np.ndarray) -> float:
    """Return the mean of |difference| over the mean of |truth|."""
    return float(np.mean(np.abs(difference)) / np.mean(np.abs(truth)))


def judge(rows: list[dict]) -> None:
    """Give the rows of one problem and quantity what follows from comparing them."""
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
    """Give groups of rows that differ in their cells alone."""
    families: dict[tuple, list[dict]] = {}
    for row in rows:
        families.setdefault(tuple(row[key] for key in METHOD), []).append(row)
    return iter(families.values())


def reached(runs: "pd.DataFrame") -> "pd.DataFrame":
    """Return the rows of the paper's method whose error counts, because no finer grid has a larger one, by cells."""
    paper = runs[runs["method"] == "paper"]
    return paper[paper["sure_error"] <= paper["error"] * (1 + 1e-6)].sort_values([*PLACE, "cells"])


def pareto(rows: list[dict]) -> list[dict]:
    """Return the rows than which none is both as cheap and as accurate, from the cheapest to the most accurate."""
    front: list[dict] = []
    known = [row for row in rows if np.isfinite(row["sure_error"])]
    for row in sorted(known, key=lambda row: (row["seconds"], row["sure_error"])):
        if row["sure_error"] < (front[-1]["sure_error"] if front else np.inf):
            front.append(row)
    return front


def cheapest(rows: list[dict], error: float) -> dict | None:
    """Return the row with the fewest seconds among those whose sure error is no larger; None if there is none."""
    enough = [row for row in rows if row["sure_error"] <= error]
    return min(enough, key=lambda row: row["seconds"], default=None)
