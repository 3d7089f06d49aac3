"""Bands of discretisation error: how many cells a front errs by, and how many bands hold the answer of a finer grid.

    .venv/bin/python benchmarks/bands.py [--calibrate] [--points 225] [--keep FOLDER] [--page docs/bands.md]

Solves columns drawn at random from `_calibration.RANGE` on grids of 50 to 1,600 cells, by the default solver and by the
paper's, and on fitted grids. The answer is that of the default solver on 6,400 cells; of some columns 12,800 tell how
far it errs. With --calibrate the columns are others, and quantiles are printed too: those that `tables/_calibration.py`
states, and what `tables/_fitted_bands.py` would state of these columns. What was solved is kept in FOLDER, so that a
run that was stopped goes on. On two cores 225 columns take some twenty minutes.
"""

import argparse
import itertools
import math
import os
import pickle
import sys
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from pathlib import Path
from types import ModuleType
from typing import Any, NamedTuple

import numpy as np

from subslide.naming import FINISHED, FRONT_LABELS
from subslide.points import Point
from subslide.tables import _calibration as calibration
from subslide.tables import _fitted_bands as fitted
from subslide.tables import bands
from subslide.tables._convergence import NO_LIMIT

GRIDS = (50, 100, 200, 400, 800, 1600)
TRUTH, BEYOND = 6400, 12800
CHECKED = 12
"""Columns whose answer is held against that of twice as many cells."""

SOLVERS: dict[str, dict[str, Any]] = {
    "default": {},
    "paper": {"order": 1, "front_flux": "hll", "model": "radial"},
    "fitted": {"grid": "fitted"},
}
"""Solvers that are tried; the paper's on a radius, which has the limit of its plane."""

SOLVED = {"default": GRIDS, "paper": GRIDS, "fitted": fitted.NODES}
COMPARED = {"default": calibration.NODES, "paper": calibration.NODES, "fitted": fitted.NODES}
"""Cells of the grids that are solved, and of those whose bands are judged."""

TITLES = {"default": "Default solver", "paper": "Paper's solver", "fitted": "Fitted grid"}
SEEDS = {"calibrated": 1, "tested": 3}
QUANTILE, DIGITS = (
    {"default": 0.95, "paper": 0.95, "fitted": 0.98},
    {"default": 20, "paper": 20, "fitted": 1e4},
)
"""Quantile of the errors that is a band, and parts of its unit to which it is rounded up."""

KINDS = ("moving", "arrived", "arrest")
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
    measured = pickle.loads(path.read_bytes()) if path.exists() else {}
    finest = (TRUTH, BEYOND) if n < CHECKED else (TRUTH,)
    grids = [(name, cells) for name in SOLVERS for cells in SOLVED[name]]
    unsolved = [one for one in (*grids, *(("default", cells) for cells in finest)) if one not in measured]
    if not unsolved:
        return measured
    from subslide.solver import solve

    for name, cells in unsolved:
        point = Point(**draw(seed, n), **SOLVERS[name], cells=cells)
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
    """One value: its error and band (m, s), their unit in the tables, the error of its answer, and its `kind_of`."""

    solver: str
    quantity: str
    cells: int
    error: float
    band: float
    unit: float
    doubt: float
    kind: str


def left_over(columns: list[dict]) -> dict[str, float]:
    """Return by how much (m) finer grids would move fronts, by quantity: twice the median move to twice the cells.

    Errors of fronts are a number of cells, so that they halve with the cells: what one halving moves, all later ones
    move once more. Waves and times of arrest have no such common error.
    """
    moves: dict[str, list[float]] = {}
    for measured in columns[:CHECKED]:
        coarse, fine = measured["default", TRUTH].values, measured["default", BEYOND].values
        for (quantity, time), value in coarse.items():
            moves.setdefault(quantity, []).append(fine[quantity, time] - value)
    return {
        name: 2 * float(np.median(some)) if name.startswith(("L_f", "x_front")) else 0.0
        for name, some in moves.items()
    }


