"""Growth of a small wave between layers that slide over each other: measured rates beside linear theory."""

import json
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from subslide import exact
from subslide.figures import _style, _words
from subslide.points import Point

if TYPE_CHECKING:
    from subslide.results import Results

TITLE = "Growth of a wave where hyperbolicity is lost"
CATEGORY = "8 Stability"
NEEDS = {"scene": ("cylinder", "shear"), "treatment": ("real", "stop")}
COLUMNS = 3
TREATED = {
    "hll": {"marker": "s", "color": "#8c510a"},
    "friction": {"marker": "v", "color": "#b40426"},
    "stop": {"marker": "x", "color": "black"},
}


@_style.styled
def draw(results: "Results") -> Figure:
    """Return the figure: growth rate over shear, a panel for each r, theory as a line and a symbol for each run.

    Parameters
    ----------
    results
        A finished study with a stability atlas.

    Returns
    -------
    Figure
        A panel for each r.
    """
    rows = results.atlas[results.atlas["scene"] == "shear"]
    if rows.empty:
        raise _style.NoRunsError("scene: shear")
    rows = rows.assign(shear=[json.loads(text)["shear"] for text in rows["scene_options"]])
    points = {run.id: run.point for run in results.runs_of_study}
    schemes = list(dict.fromkeys(rows["scheme"]))
    looks = _style.looks_of(schemes)
    values = sorted(rows["r"].unique())
    figure, axes = _style.panels(len(values), COLUMNS, 2.0, sharex=True)
    for k, (ax, r) in enumerate(zip(axes, values, strict=True)):
        part = rows[rows["r"] == r]
        x, y = theory(points[part["id"].iloc[0]], part["shear"].max())
        ax.plot(x, y, color="0.75", linewidth=3, zorder=0)
        low = -0.4 * max(y)
        ax.set_ylim(low, 1.2 * max(y))
        for (scheme, order), runs in part[part["treatment"] == "real"].groupby(
            ["scheme", "order"], sort=False
        ):
            ax.plot(runs["shear"], runs["growth_rate"], linestyle="", **symbol(looks[scheme], order))
        for name, runs in part[part["order"] == part["order"].max()].groupby("treatment", sort=False):
            if name in TREATED:
                rate = runs["growth_rate"].fillna(0.0).clip(lower=0.9 * low)
                ax.plot(
                    runs["shear"], rate, linestyle="", markersize=6, markerfacecolor="none", **TREATED[name]
                )
        ax.axvline(1.0, color="0.5", linewidth=0.7, linestyle=":")
        ax.set_title(_words.panel(k, _words.equation("r", r)))
        ax.set_ylabel("growth rate (1/s)" if k % COLUMNS == 0 else "")
    for ax in _style.bottom_row(axes, COLUMNS):
        ax.set_xlabel("shear over its limit (1)")
    entries = [(Line2D([], [], color="0.75", linewidth=3), "linear theory")]
    entries += [
        (Line2D([], [], linestyle="", **symbol(looks[scheme], order)), f"{scheme.upper()}, order {order}")
        for order in sorted(rows["order"].unique())
        for scheme in schemes
    ]
    entries += [
        (
            Line2D([], [], linestyle="", markersize=6, markerfacecolor="none", **look),
            f"treatment {name}, order 2",
        )
        for name, look in TREATED.items()
        if (rows["treatment"] == name).any()
    ]
    row = rows.iloc[0]
    layers = _words.equation("a_H", row["a_H"])
    about = f"{layers}, one wave in {row['cells']} cells, amplitude 1e-5 $H_2$ at the start"
    notes = [
        "Rates from the wave's Fourier coefficient over the run; below 0 the scheme damps a wave that theory keeps. "
        "Runs that treatment stop ends have no rate and are drawn at 0; interlayer friction that damps faster than the "
        "axis shows is drawn at its end. Beyond a second limit the speeds are real again: no growth."
    ]
    return _style.finish(figure, TITLE, about, notes, entries, 5)


def symbol(look: _style.Look, order: int) -> _style.Look:
    """Return the options of a symbol: open at first order."""
    color = look["color"]
    return {
        "marker": look["marker"],
        "color": color,
        "markersize": 4,
        "markerfacecolor": "white" if order == 1 else color,
        "markeredgewidth": 0.8,
    }


def theory(point: Point, largest: float) -> tuple[np.ndarray, list[float]]:
    """Return shears over the limit, and the rates (1/s) at which linear theory lets the point's wave grow."""
    x = np.linspace(0.0, largest, 241)
    options = dict(point.scene_options)
    rate = exact.load("shear").growth_rate
    return x, [
        rate(point.with_values(scene_options=tuple(sorted({**options, "shear": v}.items())))) for v in x
    ]
