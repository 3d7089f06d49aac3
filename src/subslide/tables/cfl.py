"""The largest stable Courant number of each scheme, order and model, found by bisection, beside the theoretical one.

Stable is what runs without friction between walls, where nothing damps what a scheme amplifies. A run counts as stable
if all of these hold:

- it ends with status `ok`, and volumes hold to `VOLUME`;
- after no moment does its energy rise by more than `GIVEN_BACK` dx / R of what the start can release (its energy less
  that of flat layers at rest): the largest bound that tests/numerics/test_energy.py holds for any scheme at its default
  Courant number;
- at no snapshot is the total variation of h2 or eta larger by more than `VARIATION` than the largest of the resolved
  run and of the same scheme at the Courant number `SAFE`: oscillations between cells (a checkerboard) grow long before
  values stop being finite;
- its distance from the resolved run (mean |difference| of h2 and eta over snapshots and cells) is at most `DISTANCE`
  times what the same scheme has at `SAFE`.

So a number is called stable only if its answer is worth having. Numbers are tried upwards in steps of `STEP` until one
is not stable (downwards by halves if `SAFE` is not), then the gap is halved down to `WIDTH`; every number tried is a
row. Stability need not be monotone: the limit is a stable number above which the next one tried is not.

Theory: a step within which the fastest wave crosses at most one cell, Courant number `THEORY`, for first order on a
line and on a radius; in the plane too, since the step follows the sum of both directions' fastest waves (donor-cell
condition); for MUSCL-Hancock as well, by linear theory (Toro 2009, section 14.4). That depths stay positive is proven
for MUSCL-Hancock up to 1/2 alone (Berthon 2006); here what leaves a cell is limited by what it holds. A wave whose
speed is the same everywhere meets the theoretical limit; in a collapse only a few cells are as fast as the step allows
for, and it may bear more. On a radius the cell at the axis has twice the edge for its size.
"""

import math
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from subslide.points import Point
from subslide.records import energy
from subslide.study.config import Study
from subslide.tables._prose import with_constants

if TYPE_CHECKING:
    from subslide.results import Results
    from subslide.solver.run import Run

TITLE = "Largest stable Courant numbers"
READS = ()
KERNELS = ("radial:float64", "radial:float64:general", "quarter:float64", "quarter:float64:general")
FLOAT_FORMAT = "%.10g"
SAFE, STEP, WIDTH, LEAST, LARGEST = 0.45, 0.15, 0.01, 0.1, 4.0
THEORY = 1
SNAPSHOTS = 48
VOLUME = 1e-10
GIVEN_BACK = 0.28
VARIATION = 0.1
DISTANCE = 4.0
SCHEMES, ORDERS = ("ifcph", "ifcp", "hll", "rusanov", "roe"), (1, 2)
FINER = 8
"""Cells of a resolved run over those of its case."""


class Case(NamedTuple):
    """What is run: a scene with options in a model, cells, its end over R / sqrt(g H2), and the reference's model."""

    model: str
    scene: str
    options: dict
    cells: int
    end: float
    resolved: str


def wave(shape: str) -> dict:
    """Return the options of a surface wave of small amplitude."""
    return {"amplitude": 0.01, "kind": "surface", "shape": shape}


CASES = (
    Case("line", "standing_wave", wave("line"), 100, 60.0, "line"),
    Case("radial", "standing_wave", wave("round"), 100, 60.0, "radial"),
    Case("line", "dam_break", {"downstream": 0.2, "layer": "grains"}, 100, 12.0, "line"),
    Case("one-layer", "cylinder", {}, 100, 12.0, "one-layer"),
    Case("radial", "cylinder", {}, 100, 12.0, "radial"),
    Case("quarter", "cylinder", {}, 60, 12.0, "radial"),
)

COLUMNS = {
    "model": ("", "geometry that was solved"),
    "scene": ("", "initial state"),
    "scheme": ("", "Riemann solver"),
    "order": ("", "order of accuracy in space and time"),
    "cfl": ("", "Courant number that was tried"),
    "stable": ("", "whether the run is stable; see above"),
    "why_not": ("", "the first criterion that it fails; empty if stable"),
    "limit": ("", "true in the row of the largest stable number"),
    "theory": ("", "theoretical limit"),
    "status": ("", "how the run ended"),
    "steps": ("", "number of time steps"),
    "volume_drift": ("", "largest relative change of a volume"),
    "energy_rise": ("", "largest rise of the energy after any moment over what the start can release"),
    "variation": (
        "",
        f"excess of the largest total variation of h2 or eta over that of the resolved run and of the Courant number"
        f" {SAFE}, relative",
    ),
    "distance": ("", f"distance from the resolved run over that at the Courant number {SAFE}"),
}
WORDS = ("stable", "why_not", "limit", "status")


class Judge(NamedTuple):
    """What runs of a case are held against.

    By quantity the largest total variation, and the resolved profiles (snapshots, x) at the case's cells; and the
    distance from these at SAFE, NaN until it is known.
    """

    variations: dict[str, float]
    profiles: dict[str, np.ndarray]
    distance: float


def about() -> str:
    """Return what the documentation says of the table: what counts as stable, and theory."""
    return f"In studies with figures of stability.\n\n{with_constants(__doc__, globals())}"


def needs(study: Study) -> str:
    """Return '' for a study with figures of stability."""
    return "" if any(name.startswith("stability_") for name in study.figures) else "figures of stability"


def table(results: "Results") -> Iterator[dict]:
    """Give the rows, by column, in the order of trial; the search is the same for every study."""
    return search()


