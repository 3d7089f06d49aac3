"""Error against seconds for every choice of numerics: a panel for each quantity and depth of water."""

from typing import TYPE_CHECKING, Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import FixedLocator, FuncFormatter, LogLocator, NullFormatter

from subslide.figures import _style, _words
from subslide.tables.work_precision import reached

if TYPE_CHECKING:
    from subslide.results import Results

TITLE = "Speed against accuracy"
CATEGORY = "7 Verification"
NEEDS = {"scene": ("cylinder",), "model": ("plane", "radial"), "order": (1, 2)}
QUANTITIES = {
    "L_f": "$L_f$",
    "x_front": "$x_\\mathrm{front}(t)$",
    "max_abs_eta": "max$\\,|\\eta|(t)$",
    "max_abs_eta_outside": "max$\\,|\\eta|(t)$ beyond $R$",
}
MODELS = {"radial": "o", "quarter": "s", "plane": "^", "one-layer": "v"}
FITTED = "D"
"""Marker of runs on fitted grids."""
STRONG = {
    "default": {"color": "black", "label": "default numerics on a radius"},
    "fitted": {"color": "#0072b2", "label": "the same on a fitted grid"},
    "paper": {"color": "#c8102e", "label": "the paper's method in the plane"},
}
COUNTED = {"default": (25, 100, 400, 1600, 6400, 25600), "fitted": (16, 24, 48, 110, 220)}
"""Cells that are written beside symbols; of other methods all are."""
TICKS = (0.01, 0.05, 0.1, 0.5, 1, 2, 5, 10, 20, 50, 100)
MOST_COLUMNS = 3


