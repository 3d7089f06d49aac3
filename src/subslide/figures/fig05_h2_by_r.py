"""Paper's Figure 5: depth of the grains along x at given times, for each ratio of densities."""

from typing import TYPE_CHECKING

import pandas as pd
from matplotlib.figure import Figure

from subslide import naming
from subslide.figures import _kinds, _profiles, _slices, _style, _words

if TYPE_CHECKING:
    from subslide.results import Results

TITLE = "Depth of the grains along x, for each ratio of densities r"
CATEGORY = "1 Shape of the grains"


@_style.styled
def draw(results: "Results") -> Figure:
    """Return the figure: a panel for each time of the profiles, a line for each r and kind of numerics.

    Parameters
    ----------
    results
        A finished study.

    Returns
    -------
    Figure
        A panel for each time, the end of the run last.
    """
    a_H = _slices.nearest(_slices.values_of(results, "a_H"), 1)
    kinds = _kinds.of(results, by=("a_H", "r"), most={"r": 6}, a_H=a_H)
    runs = pd.concat([kind.runs for kind in kinds])
    radius, height = _slices.sizes(runs)
    round_column = runs.iloc[0]["scene"] == "cylinder"
    shapes = {row["id"]: _profiles.of_run(results, row["id"], "h2") for _, row in runs.iterrows()}
    looks = _style.looks_of(sorted(runs["r"].unique()))
    times = [0.0, *_profiles.times_of(shapes.values(), 4), None]
    x_unit, unit, t_unit = (
        _words.length_unit(3 * radius),
        _words.length_unit(height),
        _words.time_unit(times[-2]),
    )

    columns = min(3, len(times))
    figure, axes = _style.panels(len(times), columns, 1.75, sharex=True, sharey=True)
    missing = []
    for k, (ax, time) in enumerate(zip(axes, times, strict=True)):
        when = _words.moment(time, t_unit) if time is not None else "end of the run"
        ax.set_title(_words.panel(k, when))
        lacking = _profiles.draw(ax, kinds, runs, shapes, time, looks, (x_unit, unit))
        missing += [f"{run}, {when}" for run in lacking]
        if round_column:
            ax.axvline(radius * x_unit.factor, color=_style.GREY, linewidth=0.7, linestyle=":", zorder=0.5)
    far = 1.05 * max(_profiles.reach(profiles, 2e-3 * height) for profiles in shapes.values())
    far += runs["dx"].fillna(0).max()
    begin = _profiles.start(shapes.values(), far)
    axes[0].set(xlim=(begin * x_unit.factor, far * x_unit.factor), ylim=(0, 1.1 * height * unit.factor))
    for ax in _style.bottom_row(axes, columns):
        ax.set_xlabel(_words.label("x", x_unit))
    for ax in axes[::columns]:
        ax.set_ylabel(_words.label("h2", unit))
    notes = ["Dotted: edge of the column at release. " * round_column]
    notes = [notes[0] + " ".join(kind.called(_rest(kind.runs, t_unit)) for kind in kinds)]
    if missing:
        notes.append(f"No profile: {'; '.join(missing)}.")
    notes += [*kinds[0].chosen.notes, *_words.trouble(runs)]
    title = f"Depth of the grains $h_2$ along $x$ for each $r$, {_words.equation('a_H', a_H)}"
    legend = _style.handles(looks, "r", dashes=not kinds[0].name, markers=False)
    return _style.finish(figure, title, _kinds.about(kinds), notes, legend, 6, _kinds.entries(kinds, False))


def _rest(runs: pd.DataFrame, unit: _words.Unit) -> str:
    """Return when the front of each run that came to rest was at its end, in words."""
    still = runs[runs["time_at_rest"].notna()]
    if still.empty:
        return "No run came to rest."
    arrived = still["time_of_arrest_1pc"]
    times = ", ".join(f"{float(f'{time * unit.factor:.3g}'):g}" for time in arrived)
    ratios = ", ".join(_words.number(r) for r in still["r"])
    near = f"within {100 * naming.ARREST:g} % of {_words.SYMBOLS['L_f']}"
    return f"The 1 % front is {near} from {times} {unit.name} on for {_words.SYMBOLS['r']} = {ratios}."
