"""Profiles against exact solutions: a panel for each case, the coarsest and the finest grid at both orders."""

from typing import TYPE_CHECKING

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from subslide import exact
from subslide.figures import _style, _verify, _words
from subslide.points import Point

if TYPE_CHECKING:
    from subslide.results import Results

TITLE = "Profiles against exact solutions"
CATEGORY = "7 Verification"
NEEDS = {"scene": ("dam_break", "paraboloid", "standing_wave")}
COLUMNS = 3
LOOKS = {
    (1, "coarse"): {"color": "#c7612b", "linestyle": ":"},
    (1, "fine"): {"color": "#c7612b", "linestyle": "-"},
    (2, "coarse"): {"color": "#2a4d9b", "linestyle": ":"},
    (2, "fine"): {"color": "#2a4d9b", "linestyle": "-"},
}


@_style.styled
def draw(results: "Results") -> Figure:
    """Return the figure: profiles of one solver at the end of each case, over the exact one.

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
    table = results.errors
    scheme = Point.scheme
    scheme = scheme if (table["scheme"] == scheme).any() else table["scheme"].iloc[0]
    points = {run.id: run.point for run in results.runs_of_study}
    figure, axes = _style.panels(len(cases), COLUMNS, 1.85)
    for k, (ax, (name, rows)) in enumerate(zip(axes, cases.items(), strict=True)):
        quantity, time = rows["quantity"].iloc[0], rows["time"].iloc[0]
        rows = rows[rows["scheme"] == scheme]
        _panel(ax, results, points, rows, quantity, time)
        ax.set_title(_words.panel(k, name))
        ax.tick_params(axis="x", labelbottom=True)
    for ax in _style.bottom_row(axes, COLUMNS):
        ax.set_xlabel("$x/R$")
    words = {"coarse": "coarsest cells", "fine": "finest cells"}
    entries = [(Line2D([], [], color="0.75", linewidth=2.8), "exact")]
    entries += [
        (Line2D([], [], **look), f"{_words.ORDERS[order]}, {words[grid]}")
        for (order, grid), look in LOOKS.items()
    ]
    notes = [
        "Profiles at the end of each case. Waves: displacement of the depth of the grains from 1, over the amplitude. "
        "Where one line is seen the others lie under it; verify_orders shows by how much they differ."
    ]
    return _style.finish(
        figure, TITLE, f"{scheme.upper()}, coarsest and finest grid of each case", notes, entries, 3
    )


def _panel(
    ax: Axes, results: "Results", points: dict[str, Point], rows: pd.DataFrame, quantity: str, time: float
) -> None:
    """Draw the exact profile of a quantity at a time (s), and those of the coarsest and finest grid."""
    fine = rows.loc[rows["cells"].idxmax()]
    point = points[fine["id"]]
    height = point.column_height
    wave = point.scene == "standing_wave"
    size = height * (dict(point.scene_options)["amplitude"] if wave else 1)
    rest = height if wave and quantity == "h2" else 0.0
    x = results.profiles(fine["id"])["x"].to_numpy()
    known = exact.load(point.scene).solution(point, x, time)[quantity]
    ax.plot(x / point.radius, (known - rest) / size, color="0.75", linewidth=2.8)
    for grid, cells in (("coarse", rows["cells"].min()), ("fine", rows["cells"].max())):
        for _, row in rows[rows["cells"] == cells].iterrows():
            record = results.profiles(row["id"])
            solved = record[quantity].isel(snapshot=-1).to_numpy()
            look = LOOKS[row["order"], grid]
            ax.plot(record["x"] / point.radius, (solved - rest) / size, **look, linewidth=0.9)
    symbol = _words.SYMBOLS[quantity]
    ax.set_ylabel(f"displacement of {symbol} (1)" if wave else f"{symbol}$/H_2$")