@_style.styled
def draw(results: "Results") -> Figure:
    """Return the figure: errors in per cent against seconds of the time loop, both on logarithmic scales.

    Parameters
    ----------
    results
        A finished study that sweeps numerics.

    Returns
    -------
    Figure
        A panel for each quantity and depth of water of which an error is known.
    """
    every = results.work_precision
    if every.empty or every["sure_error"].isna().all():
        raise _style.NoRunsError("a sweep of numerics with a converged answer")
    table = every[every["sure_error"].notna()]
    places = table[["a_H", "a_2", "r", "delta"]].drop_duplicates()
    shown = places.head(MOST_COLUMNS)
    looks = _style.looks_of(dict.fromkeys(table["scheme"]), palette="viridis", light=0.9)
    quantities = [name for name in QUANTITIES if (table["quantity"] == name).any()]
    figure, axes = _style.panels(len(quantities) * len(shown), len(shown), 2.1, sharex=True, sharey="row")
    for k, ax in enumerate(axes):
        quantity, place = quantities[k // len(shown)], shown.iloc[k % len(shown)]
        rows = table[(table["quantity"] == quantity) & (table[list(shown)] == place).all(axis=1)]
        if rows.empty:
            ax.set_visible(False)
            continue
        _panel(ax, rows, looks)
        ax.set_title(_words.panel(k, f"{QUANTITIES[quantity]}, {_words.equation('a_H', place['a_H'])}"))
        ax.set_ylabel(f"error of {QUANTITIES[quantity]} (%)" if k % len(shown) == 0 else "")
    for ax in _style.bottom_row(axes, len(shown)):
        ax.set_xlabel("time of a run (s)")
    same = [
        _words.equation(key, places[key].iloc[0])
        for key in ("a_2", "r", "delta")
        if places[key].nunique() == 1
    ]
    return _style.finish(
        figure,
        TITLE,
        ", ".join(same),
        _notes(every, len(places) - len(shown)),
        _entries(looks, table),
        6,
        _lines(table),
    )


def _panel(ax: Axes, rows: pd.DataFrame, looks: dict[str, _style.Look]) -> None:
    """Draw all runs as symbols, and on them the front, the two methods and the factors between."""
    ax.set(xscale="log", yscale="log")
    for (scheme, model, order, grid), some in rows.groupby(["scheme", "model", "order", "grid"]):
        look = {**_symbol(looks[scheme]["color"], model, order, grid), "alpha": 0.5}
        ax.plot(some["seconds"], 100 * some["sure_error"], zorder=2, **look)
    front = rows[rows["on_front"]].sort_values("seconds")
    ax.step(front["seconds"], 100 * front["sure_error"], where="post", **_FRONT)
    for name, line in STRONG.items():
        some = rows[rows["method"] == name].sort_values("cells")
        if not some.empty:
            order, model, grid = some[["order", "model", "grid"]].iloc[0]
            ax.plot(some["seconds"], 100 * some["sure_error"], color=line["color"], linewidth=1.2, zorder=4)
            symbol = _symbol(line["color"], model, order, grid) | {"markersize": 3.6, "zorder": 5}
            ax.plot(some["seconds"], 100 * some["sure_error"], **symbol)
            _counts(ax, some, line["color"], name)
    _factors(ax, rows)
    low = 100 * rows["uncertainty"].max()
    ax.axhspan(low / 1e3, low, color="0.93", zorder=0, linewidth=0)
    ax.set_ylim(bottom=low / 1.5)
    ax.yaxis.set_major_locator(FixedLocator(TICKS))
    ax.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    ax.yaxis.set_minor_formatter(NullFormatter())
    ax.xaxis.set_major_locator(LogLocator(numticks=12))


def _counts(ax: Axes, rows: pd.DataFrame, color: str, name: str) -> None:
    """Write the cells of some runs of a method beside their symbols."""
    for _, row in rows.iterrows():
        if row["cells"] in COUNTED.get(name, [row["cells"]]):
            ax.annotate(
                f"{row['cells']:.0f}",
                (row["seconds"], 100 * row["sure_error"]),
                xytext=(3, 3),
                textcoords="offset points",
                fontsize=6,
                color=color,
                zorder=6,
            )


def _factors(ax: Axes, rows: pd.DataFrame) -> None:
    """Draw an arrow, at the error of the paper's method on its finest grid, to the default numerics."""
    color = STRONG["paper"]["color"]
    for _, row in _reached(rows).tail(1).iterrows():
        height, right = 100 * row["sure_error"], row["seconds"]
        left = right / row["factor"]
        arrow = {"arrowstyle": "-|>", "color": color, "linewidth": 0.7, "shrinkA": 4, "shrinkB": 0}
        ax.annotate("", (left, height), (right, height), arrowprops=arrow, zorder=3)
        ax.text(
            np.sqrt(left * right),
            height,
            f"{_round(row['factor']):,} times",
            fontsize=7,
            color=color,
            ha="center",
            va="center",
            zorder=6,
            bbox={"facecolor": "white", "alpha": 0.85, "linewidth": 0, "pad": 0.6},
        )


def _reached(rows: pd.DataFrame) -> pd.DataFrame:
    """Return the runs of the paper's method whose error counts, and that have a factor."""
    compared = reached(rows)
    return compared[compared["factor"].notna()]


def _round(value: float) -> int:
    """Return a factor to two digits, rounded down."""
    digits = 10 ** max(int(np.floor(np.log10(value))) - 1, 0)
    return int(value // digits * digits)


_FRONT = {"color": "#f2a900", "linewidth": 3.5, "alpha": 0.75, "zorder": 1, "solid_capstyle": "round"}


def _symbol(color: Any, model: str, order: int, grid: str = "uniform") -> _style.Look:
    """Return the look of a run: its marker says the model, or a fitted grid; filled means second order."""
    return {
        "marker": FITTED if grid == "fitted" else MODELS[model],
        "color": color,
        "linestyle": "",
        "markersize": 2.6,
        "markerfacecolor": color if order == 2 else "white",
        "markeredgewidth": 0.6,
    }


def _entries(looks: dict[str, _style.Look], table: pd.DataFrame) -> list[_style.Entry]:
    """Return the entries of the legend for symbols."""
    schemes = [
        (Line2D([], [], **_symbol(look["color"], "radial", 2) | {"markersize": 5}), scheme.upper())
        for scheme, look in looks.items()
    ]
    models = [
        (Line2D([], [], **_symbol(_style.GREY, model, 2) | {"markersize": 5}), model)
        for model in MODELS
        if model in set(table["model"])
    ]
    if "fitted" in set(table["grid"]):
        symbol = _symbol(_style.GREY, "radial", 2, "fitted") | {"markersize": 5}
        models.append((Line2D([], [], **symbol), "radial, fitted grid"))
    orders = [
        (Line2D([], [], **_symbol(_style.GREY, "radial", order) | {"markersize": 5}), f"order {order}")
        for order in (2, 1)
    ]
    return schemes + models + orders


def _lines(table: pd.DataFrame) -> list[_style.Entry]:
    """Return the entries of the legend for lines and shades."""
    lines = [
        (
            Line2D([], [], color=line["color"], marker=FITTED if name == "fitted" else "o", linewidth=1.2),
            f"{line['label']} (cells beside it)",
        )
        for name, line in STRONG.items()
        if name in set(table["method"])
    ]
    front = (Line2D([], [], **{**_FRONT, "zorder": 2}), "Pareto front: no run is cheaper and as accurate")
    return [*lines, front, (Patch(color="0.93"), "below the uncertainty of the converged answer")]


def _notes(table: pd.DataFrame, hidden: int) -> list[str]:
    """Return the notes: what is drawn, what failed, what is left out."""
    once = table.drop_duplicates("id")
    failed = once[once["status"] != "ok"]["status"].value_counts()
    notes = [
        "Error: against the converged answer on a radius, relative; of a series the mean of |difference| over time over"
        " the mean of the answer. Drawn is the largest error on a grid and all finer ones of the same numerics, so that"
        " a grid that is right by chance does not count. Time: of the time loop on one core, one timing. Small symbols"
        f" are all {len(once)} runs, those in float32, with approximate wave speeds or the paper's flux at fronts too."
    ]
    least = _reached(table[table["quantity"] == "L_f"])["factor"].min()
    if np.isfinite(least):
        notes.append(
            "At the same error in $L_f$ the paper's method in the plane takes at least"
            f" {_round(least):,} times as long as the default numerics, on each grid that is not right by chance."
        )
    if len(failed):
        words = ", ".join(f"{count} {status}" for status, count in failed.items())
        notes.append(f"Not drawn are runs that did not end well ({words}).")
    if hidden:
        notes.append(f"Also in this study, not shown here: {hidden} more (a_H, a_2, r, delta).")
    return notes
