"""Errors by the size of cells, in both orders and both precisions, from very coarse to fine grids."""

from typing import TYPE_CHECKING

from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import NullFormatter, ScalarFormatter

from subslide import naming
from subslide.figures import _atlas, _style, _words
from subslide.points import Point

if TYPE_CHECKING:
    from subslide.results import Results

TITLE = "Errors from 25 to 1600 cells, in double and single precision"
CATEGORY = "8 Stability"
NEEDS = {"scene": ("cylinder", "shear"), "treatment": ("real", "stop"), "dtype": ("float32", "float64")}
COLUMNS = 3
COLORS = {1: "#c7612b", 2: "#2a4d9b"}
LOOKS = {
    "float64": {"linestyle": "-", "marker": "o", "markersize": 4},
    "float32": {"linestyle": ":", "marker": "o", "markersize": 7, "markerfacecolor": "none"},
}


@_style.styled
def draw(results: "Results") -> Figure:
    """Return the figure: error of L_f over the number of cells, a panel for each column.

    Parameters
    ----------
    results
        A finished study with a stability atlas.

    Returns
    -------
    Figure
        A panel for each column solved in single precision.
    """
    usual = {key: value for key, value in _atlas.USUAL.items() if key != "dtype"}
    rows = results.atlas
    for key, value in {**usual, "scene": "cylinder", "model": "radial", "scheme": Point.scheme}.items():
        rows = rows[rows[key] == value]
    columns = rows[rows["dtype"] == "float32"][["a_H", "r", "boundary", "a_2", "delta"]].drop_duplicates()
    if columns.empty:
        raise _style.NoRunsError("dtype: float32")
    columns = columns.sort_values(["r", "a_H"])
    figure, axes = _style.panels(len(columns), COLUMNS, 1.9, sharex=True, sharey=True)
    for k, (ax, column) in enumerate(zip(axes, columns.to_dict("records"), strict=True)):
        part = rows
        for key, value in column.items():
            part = part[part[key] == value]
        for (order, dtype), runs in part.groupby(["order", "dtype"]):
            runs = runs[runs["L_f_error"].notna()].sort_values("cells")
            ax.loglog(runs["cells"], runs["L_f_error"], color=COLORS[order], linewidth=1.0, **LOOKS[dtype])
        lost = part[~part["status"].isin(naming.FINISHED)]
        ax.plot(lost["cells"], [0.3] * len(lost), linestyle="", **_atlas.OUTCOMES["failed"])
        ax.set_title(_words.panel(k, ", ".join(_words.equation(key, column[key]) for key in ("a_H", "r"))))
        ax.xaxis.set_major_formatter(ScalarFormatter())
        ax.xaxis.set_minor_formatter(NullFormatter())
        ax.set_xticks([25, 100, 400, 1600])
        ax.set_ylabel("error of $L_f$ (1)" if k % COLUMNS == 0 else "")
    for ax in _style.bottom_row(axes, COLUMNS):
        ax.set_xlabel("cells in 0.6 m at $R$ = 70.5 mm (1)")
    entries = [
        (Line2D([], [], color=COLORS[order], linewidth=1.0, **LOOKS[dtype]), f"order {order}, {dtype}")
        for order in COLORS
        for dtype in LOOKS
    ]
    notes = ["Error against second order on 3200 cells, which differs from 1600 cells by less than 5 %."]
    about = f"{Point.scheme.upper()}, {_words.equation('a_2', Point.a_2)}, {_words.equation('delta', Point.delta)}"
    return _style.finish(figure, TITLE, about, notes, entries, 4)
