"""Power laws of runout and wave: what they predict against what was solved, beside the laboratory's runout."""

from typing import TYPE_CHECKING

import matplotlib as mpl
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from subslide.figures import _sensitivity as sensitivity
from subslide.figures import _style, _words
from subslide.laboratory import lube

if TYPE_CHECKING:
    from subslide.results import Results

TITLE = "Power laws of runout and wave"
CATEGORY = "9 Sensitivity"
NEEDS = {"design": ("saltelli",)}
LAWS = {"runout": "$L_f/R - 1$", "peak": "peak of the wave$/H_2$"}
MOST_POINTS = 4000
DRY_ANGLE = 30.0
"""Friction angle (degrees) at which the laboratory's runout, of a_2, is drawn over m: about that of its sand."""


@_style.styled
def draw(results: "Results") -> Figure:
    """Return the figure: for each law, runs over m, and over what the law predicts, coloured by r."""
    designs, _ = sensitivity.tables(results, "laws")
    if not designs:
        raise _style.NoRunsError("a run whose answer has a logarithm")
    rows = designs[-1]  # the last design of a study stands for its laws
    ours = rows[rows["source"] == "these runs"]
    laws = [name for name in LAWS if (ours["law"] == name).any()]
    runs = _runs(results, rows["design"].iloc[0])
    figure, axes = _style.panels(2 * len(laws), 2, 2.5)
    for k, name in enumerate(laws):
        law = ours[ours["law"] == name].set_index("term")
        solved, predicted = runs[name], _predicted(law["value"], runs)
        across, against = axes[2 * k], axes[2 * k + 1]
        shades = across.scatter(
            runs["m"], solved, c=runs["r"], s=3, cmap="viridis", linewidths=0, rasterized=True
        )
        if name == "runout":
            _laboratory(across, runs["m"])
        against.scatter(predicted, solved, c=runs["r"], s=3, cmap="viridis", linewidths=0, rasterized=True)
        ends = np.array([solved.min(), solved.max()])
        against.plot(ends, ends, color="black", linewidth=0.8)
        for ax in (across, against):
            ax.set(xscale="log", yscale="log", ylabel=f"{LAWS[name]} (1)")
            for axis in (ax.xaxis, ax.yaxis):
                axis.set_major_locator(LogLocator(subs=(1, 2, 5)))
                axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
                axis.set_minor_formatter(NullFormatter())
        across.set_xlabel("$m$ = tan$\\,\\delta/a_2$ (1)")
        against.set_xlabel("power law (1)")
        across.set_title(_words.panel(2 * k, LAWS[name]))
        against.set_title(_words.panel(2 * k + 1, _equation(law)))
    bar = figure.colorbar(
        mpl.cm.ScalarMappable(shades.norm, "viridis"), ax=axes, shrink=0.6, aspect=30, pad=0.01
    )
    bar.set_label(f"{_words.SYMBOLS['r']} (1)")
    quality = [
        f"{LAWS[name]}: median error {100 * row['error_median']:.1f} %, 95 % of runs within"
        f" {100 * row['error_95']:.0f} %,"
        f" {100 * row['explained']:.1f} % of the variance of the logarithm"
        for name in laws
        for row in [ours[ours["law"] == name].iloc[0]]
    ]
    left_out = {run for text in ours["left_out"].dropna() for run in str(text).split()}
    notes = [
        "; ".join(quality)
        + ", at runs that the law was not fitted to. Exponents have their bands in laws.csv.",
        f"Dashed: dry columns in the laboratory (Lube et al. 2004), 1.24 $a_2$ to $a_2$ = 1.7, at {DRY_ANGLE:g}°.",
        *([f"{len(left_out)} runs have no logarithm; laws.csv lists them."] if left_out else []),
    ]
    return _style.finish(figure, TITLE, sensitivity.title(rows), notes)


def _runs(results: "Results", number: int) -> pd.DataFrame:
    """Return the runs of a design that ended well, with their answers by law, at most so many."""
    designs = [one for one in results.designs if one["kind"] == "saltelli"]
    ids = np.unique(np.array(designs[number - 1]["ids"]))
    rows = results.runs
    rows = rows[rows["id"].isin(ids) & (rows["status"] == "ok")].iloc[:MOST_POINTS]
    runout = rows["L_f_1pc_over_R"] - 1
    peak = rows["eta_gauge_peak"] / (rows["a_2"] * rows["radius"])
    return rows.assign(runout=runout, peak=peak)


def _predicted(terms: pd.Series, runs: pd.DataFrame) -> pd.Series:
    """Return what a law says of runs."""
    variables = {"a_H": runs["a_H"], "m": runs["m"], "1 - r": 1 - runs["r"]}
    result = terms["C"] * np.ones(len(runs))
    for name, column in variables.items():
        result = result * column ** terms.get(name, 0.0)
    return result


def _laboratory(ax: Axes, m: pd.Series) -> None:
    """Draw the runout of dry columns in the laboratory."""
    heights = np.tan(np.radians(DRY_ANGLE)) / np.array([m.min(), m.max()])
    heights = np.minimum(heights, 1.7)
    ax.plot(
        np.tan(np.radians(DRY_ANGLE)) / heights,
        [lube.runout(a_2) - 1 for a_2 in heights],
        "--",
        color="#c8102e",
    )


def _equation(law: pd.DataFrame) -> str:
    """Return the law as an equation."""
    bases = {"a_H": "a_H", "m": "m", "1 - r": "(1-r)"}
    powers = "".join(
        f"\\,{base}^{{{law['value'][name]:.2f}}}" for name, base in bases.items() if name in law.index
    )
    return f"${law['value']['C']:.3g}{powers}$"
