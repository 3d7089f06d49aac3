"""Maps of the stability atlas: a panel for each scheme and order, a cell for each column, colour for error."""

import matplotlib as mpl
import numpy as np
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from subslide.figures import _style, _words
from subslide.points import Point
from subslide.tables import atlas

USUAL = {key: getattr(Point(), key) for key in atlas.VARIANTS}
SCALE = (0.0, 0.3)
"""Errors of L_f that the colours span."""
FILLED = 0.5
"""Share of a row's or column's entries that a map must have to show it."""
COMPLEX = 0.1
"""Extent over R of cells with complex wave speeds, in the resolved run, from which a map marks their loss."""
MARKS = {
    "failed": {"marker": "x", "color": "#b40426", "markersize": 5, "markeredgewidth": 1.5},
    "left_domain": {"marker": ">", "color": "0.35", "markersize": 3.5, "markeredgewidth": 0},
    "gained": {"marker": "^", "color": "#b40426", "markersize": 4.5, "markeredgewidth": 0},
}
WORDS = {
    "failed": "failed (step_collapse, diverged or negative_depth)",
    "left_domain": "left the largest box",
    "gained": f"ended well, but energy rose by over {atlas.GAINED:.0%} of what the start can release",
}


def chosen(results, **values):
    """Return the rows of the atlas with these values by column, and the usual ones in columns that tell variants apart.

    NoRunsError if there are none.
    """
    found = results.atlas
    for key, value in {**USUAL, "scene": "cylinder", **values}.items():
        entries = found[key]
        same = np.isclose(entries, value) if isinstance(value, float) else entries == value
        found = found[same]
    if found.empty:
        raise _style.NoRunsError(", ".join(f"{key}: {value}" for key, value in values.items()))
    return found


def maps(results, title, across, up, **values):
    """Return the figure of maps over two keys, `across` and `up`, of the columns with these values."""
    rows = chosen(results, model="radial", **values)
    own = rows[rows["cells"] == rows.groupby("cells")["scheme"].nunique().idxmax()]
    axes_values = [dense(own, key, other) for key, other in ((across, up), (up, across))]
    own = own[own[across].isin(axes_values[0]) & own[up].isin(axes_values[1])]
    fine = rows[rows["id"].isin(own["reference"])]
    schemes, orders = list(dict.fromkeys(own["scheme"])), sorted(own["order"].unique())
    figure, axes = _style.panels(len(schemes) * len(orders), len(schemes), 1.75, sharex=True, sharey=True)
    look = mpl.colormaps["YlGnBu"].with_extremes(bad="0.86")
    for k, ax in enumerate(axes):
        scheme, order = schemes[k % len(schemes)], orders[k // len(schemes)]
        part = own[(own["scheme"] == scheme) & (own["order"] == order)]
        shown = ax.pcolormesh(
            table(part, "L_f_error", across, up, axes_values), cmap=look, vmin=SCALE[0], vmax=SCALE[1]
        )
        mark(ax, part, across, up, axes_values)
        contour(ax, fine, across, up, axes_values)
        ax.set_title(_words.panel(k, scheme.upper()))
        ticks(ax, across, up, axes_values)
        ax.grid(False)
    for k, ax in enumerate(axes):
        ax.set_xlabel(axis(across) if k // len(schemes) == len(orders) - 1 else "")
        ax.set_ylabel(f"order {orders[k // len(schemes)]}\n{axis(up)}" if k % len(schemes) == 0 else "")
    bar = figure.colorbar(shown, ax=axes, shrink=0.6, aspect=30, extend="max", pad=0.01)
    bar.set_label("error of $L_f$ (1)")
    seen = {kind_of(row) for _, row in own.iterrows()}
    entries = [(Line2D([], [], linestyle="", **MARKS[key]), WORDS[key]) for key in MARKS if key in seen]
    entries += [
        (Patch(facecolor="0.86"), "no answer, or none to compare with"),
        (
            Line2D([], [], color="black", linewidth=1.0),
            f"wave speeds complex over {COMPLEX:g} R or more, resolved",
        ),
    ]
    return figure, own, entries


def dense(rows, key, other):
    """Return the sorted values of a key that have at least FILLED of the other key's values."""
    counts = rows.groupby(key)[other].nunique()
    return sorted(counts[counts >= FILLED * rows[other].nunique()].index)


def table(rows, column, across, up, values):
    """Return the entries (up, across) of a column as an array, NaN where there is none."""
    found = rows.pivot_table(index=up, columns=across, values=column, aggfunc="first", dropna=False)
    return np.ma.masked_invalid(found.reindex(index=values[1], columns=values[0]).to_numpy(float))


def mark(ax, rows, across, up, values):
    """Nothing; runs that failed, left the box or gained energy have their mark in `ax`."""
    for _, row in rows.iterrows():
        kind = kind_of(row)
        if kind:
            place = [
                axis_values.index(row[key]) + 0.5
                for key, axis_values in zip((across, up), values, strict=True)
            ]
            ax.plot(*place, linestyle="", **MARKS[kind])


def kind_of(row):
    """Return the mark of a run, or None."""
    if row["status"] not in atlas.FINISHED:
        return "left_domain" if row["status"] == "left_domain" else "failed"
    return "gained" if row["energy_rise"] > atlas.GAINED else None


def contour(ax, fine, across, up, values):
    """Nothing; a line in `ax` surrounds the columns whose resolved run has complex wave speeds over COMPLEX or more."""
    lost = table(fine, "nonhyperbolic_length", across, up, values).filled(0.0) >= COMPLEX
    for j, i in np.argwhere(lost):
        for dj, di, x, y in ((0, -1, (i, i), (j, j + 1)), (0, 1, (i + 1, i + 1), (j, j + 1)),
                             (-1, 0, (i, i + 1), (j, j)), (1, 0, (i, i + 1), (j + 1, j + 1))):  # fmt: skip
            beside = (j + dj, i + di)
            inside = 0 <= beside[0] < lost.shape[0] and 0 <= beside[1] < lost.shape[1]
            if not (inside and lost[beside]):
                ax.plot(x, y, color="black", linewidth=1.0, solid_capstyle="round", clip_on=False)


def ticks(ax, across, up, values):
    """Nothing; each second value or so is written on the axes, whose cells all have the same size."""
    for key, axis_values, place in ((across, values[0], ax.set_xticks), (up, values[1], ax.set_yticks)):
        step = -(-len(axis_values) // (4 if key == across else 12))
        at = range(0, len(axis_values), step)
        place([k + 0.5 for k in at], [_words.number(axis_values[k]) for k in at])


def axis(key):
    """Return the label of an axis of a key."""
    return f"{_words.SYMBOLS[key]} ({'°' if key == 'delta' else '1'})"


def about(rows, keys):
    """Return what the runs of a map share, in words."""
    row = rows.iloc[0]
    words = [_words.equation(key, row[key]) for key in keys]
    box = {"open": "box that grows", "wall": "walls"}[row["boundary"]]
    return ", ".join([*words, f"{row['cells']} cells (d$x$ = {0.6 / 0.0705 / row['cells']:.3g} $R$)", box])


def limits(tried):
    """Return the rows of a table of Courant numbers at the largest stable one of each model, scene, scheme and order.

    Where no number is stable, cfl is 0.
    """
    keys = ["model", "scene", "scheme", "order"]
    every = tried.groupby(keys, sort=False).first().reset_index()
    stable = tried[tried["limit"].astype(bool)]
    found = every[[*keys, "theory"]].merge(stable[[*keys, "cfl"]], how="left", on=keys)
    return found.fillna({"cfl": 0.0})
