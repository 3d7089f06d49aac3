"""Bands of discretisation error: how many cells a front errs by, and how many bands hold the answer of a finer grid.

    .venv/bin/python benchmarks/bands.py [--calibrate] [--points 225] [--keep FOLDER] [--page docs/bands.md]

Solves columns drawn at random from `_calibration.RANGE` on grids of 50 to 1,600 cells, twice: by the default solver and
by the paper's. The answer is that of the default solver on 6,400 cells; of some columns 12,800 tell how far it errs.
With --calibrate the columns are others, and the quantiles that `tables/_calibration.py` states are printed too. What
was solved is kept in FOLDER, so that a run that was stopped goes on. On two cores 225 columns take some twenty minutes.
"""

import argparse
import math
import os
import pickle
import sys
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from subslide.naming import FINISHED, FRONT_LABELS
from subslide.points import Point
from subslide.tables import _calibration as calibration
from subslide.tables import bands
from subslide.tables._convergence import NO_LIMIT

GRIDS = (50, 100, 200, 400, 800, 1600)
TRUTH, BEYOND = 6400, 12800
CHECKED = 12
"""Columns whose answer is held against that of twice as many cells."""

SOLVERS: dict[str, dict[str, Any]] = {
    "default": {},
    "paper": {"order": 1, "front_flux": "hll", "model": "radial"},
}
"""Solvers that are tried; the paper's on a radius, which has the limit of its plane."""

TITLES = {"default": "Default solver", "paper": "Paper's solver"}
SEEDS = {"calibrated": 1, "tested": 3}
QUANTILE = 0.95
FIFTH = 0.2
"""A value counts if the error of its answer is below this part of its band."""


def draw(seed: int, n: int) -> dict[str, float]:
    """Return the n-th column of a seed: a_H even in its logarithm, the others even in themselves."""
    rng = np.random.default_rng([seed, n])
    (low, high), *others = calibration.RANGE.values()
    values = [math.exp(rng.uniform(math.log(low), math.log(high))), *(rng.uniform(*one) for one in others)]
    return dict(zip(calibration.RANGE, values, strict=True))


def measure(seed: int, folder: Path, n: int) -> dict:
    """Return what bands compare of a column, by solver and cells; from `folder` if it is there."""
    path = folder / f"{seed}_{n:04d}.pickle"
    if path.exists():
        return pickle.loads(path.read_bytes())
    from subslide.solver import solve

    finest = (TRUTH, BEYOND) if n < CHECKED else (TRUTH,)
    measured = {}
    for name, keys in SOLVERS.items():
        for cells in GRIDS + finest * (name == "default"):
            point = Point(**draw(seed, n), **keys, cells=cells)
            run = solve(point)
            record = {key: getattr(run, key) for key in bands.MEASURED}
            one = bands.measure(point, record)
            measured[name, cells] = bands.Measured(run.status in FINISHED, one.values)
    part = path.with_suffix(f".{os.getpid()}")
    part.write_bytes(pickle.dumps(measured))
    part.replace(path)
    print(path.stem, file=sys.stderr, flush=True)
    return measured


class Held(NamedTuple):
    """One value: its error and band (m), the cell size and the error of its answer (m), and whether a front arrived."""

    solver: str
    quantity: str
    cells: int
    error: float
    band: float
    dx: float
    doubt: float
    arrived: bool


def left_over(columns: list[dict]) -> dict[str, float]:
    """Return by how much (m) finer grids would move fronts, by quantity: twice the median move to twice the cells.

    Errors of fronts are a number of cells, so that they halve with the cells: what one halving moves, all later ones
    move once more. Waves have no such common error.
    """
    moves: dict[str, list[float]] = {}
    for measured in columns[:CHECKED]:
        coarse, fine = measured["default", TRUTH].values, measured["default", BEYOND].values
        for (quantity, time), value in coarse.items():
            moves.setdefault(quantity, []).append(fine[quantity, time] - value)
    return {name: 0.0 if "eta" in name else 2 * float(np.median(some)) for name, some in moves.items()}


