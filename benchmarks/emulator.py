"""The emulator of the package held against columns that it never saw, on much finer grids; and what a prediction takes.

    .venv/bin/python benchmarks/emulator.py [--fronts 1000] [--waves 1000] [--emulator FILE] [--keep FOLDER]

Columns are drawn at random, evenly in ln a_H, r and ln m over the range. Fronts are those of 400 and 560 fitted cells,
waves those of 1,600 and 3,200 uniform ones, each extrapolated as the emulator's own. Fronts are judged where they are
asked for, at scaled times, so that what goes between the emulator's nodes counts too. What was solved is kept in
FOLDER, so that a run that was stopped goes on. On two cores it takes some ten minutes.
"""

import argparse
import json
import math
import multiprocessing
import os
import time
from collections.abc import Iterable
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import numpy as np

os.environ.setdefault("NUMBA_NUM_THREADS", "1")

from subslide.emulator import Emulator, coordinates, grids, judging, training
from subslide.emulator import measures as named
from subslide.emulator.training import LeftOut, Measured
from subslide.naming import FINISHED
from subslide.points import Point, from_dict, to_dict
from subslide.solver import solve
from subslide.study import choice

SEED = 8
"""Of the columns; those of 7 were looked at while the emulator was made."""

GRIDS = {"fronts": (400, 560), "waves": (1600, 3200)}
AT_ONCE = 50
"""Columns that are solved before they are kept."""

BULK = 100_000
ROUNDS = 5


def drawn(kind: str, count: int) -> list[list[Point]]:
    """Return the points of random columns, one for each grid."""
    (a, b), (c, d), (e, f) = coordinates.RANGE.values()
    columns = []
    for x, y, z in np.random.default_rng(SEED).random((count, 3)):
        m = e * (f / e) ** z
        keys = {"a_H": a * (b / a) ** x, "r": c + (d - c) * y, "delta": math.degrees(math.atan(0.56 * m))}
        point = Point(**keys, a_2=0.56, snapshot_times=())
        if kind == "fronts":
            point = point.with_values(grid="fitted", quantities="grains")
        else:
            point = point.with_values(t_end=5.0001 * point.time_scale)
        columns.append([point.with_values(cells=cells) for cells in GRIDS[kind]])
    return columns


def solved(kind: str, count: int, folder: Path, cores: int) -> list[Measured]:
    """Return what is learned of random columns; from `folder` what is there."""
    columns, runs = drawn(kind, count), []
    for first in range(0, count, AT_ONCE):
        path = folder / f"{kind}_{first:05d}.json"
        if not path.exists():
            points = [point for column in columns[first : first + AT_ONCE] for point in column]
            with ProcessPoolExecutor(cores, mp_context=multiprocessing.get_context("spawn")) as pool:
                rows = [
                    [to_dict(point), values]
                    for point, values in zip(points, pool.map(measured, points), strict=True)
                ]
            path.with_suffix(".part").write_text(json.dumps(rows))
            path.with_suffix(".part").replace(path)
            print(path, flush=True)
        runs += [Measured(from_dict(point), values) for point, values in json.loads(path.read_text())]
    return runs


def measured(point: Point) -> dict[str, float]:
    """Return what is learned of a point's run, and its fronts at scaled times as `x_front_1pc at 0.25`."""
    run = solve(point)
    if run.status not in FINISHED:
        raise SystemExit(f"{point.id}: {run.status}")
    kind = "fitted" if choice.is_fitted(point) else "uniform"
    values = named.measure(point, {name: getattr(run, name) for name in named.NEEDED[kind]})
    for name, front in zip(named.FRONTS, run.x_front if kind == "fitted" else (), strict=False):
        places = np.interp(named.TIMES, run.time / point.time_scale, front / point.radius)
        values |= {f"{name} at {time}": float(place) for time, place in zip(named.TIMES, places, strict=True)}
    return values


def at_times(emulator: Emulator, runs: list[Measured]) -> dict[str, LeftOut]:
    """Return predicted fronts at scaled times beside the limits of runs, by quantity."""
    columns: dict[tuple[float, ...], dict[int, dict[str, float]]] = {}
    for one in runs:
        columns.setdefault(one.point.similarity_key, {})[one.point.cells] = one.values
    inputs, cells = np.array(list(columns)), np.array(GRIDS["fronts"])
    z = coordinates.of(coordinates.GRAINS, inputs)
    answers = {}
    for name in named.FRONTS:
        value, band = emulator.predict(*inputs.T, quantities=name)[name]
        asked = [f"{name} at {time}" for time in named.TIMES]
        places = np.array(
            [[[of[n][key] for n in cells.tolist()] for key in asked] for of in columns.values()]
        )
        truth = np.stack([grids.limit(places[:, k], cells, z).value for k in range(len(asked))], axis=1)
        answers[name] = LeftOut(inputs.repeat(len(asked), 0), value.ravel(), truth.ravel(), band.ravel())
    return answers


def table(errors: dict[str, LeftOut]) -> Iterable[str]:
    """Give the lines of a table of errors."""
    yield "| quantity | values | median % | 95 % of them % | worst % | bands that hold % | median band % |"
    yield "| --- | --- | --- | --- | --- | --- | --- |"
    for name, one in errors.items():
        numbers = [
            *np.quantile(np.abs(one.error), [0.5, 0.95, 1]),
            one.covered,
            np.median(one.band / one.value),
        ]
        yield (
            f"| `{name}` | {len(one.value):,} | "
            + " | ".join(f"{100 * value:.3g}" for value in numbers)
            + " |"
        )


def timed(emulator: Emulator, quantities: list[str] | None) -> float:
    """Return the microseconds of a prediction, with its band, in bulk: the best of some rounds."""
    (a, b), (c, d), (e, f) = emulator.range.values()
    x, y, z = np.random.default_rng(1).random((3, BULK))
    rows = a * (b / a) ** x, c + (d - c) * y, e * (f / e) ** z
    best = math.inf
    for _ in range(ROUNDS):
        start = time.perf_counter()
        emulator.predict(*rows, quantities=quantities)
        best = min(best, time.perf_counter() - start)
    return 1e6 * best / BULK


def main() -> None:
    """Print errors and times."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--fronts", type=int, default=1000, help="columns whose fronts are solved")
    parser.add_argument("--waves", type=int, default=1000, help="columns whose waves are solved")
    parser.add_argument("--emulator", help="file of subslide emulate; without it the package's")
    parser.add_argument("--keep", default="results/bench/emulator", help="folder for what is solved")
    parser.add_argument("--cores", type=int, default=os.cpu_count() or 1, help="processes that solve")
    arguments = parser.parse_args()
    folder = Path(arguments.keep)
    folder.mkdir(parents=True, exist_ok=True)
    emulator = Emulator.load(arguments.emulator)
    fronts, waves = (solved(kind, getattr(arguments, kind), folder, arguments.cores) for kind in GRIDS)
    errors = judging.against(emulator, training.limits([*fronts, *waves]))
    for line in table(errors | (at_times(emulator, fronts) if fronts else {})):
        print(line)
    for quantities in (["L_f_1pc"], ["eta_gauge_peak"], ["x_front_1pc"], None):
        print(
            f"{', '.join(quantities or ['all quantities'])}: {timed(emulator, quantities):.1f} microseconds a point"
        )


if __name__ == "__main__":
    main()
