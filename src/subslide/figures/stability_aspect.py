"""Stability by aspect ratio of the column and friction angle: a map for each scheme and order."""

from typing import TYPE_CHECKING

from matplotlib.figure import Figure

from subslide.figures import _atlas, _style
from subslide.points import Point

if TYPE_CHECKING:
    from subslide.results import Results

TITLE = "Where each method lives: aspect ratio by friction angle"
CATEGORY = "8 Stability"
NEEDS = {"scene": ("cylinder", "shear"), "treatment": ("real", "stop")}


@_style.styled
def draw(results: "Results") -> Figure:
    """Return the figure: error of L_f over delta and a_2, with symbols where runs fail.

    Parameters
    ----------
    results
        A finished study with a stability atlas.

    Returns
    -------
    Figure
        Maps: a row for each order, a column for each scheme.
    """
    column = {"a_H": float(Point.a_H), "r": Point.r, "boundary": "open"}
    figure, rows, entries = _atlas.maps(results, "delta", "a_2", **column)
    notes = [
        "The scaled answer depends on tan(δ)/$a_2$ alone. Grains with little friction for their height run further "
        "than the largest box reaches; without any they never rest. Energy is not watched in open boxes."
    ]
    return _style.finish(figure, TITLE, _atlas.about(rows, ("a_H", "r")), notes, more=entries)
