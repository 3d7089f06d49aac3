"""Maps of the stability atlas: a panel for each scheme and order, a cell for each column, colour for error."""

from typing import TYPE_CHECKING, Any, NamedTuple

import matplotlib as mpl
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from subslide import naming
from subslide.figures import _style, _words
from subslide.points import Point
from subslide.records.energy import GAINED
from subslide.tables import _by_method

if TYPE_CHECKING:
    from subslide.results import Results

USUAL = {key: getattr(Point(), key) for key in _by_method.VARIANTS}
"""Default of each column that tells variants of a method apart."""
SCALE = (0.0, 0.3)
"""Errors of L_f that the colours span."""
FILLED = 0.5
"""Share of a row's or column's entries that a map must have to show it."""
COMPLEX = 0.1
"""Extent over R of cells with complex wave speeds, in the resolved run, from which a map outlines their loss."""
BOXES = {"open": "open sea", "paper": "the paper's box", "wall": "walls"}
"""What a map calls the edge of its runs' box."""
OUTCOMES = {
    "failed": {"marker": "x", "color": "#b40426", "markersize": 5, "markeredgewidth": 1.5},
    "left_domain": {"marker": ">", "color": "0.35", "markersize": 3.5, "markeredgewidth": 0},
    "gained": {"marker": "^", "color": "#b40426", "markersize": 4.5, "markeredgewidth": 0},
}
"""Look of the symbol on a run by how it went wrong."""
OUTCOME_WORDS = {
    "failed": "failed (step_collapse, diverged or negative_depth)",
    "left_domain": "left the largest box",
    "gained": f"ended well, but energy rose by over {GAINED:.0%} of what the start can release",
}


class Sides(NamedTuple):
    """The two keys of a map, along x and along y, and the sorted values it shows of each."""

    across: str
    up: str
    across_values: list[float]
    up_values: list[float]


def chosen(results: "Results", **values: Any) -> pd.DataFrame:
    """Return the rows of the atlas with some values, and the usual ones in columns that tell variants apart.

    Parameters
    ----------
    results
        The study.
    **values
        Value by column; the scene is a cylinder if it is not given.

    Raises
    ------
    NoRunsError
        If there are no such rows.
    """
    rows = results.atlas
    for key, value in {**USUAL, "scene": "cylinder", **values}.items():
        entries = rows[key]
        same = np.isclose(entries, value) if isinstance(value, float) else entries == value
        rows = rows[same]
    if rows.empty:
        raise _style.NoRunsError(", ".join(f"{key}: {value}" for key, value in values.items()))
    return rows


