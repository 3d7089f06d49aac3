"""Paper's Figure 6: front of the grains against time for each depth of water, and the final length."""

from typing import TYPE_CHECKING

import pandas as pd
from matplotlib.figure import Figure

from subslide.figures import _fronts, _kinds, _slices, _style, _words

if TYPE_CHECKING:
    from subslide.results import Results

TITLE = "Front of the grains against time, and its final length"
CATEGORY = "2 Front of the grains"


@_style.styled
def draw(results: "Results") -> Figure:
    """Return the figure: fronts in a panel for each a_H, a line for each r; L_f against r in the last.

    Parameters
    ----------
    results
        A finished study.

    Returns
    -------
    Figure
        A panel for each a_H, and one of final lengths.
    """
    kinds = _kinds.of(results, most={"a_H": 5, "r": 6})
    runs = pd.concat([kind.runs for kind in kinds])
    radius, _ = _slices.sizes(runs)
    curves = _slices.curves(results, runs, _fronts.QUANTITY)
    depths = sorted(runs["a_H"].unique())
    until = 1.15 * _fronts.moving_until(curves)
    units = _words.Units(_words.time_unit(until), _words.length_unit(3 * radius))
    looks = _style.looks_of(runs["r"].unique())

    columns = 2 if len(depths) in (1, 3) else 3
    figure, axes = _style.panels(len(depths) + 1, columns, 2.5 if len(kinds) > 1 else 2.3)
    *fronts, last = axes
    for k, (ax, a_H) in enumerate(zip(fronts, depths, strict=True)):
        for kind in kinds:
            _fronts.plot(ax, kind, kind.runs[kind.runs["a_H"] == a_H], curves, looks, "r", units)
        ax.sharey(fronts[0])
        ax.set(xlim=(0, until * units.time.factor), title=_words.panel(k, _words.equation("a_H", a_H)))
        ax.set_xlabel(_words.label("time", units.time))
        ax.set_ylabel(_words.label("x_front", units.value) if k % columns == 0 else "")
        if k % columns == columns - 1 or len(depths) == 1:
            _fronts.over_radius(ax, radius, units.value)
    shades = _style.looks_of(depths, palette="plasma", light=0.7)
    _fronts.lengths(last, kinds, shades, radius, 3 if columns == 2 else 2)
    last.set_title(_words.panel(len(depths), f"final length {_words.SYMBOLS['L_f']}"))
    notes = [
        f"Front: the farthest point on the $x$ axis where $h_2$ is {_words.THRESHOLD:.0%} of $H_2$, found "
        f"between centres of cells.{_fronts.ringed(runs)}",
        *_fronts.convergence(kinds),
        *kinds[0].chosen.notes,
        *_words.trouble(runs, cross=_fronts.CROSS),
    ]
    title = f"Front of the grains against time, and its final length ({_words.FRONT})"
    legend = _style.handles(looks, "r", dashes=not kinds[0].name)
    return _style.finish(figure, title, _kinds.about(kinds), notes, legend, 6, _kinds.entries(kinds))
