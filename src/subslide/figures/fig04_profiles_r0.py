"""Paper's Figure 4: profiles of the grains without buoyancy (r = 0), beside the laboratory's runout law."""

from typing import TYPE_CHECKING

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from subslide import naming
from subslide.figures import _kinds, _profiles, _slices, _style, _words
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
    kinds = _kinds.of(results, by=("a_H",), most={"a_H": 4}, r=0)
    runs = pd.concat([kind.runs for kind in kinds])
    radius, height = _slices.sizes(runs)
    runout = laboratory.runout(runs.iloc[0]["a_2"])
    shapes = {row["id"]: _profiles.of_run(results, row["id"], "h2") for _, row in runs.iterrows()}

    figure, (left, right) = _style.panels(2, 2, 2.9)
    main = _slices.nearest(list(kinds[-1].runs["a_H"]), 1)
    _evolution(left, kinds, shapes, main, (radius, height, runout))
    round_column = runs.iloc[0]["scene"] == "cylinder"
    if round_column:
        top = lajeunesse.height(runs.iloc[0]["a_2"]) * radius * _words.length_unit(height).factor
        left.axhline(top, xmax=0.06, **LAW)
    left.set_title(_words.panel(0, f"$h_2$ along $x$, {_words.equation('a_H', main)}"))
    depths = _foot(right, kinds, shapes, (radius, height, runout))
    right.set_title(_words.panel(1, "foot of the deposit at the end of the run"))
    farthest = np.nanmax([runout, *runs[f"L_f_{_words.THRESHOLD_LABEL}_over_R"]])
    right.set_xlim(0.75 * runout, 1.1 * farthest)
    notes = _notes(kinds, depths, runout)
    if round_column:
        notes += _in_the_middle(kinds, shapes, radius)
    notes += [*kinds[0].chosen.notes, *_words.trouble(runs, by=("a_H",))]
    title = "Profiles of the grains at $r$ = 0, beside the laboratory runout law"
    return _style.finish(figure, title, _kinds.about(kinds), notes, more=_kinds.entries(kinds, symbols=False))


def _evolution(
    ax: Axes,
    kinds: list[_kinds.Kind],
    shapes: dict[str, list[_profiles.Profile]],
    a_H: float,
    sizes: tuple[float, float, float],
) -> None:
    """Draw the profiles of a run of each kind at all times, those of the last kind that coincide as one line.

    Parameters
    ----------
    ax
        Panel to draw in.
    kinds, shapes
        Kinds of numerics, and profiles by id of the run.
    a_H
        Depth of water of the runs.
    sizes
        R and H2 (m), and the laboratory's runout over R.
    """
    radius, height, runout = sizes
    x_unit, unit = _words.length_unit(3 * radius), _words.length_unit(height)
    ids = {kind.name: kind.runs["id"][kind.runs["a_H"] == a_H] for kind in kinds}
    drawn = {name: shapes[run] for name, runs in ids.items() for run in runs}
    groups = _profiles.together(drawn[kinds[-1].name], 2e-3 * height)
    looks = _style.looks_of(range(len(groups)), light=0.75)
    for kind in kinds:
        for profile in drawn.get(kind.name, []):
            n = max(k for k, group in enumerate(groups) if k == 0 or group[0].time <= profile.time)
            first = kind is kinds[-1] and profile is groups[n][0]
            label = _profiles.name_of(groups[n]) if first else None
            if first or kind is not kinds[-1]:
                x, depth = profile.x * x_unit.factor, profile.values * unit.factor
                ax.plot(x, depth, **kind.line(looks[n]), label=label)
    ax.axvline(runout * radius * x_unit.factor, ymax=0.72, **LAW)
    far = max(*(_profiles.reach(one, 1e-3 * height) for one in drawn.values()), runout * radius)
    begin = _profiles.start(drawn.values(), far)
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
    kinds: list[_kinds.Kind],
    shapes: dict[str, list[_profiles.Profile]],
    sizes: tuple[float, float, float],
) -> dict[str, dict[float, float]]:
    """Draw the last profile of each run, and return its depth (% of H2) at the law's runout by kind and a_H."""
    radius, height, runout = sizes
    depths: dict[str, dict[float, float]] = {kind.name: {} for kind in kinds}
    values = sorted({a_H for kind in kinds for a_H in kind.runs["a_H"]})
    looks = _style.looks_of(values, palette="plasma", light=0.7)
    for kind in kinds:
        for _, row in kind.runs.iterrows():
            end = _profiles.at(shapes[row["id"]], None)
            if end is None:
                continue
            a_H, look = row["a_H"], looks[row["a_H"]]
            depth = 100 * float(np.interp(runout * radius, end.x, end.values)) / height
            depths[kind.name][a_H] = depth
            label = _words.equation("a_H", a_H) if kind is kinds[-1] else None
            ax.plot(end.x / radius, 100 * end.values / height, **kind.line(look), label=label)
            ax.plot(runout, depth, look["marker"], color=look["color"], markeredgewidth=0, markersize=5)
    for threshold in naming.FRONT_THRESHOLDS:
        ax.axhline(100 * threshold, color=_style.GREY, linewidth=0.7, linestyle=":")
    ax.axvline(runout, ymax=0.72, **LAW, label=f"laboratory law, {runout:.2f} $R$")
    ax.set(xlabel="$x/R$", ylabel="$h_2/H_2$ (%)", ylim=(0, FOOT))
    ax.set_yticks([100 * t for t in naming.FRONT_THRESHOLDS] + [10, 15, 20, 25])
    ax.legend(loc="upper right", frameon=True, edgecolor="white", framealpha=1)
    return depths


