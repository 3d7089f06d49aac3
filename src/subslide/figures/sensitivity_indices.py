"""First-order and total Sobol' indices: bars with bands, a panel for each design and answer."""

from typing import TYPE_CHECKING

import pandas as pd
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from subslide.figures import _sensitivity as sensitivity
from subslide.figures import _style, _words

if TYPE_CHECKING:
    from subslide.results import Results

TITLE = "What each parameter explains"
CATEGORY = "9 Sensitivity"
NEEDS = {"design": ("saltelli",)}


@_style.styled
def draw(results: "Results") -> Figure:
    """Return the figure: first-order and total indices of each answer, with 95 % bands."""
    designs, notes = sensitivity.tables(results, "indices")
    if not designs:
        raise _style.NoRunsError("an answer that varies")
    outputs = list(dict.fromkeys(output for rows in designs for output in rows["output"]))
    figure, axes = _style.panels(len(designs) * len(outputs), len(outputs), 1.75, sharey=True)
    for k, ax in enumerate(axes):
        rows = designs[k // len(outputs)]
        some = rows[rows["output"] == outputs[k % len(outputs)]]
        sensitivity.bars(ax, some, rows["inputs"].iloc[0].split())
        ax.set_title(_words.panel(k, sensitivity.OUTPUTS[outputs[k % len(outputs)]]))
        if k % len(outputs) == 0:
            ax.set_ylabel(f"design {rows['design'].iloc[0]}\nindex (1)")
    every = pd.concat(designs)
    entries: list[_style.Entry] = [
        (Patch(facecolor=_style.GREY), "first order: alone"),
        (Patch(facecolor=sensitivity.TOTAL), "total: alone and with others"),
    ]
    notes = [
        "; ".join(sensitivity.title(rows) for rows in designs) + ".",
        "Lines: 95 % bands of sampling, grid error and failed runs.",
        *sensitivity.failures(every),
        *notes,
    ]
    return _style.finish(figure, TITLE, sensitivity.size(every), notes, entries)