def compare(seed: int, n: int, measured: dict, moves: dict[str, float]) -> Iterator[Held]:
    """Give the values of a column on each grid beside its answer; a front that has stopped counts as L_f alone."""
    answer = measured["default", TRUTH].values
    for name, keys in SOLVERS.items():
        for cells in COMPARED[name]:
            point = Point(**draw(seed, n), **keys, cells=cells)
            counts = (cells,) if name == "fitted" else (cells, cells // 2, cells // 4)
            grids = [measured[name, count] for count in counts]
            for row in bands.rows(point, *grids):
                quantity, time, value = row["quantity"], row["time"], row["value"]
                length = grids[0].values.get((quantity.replace("x_front", "L_f"), None), math.nan)
                stopped = time is not None and value == length
                if row["convergence"] == NO_LIMIT or stopped:
                    continue
                true = answer[quantity, time] + moves[quantity]
                doubt = math.nan
                if ("default", BEYOND) in measured:
                    finer = measured["default", BEYOND].values[quantity, time] + moves[quantity] / 2
                    doubt = abs(finer - true)
                kind = kind_of(quantity, value >= calibration.ARRIVED * length)
                unit = value * fitted.factor(point) if name == "fitted" else point.dx
                yield Held(name, quantity, cells, abs(value - true), row["band"], unit, doubt, kind)


def kind_of(quantity: str, arrived: bool) -> str:
    """Return the one of KINDS that a quantity belongs to, '' for a wave."""
    if quantity in bands.ARRESTS:
        return "arrest"
    if quantity.startswith("L_f") or (quantity.startswith("x_front") and arrived):
        return "arrived"
    return "moving" if quantity.startswith("x_front") else ""


def quantiles(held: list[Held]) -> None:
    """Print cells or shares that values err by, with twice the error of their answers: what the tables state."""
    for name, kind, label in itertools.product(SOLVERS, KINDS, FRONT_LABELS):
        row = []
        for cells in COMPARED[name]:
            some = [
                one
                for one in held
                if (one.solver, one.cells, one.kind) == (name, cells, kind) and one.quantity.endswith(label)
            ]
            if some:
                doubt = 2 * float(np.nanmedian([one.doubt / one.unit for one in some]))
                error = float(np.quantile([one.error / one.unit for one in some], QUANTILE[name])) + doubt
                row.append(math.ceil(DIGITS[name] * error) / DIGITS[name])
        if row:
            print(name, kind, label, row)


def table(held: list[Held], name: str) -> tuple[list[str], list[Held]]:
    """Return the lines of a solver's table of coverage, and the values that count.

    A value counts if the error of its answer, that of the median column that was checked, is below a fifth of its band.
    """
    nodes = COMPARED[name]
    lines = ["| quantity | " + " | ".join(f"{cells}" for cells in nodes) + " |"]
    lines.append("| --- " * (len(nodes) + 1) + "|")
    counted: list[Held] = []
    quantities = list(dict.fromkeys(one.quantity for one in held if one.solver == name))
    for quantity in quantities:
        texts = []
        for cells in nodes:
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
    """Return the median error (m, s) of the answers that were checked, twice it for what 12,800 cells leave."""
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
- Columns, solvers or uniform grids beyond these get the wider of this band and Richardson's (Roache 1994). At second
  order the bands of 1,600 cells are taken to 3,200, as of `numerics: resolved`: against 12,800 cells they held 98 % of
  896 values of 47 columns (lengths 91 to 100 %).

Half-width of fronts, in cells:

| order | front | threshold | {heads} |
{rule_cells}
{cells}

Half-width of waves, the largest of:

| order | times abs(f1 - f2) | times abs(f2 - f3) | times the value and dx/R |
| --- | --- | --- | --- |
{waves}

### Fitted grids

{fitted_method}

Shares (per cent) in deep water: the 98 % quantiles of what the 16 corners of the range and 300 columns drawn from it
err by (the default solver; answers of 12,800 uniform cells), and of 1 % fronts twice the median change of their answers
from 6,400 to 12,800 cells (of others it is below 0.01 %). Between these grids logarithms are linear:

| value | threshold | {fitted_heads} |
{fitted_rule}
{shares}

Beyond (other columns, scenes, friction laws or solvers, fewer than {least} or more than {most} cells) bands are
{outside:g} times as wide, at first order {outside_first:g} times; by (24/cells)^2 more below {least} cells; and, of
grains at rest, by (0.24/m)^3 more where m = tan(delta)/a_2 is below 0.24 (at most 14 times): slow grains err more. So
chosen they held 99 % of 44,000 values of 360 such columns, 24 each beyond one end of the range (a_2 0.05 to 5, r to
0.95, delta 5 to 60, a_H 0.02 to 50) or beyond three, on a line, by Voellmy's and Pouliquen's laws, by other solvers and
at first order, on 16 to 110 cells; of none of these kinds less than 95 %. Their answers were those of 400 fitted cells.

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
    words = {"moving": "front on its way", "arrived": "front at rest", "arrest": "time of arrest"}
    waves = [
        f"| {order} | {w.last:g} | {w.before:g} | {w.cell:g} |" for order, w in calibration.WAVES.items()
    ]
    shares = [
        f"| {words[kind]} | {label} | {' | '.join(f'{100 * one:g}' for one in row)} |"
        for kind, rows in fitted.SHARES.items()
        for label, row in zip(("1 %", "3 %", "5 %"), rows, strict=True)
    ]
    return PAGE.format(
        method=_method(calibration),
        fitted_method=_method(fitted),
        fitted_heads=" | ".join(f"{one} cells" for one in fitted.NODES),
        fitted_rule="| --- " * (2 + len(fitted.NODES)) + "|",
        shares="\n".join(shares),
        least=fitted.NODES[0],
        most=fitted.NODES[-1],
        outside=fitted.OUTSIDE,
        outside_first=fitted.OUTSIDE**2,
        near=round(100 * (1 - calibration.ARRIVED)),
        quantile=round(100 * QUANTILE["default"]),
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


def _method(module: ModuleType) -> str:
    """Return what the docstring of a module says after its first line."""
    return (module.__doc__ or "").split("\n\n", 1)[1].strip()


def tested(held: list[Held], name: str, title: str) -> str:
    """Return the section on a solver."""
    rows, counted = table(held, name)
    pooled = np.mean([one.error <= one.band for one in counted])
    kinds = {
        "fronts and lengths": KINDS[:2],
        "times of arrest": KINDS[2:],
        "waves": ("",),
    }
    widths = {
        what: np.median(some)
        for what, kind in kinds.items()
        if (some := [one.band / max(one.error, 1e-15) for one in counted if one.kind in kind])
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
