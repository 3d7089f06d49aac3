"""Paper's Figure 4: profiles of the grains without buoyancy (r = 0), beside the laboratory's runout law."""

from typing import TYPE_CHECKING

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from subslide import naming
from subslide.figures import _profiles, _slices, _style, _words
from subslide.laboratory import lajeunesse
from subslide.laboratory import lube as laboratory

if TYPE_CHECKING:
    from subslide.results import Results

TITLE = "Profiles of the grains at r = 0, beside the laboratory runout law"
CATEGORY = "1 Shape of the grains"
NEEDS = {"r": (0,)}

FOOT = 25.0
"""Depth (% of H2) up to which the foot of the deposit is drawn."""
LAW = {"color": "black", "linewidth": 2.2, "zorder": 1.5}


@_style.styled
def draw(results: "Results") -> Figure:
    """Return the figure: all profiles of one run, and the foot of the deposit for each a_H.

    Parameters
    ----------
    results
        A finished study.

    Returns
    -------
    Figure
        Two panels.
    """
    chosen = _slices.cut(results, by=("a_H",), most={"a_H": 4}, r=0)
    runs = chosen.runs
    radius, height = _slices.sizes(runs)
    runout = laboratory.runout(runs.iloc[0]["a_2"])
    records = {row["a_H"]: results.record(row["id"]) for _, row in runs.iterrows()}
    shapes = {row["a_H"]: _profiles.of_run(results, row["id"], "h2") for _, row in runs.iterrows()}

    figure, (left, right) = _style.panels(2, 2, 2.9)
    main = _slices.nearest(list(shapes), 1)
    _evolution(left, shapes[main], radius, height, runout)
    round_column = runs.iloc[0]["scene"] == "cylinder"
    if round_column:
        top = lajeunesse.height(runs.iloc[0]["a_2"]) * radius * _words.length_unit(height).factor
        left.axhline(top, xmax=0.06, **LAW)
    left.set_title(_words.panel(0, f"$h_2$ along $x$, {_words.equation('a_H', main)}"))
    depths = _foot(right, shapes, radius, height, runout)
    right.set_title(_words.panel(1, "foot of the deposit at the end of the run"))
    fronts = {
        a_H: float(record["L_f"].sel(front_threshold=_words.THRESHOLD, method="nearest")) / radius
        for a_H, record in records.items()
    }
    farthest = np.nanmax([runout, *fronts.values()])
    right.set_xlim(0.75 * runout, 1.1 * farthest)
    notes = _notes(depths, fronts, runout)
    if round_column:
        notes += _in_the_middle(runs, shapes, radius)
    notes += [*chosen.notes, *_words.trouble(runs, by=("a_H",))]
    title = "Profiles of the grains at $r$ = 0, beside the laboratory runout law"
    return _style.finish(figure, title, chosen.about, notes)


def _evolution(
    ax: Axes, profiles: list[_profiles.Profile], radius: float, height: float, runout: float
) -> None:
    """Draw the profiles of a run at all times, those that coincide as one line."""
    x_unit, unit = _words.length_unit(3 * radius), _words.length_unit(height)
    groups = _profiles.together(profiles, 2e-3 * height)
    for look, group in zip(_style.looks_of(range(len(groups)), light=0.75).values(), groups, strict=False):
        x, depth = group[0].x * x_unit.factor, group[0].values * unit.factor
        ax.plot(x, depth, **_style.line(look), label=_profiles.name_of(group))
    ax.axvline(runout * radius * x_unit.factor, ymax=0.72, **LAW)
    far = max(_profiles.reach(profiles, 1e-3 * height), runout * radius)
    begin = _profiles.start([profiles], far)
    ax.set(
        xlim=(1.08 * begin * x_unit.factor, 1.08 * far * x_unit.factor), ylim=(0, 1.45 * height * unit.factor)
    )
    ax.set(xlabel=_words.label("x", x_unit), ylabel=_words.label("h2", unit))
    ax.legend(
        title="$t$ after release",
        alignment="left",
        handlelength=2.6,
        loc="upper left",
        ncols=2,
        frameon=True,
        edgecolor="white",
        framealpha=1,
    )


