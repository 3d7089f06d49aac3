"""What failure looks like: profiles and series of runs that went wrong, beside those that did not."""

import numpy as np
from matplotlib.lines import Line2D

from subslide import atlas
from subslide.figures import _atlas, _style, _words
from subslide.points import Point

TITLE = "What failure looks like"
CATEGORY = "8 Stability"
NEEDS = {"scene": ("cylinder", "shear"), "treatment": ("real", "stop")}
RIGHT = {"color": "#2a4d9b", "linewidth": 1.2, "linestyle": "-"}
WRONG = {"color": "#b40426", "linewidth": 1.0, "linestyle": (0, (4, 1))}
START = {"color": "0.75", "linewidth": 2.5, "linestyle": "-"}


@_style.styled
def draw(results):
    """Return the figure: a panel for each way to fail; a study without such a run has none in its panel."""
    figure, axes = _style.panels(6, 2, 1.9)
    panels = (creeping, printed, checkerboard, blown_up, film, quiet)
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
        (Line2D([], [], **START), "start, or what is right"),
        (Line2D([], [], **RIGHT), "default"),
        (Line2D([], [], **WRONG), "as the panel says"),
    ]
    return _style.finish(figure, TITLE, "real runs of this study", notes, entries, 3)


def creeping(ax, results):
    """Return the title of a panel of a pile, which friction must hold, after long creeping."""
    rows = results.atlas[(results.atlas["scene"] == "pile") & (results.atlas["scheme"] == Point.scheme)]
    rows = rows[rows["order"] == 1]
    with_it = rows[rows["friction_in_viscosity"].astype(bool)]
    without = rows[~rows["friction_in_viscosity"].astype(bool)]
    if with_it.empty or without.empty:
        return None
    first = profile(ax, results, with_it.iloc[0], START, at=0)
    profile(ax, results, with_it.iloc[0], RIGHT)
    last = profile(ax, results, without.iloc[0], WRONG)
    ax.set_xlim(0, 2.2)
    labels(ax, "$x/R$", "$h_2/H_2$")
    return (
        f"creeping: a pile at rest after {last:.3g} s\nwithout friction in the viscosity"
        if first == 0
        else None
    )


def printed(ax, results):
    """Return the title of a panel of the paper's printed test of rest."""
    found = results.atlas[
        (results.atlas["as_printed"] == "friction") & (results.atlas["r"] == Point.r)
        & (results.atlas["a_H"] == Point.a_H) & (results.atlas["scheme"] == Point.scheme) & (results.atlas["order"] == 1)
    ]  # fmt: skip
    if found.empty:
        return None
    wrong = found.iloc[0]
    right = twin(results, wrong, as_printed="none")
    for row, look in ((right, RIGHT), (wrong, WRONG)):
        if row is not None:
            data = results.record(row["id"])
            ax.plot(data["time"], data["x_front"][0] / row["radius"], **look)
    ax.set_xlim(0, 1.5)
    labels(ax, "$t$ (s)", "$x_\\mathrm{front}/R$")
    return f"the printed test of rest stops nothing\n(order 1, status {wrong['status']})"


def checkerboard(ax, results):
    """Return the title of a panel of oscillations between cells."""
    row = fast(results, ascending=True)
    if row is None:
        return None
    data = results.record(row["id"])
    profile(ax, results, row, WRONG, "eta", at=min(2, data.sizes["snapshot"] - 1))
    labels(ax, "$x/R$", "$\\eta/H_2$")
    return f"checkerboard: Courant number {row['cfl']:g}\n({row['scheme'].upper()}, order {row['order']})"


def blown_up(ax, results):
    """Return the title of a panel of the last state of a run that blew up."""
    row = fast(results, ascending=False)
    if row is None:
        return None
    data = results.record(row["id"])
    energy = data["energy"]
    ax.semilogy(data["time"], energy / float(energy[0]), **WRONG)
    labels(ax, "$t$ (s)", "energy over its start (1)")
    return f"blow-up: Courant number {row['cfl']:g}, {row['scheme'].upper()},\norder {row['order']}: {row['status']}, {row['steps']} steps"


