"""Main effects: the mean of each answer along each parameter, with bands."""

from typing import TYPE_CHECKING

import seaborn as sns
from matplotlib.figure import Figure

from subslide.figures import _sensitivity as sensitivity
from subslide.figures import _style, _words

if TYPE_CHECKING:
    from subslide.results import Results

TITLE = "Mean answers along each parameter"
CATEGORY = "9 Sensitivity"
NEEDS = {"design": ("saltelli",)}


@_style.styled
def draw(results: "Results") -> Figure:
    """Return the figure: of the first design, means of each answer over all other parameters."""
    designs, _ = sensitivity.tables(results, "effects")
    if not designs:
        raise _style.NoRunsError("an answer that varies")
    rows = designs[0]
    inputs = rows["inputs"].iloc[0].split()
    outputs = list(dict.fromkeys(rows["output"]))
    figure, axes = _style.panels(len(outputs) * len(inputs), len(inputs), 1.6, sharex="col", sharey="row")
    for k, ax in enumerate(axes):
        output, name = outputs[k // len(inputs)], inputs[k % len(inputs)]
        some = rows[(rows["output"] == output) & (rows["input"] == name)]
        colour = sensitivity.COLOURS.get(name, _style.GREY)
        ax.fill_between(some["value"], some["low"], some["high"], color=colour, alpha=0.2, linewidth=0)
        sns.lineplot(
            some, x="value", y="mean", ax=ax, color=colour, marker="o", markersize=3.5, errorbar=None
        )
        ax.set_title(_words.panel(k, sensitivity.symbol(name)))
        ax.set_ylabel(f"{sensitivity.OUTPUTS[output]} (1)" if k % len(inputs) == 0 else "")
        unit = "°" if name == "delta" else "1"
        last = k // len(inputs) == len(outputs) - 1
        ax.set_xlabel(f"{sensitivity.symbol(name)} ({unit})" if last else "")
    notes = [
        "Means over all other parameters, in parts of equal probability. Shaded: 95 % bands of sampling, grid error and"
        " failed runs. Time of arrest over $R/\\sqrt{g H_2}$.",
    ]
    if results.table("effects")["design"].nunique() > 1:
        notes.append("The other designs are in effects.csv.")
    return _style.finish(figure, TITLE, sensitivity.title(rows), notes)
