"""Errors of a study's runs against exact solutions, and the order at which they fall with the size of cells.

Expected is the least order that a scheme in order should show, with its reason:

- `standing_wave`, 0.9 and 1.8: the answer is smooth, so the formal orders 1 and 2 hold but for a tenth, which limiters
  at crests and coarse grids may cost.
- `paraboloid` of grains alone, 0.6 and 1.6: smooth up to an edge where the depth goes to 0 with a kink. First order
  lags at the edge by a distance that shrinks more slowly than the cells, and by how much depends on the CFL number;
  second order keeps nearly its formal order.
- `paraboloid` under water, 0.6 and 1: the same, but a dry edge under water has the viscosity of a solver of four waves,
  which is of first order there.
- `dam_break`, 0.6 and 0.8: kinks at both ends of the fan hold first order below 1 (theory for kinks: 2/3 and more);
  a shock is as wide as a cell or two, and the first steps from the jump leave an error of about a cell for good, so
  second order shows 1 at best. Where in its cell the shock stands lets the order of two grids scatter by 0.2.
- other scenes have no expectation.

Fronts of the Coulomb dam break are compared with the edge where the depth ends. A front at 1 % of H2 stays behind that
edge on any grid: the difference is no error of the scheme, falls at no order and has no expectation.
"""

import json
import math
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pandas as pd
import xarray as xr

from subslide import exact
from subslide.files import write_text
from subslide.points import RUN_KEYS, Point, from_dict, options_text
from subslide.results import Results, trimmed
from subslide.tables import bands

COLUMNS = {
    "id": ("", "name of the run"),
    "scene": ("", "initial state"),
    "options": ("", "options of the scene (JSON)"),
    "scheme": ("", "Riemann solver"),
    "front_flux": ("", "flux into a dry cell"),
    "wave_speeds": ("", "wave speeds of the Riemann solver"),
    "order": ("", "order of accuracy in space and time"),
    "model": ("", "geometry that was solved"),
    "cells": ("", "cell size as a count; see config/README.md"),
    "dtype": ("", "floating-point type of the state"),
    "time": ("s", "elapsed time since release"),
    "quantity": ("", "what is compared, see below"),
    "error": ("", "relative error; empty where the run failed before that time"),
    "observed_order": (
        "",
        "log(e2/e1) / log(cells1/cells2) against the next coarser run, equal but for its cells",
    ),
    "expected_order": ("", "least order that counts as reached; empty where none is expected"),
    "verdict": ("", "see below"),
}
QUANTITIES = {
    "h2": "depth of the grains: sum of |error| over the sum of |exact|, each cell (on a radius each ring) by its size;"
    " for waves of small amplitude the mean of |error| over the exact amplitude",
    "eta": "displacement of the water surface, likewise; for a dam break of water over its depth",
    **{
        f"x_front_{t}": f"how far the front at {t[:-2]} % of H2 is behind the exact edge, over the edge's distance"
        for t in bands.THRESHOLDS
    },
    "h2_change": "grains that must stay at rest: largest change of their depth since the start, over H2",
}
REACHED, BELOW, FIRST, FAILED, NONE = "reached", "below", "first grid", "failed", "no expectation"
STILL, MOVED = "still", "moved"
VERDICTS = {
    REACHED: "the observed order is at least the expected one",
    BELOW: "it is not",
    FIRST: "the study has no coarser run to compare with",
    FAILED: "the run ended before that time, or the coarser one did",
    NONE: "no order is expected",
    STILL: "grains at rest did not move by a bit",
    MOVED: "grains at rest moved",
}
EXPECTED = {
    "standing_wave": (0.9, 1.8),
    "paraboloid one-layer": (0.6, 1.6),
    "paraboloid": (0.6, 1.0),
    "dam_break": (0.6, 0.8),
}
"""Least expected orders of schemes of first and second order, by scene, or by scene and model."""
REQUIRED = ("standing_wave", "paraboloid one-layer")
"""Keys of EXPECTED without which `subslide verify` fails; so do grains at rest that move."""
READ = ("h2", "eta", "snapshot_time", "time", "x_front", "dx", "model", "steps")
"""Variables of records that errors follow from."""
GAUSS = ((-math.sqrt(0.6), 5 / 18), (0.0, 8 / 18), (math.sqrt(0.6), 5 / 18))
"""Places in a cell from -1 to 1 and weights of Gauss's quadrature."""


