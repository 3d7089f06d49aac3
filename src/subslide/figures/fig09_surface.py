"""Paper's Figure 9: the water surface along x at given times, for the depths nearest to a_H = 1 and 2."""

from typing import TYPE_CHECKING

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from subslide.figures import _kinds, _profiles, _slices, _style, _water, _words
from subslide.points import PAPER_BOX

if TYPE_CHECKING:
    from subslide.results import Results

TITLE = "Water surface along x at the paper's times"
CATEGORY = "3 Water surface"


@_style.styled
def draw(results: "Results") -> Figure:
    """Return the figure: a row for each time, a column for each a_H, a line for each r and kind of numerics.

    Parameters
    ----------
    results
        A finished study.

    Returns
    -------
    Figure
        A panel for each time and depth of water.
    """
    known = _slices.values_of(results, "a_H")
    kinds = _kinds.of(results, most={"r": 6}, a_H=[_slices.nearest(known, 1), _slices.nearest(known, 2)])
    runs, dry = _water.wet(pd.concat([kind.runs for kind in kinds]))
    if runs.empty:
        raise _style.NoRunsError(" ".join(dry))
    shown, left_out = _water.buoyant(runs)
    radius, _ = _slices.sizes(kinds[0].runs)
    looks = {r: look for r, look in _style.looks_of(runs["r"].unique()).items() if r in set(shown["r"])}
    round_column = kinds[0].runs.iloc[0]["scene"] == "cylinder"
    shapes = {row["id"]: _profiles.of_run(results, row["id"], "eta") for _, row in shown.iterrows()}
    depths = sorted(shown["a_H"].unique())
    times = _profiles.times_of(shapes.values(), 4)
    waves = [p.values for profiles in shapes.values() for p in profiles]
    x_unit, unit, t_unit = (
        _words.length_unit(3 * radius),
        _words.length_unit(*waves),
        _words.time_unit(*times),
    )

    columns = len(depths)
    figure, axes = _style.panels(max(len(times), 1) * columns, columns, 1.3, sharex=True, sharey="row")
    missing = []
    for k, ax in enumerate(axes if times else []):
        time, a_H = times[k // columns], depths[k % columns]
        where = f"{_words.equation('a_H', a_H)}, {_words.moment(time, t_unit)}"
        ax.set_title(_words.panel(k, where))
        rows = shown[shown["a_H"] == a_H]
        if (rows["wave_free_until"] < time).any():
            ax.set_facecolor(_water.REFLECTED)
        lacking = _profiles.draw(ax, kinds, rows, shapes, time, looks, (x_unit, unit))
        missing += [f"{run}, {where}" for run in lacking]
        ax.axhline(0, color="black", linewidth=0.5, zorder=0.5)
        if round_column:
            ax.axvline(radius * x_unit.factor, color=_style.GREY, linewidth=0.7, linestyle=":", zorder=0.5)
    least = 0.01 * unit.factor * max((np.abs(wave).max() for wave in waves), default=0.0)
    for ax in axes[::columns]:  # round-off about a level surface is no wave
        low, high = ax.get_ylim()
        ax.set_ylim(min(low, -least), max(high, least))
    far = PAPER_BOX * radius
    axes[0].set_xlim(_profiles.start(shapes.values(), far) * x_unit.factor, far * x_unit.factor)
    for ax in axes[::columns]:
        ax.set_ylabel(_words.label("eta", unit))
    for ax in _style.bottom_row(axes, columns):
        ax.set_xlabel(_words.label("x", x_unit))
    notes = [
        "Displacement from the level at release. Each row has its own scale."
        + " Dotted: edge of the column at release." * round_column
    ]
    if not times:
        notes = ["No run of this study has a profile of the water surface."]
    else:
        notes += _water.convergence(results, kinds, times[:2], t_unit, bars=False)
    if missing:
        notes.append(f"No profile: {'; '.join(missing)}.")
    notes += [
        *_water.reflected("Grey panels", shown, max(times, default=0.0)),
        *left_out,
        *dry,
        *kinds[0].chosen.notes,
        *_words.trouble(shown),
    ]
    title = f"Displacement of the water surface {_words.SYMBOLS['eta']} along $x$"
    legend = _style.handles(looks, "r", dashes=not kinds[0].name, markers=False)
    return _style.finish(figure, title, _kinds.about(kinds), notes, legend, 6, _kinds.entries(kinds, False))
