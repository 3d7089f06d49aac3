"""The emulator of the package held against columns that it never saw, on much finer grids; and what a prediction takes.

    .venv/bin/python benchmarks/emulator.py [--fronts 1000] [--waves 200] [--emulator FILE] [--keep FOLDER]

Columns are drawn at random, evenly in ln a_H, r and ln m over the range. Fronts are those of 400 and 560 fitted cells,
waves those of 1,600 and 3,200 uniform ones, each extrapolated as the emulator's own. What was solved is kept in FOLDER,
so that a run that was stopped goes on. On two cores it takes some five minutes.
"""

import argparse
import json
import math
import os
import time
from collections.abc import Iterable
from pathlib import Path

import numpy as np

os.environ.setdefault("NUMBA_NUM_THREADS", "1")

from subslide.emulator import Emulator, coordinates, growing, judging, training
from subslide.emulator.training import Measured
from subslide.points import Point, from_dict, to_dict

SEED = 7
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
            rows = [[to_dict(one.point), one.values] for one in growing.solved(points, cores)]
            path.with_suffix(".part").write_text(json.dumps(rows))
            path.with_suffix(".part").replace(path)
            print(path, flush=True)
        runs += [Measured(from_dict(point), values) for point, values in json.loads(path.read_text())]
    return runs


def table(errors: dict[str, training.LeftOut]) -> Iterable[str]:
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
    parser.add_argument("--waves", type=int, default=200, help="columns whose waves are solved")
    parser.add_argument("--emulator", help="file of subslide emulate; without it the package's")
    parser.add_argument("--keep", default="results/bench/emulator", help="folder for what is solved")
    parser.add_argument("--cores", type=int, default=os.cpu_count() or 1, help="processes that solve")
    arguments = parser.parse_args()
    folder = Path(arguments.keep)
    folder.mkdir(parents=True, exist_ok=True)
    emulator = Emulator.load(arguments.emulator)
    runs = [run for kind in GRIDS for run in solved(kind, getattr(arguments, kind), folder, arguments.cores)]
    for line in table(judging.against(emulator, training.limits(runs))):
        print(line)
    for quantities in (["L_f_1pc"], ["eta_gauge_peak"], ["x_front_1pc"], None):
        print(
            f"{', '.join(quantities or ['all quantities'])}: {timed(emulator, quantities):.1f} microseconds a point"
        )


if __name__ == "__main__":
    main()
