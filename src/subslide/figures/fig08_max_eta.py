"""Paper's Figure 8: largest displacement of the water surface against time, the paper's times marked."""

from typing import TYPE_CHECKING

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from subslide import naming
from subslide.figures import _fronts, _kinds, _slices, _style, _water, _words
from subslide.points import PAPER_BOX, PAPER_TIMES, paper_times

if TYPE_CHECKING:
    from subslide.results import Results

TITLE = "Largest displacement of the water surface against time"
CATEGORY = "3 Water surface"

END = 1.1
"""End of the axis of time, over the last of the paper's times."""
ROWS = {"max_abs_eta": "whole box", "max_abs_eta_outside": "beyond $R$"}


@_style.styled
def draw(results: "Results") -> Figure:
    """Return the figure: a column for each a_H; the whole box above, beyond R below; a line for each r.

    Parameters
    ----------
    results
        A finished study.

    Returns
    -------
    Figure
        Two rows of panels.
    """
    kinds = _kinds.of(results, most={"a_H": 4, "r": 6})
    runs, dry = _water.wet(pd.concat([kind.runs for kind in kinds]))
    if runs.empty:
        raise _style.NoRunsError(" ".join(dry))
    shown, left_out = _water.buoyant(runs)
    radius, _ = _slices.sizes(kinds[0].runs)
    times = np.array(paper_times(radius))
    depths = sorted(shown["a_H"].unique())
    looks = {r: look for r, look in _style.looks_of(runs["r"].unique()).items() if r in set(shown["r"])}
    curves = {quantity: _slices.curves(results, shown, quantity) for quantity in ROWS}
    values = [value for quantity in curves.values() for _, value in quantity.values()]
    units = _words.Units(_words.time_unit(times), _words.length_unit(*values))

    columns = len(depths)
    figure, axes = _style.panels(
        2 * columns, columns, 2.1 if len(kinds) == 1 else 3.0, sharex=True, sharey="row"
    )
    for k, ax in enumerate(axes):
        quantity, a_H = list(ROWS)[k // columns], depths[k % columns]
        rows = shown[shown["a_H"] == a_H]
        for kind in kinds:
            for _, row in rows[rows["id"].isin(kind.runs["id"])].iterrows():
                curve = curves[quantity].get(row["id"])
                _line(ax, kind, row, quantity, curve, looks[row["r"]], times, units)
        for time in times:
            ax.axvline(time * units.time.factor, color=_style.GREY, linewidth=0.6, linestyle=":", zorder=0.5)
        reached = rows["wave_free_until"].min() * units.time.factor
        if np.isfinite(reached):
            ax.axvspan(reached, 1e3 * reached, color=_water.REFLECTED, zorder=0, linewidth=0)
        ax.set_title(_words.panel(k, f"{_words.equation('a_H', a_H)}, {ROWS[quantity]}"))
        if len(kinds) == 1:
            ax.set_ylim(bottom=0)
    if len(kinds) > 1:
        _logarithmic(axes, columns, curves, times, units.value)
    axes[0].set_xlim(0, END * times[-1] * units.time.factor)
    for ax in axes[::columns]:
        ax.set_ylabel(_words.label("max_abs_eta", units.value))
    for ax in _style.bottom_row(axes, columns):
        ax.set_xlabel(_words.label("time", units.time))
    title = f"Largest displacement of the water surface, {_words.SYMBOLS['max_abs_eta']}, against time"
    notes = [
        *_notes(results, kinds, shown, times, units.time),
        *left_out,
        *dry,
        *kinds[0].chosen.notes,
        *_words.trouble(shown, cross=_fronts.CROSS),
    ]
    legend = _style.handles(looks, "r", dashes=not kinds[0].name)
    return _style.finish(figure, title, _kinds.about(kinds), notes, legend, 6, _kinds.entries(kinds))


def _logarithmic(
    axes: list[Axes], columns: int, curves: dict[str, dict], times: np.ndarray, unit: _words.Unit
) -> None:
    """Set a logarithmic scale on each row of panels that holds every value after half the first of `times`."""
    for k, quantity in enumerate(curves.values()):
        late = [value[(time >= times[0] / 2) & (value > 0)] for time, value in quantity.values()]
        seen = np.concatenate([np.empty(0), *late]) * unit.factor
        for ax in axes[k * columns : (k + 1) * columns]:
            ax.set_yscale("log")
            if seen.size:
                ax.set_ylim(0.8 * np.quantile(seen, 0.02), 1.5 * seen.max())


def _notes(
    results: "Results",
    kinds: list[_kinds.Kind],
    shown: pd.DataFrame,
    times: np.ndarray,
    unit: _words.Unit,
) -> list[str]:
    """Return what symbols and shades mean, and what is not converged."""
    stated = ", ".join(f"{time * unit.factor:.4g}" for time in times)
    scaled = "" if np.allclose(times, PAPER_TIMES) else " scaled by $\\sqrt{R}$"
    return [
        f"Dotted lines and symbols: {stated} {unit.name}, the paper's times{scaled}. The surface is watched to "
        f"{PAPER_BOX:.2f} $R$. Each row has its own scale.{_longest(kinds)}",
        *_water.reflected("Grey", shown, END * times[-1]),
        *_water.convergence(results, kinds, times[:2], unit),
    ]


def _longest(kinds: list[_kinds.Kind]) -> str:
    """Return the sentence on bars that leave a logarithmic scale, where there is one with bars."""
    if len(kinds) == 1 or not any(kind.banded for kind in kinds):
        return ""
    return " A bar that ends at the foot of its panel is a band as wide as the value, or wider."


def _line(
    ax: Axes,
    kind: _kinds.Kind,
    row: pd.Series,
    quantity: str,
    curve: tuple[np.ndarray, np.ndarray] | None,
    look: _style.Look,
    times: np.ndarray,
    units: _words.Units,
) -> None:
    """Draw a run's curve, its values at the paper's times as symbols, a cross if it failed."""
    if curve is None or not np.isfinite(curve[1]).any():
        return
    seen = np.isfinite(curve[1])
    time, value = curve[0][seen], curve[1][seen]
    ax.plot(time * units.time.factor, value * units.value.factor, **kind.line(look))
    if kind.banded:
        banded = kind.banded_values(row["id"], quantity)
        _kinds.symbols(ax, kind, banded, look, banded["time"] * units.time.factor, units.value.factor)
    else:
        inside = times[times <= time[-1]]
        options = {"color": look["color"], "marker": look["marker"], "markeredgewidth": 0, "linestyle": ""}
        ax.plot(inside * units.time.factor, np.interp(inside, time, value) * units.value.factor, **options)
    if row["status"] not in naming.FINISHED:
        _style.cross_end(ax, time[-1] * units.time.factor, value[-1] * units.value.factor)
