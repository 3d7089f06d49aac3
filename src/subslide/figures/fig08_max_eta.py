"""Paper's Figure 8: largest displacement of the water surface against time, the paper's times marked."""

import numpy as np
import pandas as pd

from subslide.figures import _kinds, _slices, _style, _water, _words
from subslide.points import PAPER_BOX, PAPER_TIMES, paper_times

TITLE = "Largest displacement of the water surface against time"
CATEGORY = "3 Water surface"
NEEDS = {}

ROWS = {"max_abs_eta": "whole box", "max_abs_eta_outside": "beyond $R$"}


@_style.styled
def draw(results):
    """Return the figure: a column for each a_H; the whole box above, beyond R below; a line for each r."""
    found = _kinds.kinds(results, most={"a_H": 4, "r": 6})
    runs, dry = _water.wet(pd.concat([kind.runs for kind in found]))
    shown, left_out = _water.buoyant(runs)
    radius, _ = _slices.sizes(found[0].runs)
    marks = np.array(paper_times(radius))
    depths = sorted(shown["a_H"].unique())
    looks = {r: look for r, look in _style.keys_to(runs["r"].unique()).items() if r in set(shown["r"])}
    curves = {quantity: _slices.curves(results, shown, quantity) for quantity in ROWS}
    values = [value for quantity in curves.values() for _, value in quantity.values()]
    t_unit, unit = _words.time_unit(marks), _words.length_unit(*values)

    columns = max(len(depths), 1)
    figure, axes = _style.panels(
        2 * columns, columns, 2.1 if len(found) == 1 else 3.0, sharex=True, sharey="row"
    )
    for k, ax in enumerate(axes if depths else []):
        quantity, a_H = list(ROWS)[k // columns], depths[k % columns]
        rows = shown[shown["a_H"] == a_H]
        for kind in found:
            for _, row in rows[rows["id"].isin(kind.runs["id"])].iterrows():
                curve = curves[quantity].get(row["id"])
                _line(ax, kind, row, quantity, curve, looks[row["r"]], marks, t_unit, unit)
        for time in marks:
            ax.axvline(time * t_unit.factor, color=_style.GREY, linewidth=0.6, linestyle=":", zorder=0.5)
        reached = _water.edge_time(rows.iloc[0]) * t_unit.factor
        ax.axvspan(reached, 1e3 * reached, color="0.94", zorder=0, linewidth=0)
        ax.set_title(_words.panel(k, f"{_words.equation('a_H', a_H)}, {ROWS[quantity]}"))
        if len(found) == 1:
            ax.set_ylim(bottom=0)
    if len(found) > 1:
        _logarithmic(axes, columns, curves, marks, unit)
    axes[0].set_xlim(0, 1.1 * marks[-1] * t_unit.factor)
    for ax in axes[::columns]:
        ax.set_ylabel(_words.label("max_abs_eta", unit))
    for ax in _style.bottom_row(axes, columns):
        ax.set_xlabel(_words.label("time", t_unit))
    title = f"Largest displacement of the water surface, {_words.SYMBOLS['max_abs_eta']}, against time"
    notes = [
        *_notes(results, found, shown, marks, t_unit),
        *left_out,
        *dry,
        *found[0].chosen.notes,
        *_slices.trouble(shown, mark="× ends its curve"),
    ]
    legend = _style.handles(looks, "r", dashes=not found[0].name)
    return _style.finish(figure, title, _kinds.about(found), notes, legend, 6, _kinds.entries(found))


def _logarithmic(axes, columns, curves, marks, unit):
    """Nothing; each row of `axes` has a logarithmic scale that holds every value after half the first of `marks`."""
    for k, quantity in enumerate(curves.values()):
        seen = [value[(time >= marks[0] / 2) & (value > 0)] for time, value in quantity.values()]
        seen = np.concatenate([np.empty(0), *seen]) * unit.factor
        for ax in axes[k * columns : (k + 1) * columns]:
            ax.set_yscale("log")
            if seen.size:
                ax.set_ylim(0.8 * np.quantile(seen, 0.02), 1.5 * seen.max())


def _notes(results, found, shown, marks, unit):
    """Return what symbols and shades mean, and what is not converged."""
    if shown.empty:
        return ["No run of this study has a water surface."]
    times = ", ".join(f"{time * unit.factor:.4g}" for time in marks)
    scaled = "" if np.allclose(marks, PAPER_TIMES) else " scaled by $\\sqrt{R}$"
    return [
        f"Dotted lines and symbols: {times} {unit.name}, the paper's times{scaled}. Grey: waves from $R$ have "
        f"reached the edge of the watched box (half-width {PAPER_BOX:.2f} $R$); from then on its boundary has a part. "
        f"Each row has its own scale.{_longest(found)}",
        *_water.convergence(results, found, marks[:2], unit),
    ]


def _longest(found):
    """Return the sentence on bars that leave a logarithmic scale, where there is one with bars."""
    if len(found) == 1 or not any(kind.banded for kind in found):
        return ""
    return " A bar that ends at the foot of its panel is a band as wide as the value, or wider."


def _line(ax, kind, row, quantity, curve, look, marks, t_unit, unit):
    """Nothing; a run's curve is in `ax`, its values at the marked times as symbols, a cross if it failed."""
    if curve is None or not np.isfinite(curve[1]).any():
        return
    seen = np.isfinite(curve[1])
    time, value = curve[0][seen], curve[1][seen]
    ax.plot(time * t_unit.factor, value * unit.factor, **kind.line(look))
    if kind.banded:
        at = kind.marks(row["id"], quantity)
        _kinds.symbols(ax, kind, at, look, at["time"] * t_unit.factor, unit.factor)
    else:
        inside = marks[marks <= time[-1]]
        options = {"color": look["color"], "marker": look["marker"], "markeredgewidth": 0, "linestyle": ""}
        ax.plot(inside * t_unit.factor, np.interp(inside, time, value) * unit.factor, **options)
    if row["status"] not in _slices.FINISHED:
        _style.mark_end(ax, time[-1] * t_unit.factor, value[-1] * unit.factor)