def _in_the_middle(
    kinds: list[_kinds.Kind], shapes: dict[str, list[_profiles.Profile]], radius: float
) -> list[str]:
    """Return what the figure measures of the height on the axis and of the time of rest, beside the laboratory's."""
    row = kinds[0].runs.iloc[0]
    law = laboratory.duration(row["a_2"] * radius, row["g"])
    unit = _words.time_unit(law)
    notes = [
        "Tick on the left axis: height on the axis of such deposits (Lajeunesse et al. 2004), the lesser of $a_2$ and"
        f" 0.74 $R$: {lajeunesse.height(row['a_2']):.2f} $R$. Grains of such columns are at rest after 3.0"
        f" $\\sqrt{{H_2/g}}$ = {law * unit.factor:.3g} {unit.name} (Lube et al. 2004)."
    ]
    for kind in kinds:
        ends = [_profiles.at(shapes[name], None) for name in kind.runs["id"]]
        tops = [f"{np.interp(0, end.x, end.values) / radius:.2f}" for end in ends if end]
        rest = [f"{time * unit.factor:.3g}" for time in kind.runs["time_at_rest"].dropna()]
        if tops and rest:
            text = f"Height there {', '.join(tops)} $R$, at rest after {', '.join(rest)} {unit.name}."
            notes.append(kind.called(text))
    return notes


def _notes(kinds: list[_kinds.Kind], depths: dict[str, dict[float, float]], runout: float) -> list[str]:
    """Return what the figure measures where the law puts the edge of the deposit."""
    rule = "1 + 1.24 $a_2$ where $a_2$ < 1.7, else 1 + 1.6 $\\sqrt{a_2}$"
    notes = [
        f"Vertical line: runout/$R$ of dry columns in the laboratory (Lube et al. 2004), {rule}: {runout:.2f}. Dotted: "
        "the depths (1, 3, 5 %) that define fronts in the tables."
    ]
    for kind in kinds:
        there = depths[kind.name]
        if not there:
            continue
        words = ", ".join(f"{depth:.1f} % ({_words.equation('a_H', a_H)})" for a_H, depth in there.items())
        rows = kind.runs.set_index("a_H")[f"L_f_{_words.THRESHOLD_LABEL}_over_R"]
        ends = ", ".join(f"{rows[a_H]:.2f}" for a_H in there)
        text = f"Depth there, in $H_2$: {words}; {_words.THRESHOLD:.0%} front at {ends} $R$."
        notes.append(kind.called(text))
    if any(len(there) > 1 for there in depths.values()):
        notes.append(
            f"At $r$ = 0 the grains cannot feel the water: what differs between values of "
            f"{_words.SYMBOLS['a_H']} "
            "is numerical error."
        )
    return notes
