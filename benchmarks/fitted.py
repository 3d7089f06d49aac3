"""What a fitted grid costs and errs: tables on the range of the README, and the chart beyond it (docs/fitted.md).

    .venv/bin/python benchmarks/fitted.py accuracy [--columns 200] [--truth 12800] [--seed 12]
    .venv/bin/python benchmarks/fitted.py speed [--columns 200] [--seed 12]
    .venv/bin/python benchmarks/fitted.py chart [--columns 400] [--seed 5] [--output docs/fitted_range.png]

`accuracy` holds 24, 34, 48 and 110 cells against a uniform grid, on columns drawn at random and the corners of the
range; `speed` the loop of 48 cells against that of 800 uniform ones to the same end, in turn; `chart` draws errors far
beyond the range, against a fitted grid of 440 cells.
"""

import argparse
import itertools
import sys
from pathlib import Path

import numpy as np

from subslide.points import Point
from subslide.solver import solve
from subslide.solver.run import Run

RANGE = {"a_H": (0.5, 10.0), "a_2": (0.3, 1.5), "r": (0.0, 0.8), "delta": (20.0, 40.0)}
BEYOND = {"a_H": (0.1, 10.0), "a_2": (0.1, 5.0), "r": (0.0, 0.95), "delta": (5.0, 60.0)}
"""Columns that `chart` draws: a_H and a_2 by their logarithms."""
CELLS = (24, 34, 48, 110)
CHARTED, FINE = (24, 48, 110), 440
EARLIEST = 0.3
"""Scaled time from which fronts are compared."""


def drawn(columns: int, seed: int) -> list[Point]:
    """Return the corners of the range, and columns drawn at random in it."""
    random = np.random.default_rng(seed)
    values = [[round(random.uniform(*RANGE[key]), 6) for key in RANGE] for _ in range(columns)]
    return [point(one) for one in (*itertools.product(*RANGE.values()), *values)]


def far(columns: int, seed: int) -> list[Point]:
    """Return columns drawn far beyond the range."""
    random = np.random.default_rng(seed)
    values = []
    for _ in range(columns):
        logs = [float(10 ** random.uniform(*np.log10(BEYOND[key]))) for key in ("a_H", "a_2")]
        values.append((*logs, *(random.uniform(*BEYOND[key]) for key in ("r", "delta"))))
    return [point(one) for one in values]


def point(values, **others) -> Point:
    """Return a column on the uniform grid, without snapshots on its way."""
    return Point(**dict(zip(RANGE, map(float, values), strict=True)), snapshot_times=(), **others)


def fitted(column: Point, cells: int) -> Run:
    """Return a column's run on a fitted grid."""
    return solve(column.with_values(grid="fitted", cells=cells))


def errors(run: Run, truth: Run) -> tuple[float, ...]:
    """Return errors (%) of L_f at each threshold, the largest of x_front (1 %) from EARLIEST on, and of its arrest."""
    end = truth.time[-1]
    times = np.geomspace(min(EARLIEST * run.point.time_scale, end), end, 40)
    here, there = (np.interp(times, one.time, one.x_front[0]) for one in (run, truth))
    arrest = run.time_of_arrest[0] / truth.time_of_arrest[0] - 1
    return (*(100 * (run.L_f / truth.L_f - 1)), 100 * np.abs(here / there - 1).max(), 100 * arrest)


def accuracy(columns: list[Point], cells: int) -> None:
    """Print errors by number of cells: median, 95 % and worst of their sizes."""
    truths = [solve(column.with_values(cells=cells)) for column in progress(columns)]
    print(f"{len(columns)} columns, sizes of errors (%) against {cells} uniform cells: median / 95 % / worst")
    print(
        "cells  "
        + "  ".join(f"{name:18s}" for name in ("L_f 1 %", "L_f 3 %", "L_f 5 %", "x_front", "arrest"))
    )
    for count in CELLS:
        found = [errors(fitted(column, count), truth) for column, truth in zip(columns, truths, strict=True)]
        size = np.abs(np.array(found))
        shown = zip(np.median(size, axis=0), np.quantile(size, 0.95, axis=0), size.max(axis=0), strict=True)
        print(f"{count:5d}  " + "  ".join(f"{a:.2f} / {b:.2f} / {c:.2f} ".ljust(18) for a, b, c in shown))


