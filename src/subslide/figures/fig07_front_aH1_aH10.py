"""Paper's Figure 7: front of the grains against time for a_H = 1 beside a_H = 10; how far r spreads it."""

from typing import TYPE_CHECKING, Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from subslide import naming
from subslide.figures import _fronts, _kinds, _slices, _style, _words

if TYPE_CHECKING:
    from subslide.results import Results

TITLE = "Front of the grains against time: shallow (a_H = 1) and deep water (a_H = 10)"
CATEGORY = "2 Front of the grains"
NEEDS = {"a_H": (1, 10)}


@_style.styled
def draw(results: "Results") -> Figure:
    """Return the figure: a panel for each r with both values of a_H, and the spread over r against time.

    Parameters
    ----------
    results
        A finished study.

    Returns
    -------
    Figure
        A panel for each r, and one of the spread.
    """
    kinds = _kinds.of(results, most={"r": 5}, a_H=(1, 10))
    runs = pd.concat([kind.runs for kind in kinds])
    radius, _ = _slices.sizes(runs)
    curves = _slices.curves(results, runs, _fronts.QUANTITY)
    until = 1.15 * _fronts.moving_until(curves)
    units = _words.Units(_words.time_unit(until), _words.length_unit(3 * radius))
    ratios = sorted(runs["r"].unique())
    looks = _style.looks_of(runs["a_H"].unique(), palette="plasma", light=0.6)

    figure, axes = _style.panels(len(ratios) + 1, 3, 2.0, sharex=True)
    *fronts, last = axes
    for k, (ax, r) in enumerate(zip(fronts, ratios, strict=True)):
        for kind in kinds:
            _fronts.plot(ax, kind, kind.runs[kind.runs["r"] == r], curves, looks, "a_H", units)
        ax.sharey(fronts[0])
        ax.set(xlim=(0, until * units.time.factor), title=_words.panel(k, _words.equation("r", r)))
        ax.set_ylabel(_words.label("x_front", units.value) if k % 3 == 0 else "")
    time = np.linspace(0, until, 400)
    for kind in kinds:
        finished = kind.runs[kind.runs["status"].isin(naming.FINISHED)]
        for a_H, rows in finished.groupby("a_H"):
            _spread(last, kind, rows, curves, looks[a_H], time, units)
    spread = f"largest $-$ least {_words.label('x_front', units.value)}"
    last.set(title=_words.panel(len(ratios), "spread of the front over $r$"), ylabel=spread)
    last.set_ylim(bottom=0)
    for ax in _style.bottom_row(axes, 3):
        ax.set_xlabel(_words.label("time", units.time))
    notes = [
        f"Front: the farthest point on the $x$ axis where $h_2$ is {_words.THRESHOLD:.0%} of $H_2$. At $r$ = 0 the "
        "water cannot act on the grains: lines of one kind should be one. Last panel: at each time, the farthest less "
        "the nearest front among the values of $r$ shown; its band is the sum of theirs.",
        *_fronts.convergence(kinds),
        *kinds[0].chosen.notes,
        *_words.trouble(runs, cross=_fronts.CROSS),
    ]
    title = f"Front of the grains in shallow and deep water ({_words.FRONT})"
    legend = _style.handles(looks, "a_H", dashes=not kinds[0].name)
    return _style.finish(figure, title, _kinds.about(kinds), notes, legend, 6, _kinds.entries(kinds))


def _spread(
    ax: Axes,
    kind: _kinds.Kind,
    rows: pd.DataFrame,
    curves: dict[str, Any],
    look: _style.Look,
    time: np.ndarray,
    units: _words.Units,
) -> None:
    """Draw the farthest less the nearest front of some runs at some times (s), with bands where they have any."""
    fronts = [np.interp(time, *curves[name]) for name in rows["id"] if name in curves]
    if len(fronts) < 2:
        return
    options = (
        {} if kind.banded else {"marker": look["marker"], "markevery": (0.06, 0.22), "markeredgewidth": 0}
    )
    spread = np.ptp(fronts, axis=0) * units.value.factor
    ax.plot(time * units.time.factor, spread, **kind.line(look), **options)
    if kind.banded:
        values = pd.concat([kind.banded_values(name, _fronts.QUANTITY) for name in rows["id"]])
        ends = []
        for when, group in values.groupby("time"):
            two = group.iloc[[group["value"].argmin(), group["value"].argmax()]]
            parts = {"band": two["band"].sum(skipna=False), "ordered": two["ordered"].min()}
            ends.append({"time": when, "value": np.ptp(group["value"]), **parts})
        ends = pd.DataFrame(ends)
        _kinds.symbols(ax, kind, ends, look, ends["time"] * units.time.factor, units.value.factor)