def film(ax, results):
    """Return the title of a panel of a run of the default scheme that failed under a film of water."""
    rows = usual(results, status="step_collapse")
    rows = rows[(rows["a_H"] > 0) & (rows["cells"] == 100)]
    if rows.empty:
        return None
    row = rows.sort_values("a_H").iloc[-1]
    data = results.record(row["id"])
    top = data["h2"].isel(snapshot=-1) / (row["a_2"] * row["radius"])
    ax.plot(data["x"] / row["radius"], top, **START)
    surface = 1 + row["a_H"] + data["eta"].isel(snapshot=-1) / (row["a_2"] * row["radius"])
    ax.plot(data["x"] / row["radius"], surface, **WRONG)
    ax.set_xlim(0, 4.2)
    labels(ax, "$x/R$", "$h_2/H_2$, surface$/H_2$")
    return f"film of {_words.equation('a_H', row['a_H'])}, {_words.equation('r', row['r'])}, order {row['order']}:\n{row['status']} at {float(data['time'][-1]):.3g} s"


def quiet(ax, results):
    """Return the title of a panel of a run that ended well although its energy rose."""
    rows = usual(results)
    rows = rows[
        rows["status"].isin(atlas.FINISHED) & (rows["energy_rise"] > atlas.GAINED) & (rows["cells"] == 100)
    ]
    if rows.empty:
        return None
    row = rows.sort_values("energy_rise").iloc[-1]
    data = results.record(row["id"])
    energy = data["energy"] / float(data["energy"][0])
    ax.semilogy(data["time"], energy, **WRONG)
    fine = results.atlas[results.atlas["id"] == row["reference"]]
    if len(fine):
        data = results.record(fine.iloc[0]["id"])
        ax.semilogy(data["time"], data["energy"] / float(data["energy"][0]), **RIGHT)
    labels(ax, "$t$ (s)", "energy over its start (1)")
    return f"status ok, yet energy rose: {_words.equation('a_H', row['a_H'])},\n{_words.equation('r', row['r'])}, order {row['order']} (blue: {800} cells)"


def usual(results, **values):
    """Return the rows of collapses behind walls with the default scheme and these values."""
    rows = _atlas.chosen(results, scheme=Point.scheme, boundary="wall")
    for key, value in values.items():
        rows = rows[rows[key] == value]
    return rows


def fast(results, ascending):
    """Return the row with the least or the largest Courant number above 1 of a first-order run, or None."""
    rows = results.atlas[(results.atlas["cfl"] > 1) & (results.atlas["order"] == 1)]
    return None if rows.empty else rows.sort_values(["cfl", "scheme"], ascending=[ascending, True]).iloc[0]


def twin(results, row, **values):
    """Return the row of the run that differs in these values alone, or None."""
    found = results.atlas
    keys = [
        *_atlas.USUAL,
        "a_H",
        "a_2",
        "r",
        "delta",
        "scene",
        "scheme",
        "order",
        "cells",
        "boundary",
        "model",
    ]
    for key in keys:
        found = found[found[key] == values.get(key, row[key])]
    return found.iloc[0] if len(found) else None


def profile(ax, results, row, look, quantity="h2", at=-1):
    """Return the time (s) of a profile of a run, which is then in `ax`, over H2."""
    data = results.record(row["id"]).isel(snapshot=at)
    ax.plot(data["x"] / row["radius"], data[quantity] / (row["a_2"] * row["radius"]), **look)
    return float(np.round(data["snapshot_time"], 9))


def labels(ax, x, y):
    """Nothing; both axes have their labels."""
    ax.set_xlabel(x)
    ax.set_ylabel(y)
