"""Stability by depth of the water and density: a map for each scheme and order."""

from typing import TYPE_CHECKING

from matplotlib.figure import Figure

from subslide.figures import _atlas, _style
from subslide.points import Point

if TYPE_CHECKING:
    from subslide.results import Results

TITLE = "Where each method lives: depth of the water by density"
CATEGORY = "8 Stability"
NEEDS = {"scene": ("cylinder", "shear"), "treatment": ("real", "stop")}


@_style.styled
def draw(results: "Results") -> Figure:
    """Return the figure: error of L_f over r and a_H, with symbols where runs fail.

    Parameters
    ----------
    results
        A finished study with a stability atlas.

    Returns
    -------
    Figure
        Maps: a row for each order, a column for each scheme.
    """
    column = {"a_2": Point.a_2, "delta": Point.delta, "boundary": "wall"}
    figure, rows, entries = _atlas.maps(results, "r", "a_H", **column)
    notes = ["Error: against the default scheme on the finest grid, where its two finest grids agree."]
    return _style.finish(figure, TITLE, _atlas.about(rows, ("a_2", "delta")), notes, more=entries)