def compare(seed: int, n: int, measured: dict, moves: dict[str, float]) -> Iterator[Held]:
    """Give the values of a column on each grid beside its answer; a front that has stopped counts as L_f alone."""
    answer = measured["default", TRUTH].values
    for name, keys in SOLVERS.items():
        for cells in GRIDS[2:]:
            point = Point(**draw(seed, n), **keys, cells=cells)
            grids = [measured[name, count] for count in (cells, cells // 2, cells // 4)]
            for row in bands.rows(point, *grids):
                quantity, time = row["quantity"], row["time"]
                length = grids[0].values.get((quantity.replace("x_front", "L_f"), None), math.nan)
                stopped = time is not None and row["value"] == length
                if row["convergence"] == NO_LIMIT or stopped:
                    continue
                true = answer[quantity, time] + moves[quantity]
                arrived = quantity.startswith("L_f") or row["value"] >= calibration.ARRIVED * length
                doubt = math.nan
                if ("default", BEYOND) in measured:
                    finer = measured["default", BEYOND].values[quantity, time] + moves[quantity] / 2
                    doubt = abs(finer - true)
                error = abs(row["value"] - true)
                yield Held(name, quantity, cells, error, row["band"], point.dx, doubt, arrived)


def quantiles(held: list[Held]) -> None:
    """Print what `_calibration` states: cells that fronts err by, and those that their answers may err by on top."""
    for name in SOLVERS:
        for arrived in (False, True):
            for label in FRONT_LABELS:
                row = []
                for cells in calibration.NODES:
                    some = [
                        one
                        for one in held
                        if (one.solver, one.cells, one.arrived) == (name, cells, arrived)
                        and one.quantity.endswith(label)
                    ]
                    error = float(np.quantile([one.error for one in some], QUANTILE)) + typical_doubt(some)
                    row.append(math.ceil(20 * error / some[0].dx) / 20)
                print(name, "arrived" if arrived else "moving", label, row)


def table(held: list[Held], name: str) -> tuple[list[str], list[Held]]:
    """Return the lines of a solver's table of coverage, and the values that count.

    A value counts if the error of its answer, that of the median column that was checked, is below a fifth of its band.
    """
    lines = ["| quantity | " + " | ".join(f"{cells}" for cells in calibration.NODES) + " |"]
    lines.append("| --- " * (len(calibration.NODES) + 1) + "|")
    counted: list[Held] = []
    quantities = list(dict.fromkeys(one.quantity for one in held))
    for quantity in quantities:
        texts = []
        for cells in calibration.NODES:
            some = [one for one in held if (one.solver, one.quantity, one.cells) == (name, quantity, cells)]
            doubt = typical_doubt(some)
            some = [one for one in some if doubt < FIFTH * one.band]
            counted += some
            inside = np.mean([one.error <= one.band for one in some]) if some else math.nan
            width = np.median([one.band / max(one.error, 1e-15) for one in some]) if some else math.nan
            texts.append(f"{100 * inside:.0f} % of {len(some)}, {width:.2g}")
        lines.append(f"| `{quantity}` | {' | '.join(texts)} |")
    return lines, counted


def typical_doubt(some: list[Held]) -> float:
    """Return the median error (m) of the answers of those that were checked, twice it for what 12,800 cells leave."""
    return 2 * float(np.nanmedian([one.doubt for one in some]))


PAGE = """# Bands of discretisation error

[bands.csv](tables.md) states a band about each value of a study with `bands: true`. This page says how bands were
read off, and how many hold. It is written by

    .venv/bin/python benchmarks/bands.py --page docs/bands.md

## Method

{method}

- **Fronts and lengths**: the band is a number of cells. It depends on the order of the scheme, on the threshold, on
  whether the front has come within {near} % of its last place, and on cells: the {quantile} % quantile of the errors at
  {nodes} cells and twice the median error of the answer, linear in the logarithm between them.
- **Waves**: the band is the largest of three parts, multiples of the difference to the run with half the cells, of that
  between half and a quarter of the cells, and of the value times dx/R.
- **Without a limit**: {limitless}.
  The surface leaps beside the column at the start, and waves that meet on the axis are the higher the finer the grid;
  bands.csv says so instead of a number.
- Columns, solvers or grids beyond these get the wider of this band and Richardson's (Roache 1994). At second order the
  bands of 1,600 cells are taken to 3,200, as of `numerics: resolved`: against 12,800 cells they held 98 % of 896 values
  of 47 columns (lengths 91 to 100 %).

Half-width of fronts, in cells:

| order | front | threshold | {heads} |
{rule_cells}
{cells}

Half-width of waves, the largest of:

| order | times abs(f1 - f2) | times abs(f2 - f3) | times the value and dx/R |
| --- | --- | --- | --- |
{waves}

## Tested

On {count} columns drawn apart from those that gave the numbers ({ranges}).
The answer is that of the default solver on {truth:,} cells, fronts moved on by what the {beyond:,} cells of
{checked} columns leave (their median; errors of fronts halve with the cells). A value counts where the error of its
answer (twice the median difference to what {beyond:,} cells give) is below a fifth of its band. Fronts that have
stopped count once, as lengths. Of each quantity: the share of bands that hold the answer, of how many, and the median
of band over error.
{tested}"""


def page(held: list[Held], count: int) -> str:
    """Return the page on bands."""
    nodes = [f"{cells:,}" for cells in calibration.NODES]
    cells = [
        f"| {order} | {'arrived' if arrived else 'moving'} | {label} | {' | '.join(f'{one:g}' for one in row)} |"
        for (order, arrived), rows in calibration.CELLS.items()
        for label, row in zip(("1 %", "3 %", "5 %"), rows, strict=True)
    ]
    waves = [
        f"| {order} | {w.last:g} | {w.before:g} | {w.cell:g} |" for order, w in calibration.WAVES.items()
    ]
    return PAGE.format(
        method=(calibration.__doc__ or "").split("\n\n", 1)[1].strip(),
        near=round(100 * (1 - calibration.ARRIVED)),
        quantile=round(100 * QUANTILE),
        nodes=", ".join(nodes),
        limitless=" and ".join(f"`{name}`" for name in bands.LIMITLESS),
        heads=" | ".join(f"{one} cells" for one in nodes),
        rule_cells="| --- " * (3 + len(nodes)) + "|",
        cells="\n".join(cells),
        waves="\n".join(waves),
        count=count,
        ranges=", ".join(f"{key} {low:g} to {high:g}" for key, (low, high) in calibration.RANGE.items()),
        truth=TRUTH,
        beyond=BEYOND,
        checked=CHECKED,
        tested="\n".join(tested(held, name, title) for name, title in TITLES.items()),
    )


def tested(held: list[Held], name: str, title: str) -> str:
    """Return the section on a solver."""
    rows, counted = table(held, name)
    pooled = np.mean([one.error <= one.band for one in counted])
    widths = {
        what: np.median(
            [one.band / max(one.error, 1e-15) for one in counted if ("eta" in one.quantity) is wave]
        )
        for what, wave in (("fronts and lengths", False), ("waves", True))
    }
    words = ", ".join(f"{width:.2g} for {what}" for what, width in widths.items())
    text = (
        f"{100 * pooled:.1f} % of {len(counted):,} bands hold the answer; median of band over error: {words}."
    )
    return "\n".join(["", f"### {title}", "", *rows, "", text, ""])


def main() -> None:
    """Measure, and print quantiles or write the page."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", 1)[0])
    parser.add_argument(
        "--calibrate", action="store_true", help="print the quantiles of the columns to calibrate on"
    )
    parser.add_argument("--points", type=int, default=225, help="columns")
    parser.add_argument("--keep", type=Path, default=Path("results/_bands"), help="folder of what was solved")
    parser.add_argument("--page", type=Path, help="page to write; else it is printed")
    asked = parser.parse_args()
    asked.keep.mkdir(parents=True, exist_ok=True)
    seed = SEEDS["calibrated" if asked.calibrate else "tested"]
    with ProcessPoolExecutor(os.cpu_count()) as pool:
        columns = list(pool.map(partial(measure, seed, asked.keep), range(asked.points)))
    moves = left_over(columns)
    held = [one for n, measured in enumerate(columns) for one in compare(seed, n, measured, moves)]
    if asked.calibrate:
        quantiles(held)
    if asked.page:
        asked.page.write_text(page(held, len(columns)), encoding="utf-8")
    else:
        print(page(held, len(columns)))


if __name__ == "__main__":
    main()
