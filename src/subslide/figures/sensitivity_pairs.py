"""Second-order Sobol' indices: heat maps of what pairs of parameters explain together."""

from typing import TYPE_CHECKING

import numpy as np
import pandas as pd
import seaborn as sns
from matplotlib.figure import Figure

from subslide.figures import _sensitivity as sensitivity
from subslide.figures import _style, _words

if TYPE_CHECKING:
    from subslide.results import Results

TITLE = "What pairs of parameters explain together"
CATEGORY = "9 Sensitivity"
NEEDS = {"design": ("saltelli",)}
SPAN = 0.2
"""Indices from minus to plus this have colours of their own."""


@_style.styled
def draw(results: "Results") -> Figure:
    """Return the figure: first-order indices on the diagonal, second-order ones below, with half-widths of bands."""
    designs, notes = sensitivity.tables(results, "indices")
    if not designs:
        raise _style.NoRunsError("an answer that varies")
    outputs = list(dict.fromkeys(output for rows in designs for output in rows["output"]))
    figure, axes = _style.panels(len(designs) * len(outputs), len(outputs), 2.0)
    for k, ax in enumerate(axes):
        rows = designs[k // len(outputs)]
        inputs = rows["inputs"].iloc[0].split()
        some = rows[(rows["output"] == outputs[k % len(outputs)]) & rows["kind"].isin(("first", "second"))]
        values, texts = _matrix(some, inputs)
        names = [sensitivity.symbol(name) for name in inputs]
        sns.heatmap(
            values, ax=ax, mask=np.isnan(values), annot=texts, fmt="", cmap="RdBu_r", center=0, vmin=-SPAN, vmax=SPAN,
            cbar=False, square=False, linewidths=1.5, annot_kws={"size": 6.2}, xticklabels=names, yticklabels=names,
        )  # fmt: skip
        ax.tick_params(length=0, rotation=0)
        ax.grid(False)
        sns.despine(ax=ax, left=True, bottom=True)
        ax.set_title(_words.panel(k, sensitivity.OUTPUTS[outputs[k % len(outputs)]]))
        if k % len(outputs) == 0:
            ax.set_ylabel(f"design {rows['design'].iloc[0]}")
    every = pd.concat(designs)
    notes = [
        "; ".join(sensitivity.title(rows) for rows in designs) + ".",
        "On the diagonal first-order indices, below it second-order ones; after ± half the width of the 95 % band. An"
        f" asterisk: the band leaves out 0. Colours end at ±{SPAN:g}.",
        *sensitivity.failures(every),
        *notes,
    ]
    return _style.finish(figure, TITLE, sensitivity.size(every), notes)


def _matrix(rows: pd.DataFrame, inputs: list[str]) -> tuple[np.ndarray, np.ndarray]:
    """Return indices by pair of inputs, not a number above the diagonal, and the texts of the fields."""
    values = np.full((len(inputs), len(inputs)), np.nan)
    texts = np.full(values.shape, "", object)
    for _, row in rows.iterrows():
        one = inputs.index(row["input"])
        other = one if pd.isna(row["other"]) else inputs.index(row["other"])
        place = (max(one, other), min(one, other))
        values[place] = row["estimate"]
        sure = "*" if row["low"] > 0 or row["high"] < 0 else ""
        texts[place] = f"{row['estimate']:.3f}{sure}\n±{(row['high'] - row['low']) / 2:.3f}"
    return values, texts
