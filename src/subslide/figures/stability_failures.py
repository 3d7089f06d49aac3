"""What failure looks like: profiles and series of runs that went wrong, beside those that did not."""

from typing import TYPE_CHECKING, Any

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from subslide.figures import _slices, _style, _words
from subslide.points import RUN_KEYS, Point

if TYPE_CHECKING:
    from subslide.results import Results

TITLE = "What failure looks like"
CATEGORY = "8 Stability"
NEEDS = {"scene": ("cylinder", "shear"), "treatment": ("real", "stop")}
RIGHT = {"color": "#2a4d9b", "linewidth": 1.2, "linestyle": "-"}
WRONG = {"color": "#b40426", "linewidth": 1.0, "linestyle": (0, (4, 1))}
START = {"color": "0.75", "linewidth": 2.5, "linestyle": "-"}


@_style.styled
def draw(results: "Results") -> Figure:
    """Return the figure: a panel for each way to fail; a study without such a run has none in its panel.

    Parameters
    ----------
    results
        A finished study with a stability atlas.

    Returns
    -------
    Figure
        Four panels.
    """
    figure, axes = _style.panels(4, 2, 1.9)
    panels = (creeping, printed, checkerboard, blown_up)
    for k, (ax, panel) in enumerate(zip(axes, panels, strict=True)):
        title = panel(ax, results)
        ax.set_title(_words.panel(k, title or f"{panel.__name__.replace('_', ' ')}: no such run"))
    statuses = results.atlas["status"].value_counts()
    ends = ", ".join(f"{name} {count}" for name, count in statuses.items())
    never = [name for name in ("negative_depth", "diverged") if name not in statuses]
    notes = [
        f"Of the study's {len(results.atlas)} runs: {ends}."
        + (f" None ended as {' or '.join(never)}: what leaves a cell is limited by what it holds, so depths stay "
           "non-negative, and a run that blows up ends as step_collapse before its values overflow." if never else "")
    ]  # fmt: skip
    entries = [
        (Line2D([], [], **START), "start in (a)"),
        (Line2D([], [], **RIGHT), "as it should be"),
        (Line2D([], [], **WRONG), "what went wrong"),
    ]
    return _style.finish(figure, TITLE, "real runs of this study", notes, entries, 3)


def creeping(ax: Axes, results: "Results") -> str | None:
    """Draw a pile, which friction must hold, after long creeping; return the title, or None without such runs."""
    wrong = first(results, scene="pile", friction_in_viscosity=False)
    right = wrong is not None and twin(results, wrong, friction_in_viscosity=True)
    if right is None or wrong is None:
        return None
    profile(ax, results, right, START, at=0)
    profile(ax, results, right, RIGHT)
    last = profile(ax, results, wrong, WRONG)
    ax.set_xlim(0, 2.2)
    labels(ax, "$x/R$", "$h_2/H_2$")
    return f"creeping: a pile at rest after {last:.3g} s\nwithout friction in the viscosity"


def printed(ax: Axes, results: "Results") -> str | None:
    """Draw the paper's printed test of rest; return the title, or None without such a run."""
    wrong = first(results, as_printed="friction", r=Point.r, a_H=1)
    if wrong is None:
        return None
    right = twin(results, wrong, as_printed="none")
    if right is not None:
        profile(ax, results, right, RIGHT)
    last = profile(ax, results, wrong, WRONG)
    ax.set_xlim(0, 3)
    labels(ax, "$x/R$", "$h_2/H_2$")
    return f"the printed test of rest stops nothing:\nstatus {wrong['status']} after {last:.3g} s"


def checkerboard(ax: Axes, results: "Results") -> str | None:
    """Draw oscillations between cells; return the title, or None without such a run."""
    row = fast(results, ascending=True)
    if row is None:
        return None
    at = min(2, results.profiles(row["id"]).sizes["snapshot"] - 1)
    right = twin(results, row, cfl=Point.cfl)
    if right is not None:
        profile(ax, results, right, RIGHT, "eta", at)
    time = profile(ax, results, row, WRONG, "eta", at)
    labels(ax, "$x/R$", "$\\eta/H_2$")
    return f"checkerboard: Courant number {row['cfl']:g},\n{method(row)}, {time:.3g} s"


def blown_up(ax: Axes, results: "Results") -> str | None:
    """Draw the energy of a run that blew up; return the title, or None without such a run."""
    row = fast(results, ascending=False)
    if row is None:
        return None
    energy(ax, results, row, WRONG)
    return (
        f"blow-up: Courant number {row['cfl']:g}, {method(row)}:\n{row['status']} after {row['steps']} steps"
    )


def first(results: "Results", **values: Any) -> pd.Series | None:
    """Return the first row of a first-order run of the default scheme with these values, or None."""
    rows = results.atlas
    for key, value in {"scheme": Point.scheme, "order": 1, **values}.items():
        rows = rows[rows[key] == value]
    return rows.iloc[0] if len(rows) else None


def fast(results: "Results", ascending: bool) -> pd.Series | None:
    """Return the row with the least or the largest Courant number above 1 of a first-order run, or None."""
    rows = results.atlas[(results.atlas["cfl"] > 1) & (results.atlas["order"] == 1)]
    return None if rows.empty else rows.sort_values(["cfl", "scheme"], ascending=[ascending, True]).iloc[0]


def twin(results: "Results", row: pd.Series, **values: Any) -> pd.Series | None:
    """Return the row of the run that differs in these values alone, or None."""
    rows = results.atlas
    for key in RUN_KEYS:
        if key in rows:
            rows = rows[rows[key] == values.get(key, row[key])]
    return rows.iloc[0] if len(rows) else None


def profile(
    ax: Axes, results: "Results", row: pd.Series, look: _style.Look, quantity: str = "h2", at: int = -1
) -> float:
    """Draw a profile of a run over H2, and return its time (s).

    Parameters
    ----------
    ax
        Panel to draw in.
    results
        The study.
    row
        Row of the run in the atlas.
    look
        Options of the line.
    quantity
        Name of the profiles in the record.
    at
        Which of them.
    """
    data = results.profiles(row["id"]).isel(snapshot=at)
    ax.plot(data["x"] / row["radius"], data[quantity] / _slices.column(row).column_height, **look)
    return float(data["snapshot_time"])


def energy(ax: Axes, results: "Results", row: pd.Series, look: _style.Look) -> None:
    """Draw the energy of a run over time, over that of its start."""
    data = results.profiles(row["id"])
    ax.semilogy(data["time"], data["energy"] / float(data["energy"][0]), **look)
    labels(ax, "$t$ (s)", "energy$/E_0$ (1)")


def method(row: pd.Series) -> str:
    """Return a run's scheme and order, in words."""
    return f"{row['scheme'].upper()} of order {row['order']}"


def labels(ax: Axes, x: str, y: str) -> None:
    """Label both axes."""
    ax.set_xlabel(x)
    ax.set_ylabel(y)
