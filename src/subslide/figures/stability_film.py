"""Stability under a vanishing film of water by friction angle: a map for each scheme and order."""

from typing import TYPE_CHECKING

from matplotlib.figure import Figure

from subslide.figures import _atlas, _style
from subslide.points import Point

if TYPE_CHECKING:
    from subslide.results import Results

TITLE = "Where each method lives: a film of water over the column"
CATEGORY = "8 Stability"
NEEDS = {"scene": ("cylinder", "shear"), "treatment": ("real", "stop")}


@_style.styled
def draw(results: "Results") -> Figure:
    """Return the figure: error of L_f over delta and a_H, with symbols where runs fail.

    Parameters
    ----------
    results
        A finished study with a stability atlas.

    Returns
    -------
    Figure
        Maps: a row for each order, a column for each scheme.
    """
    column = {"a_2": Point.a_2, "r": Point.r, "boundary": "wall"}
    figure, rows, entries = _atlas.maps(results, "delta", "a_H", **column)
    notes = [
        "At $a_H$ = 0 the column touches the surface. Where friction holds a part of the flat top, the film drains "
        "over its edge: to the water, steps of grains at rest are a bed."
    ]
    return _style.finish(figure, TITLE, _atlas.about(rows, ("a_2", "r")), notes, more=entries)