def search(
    cases: Iterable[Case] = CASES, schemes: Iterable[str] = SCHEMES, orders: Iterable[int] = ORDERS
) -> Iterator[dict]:
    """Give a row for each Courant number tried, in the order of trial."""
    for case in cases:
        judge = resolved(case)
        for scheme in schemes:
            for order in orders:
                yield from limit(case, scheme, order, judge)


def limit(case: Case, scheme: str, order: int, judge: Judge) -> list[dict]:
    """Return the rows of one scheme and order; `limit` is true in one of them, or in none if none is stable."""
    start = solve(point(case, scheme, order, SAFE))
    if start.status == "ok":
        varied = {name: variation(values) for name, values in known(start).items()}
        most = {name: max(varied[name], judge.variations[name]) for name in varied}
        judge = Judge(most, judge.profiles, distance(start, judge.profiles))
    rows = [tried(start, judge)]

    def stable(cfl: float) -> bool:
        rows.append(tried(solve(point(case, scheme, order, cfl)), judge))
        return rows[-1]["stable"]

    low, high = SAFE, SAFE + STEP
    if rows[0]["stable"]:
        while high < LARGEST and stable(round(high, 6)):
            low, high = high, high + STEP
    else:
        low, high = 0.5 * SAFE, SAFE
        while low >= LEAST and not stable(low):
            low, high = 0.5 * low, low
    if low >= LEAST and high < LARGEST:
        while high - low > WIDTH:
            middle = round(0.5 * (low + high), 6)
            low, high = (middle, high) if stable(middle) else (low, middle)
        next(row for row in rows if abs(row["cfl"] - low) < 1e-6)["limit"] = True
    about = {"model": case.model, "scene": case.scene, "scheme": scheme, "order": order, "theory": THEORY}
    return [{**about, **row} for row in rows]


def point(case: Case, scheme: str, order: int, cfl: float) -> Point:
    """Return the point of a case at a Courant number."""
    r = 0.0 if case.model == "one-layer" else Point.r
    options = tuple(sorted(case.options.items()))
    plain = Point(scene=case.scene, scene_options=options, model=case.model, r=r, delta=0.0, boundary="wall")
    end = case.end * math.sqrt(plain.radius / (plain.g * plain.a_2))
    times = tuple(end * (n + 1) / SNAPSHOTS for n in range(SNAPSHOTS))
    return plain.with_values(
        cells=case.cells, scheme=scheme, order=order, cfl=cfl, t_end=end, snapshot_times=times
    )


def resolved(case: Case) -> Judge:
    """Return what the runs of a case are held against, from a run of the default numerics on FINER times the cells."""
    usual = point(case, Point.scheme, Point.order, Point.cfl)
    fine = solve(usual.with_values(cells=FINER * case.cells, model=case.resolved))
    x = solve(usual.with_values(t_end=1e-6, snapshot_times=())).x
    profiles = known(fine)
    return Judge(
        {name: variation(values) for name, values in profiles.items()},
        {
            name: np.array([np.interp(x, fine.x, line) for line in values])
            for name, values in profiles.items()
        },
        math.nan,
    )


def tried(run: "Run", judge: Judge) -> dict:
    """Return the entries of a row that follow from its run."""
    ended = run.status == "ok"
    measured = {
        "volume_drift": max(change(run.sediment_volume), change(run.water_volume)),
        "energy_rise": energy.rise(
            run.point, run.model, run.box_half_width, {"time": run.time, **run.series}
        ),
        "variation": max(
            variation(values) / max(judge.variations[name], 1e-3) - 1 for name, values in known(run).items()
        )
        if ended
        else math.nan,
        "distance": distance(run, judge.profiles) / judge.distance if ended else math.nan,
    }
    passed = {
        f"status {run.status}": ended,
        "volume": measured["volume_drift"] <= VOLUME,
        "energy": measured["energy_rise"] <= GIVEN_BACK * run.dx / run.point.radius,
        "total variation": measured["variation"] <= VARIATION,
        "distance": measured["distance"] <= DISTANCE,
    }
    why = next((name for name, good in passed.items() if not good), "")
    about = {"cfl": run.point.cfl, "stable": not why, "why_not": why, "limit": False}
    return {**about, "status": run.status, "steps": run.steps, **measured}


def solve(point: Point) -> "Run":
    """Return the solved run of a point."""
    from subslide import solver

    return solver.solve(point)


def known(run: "Run") -> dict[str, np.ndarray]:
    """Return the profiles (snapshots, x) of a run over H2, by quantity; what a model lacks is left out."""
    height = run.point.a_2 * run.point.radius
    profiles = {"h2": run.h2 / height, "eta": run.eta / height}
    return {name: values for name, values in profiles.items() if not np.isnan(values[0]).all()}


def variation(values: np.ndarray) -> float:
    """Return the largest total variation over the snapshots of profiles (snapshots, x)."""
    return float(np.abs(np.diff(values, axis=1)).sum(axis=1).max())


def distance(run: "Run", reference: dict[str, np.ndarray]) -> float:
    """Return the mean |difference| of a run's h2 and eta from the reference's over snapshots and cells."""
    return float(np.mean([np.abs(values - reference[name]).mean() for name, values in known(run).items()]))


def change(volume: np.ndarray) -> float:
    """Return the largest relative change of a volume while it is finite; 0 where the model lacks it."""
    volume = volume[np.isfinite(volume)]
    return float(np.abs(volume / volume[0] - 1).max()) if len(volume) and volume[0] else 0.0