def _foot(
    ax: Axes,
    shapes: dict[float, list[_profiles.Profile]],
    radius: float,
    height: float,
    runout: float,
) -> dict[float, float]:
    """Draw the last profile of each a_H, and return its depth (% of H2) at the law's runout by a_H."""
    depths = {}
    for (a_H, look), profiles in zip(
        _style.looks_of(shapes, palette="plasma", light=0.7).items(), shapes.values(), strict=True
    ):
        end = _profiles.at(profiles, None)
        if end is None:
            continue
        depths[a_H] = 100 * np.interp(runout * radius, end.x, end.values) / height
        ax.plot(
            end.x / radius, 100 * end.values / height, **_style.line(look), label=_words.equation("a_H", a_H)
        )
        ax.plot(runout, depths[a_H], look["marker"], color=look["color"], markeredgewidth=0, markersize=5)
    for threshold in naming.FRONT_THRESHOLDS:
        ax.axhline(100 * threshold, color=_style.GREY, linewidth=0.7, linestyle=":")
    ax.axvline(runout, ymax=0.72, **LAW, label=f"laboratory law, {runout:.2f} $R$")
    ax.set(xlabel="$x/R$", ylabel="$h_2/H_2$ (%)", ylim=(0, FOOT))
    ax.set_yticks([100 * t for t in naming.FRONT_THRESHOLDS] + [10, 15, 20, 25])
    ax.legend(loc="upper right", frameon=True, edgecolor="white", framealpha=1)
    return depths


def _in_the_middle(
    runs: pd.DataFrame, shapes: dict[float, list[_profiles.Profile]], radius: float
) -> list[str]:
    """Return what the figure measures of the height on the axis and of the time of rest, beside the laboratory's."""
    row = runs.iloc[0]
    law = laboratory.duration(row["a_2"] * radius, row["g"])
    unit = _words.time_unit(law)
    ends = {a_H: _profiles.at(profiles, None) for a_H, profiles in shapes.items()}
    tops = [f"{np.interp(0, end.x, end.values) / radius:.2f}" for end in ends.values() if end]
    notes = []
    if tops:
        notes.append(
            f"Tick on the left axis: height on the axis of such deposits (Lajeunesse et al. 2004), the lesser of $a_2$"
            f" and 0.74 $R$: {lajeunesse.height(row['a_2']):.2f} $R$; the model's: {', '.join(tops)} $R$."
        )
    rest = runs["time_at_rest"].dropna()
    if len(rest):
        times = ", ".join(f"{time * unit.factor:.3g}" for time in rest)
        notes.append(
            f"Grains of such columns are at rest after 3.0 $\\sqrt{{H_2/g}}$ = {law * unit.factor:.3g} {unit.name}"
            f" (Lube et al. 2004); the model's after {times} {unit.name}."
        )
    return notes


def _notes(depths: dict[float, float], fronts: dict[float, float], runout: float) -> list[str]:
    """Return what the figure measures where the law puts the edge of the deposit."""
    rule = "1 + 1.24 $a_2$ where $a_2$ < 1.7, else 1 + 1.6 $\\sqrt{a_2}$"
    notes = [
        f"Vertical line: runout/$R$ of dry columns in the laboratory (Lube et al. 2004), {rule}: "
        f"{runout:.2f}."
    ]
    if depths:
        there = ", ".join(f"{depth:.1f} % ({_words.equation('a_H', a_H)})" for a_H, depth in depths.items())
        ends = ", ".join(f"{front:.2f}" for a_H, front in fronts.items() if a_H in depths)
        notes.append(
            f"The model's depth there, in $H_2$: {there}. Its {_words.THRESHOLD:.0%} front is at {ends} "
            f"$R$. Dotted: "
            "the depths (1, 3, 5 %) that define fronts in the tables."
        )
    if len(depths) > 1:
        notes.append(
            f"At $r$ = 0 the grains cannot feel the water: what differs between values of "
            f"{_words.SYMBOLS['a_H']} "
            "is numerical error."
        )
    return notes
