"""Kinds of numerics that a figure draws together, told apart by line, and the bands that each has."""

from typing import NamedTuple

import numpy as np
import pandas as pd
from matplotlib.lines import Line2D

from subslide.figures import _slices
from subslide.tables import _convergence as convergence

PAIR = ("paper", "resolved")
"""Numerics that are drawn together where a study has both."""
TITLES = {"paper": "paper's numerics", "resolved": "resolved"}
LINES = {
    "paper": {"linestyle": (0, (2.2, 1.1)), "linewidth": 0.8},
    "resolved": {"linestyle": "-", "linewidth": 1.5},
}


class Kind(NamedTuple):
    """Runs of one kind of numerics: its name ('' if the figure has one kind), the slice, and its bands."""

    name: str
    chosen: _slices.Slice
    bands: pd.DataFrame

    @property
    def runs(self):
        """Table of the runs."""
        return self.chosen.runs

    @property
    def banded(self):
        """Whether the runs have bands."""
        return not self.bands.empty

    def line(self, look):
        """Return the options of a curve without symbols: dashes say which kind, or which value if there is one kind."""
        style = LINES[self.name] if self.name else {"linestyle": look["linestyle"], "linewidth": 1.3}
        return {"color": look["color"], **style}

    def marks(self, name, quantity):
        """Return the rows (time, value, band in SI units; NaN where there is none) of a run's bands."""
        rows = self.bands[(self.bands["id"] == name) & (self.bands["quantity"] == quantity)]
        band = rows["band"].where(rows["convergence"] == convergence.CONVERGING)
        return rows.assign(band=band)[["time", "value", "band"]].astype(float)


def kinds(results, **options):
    """Return the kinds of a figure: the paper's numerics and the resolved, or the one that `_slices.cut` prefers."""
    names = [name for name in PAIR if (results.runs["numerics"] == name).any()]
    chosen = (
        {name: _slices.cut(results, numerics=name, **options) for name in PAIR}
        if len(names) == len(PAIR)
        else {"": _slices.cut(results, **options)}
    )
    bands = results.bands
    return [Kind(name, one, bands[bands["id"].isin(one.runs["id"])]) for name, one in chosen.items()]


def about(found):
    """Return what all runs share, for the line below a figure's title."""
    if len(found) == 1:
        return found[0].chosen.about
    return _slices.shared(found[0].runs)


def symbols(ax, kind, rows, look, x, unit, size=4.0):
    """Nothing; values at the places `x` are in `ax`: filled with their bands as bars, open where not converged."""
    size = 0.8 * size if kind.name == "paper" else size
    known = rows["band"].notna().to_numpy()
    values, bands = rows["value"].to_numpy() * unit, rows["band"].to_numpy() * unit
    mark = {"marker": look["marker"], "color": look["color"], "linestyle": "", "markersize": size}
    x = np.asarray(x, float)
    ax.errorbar(
        x[known],
        values[known],
        bands[known],
        **mark,
        markeredgewidth=0,
        elinewidth=0.6 if kind.name == "paper" else 0.9,
        zorder=3,
    )
    ax.plot(x[~known], values[~known], **mark, markerfacecolor="white", markeredgewidth=0.7, zorder=3.2)


def entries(found):
    """Return the entries of a legend, (handle, label): a line for each kind, and the symbols of bands."""
    lines = [
        (
            Line2D([], [], color="0.25", **LINES[kind.name]),
            f"{TITLES[kind.name]}: {_slices.solver(kind.runs)}",
        )
        for kind in found
        if kind.name
    ]
    if any(kind.banded for kind in found):
        plain = {"color": "0.25", "marker": "o", "linestyle": "", "markersize": 4, "markeredgewidth": 0.8}
        bar = Line2D([], [], **{**plain, "marker": "|", "markersize": 10})
        lines += [((bar, Line2D([], [], **plain)), "value with its band of grid error")]
        lines += [(Line2D([], [], **plain, markerfacecolor="white"), "value whose three grids give no order")]
    return lines


def note(found, quantities, what):
    """Return the notes on bands: what a bar is, and how many of the values marked are not converged."""
    if not any(kind.banded for kind in found):
        return []
    counts = []
    for kind in found:
        rows = kind.bands[kind.bands["quantity"].isin(quantities)]
        lost = int((rows["convergence"] != convergence.CONVERGING).sum())
        name = f"{TITLES[kind.name]} " if kind.name else ""
        counts.append(f"{name}{lost} of {len(rows)}")
    return [
        "Bars: the band of discretisation error that three grids leave (bands.csv), where it exceeds the symbol; open "
        f"symbols: three grids give no order, without bar: {', '.join(counts)} {what}."
    ]


def ratios(found, values):
    """Return (least, greatest) of the paper's numerics over the resolved, run by run; None without both.

    values: a function of a kind that returns its values by (a_H, r).
    """
    if len(found) < len(PAIR):
        return None
    coarse, fine = (values(kind) for kind in found)
    ratio = (coarse / fine).replace([np.inf, -np.inf], np.nan).dropna()
    return (float(ratio.min()), float(ratio.max())) if len(ratio) else None


def percent(low, high):
    """Return 'low to high %' of two fractions, or one number where they read the same."""
    low, high = f"{100 * low:.3g}", f"{100 * high:.3g}"
    return f"{low} %" if low == high else f"{low} to {high} %"
