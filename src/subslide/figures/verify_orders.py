"""Errors against exact solutions by the size of cells: a panel for each case, a line for each solver and order."""

from typing import TYPE_CHECKING

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import NullFormatter, ScalarFormatter

from subslide.figures import _style, _verify, _words

if TYPE_CHECKING:
    from subslide.results import Results

TITLE = "Errors against exact solutions"
CATEGORY = "7 Verification"
NEEDS = {"scene": ("dam_break", "paraboloid", "standing_wave")}
COLUMNS = 3


@_style.styled
def draw(results: "Results") -> Figure:
    """Return the figure: relative L1 error against the size of cells, with slopes 1 and 2 in grey.

    Parameters
    ----------
    results
        A finished study with a table of errors.

    Returns
    -------
    Figure
        A panel for each case.
    """
    cases = _verify.cases(results)
    schemes = list(dict.fromkeys(results.errors["scheme"]))
    looks = _style.looks_of(schemes)
    figure, axes = _style.panels(len(cases), COLUMNS, 1.85)
    unit = _words.length_unit(0.05)
    for k, (ax, (name, rows)) in enumerate(zip(axes, cases.items(), strict=True)):
        rows = _verify.sizes_of_cells(results, rows)
        for (scheme, order), line in rows.groupby(["scheme", "order"], sort=False):
            line = line.sort_values("dx")
            ax.loglog(line["dx"] * unit.factor, line["error"], **_look(looks[scheme], order))
        _slopes(ax, rows, unit)
        ax.set_title(_words.panel(k, name))
        ax.set_ylabel("relative error (1)" if k % COLUMNS == 0 else "")
        ax.set_xticks(sorted(rows["dx"].unique() * unit.factor))
        ax.xaxis.set_major_formatter(ScalarFormatter())
        ax.xaxis.set_minor_formatter(NullFormatter())
        ax.tick_params(axis="x", labelbottom=True)
    for ax in _style.bottom_row(axes, COLUMNS):
        ax.set_xlabel(f"d$x$ ({unit.name})")
    entries = [
        (Line2D([], [], **_look(looks[scheme], order)), f"{scheme.upper()}, order {order}")
        for order in (2, 1)
        for scheme in schemes
    ]
    notes = [
        "Error: mean over cells (over rings by their area in round cases) of |solved - exact|, over the mean depth, or "
        "for waves over their amplitude. Depth of the grains, or of the water where it is alone. Grey: slopes 1 and 2. "
        "Lines that lie on each other are solvers that agree."
    ]
    return _style.finish(
        figure, TITLE, "a panel for each case, a line for each solver and order", notes, entries, 5
    )


def _look(look: _style.Look, order: int) -> _style.Look:
    """Return the look of a line: open markers and dashes at first order."""
    first = order == 1
    return {
        **look,
        "linestyle": "--" if first else "-",
        "markerfacecolor": "white" if first else look["color"],
        "linewidth": 1.0,
        "markersize": 3.5,
        "markeredgewidth": 0.8,
    }


def _slopes(ax: Axes, rows: pd.DataFrame, unit: _words.Unit) -> None:
    """Draw lines of slopes 1 and 2 through the middle of the errors of first and of second order."""
    x = np.array([rows["dx"].min(), rows["dx"].max()]) * unit.factor
    for order, errors in rows.groupby("order")["error"]:
        middle = np.exp(np.nanmean(np.log(errors.where(errors > 0))))
        if np.isfinite(middle):
            ax.loglog(x, middle * (x / np.sqrt(x.prod())) ** order, color="0.8", linewidth=3, zorder=0)
