"""What figures of sensitivity share: a study's designs, symbols of inputs and answers, bars with bands."""

from typing import TYPE_CHECKING

import numpy as np
import pandas as pd
import seaborn as sns
from matplotlib.axes import Axes

from subslide.figures import _style, _words

if TYPE_CHECKING:
    from subslide.results import Results

MOST_DESIGNS = 3
OUTPUTS = {
    "L_f_1pc": "$L_f/R$",
    "eta_gauge_peak": "peak of the wave$/H_2$",
    "time_of_arrest_1pc": "time of arrest",
    "x_front_1pc": "$x_\\mathrm{front}/R$",
    "max_abs_eta": "max$\\,|\\eta|/H_2$",
}
COLOURS = {"a_H": "#0072b2", "a_2": "#d55e00", "r": "#009e73", "delta": "#cc79a7", "m": "#7a4fa3"}
"""Colours of inputs, told apart by eyes that see few; others take grey."""
DASHES = {
    "a_H": "-",
    "a_2": (0, (5, 1.5)),
    "r": (0, (4, 1.2, 1, 1.2)),
    "delta": (0, (1.2, 1)),
    "m": (0, (9, 2)),
}
TOTAL = "0.72"
"""Shade of bars of total indices."""


def symbol(name: str) -> str:
    """Return the symbol of an input."""
    return "$m$" if name == "m" else _words.SYMBOLS.get(name, name)


def tables(results: "Results", name: str) -> tuple[list[pd.DataFrame], list[str]]:
    """Return the rows of a table for each of the first designs, and notes on those that are left out.

    Parameters
    ----------
    results
        A finished study.
    name
        Name of a table with rows for each design.
    """
    rows = results.table(name)
    numbers = rows["design"].unique()
    shown = [rows[rows["design"] == number] for number in numbers[:MOST_DESIGNS]]
    more = numbers[MOST_DESIGNS:]
    return shown, [f"Designs {', '.join(map(str, more))} are not shown; see {name}.csv."] if len(more) else []


def title(rows: pd.DataFrame) -> str:
    """Return what a design is over, in words."""
    first = rows.iloc[0]
    others = "" if pd.isna(first["others"]) else f" ({first['others']})"
    return f"design {first['design']}: " + ", ".join(map(symbol, first["inputs"].split())) + others


def size(rows: pd.DataFrame) -> str:
    """Return how large the designs are, in words."""
    parts = rows.drop_duplicates("design")
    told = [
        f"design {row['design']}: {row['runs']} runs ({row['scramblings']} scramblings, N = {row['points']})"
        for _, row in parts.iterrows()
    ]
    return "; ".join(told)


def failures(rows: pd.DataFrame) -> list[str]:
    """Return a note on the runs that failed, of the table of indices."""
    failed = {name for text in rows["failed"].dropna() for name in str(text).split()}
    if not failed:
        return []
    return [
        f"{len(failed)} runs lack an answer (listed in indices.csv); bands hold whatever it may have been."
    ]


def bars(ax: Axes, rows: pd.DataFrame, inputs: list[str]) -> None:
    """Draw bars of first-order and total indices with their bands, an input beside the other.

    Parameters
    ----------
    ax
        Panel.
    rows
        Indices of one output of one design.
    inputs
        Inputs in order.
    """
    kinds = rows[rows["kind"].isin(("first", "total"))]
    sns.barplot(
        kinds, x="input", y="estimate", hue="kind", order=inputs, hue_order=["first", "total"], ax=ax,
        errorbar=None, legend=False, palette=[_style.GREY, TOTAL], saturation=1,
    )  # fmt: skip
    for n, kind in enumerate(("first", "total")):
        some = kinds[kinds["kind"] == kind].set_index("input").loc[inputs]
        places = np.arange(len(inputs)) + (n - 0.5) * 0.4
        low, high = some["estimate"] - some["low"], some["high"] - some["estimate"]
        ax.errorbar(
            places, some["estimate"], (low, high), fmt="none", color="black", elinewidth=0.9, capsize=2
        )
    ax.axhline(0, color="black", linewidth=0.6)
    ax.set_xticks(range(len(inputs)), [symbol(name) for name in inputs])
    ax.set(xlabel="", ylabel="")
    ax.grid(False, axis="x")
