"""Largest stable Courant number, measured, beside the theoretical one: bars for each scheme and order."""

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from subslide.figures import _atlas, _style, _words
from subslide.points import Point

if TYPE_CHECKING:
    from subslide.results import Results

TITLE = "Largest stable Courant number"
CATEGORY = "8 Stability"
NEEDS = {"scene": ("cylinder", "shear"), "treatment": ("real", "stop")}
COLUMNS = 3
SCENES = {"standing_wave": "standing wave", "dam_break": "dam break", "cylinder": "collapse"}


@_style.styled
def draw(results: "Results") -> Figure:
    """Return the figure: a panel for each model and scene, a bar for each scheme and order.

    Parameters
    ----------
    results
        A finished study with a table of Courant numbers.

    Returns
    -------
    Figure
        A panel for each model and scene.
    """
    largest = _atlas.limits(results.cfl)
    groups = list(largest.groupby(["model", "scene"], sort=False))
    schemes = list(dict.fromkeys(largest["scheme"]))
    looks = _style.looks_of(sorted(schemes))
    figure, axes = _style.panels(len(groups), COLUMNS, 1.7, sharey=True)
    for k, (ax, ((model, scene), rows)) in enumerate(zip(axes, groups, strict=True)):
        for _, row in rows.iterrows():
            place = schemes.index(row["scheme"]) + (-0.2 if row["order"] == 1 else 0.2)
            look = {"color": looks[row["scheme"]]["color"], "edgecolor": "white", "linewidth": 0.5}
            ax.bar(place, row["cfl"], width=0.38, hatch="////" if row["order"] == 1 else None, **look)
            if row["cfl"] == 0:
                ax.text(place, 0.03, "none", rotation=90, ha="center", va="bottom", fontsize=7)
        ax.axhline(rows["theory"].iloc[0], color="black", linewidth=1.2)
        ax.axhline(Point.cfl, color="#b40426", linewidth=1.0, linestyle="--")
        ax.set_xticks(np.arange(len(schemes)), [name.upper() for name in schemes], rotation=30)
        ax.tick_params(axis="x", labelbottom=True)
        ax.grid(False, axis="x")
        ax.set_title(_words.panel(k, f"{model}, {SCENES.get(scene, scene)}"))
        ax.set_ylabel("Courant number (1)" if k % COLUMNS == 0 else "")
    entries = [
        (Patch(facecolor="0.5", hatch="////", edgecolor="white"), "order 1"),
        (Patch(facecolor="0.5"), "order 2"),
        (Line2D([], [], color="black", linewidth=1.2), "theory"),
        (Line2D([], [], color="#b40426", linewidth=1.0, linestyle="--"), "default"),
    ]
    notes = [
        "Found by bisection without friction between walls; a run counts as stable if volumes hold, its energy and "
        "total variation do not grow and it stays near the resolved run (docs/tables.md). In a collapse few cells are "
        "as fast as the step allows for, so it bears more than a wave. 'none': energy rises at any Courant number."
    ]
    tried = f"{len(results.cfl)} runs"
    return _style.finish(figure, TITLE, tried, notes, entries, 4)
