"""Paper's Figure 7: front of the grains against time for a_H = 1 beside a_H = 10; how far r spreads it."""

import numpy as np

from subslide.figures import _fronts, _slices, _style, _words

TITLE = "Front of the grains against time: shallow (a_H = 1) and deep water (a_H = 10)"
CATEGORY = "2 Front of the grains"
NEEDS = {"a_H": (1, 10)}


@_style.styled
def draw(results):
    """Return the figure: a panel for each r with both values of a_H, and the spread over r against time."""
    chosen = _slices.cut(results, most={"r": 5}, a_H=(1, 10))
    runs = chosen.runs
    radius, _ = _slices.sizes(runs)
    curves = _slices.curves(results, runs, _fronts.QUANTITY)
    until = 1.15 * _fronts.moving_until(curves)
    t_unit, x_unit = _words.time_unit(until), _words.length_unit(3 * radius)
    ratios = sorted(runs["r"].unique())
    looks = _style.keys_to(runs["a_H"].unique(), palette="plasma", light=0.6)

    figure, axes = _style.panels(len(ratios) + 1, 3, 1.9, sharex=True)
    *fronts, last = axes
    for k, (ax, r) in enumerate(zip(fronts, ratios, strict=True)):
        _fronts.plot(ax, runs[runs["r"] == r], curves, looks, "a_H", t_unit, x_unit)
        ax.sharey(fronts[0])
        ax.set(xlim=(0, until * t_unit.factor), title=_words.panel(k, _words.equation("r", r)))
        ax.set_ylabel(_words.label("x_front", x_unit) if k % 3 == 0 else "")
    time = np.linspace(0, until, 400)
    for a_H, rows in runs[runs["status"].isin(_slices.FINISHED)].groupby("a_H"):
        found = [np.interp(time, *curves[key]) for key in rows["id"] if key in curves]
        if len(found) > 1:
            spread = np.ptp(found, axis=0) * x_unit.factor
            last.plot(time * t_unit.factor, spread, **looks[a_H], markevery=(0.06, 0.22), markeredgewidth=0)
    spread = f"largest $-$ least {_words.label('x_front', x_unit)}"
    last.set(title=_words.panel(len(ratios), "spread of the front over $r$"), ylabel=spread)
    last.set_ylim(bottom=0)
    for ax in _style.bottom_row(axes, 3):
        ax.set_xlabel(_words.label("time", t_unit))
    notes = [
        f"Front: the farthest point on the $x$ axis where $h_2$ is {_words.THRESHOLD:.0%} of $H_2$. At "
        f"$r$ = 0 the "
        "water cannot act on the grains: both lines should be one. Last panel: at each time, the farthest "
        "less the "
        "nearest front among the values of $r$ shown."
    ]
    if _slices.first_order(runs):
        notes.append(_fronts.NOT_CONVERGED)
    title = f"Front of the grains in shallow and deep water ({_words.FRONT})"
    notes += [*chosen.notes, *_slices.trouble(runs, mark=_fronts.MARK)]
    return _style.finish(figure, title, chosen.about, notes, _style.handles(looks, "a_H"))
