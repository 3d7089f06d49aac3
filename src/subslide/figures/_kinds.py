"""Kinds of numerics that a figure draws together, told apart by line, and the bands that each has."""

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from subslide.figures import _slices, _style, _words
from subslide.tables import _convergence as convergence

if TYPE_CHECKING:
    from subslide.results import Results

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
    def runs(self) -> pd.DataFrame:
        """Table of the runs."""
        return self.chosen.runs

    @property
    def banded(self) -> bool:
        """Whether the runs have bands."""
        return not self.bands.empty

    def line(self, look: _style.Look) -> dict[str, Any]:
        """Return the options of a curve without symbols: dashes say which kind, or which value if there is one kind."""
        style = LINES[self.name] if self.name else {"linestyle": look["linestyle"], "linewidth": 1.3}
        return {"color": look["color"], **style}

    def called(self, text: str) -> str:
        """Return a text with the name of the kind before it, if the figure has several."""
        return f"{TITLES[self.name].capitalize()}: {text}" if self.name else text

    def banded_values(self, run: str, quantity: str) -> pd.DataFrame:
        """Return the values of a run that have a row in the table of bands.

        Parameters
        ----------
        run
            Id of the run.
        quantity
            Name of the quantity, such as ``x_front_1pc``.

        Returns
        -------
        DataFrame
            A row for each time: ``time`` (s; NaN for a final length), ``value`` and ``band`` (SI units), ``ordered`` (0
            where three grids give no order, else 1).
        """
        rows = self.bands[(self.bands["id"] == run) & (self.bands["quantity"] == quantity)]
        ordered = ~rows["convergence"].isin(convergence.UNORDERED)
        return rows.assign(ordered=ordered)[["time", "value", "band", "ordered"]].astype(float)


def of(results: "Results", **options: Any) -> list[Kind]:
    """Return the kinds of a figure: the paper's numerics and the resolved, or the one that is preferred.

    Parameters
    ----------
    results
        The study.
    **options
        Options of `_slices.cut`, the same for each kind.
    """
    names = [name for name in PAIR if (results.runs["numerics"] == name).any()]
    slices = (
        {name: _slices.cut(results, numerics=name, **options) for name in PAIR}
        if len(names) == len(PAIR)
        else {"": _slices.cut(results, **options)}
    )
    bands = results.bands
    return [Kind(name, one, bands[bands["id"].isin(one.runs["id"])]) for name, one in slices.items()]


def about(kinds: list[Kind]) -> str:
    """Return what all runs share, for the line below a figure's title."""
    if len(kinds) == 1:
        return kinds[0].chosen.about
    return _words.shared(kinds[0].runs)


def symbols(
    ax: Axes, kind: Kind, rows: pd.DataFrame, look: _style.Look, x: Any, unit: float, size: float = 4.0
) -> None:
    """Draw values as symbols, with their bands as bars; open where three grids give no order.

    Parameters
    ----------
    ax
        Panel to draw in.
    kind
        Kind of numerics that the values belong to; those of the paper's are smaller.
    rows
        Values and bands, as `Kind.banded_values` returns them.
    look
        Colour and marker.
    x
        Place of each row on the x axis, in units of that axis.
    unit
        Units of the y axis in the unit of the values.
    size
        Size of the symbols (point).
    """
    size = 0.8 * size if kind.name == "paper" else size
    values, bands = rows["value"].to_numpy() * unit, rows["band"].to_numpy() * unit
    symbol = {"marker": look["marker"], "color": look["color"], "linestyle": "", "markersize": size}
    ordered = rows["ordered"].to_numpy() == 1
    filled = {"markeredgewidth": 0, "zorder": 3}
    hollow = {"markerfacecolor": "white", "markeredgewidth": 0.7, "zorder": 3.2}
    for some, face in ((ordered, filled), (~ordered, hollow)):
        width = 0.6 if kind.name == "paper" else 0.9
        ax.errorbar(np.asarray(x, float)[some], values[some], bands[some], **symbol, **face, elinewidth=width)


def entries(kinds: list[Kind], symbols: bool = True) -> list[_style.Entry]:
    """Return the entries of a legend, (handle, label): a line for each kind, and with `symbols` those of bands."""
    lines = [
        (
            Line2D([], [], color="0.25", **LINES[kind.name]),
            f"{TITLES[kind.name]}: {_words.solver(kind.runs)}",
        )
        for kind in kinds
        if kind.name
    ]
    if symbols and any(kind.banded for kind in kinds):
        plain = {"color": "0.25", "marker": "o", "linestyle": "", "markersize": 4, "markeredgewidth": 0.8}
        bar = Line2D([], [], **{**plain, "marker": "|", "markersize": 10})
        lines += [((bar, Line2D([], [], **plain)), "value with its band of grid error")]
        lines += [(Line2D([], [], **plain, markerfacecolor="white"), "value whose three grids give no order")]
    return lines


def note(kinds: list[Kind], quantities: tuple[str, ...], what: str) -> list[str]:
    """Return the notes on bands: what a bar is, and how many values have none.

    Parameters
    ----------
    kinds
        Kinds of numerics that the figure draws.
    quantities
        Quantities whose values it draws with bands.
    what
        What it calls them, such as 'fronts and lengths'.
    """
    if not any(kind.banded for kind in kinds):
        return []
    counts = []
    for kind in kinds:
        rows = kind.bands[kind.bands["quantity"].isin(quantities)]
        lost = int(rows["convergence"].isin(convergence.UNORDERED).sum())
        name = f"{TITLES[kind.name]} " if kind.name else ""
        counts.append(f"{name}{lost} of {len(rows)}")
    return [
        "Bars: the band of discretisation error (bands.csv), where it exceeds the symbol; open symbols: three grids "
        f"give no order: {', '.join(counts)} {what}."
    ]


def ratios(kinds: list[Kind], values: Callable[[Kind], pd.Series]) -> tuple[float, float] | None:
    """Return (least, greatest) of the paper's numerics over the resolved, run by run; None without both.

    Parameters
    ----------
    kinds
        Kinds of numerics that the figure draws, the paper's first.
    values
        Function that returns the values of a kind, indexed by (a_H, r).
    """
    if len(kinds) < len(PAIR):
        return None
    coarse, fine = (values(kind) for kind in kinds)
    ratio = (coarse / fine).replace([np.inf, -np.inf], np.nan).dropna()
    return (float(ratio.min()), float(ratio.max())) if len(ratio) else None


def percent(low: float, high: float) -> str:
    """Return 'low to high %' of two fractions, or one number where they read the same."""
    least, most = f"{100 * low:.3g}", f"{100 * high:.3g}"
    return f"{least} %" if least == most else f"{least} to {most} %"
