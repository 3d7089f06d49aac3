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
- `riemann`, the coupled dam break, 0.4 and 0.8: the same, and the weak waves of the surface that go before the grains
  are jumps, which first order smears over more cells the longer they go: the root of the cell's size in theory.
- other scenes have no expectation.

Fronts of the Coulomb dam break are compared with the edge where the depth ends. A front at 1 % of H2 stays behind that
edge on any grid: the difference is no error of the scheme, falls at no order and has no expectation.
"""

import json
import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from subslide import catalogue, exact
from subslide.keys import schema, words
from subslide.naming import FRONT_LABELS
from subslide.points import Point, options_text, to_dict
from subslide.study.config import Study
from subslide.tables import _norms, _orders
from subslide.tables._verdicts import (
    BELOW,
    EXPECTED,
    FAILED,
    FIRST,
    METHOD,
    MOVED,
    NONE,
    REACHED,
    REQUIRED,
    STILL,
    VERDICTS,
    order_between,
)

if TYPE_CHECKING:
    from subslide.results import Results

TITLE = "Errors against exact solutions"
READS = ("records",)
FLOAT_FORMAT = "%.10g"
COLUMNS = {
    "id": ("", "name of the run"),
    "scene": ("", "initial state"),
    "options": ("", "options of the scene (JSON)"),
    **{key: (words.unit(key), schema.properties()[key]["description"]) for key in METHOD},
    "model": ("", "geometry that was solved"),
    "time": ("s", "elapsed time since release"),
    "quantity": ("", "what is compared, see above"),
    "error": ("", "relative error; empty where the run failed before that time"),
    "observed_order": (
        "",
        "log(e2/e1) / log(cells1/cells2) against the next coarser run, equal but for its cells",
    ),
    "expected_order": ("", "least order that counts as reached; empty where none is expected"),
    "verdict": ("", "see above"),
}
WORDS = ("id", "options", "quantity", "verdict")
QUANTITIES = {
    "h2": "depth of the grains: sum of |error| over the sum of |exact|, each cell (on a radius each ring) by its size;"
    " for waves of small amplitude the mean of |error| over the exact amplitude",
    "eta": "displacement of the water surface, likewise; for a dam break of water over its depth",
    **{
        f"x_front_{t}": f"how far the front at {t[:-2]} % of H2 is behind the exact edge, over the edge's distance"
        for t in FRONT_LABELS
    },
    "h2_change": "grains that must stay at rest: largest change of their depth since the start, over H2",
}
MEASURED = ("x", "cell_width", "h2", "eta", "snapshot_time", "time", "x_front", "dx", "model")
"""Variables of records that the table follows from."""


def about() -> str:
    """Return what the documentation says of the table: its quantities and verdicts."""
    quantities = "\n".join(f"- `{name}`: {text}" for name, text in QUANTITIES.items())
    verdicts = "\n".join(f"- `{name}`: {text}" for name, text in VERDICTS.items())
    return f"""One row for each run, quantity and time with a known answer, in studies that have a scene with an exact
solution. Times are those of `snapshot_times` after the start, and `t_end` where it is a time. A run of which
no profiles were kept (`keep`) has no rows. Reasons for the expected orders: docs/verification.md.

Quantities:

{quantities}

Verdicts:

{verdicts}"""


def needs(study: Study) -> str:
    """Return '' for a study that has a scene with an exact solution, and keeps profiles."""
    known = catalogue.names("exact")
    if not any(point.scene in known for point in study.points):
        return f"scene: {' or '.join(known)}"
    return "" if study.keep == "all" else "keep: all"


def table(results: "Results") -> list[dict]:
    """Return the rows, by column, in the order of the runs, then by time and quantity."""
    known = catalogue.names("exact")
    solved = [run for run in results.runs_of_study if run.point.scene in known]
    rows: list[dict] = []
    families: dict[str, list[dict]] = {}
    for run, record in results.each(*MEASURED, among=solved):
        if "h2" not in record:  # of a batch that was solved while the study kept less
            continue
        for row in run_rows(run.point, record):
            rows.append(row)
            families.setdefault(_family(run.point, row), []).append(row)
    for family in families.values():
        judge(family)
    return rows


def text(results: "Results") -> str:
    """Return errors and observed orders as lines to read."""
    return _orders.text(_orders.lines(results.errors)) if len(results.errors) else "no run has a known answer"


def run_rows(point: Point, record: dict) -> Iterator[dict]:
    """Give the rows of one run, without orders: one for each quantity and time with a known answer."""
    answer = exact.load(point.scene)
    about_run = {"id": point.id, "scene": point.scene, "options": options_text(point)}
    about_run |= {key: getattr(point, key) for key in METHOD} | {"model": record["model"]}
    order = expected(point, record["model"])[0]
    for time in times(point, record):
        for quantity, error in _norms.errors_at(answer, point, record, time):
            plain = quantity in ("h2", "eta")
            row = {"time": time, "quantity": quantity, "error": error}
            yield {**about_run, **row, "expected_order": order if plain else math.nan}


def expected(point: Point, model: str) -> tuple[float, bool]:
    """Return the least expected order of a run (NaN if none), and whether verification requires it."""
    for key in (f"{point.scene} {model}", point.scene):
        if key in EXPECTED:
            return EXPECTED[key][point.order - 1], key in REQUIRED
    return math.nan, False


def times(point: Point, record: dict) -> list[float]:
    """Return the times (s) after the start at which runs on every grid have profiles: not the end of a run to rest."""
    asked = {time for time in record["snapshot_time"].tolist() if time in point.profile_times}
    return sorted(time for time in asked | ({point.t_end} - {None}) if time > 0)


def judge(family: list[dict]) -> None:
    """Give rows that differ in their cells alone their observed orders and verdicts."""
    coarser = None
    for row in sorted(family, key=lambda row: row["cells"]):
        p = order_between(coarser, row) if coarser else math.nan
        row |= {"observed_order": p, "verdict": verdict(row, p, coarser is None)}
        coarser = row


def verdict(row: dict, p: float, first: bool) -> str:
    """Return the word on a row with the observed order p; see VERDICTS."""
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


def _family(point: Point, row: dict) -> str:
    """Return a text that is equal for rows of runs that differ in their cells alone."""
    same = {key: value for key, value in to_dict(point).items() if key != "cells"}
    return json.dumps([same, row["quantity"], row["time"]], sort_keys=True)