def maps(
    results: "Results", across: str, up: str, **values: Any
) -> tuple[Figure, pd.DataFrame, list[_style.Entry]]:
    """Return the figure of maps over two keys.

    Parameters
    ----------
    results
        The study.
    across, up
        Keys along x and along y.
    **values
        Value by column of the atlas that all runs of the maps have.

    Returns
    -------
    figure
        The maps, without title and notes.
    rows
        Rows of the atlas that they show.
    entries
        Entries of their legend.
    """
    rows = chosen(results, model="radial", **values)
    tried = rows[rows["cells"] == rows.groupby("cells")["scheme"].nunique().idxmax()]
    sides = Sides(across, up, dense(tried, across, up), dense(tried, up, across))
    tried = tried[tried[across].isin(sides.across_values) & tried[up].isin(sides.up_values)]
    resolved = rows[rows["id"].isin(tried["reference"])]
    schemes, orders = list(dict.fromkeys(tried["scheme"])), sorted(tried["order"].unique())
    figure, axes = _style.panels(len(schemes) * len(orders), len(schemes), 1.75, sharex=True, sharey=True)
    look = mpl.colormaps["YlGnBu"].with_extremes(bad="0.86")
    for k, ax in enumerate(axes):
        scheme, order = schemes[k % len(schemes)], orders[k // len(schemes)]
        part = tried[(tried["scheme"] == scheme) & (tried["order"] == order)]
        mesh = ax.pcolormesh(table(part, "L_f_error", sides), cmap=look, vmin=SCALE[0], vmax=SCALE[1])
        outcomes(ax, part, sides)
        contour(ax, resolved, sides)
        ax.set_title(_words.panel(k, scheme.upper()))
        ticks(ax, sides)
        ax.grid(False)
        ax.set_xlabel(axis(across) if k // len(schemes) == len(orders) - 1 else "")
        ax.set_ylabel(f"order {order}\n{axis(up)}" if k % len(schemes) == 0 else "")
    bar = figure.colorbar(mesh, ax=axes, shrink=0.6, aspect=30, extend="max", pad=0.01)
    bar.set_label("error of $L_f$ (1)")
    return figure, tried, legend(tried)


def legend(rows: pd.DataFrame) -> list[_style.Entry]:
    """Return the entries of a legend for the symbols, shades and lines of maps of these rows."""
    seen = {outcome(row) for _, row in rows.iterrows()}
    symbols = [
        (Line2D([], [], linestyle="", **look), OUTCOME_WORDS[name])
        for name, look in OUTCOMES.items()
        if name in seen
    ]
    return [
        *symbols,
        (Patch(facecolor="0.86"), "no answer, or none to compare with"),
        (
            Line2D([], [], color="black", linewidth=1.0),
            f"wave speeds complex over {COMPLEX:g} R or more, resolved",
        ),
    ]


def dense(rows: pd.DataFrame, key: str, other: str) -> list[float]:
    """Return the sorted values of a key that have at least FILLED of the other key's values."""
    counts = rows.groupby(key)[other].nunique()
    return sorted(counts[counts >= FILLED * rows[other].nunique()].index)


def table(rows: pd.DataFrame, column: str, sides: Sides) -> np.ma.MaskedArray:
    """Return the entries of a column as an array (up, across), masked where there is none."""
    entries = rows.pivot_table(
        index=sides.up, columns=sides.across, values=column, aggfunc="first", dropna=False
    )
    entries = entries.reindex(index=sides.up_values, columns=sides.across_values)
    return np.ma.masked_invalid(entries.to_numpy(float))


def outcomes(ax: Axes, rows: pd.DataFrame, sides: Sides) -> None:
    """Draw a symbol on each run that failed, left the box or gained energy."""
    for _, row in rows.iterrows():
        name = outcome(row)
        if name:
            x = sides.across_values.index(row[sides.across]) + 0.5
            y = sides.up_values.index(row[sides.up]) + 0.5
            ax.plot(x, y, linestyle="", **OUTCOMES[name])


def outcome(row: pd.Series) -> str | None:
    """Return how a run went wrong, one of `OUTCOMES`, or None."""
    if row["status"] not in naming.FINISHED:
        return "left_domain" if row["status"] == "left_domain" else "failed"
    return "gained" if row["energy_rise"] > GAINED else None


def contour(ax: Axes, resolved: pd.DataFrame, sides: Sides) -> None:
    """Draw a line about the columns whose resolved run has complex wave speeds over COMPLEX or more."""
    lost = table(resolved, "nonhyperbolic_length", sides).filled(0.0) >= COMPLEX
    for j, i in np.argwhere(lost):
        for dj, di, x, y in ((0, -1, (i, i), (j, j + 1)), (0, 1, (i + 1, i + 1), (j, j + 1)),
                             (-1, 0, (i, i + 1), (j, j)), (1, 0, (i, i + 1), (j + 1, j + 1))):  # fmt: skip
            beside = (j + dj, i + di)
            inside = 0 <= beside[0] < lost.shape[0] and 0 <= beside[1] < lost.shape[1]
            if not (inside and lost[beside]):
                ax.plot(x, y, color="black", linewidth=1.0, solid_capstyle="round", clip_on=False)


def ticks(ax: Axes, sides: Sides) -> None:
    """Write each second value or so on the axes, whose cells all have the same size."""
    for values, most, place in (
        (sides.across_values, 4, ax.set_xticks),
        (sides.up_values, 12, ax.set_yticks),
    ):
        places = range(0, len(values), -(-len(values) // most))
        place([k + 0.5 for k in places], [_words.number(values[k]) for k in places])


def axis(key: str) -> str:
    """Return the label of an axis of a key."""
    return f"{_words.SYMBOLS[key]} ({'°' if key == 'delta' else '1'})"


def about(rows: pd.DataFrame, keys: tuple[str, ...]) -> str:
    """Return what the runs of a map share, in words: the values of some keys, the cells and the box."""
    row = rows.iloc[0]
    words = [_words.equation(key, row[key]) for key in keys]
    box = BOXES[row["boundary"]]
    dx = Point(cells=row["cells"]).scaled_dx
    return ", ".join([*words, f"{row['cells']} cells (d$x$ = {dx:.3g} $R$)", box])


def limits(tried: pd.DataFrame) -> pd.DataFrame:
    """Return the largest stable Courant number of each model, scene, scheme and order.

    Parameters
    ----------
    tried
        Table of Courant numbers (tables/cfl.csv).

    Returns
    -------
    DataFrame
        Columns ``model``, ``scene``, ``scheme``, ``order``, ``theory`` and ``cfl``, which is 0 where none is stable.
    """
    keys = ["model", "scene", "scheme", "order"]
    every = tried.groupby(keys, sort=False).first().reset_index()
    stable = tried[tried["limit"].astype(bool)]
    largest = every[[*keys, "theory"]].merge(stable[[*keys, "cfl"]], how="left", on=keys)
    return largest.fillna({"cfl": 0.0})
