"""Sobol' indices of front and wave against time: curves with bands."""

from typing import TYPE_CHECKING

from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from subslide.figures import _sensitivity as sensitivity
from subslide.figures import _style, _words

if TYPE_CHECKING:
    from subslide.results import Results

TITLE = "What each parameter explains, and when"
CATEGORY = "9 Sensitivity"
NEEDS = {"design": ("saltelli",)}
KINDS = {"first": "first order", "total": "total"}


@_style.styled
def draw(results: "Results") -> Figure:
    """Return the figure: of the first design, first-order and total indices of front and wave over scaled time."""
    designs, _ = sensitivity.tables(results, "indices_in_time")
    if not designs:
        raise _style.NoRunsError("an answer that varies")
    rows = designs[0]
    inputs = rows["inputs"].iloc[0].split()
    outputs = list(dict.fromkeys(rows["output"]))
    figure, axes = _style.panels(len(outputs) * len(KINDS), len(KINDS), 2.0, sharex="row", sharey=True)
    for k, ax in enumerate(axes):
        output, kind = outputs[k // len(KINDS)], list(KINDS)[k % len(KINDS)]
        some = rows[(rows["output"] == output) & (rows["kind"] == kind)]
        for name in inputs:
            curve = some[some["input"] == name]
            colour = sensitivity.COLOURS.get(name, _style.GREY)
            ax.fill_between(curve["time"], curve["low"], curve["high"], color=colour, alpha=0.15, linewidth=0)
            ax.plot(
                curve["time"], curve["estimate"], color=colour, linestyle=sensitivity.DASHES.get(name, "-")
            )
        ax.set_title(_words.panel(k, f"{sensitivity.OUTPUTS[output]}, {KINDS[kind]}"))
        ax.set_ylim(-0.1, 1.1)
        ax.set_xlim(0, some["time"].max())
        ax.set_ylabel("index (1)" if k % len(KINDS) == 0 else "")
        ax.set_xlabel("time over $R/\\sqrt{g H_2}$ (1)")
    entries: list[_style.Entry] = [
        (
            Line2D(
                [],
                [],
                color=sensitivity.COLOURS.get(name, _style.GREY),
                linestyle=sensitivity.DASHES.get(name, "-"),
            ),
            sensitivity.symbol(name),
        )
        for name in inputs
    ]
    notes = [
        "Shaded: 95 % bands of sampling, grid error and failed runs, cut off below -0.1 and above 1.1. Waves: up to the"
        " time that every run reaches.",
    ]
    if results.table("indices_in_time")["design"].nunique() > 1:
        notes.append("The other designs are in indices_in_time.csv.")
    return _style.finish(figure, TITLE, sensitivity.title(rows), notes, entries)