def write(folder: Path) -> Path:
    """Path of the table of errors of the study in `folder`, newly written."""
    path = folder / "tables" / "errors.csv"
    path.parent.mkdir(exist_ok=True)
    write_text(path, table(Results(folder)).to_csv(index=False, float_format="%.10g", lineterminator="\n"))
    return path


def table(results: Results) -> pd.DataFrame:
    """Table of errors: rows in the order of the runs, then by time and quantity."""
    batches, rows, families = {}, [], {}
    for row in results.points:
        if row["scene"] not in exact.NAMES:
            continue
        if row["batch"] not in batches:
            batches[row["batch"]] = results.batch(row["batch"])[list(READ)].load()
        for found in run_rows(_point(row), trimmed(batches[row["batch"]], row["id"])):
            rows.append(found)
            families.setdefault(_family(row, found), []).append(found)
    for family in families.values():
        judge(family)
    return pd.DataFrame(rows, columns=list(COLUMNS))


def run_rows(point: Point, run: xr.Dataset) -> Iterator[dict]:
    """Rows of one run, without orders: one for each quantity and time with a known answer."""
    answer = exact.load(point.scene)
    about = {"id": point.id, "scene": point.scene, "options": options_text(point)}
    about |= {key: getattr(point, key) for key in ("scheme", "front_flux", "wave_speeds", "order")}
    about |= {"model": str(run["model"].values), "cells": point.cells, "dtype": point.dtype}
    about["expected_order"] = expected(point, about["model"])[0]
    for time in times(point, run):
        for quantity, error in errors_at(answer, point, run, time):
            plain = quantity in ("h2", "eta")
            yield {
                **about,
                "time": time,
                "quantity": quantity,
                "error": error,
                "expected_order": about["expected_order"] if plain else math.nan,
            }


def expected(point: Point, model: str) -> tuple[float, bool]:
    """Least expected order of a run (NaN if none), and whether verification requires it."""
    for key in (f"{point.scene} {model}", point.scene):
        if key in EXPECTED:
            return EXPECTED[key][point.order - 1], key in REQUIRED
    return math.nan, False


def times(point: Point, run: xr.Dataset) -> list[float]:
    """Times (s) after the start at which runs on every grid have profiles: not the end of a run to rest."""
    found = [float(time) for time in np.atleast_1d(run["snapshot_time"].values)][:-1]
    if point.t_end is not None:
        found.append(point.t_end)
    return sorted({time for time in found if time > 0})


def errors_at(answer, point: Point, run: xr.Dataset, time: float) -> Iterator[tuple[str, float]]:
    """Quantity and error of each known answer at one time; NaN if the run ended before."""
    if hasattr(answer, "stays"):
        if answer.stays(point):
            yield "h2_change", _change(point, _profile(run, "h2", time), _profile(run, "h2", 0.0))
        return
    known = cell_means(answer, point, run, time)
    weight = weights(run)
    for quantity, values in known.items():
        if not np.isfinite(run[quantity].values).any():  # water of a model without water
            continue
        size = scale(answer, point, quantity, time, values, weight)
        if np.isfinite(values).all() and size > 0:
            solved = _profile(run, quantity, time)
            yield quantity, float((weight * np.abs(solved - values)).sum() / size)
    if point.delta > 0 and hasattr(answer, "edge_known") and answer.edge_known(point, time):
        edge = answer.edge_position(point, time)
        for label, n in bands.THRESHOLDS.items():
            yield f"x_front_{label}", 1 - _front(run, n, time) / edge