def speed(columns: list[Point]) -> None:
    """Print how many times as long 800 uniform cells take as 48 fitted ones, each the best of several in turn."""
    ratios, walls = [], []
    for column in progress(columns):
        end = fitted(column, 48).time[-1]
        pair = [
            column.with_values(t_end=end, cells=800),
            column.with_values(t_end=end, cells=48, grid="fitted"),
        ]
        taken = [[solve(one).wall_seconds for one in pair for _ in range(2)] for _ in range(3)]
        uniform, fit = (min(min(row[k : k + 2]) for row in taken) for k in (0, 2))
        ratios.append(uniform / fit)
        walls.append(fit)
    print(
        f"{len(columns)} columns: 800 uniform cells take {np.median(ratios):.1f} times as long as 48 fitted ones"
    )
    print(f"in the median, {np.quantile(ratios, 0.1):.1f} at 10 %, {min(ratios):.1f} at least;", end=" ")
    print(f"48 cells {1e3 * np.median(walls):.2f} ms in the median, {1e3 * np.mean(walls):.2f} in the mean")


def chart(columns: list[Point], output: Path) -> None:
    """Draw the error of L_f against m, by number of cells."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    runs = [[fitted(column, cells) for cells in (*CHARTED, FINE)] for column in progress(columns)]
    runs = [row for row in runs if np.isfinite(row[-1].L_f[0])]
    m = np.array([row[-1].point.friction_number for row in runs])
    inside = [all(a <= getattr(row[0].point, key) <= b for key, (a, b) in RANGE.items()) for row in runs]
    figure, panels = plt.subplots(1, len(CHARTED), figsize=(11, 4), sharey=True, layout="constrained")
    for n, (ax, cells) in enumerate(zip(panels, CHARTED, strict=True)):
        size = np.array([abs(100 * (row[n].L_f[0] / row[-1].L_f[0] - 1)) for row in runs])
        for label, chosen, colour in (
            ("a_H < 0.5", np.array([row[0].point.a_H < 0.5 for row in runs]), "#b40426"),
            ("r > 0.8", np.array([row[0].point.r > 0.8 for row in runs]), "#3b4cc0"),
            ("in the range", np.array(inside), "black"),
        ):
            ax.plot(m[chosen], size[chosen], "o", markersize=3.5, color=colour, label=label)
        rest = np.array(
            [
                not a and p[0].point.a_H >= 0.5 and p[0].point.r <= 0.8
                for a, p in zip(inside, runs, strict=True)
            ]
        )
        ax.plot(m[rest], size[rest], "o", markersize=3.5, color="0.6", label="others", zorder=1)
        for share in (0.5, 0.95):
            ax.axhline(
                np.quantile(size, share), color="black", linewidth=0.8, linestyle="--" if share < 0.9 else "-"
            )
        ax.set(xscale="log", yscale="log", ylim=(1e-3, 100), xlabel="$m = \\tan\\delta / a_2$")
        ax.set_title(
            f"{cells} cells: median {np.median(size):.2f} %, 95 % {np.quantile(size, 0.95):.2f} %,"
            f" worst {size.max():.1f} %",
            fontsize=9,
        )
        ax.grid(True, which="major", linewidth=0.4, alpha=0.5)
    panels[0].set_ylabel("error of $L_f$ (1 % front), %")
    panels[-1].legend(fontsize=8, loc="upper right")
    figure.savefig(output, dpi=110)
    checked = [row[-1] for row in runs[::10]]
    uniform = [solve(run.point.with_values(grid="uniform", cells=1600)) for run in checked]
    apart = np.abs([100 * (a.L_f[0] / b.L_f[0] - 1) for a, b in zip(checked, uniform, strict=True)])
    print(
        f"{FINE} cells against 1,600 uniform ones, {len(checked)} columns: median {np.nanmedian(apart):.2f} %,",
        end=" ",
    )
    print(f"worst {np.nanmax(apart):.2f} %; {np.isnan(apart).sum()} left the sea")
    print(f"{len(runs)} of {len(columns)} columns have a deposit of 1 % of H2 at its end; drawn in {output}")


def progress(columns: list[Point]):
    """Give the columns, and say on stderr how far it has come."""
    for n, column in enumerate(columns):
        if n % 20 == 0:
            print(f"{n} of {len(columns)}", file=sys.stderr)
        yield column


def main() -> None:
    """Do what is asked."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("what", choices=("accuracy", "speed", "chart"))
    parser.add_argument("--columns", type=int)
    parser.add_argument("--seed", type=int)
    parser.add_argument("--truth", type=int, default=12800)
    parser.add_argument("--output", type=Path, default=Path("docs/fitted_range.png"))
    asked = parser.parse_args()
    if asked.what == "chart":
        chart(far(asked.columns or 400, 5 if asked.seed is None else asked.seed), asked.output)
        return
    columns = drawn(asked.columns or 200, 12 if asked.seed is None else asked.seed)
    if asked.what == "speed":
        speed(columns)
    else:
        accuracy(columns, asked.truth)


if __name__ == "__main__":
    main()