def cell_means(answer, point: Point, run: xr.Dataset, time: float) -> dict[str, np.ndarray]:
    """Exact h2 and eta (m) by cell or ring, of Gauss's quadrature with three points."""
    x, dx = run["x"].values, float(run["dx"])
    ring = is_round(run)
    total, size = {}, 0.0
    for place, share in GAUSS:
        spot = x + 0.5 * dx * place
        share = share * np.abs(spot) if ring else share
        size = size + share
        for quantity, values in answer.solution(point, spot, time).items():
            total[quantity] = total.get(quantity, 0.0) + share * values
    return {quantity: values / size for quantity, values in total.items()}


def is_round(run: xr.Dataset) -> bool:
    """Whether the cells of a profile stand for rings: a line alone reaches across the axis with a model that is no
    plane."""
    return float(run["x"].values[0]) > 0 or str(run["model"].values) == "plane"


def weights(run: xr.Dataset) -> np.ndarray:
    """Relative sizes of the cells or rings of a profile."""
    x = run["x"].values
    return np.abs(x) if is_round(run) else np.ones(len(x))


def scale(answer, point: Point, quantity: str, time: float, values: np.ndarray, weight: np.ndarray) -> float:
    """What an error is relative to, in the unit of sum(weight * |error|); 0 where nothing is compared."""
    height = point.a_2 * point.radius
    if hasattr(answer, "amplitude"):
        return float(weight.sum()) * answer.amplitude(point, time) * height
    if point.scene == "dam_break" and quantity == "eta":
        values = values + (1 + point.a_H) * height
    return float((weight * np.abs(values)).sum())


def judge(family: list[dict]) -> None:
    """Nothing; rows that differ in their cells alone get observed orders and verdicts."""
    coarser = None
    for row in sorted(family, key=lambda row: row["cells"]):
        p = order_between(coarser, row) if coarser else math.nan
        row |= {"observed_order": p, "verdict": verdict(row, p, coarser is None)}
        coarser = row


def order_between(coarse, fine) -> float:
    """Observed order between two rows; NaN where an error is 0 or unknown."""
    if not (coarse["error"] > 0 and fine["error"] > 0):
        return math.nan
    return math.log(coarse["error"] / fine["error"]) / math.log(fine["cells"] / coarse["cells"])


def verdict(row, p: float, first: bool) -> str:
    """Word on a row with the observed order p; see VERDICTS."""
    if not math.isfinite(row["error"]):
        return FAILED
    if row["quantity"] == "h2_change":
        return STILL if row["error"] == 0 else MOVED
    if math.isnan(row["expected_order"]):
        return NONE
    if first:
        return FIRST
    if math.isnan(p):
        return FAILED
    return REACHED if p >= row["expected_order"] else BELOW


def _family(row: dict, found: dict) -> str:
    """Text that is equal for rows of runs that differ in their cells alone."""
    same = {key: row[key] for key in RUN_KEYS if key != "cells"}
    return json.dumps([same, found["quantity"], found["time"]], sort_keys=True)


def _point(row: dict) -> Point:
    return from_dict({key: row[key] for key in RUN_KEYS})


def _profile(run: xr.Dataset, quantity: str, time: float) -> np.ndarray:
    """Profile (m) at a time, NaN if the run has none."""
    shots = np.atleast_1d(run["snapshot_time"].values)
    place = int(np.argmin(np.abs(shots - time)))
    near = abs(shots[place] - time) <= 1e-9 * max(time, 1e-12)
    return run[quantity].values[place] if near else np.full(len(run["x"]), math.nan)


def _change(point: Point, later: np.ndarray, start: np.ndarray) -> float:
    return float(np.max(np.abs(later - start))) / (point.a_2 * point.radius)


def _front(run: xr.Dataset, n: int, time: float) -> float:
    """Front (m) at threshold n and a time, NaN if the run ended before."""
    return float(np.interp(time, run["time"].values, run["x_front"].values[n], right=math.nan))
