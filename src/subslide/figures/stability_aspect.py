"""Stability by aspect ratio of the column and friction angle: a map for each scheme and order."""

from subslide.figures import _atlas, _style
from subslide.points import Point

TITLE = "Where each method lives: aspect ratio by friction angle"
CATEGORY = "8 Stability"
NEEDS = {"scene": ("cylinder", "shear"), "treatment": ("real", "stop")}


@_style.styled
def draw(results):
    """Return the figure: error of L_f over delta and a_2, with marks where runs fail."""
    column = {"a_H": float(Point.a_H), "r": Point.r, "boundary": "open"}
    figure, rows, entries = _atlas.maps(results, TITLE, "delta", "a_2", **column)
    notes = [
        "The scaled answer depends on tan(δ)/$a_2$ alone. Grains with little friction for their height run further "
        "than the largest box reaches; without any they never rest. Energy is not watched in open boxes."
    ]
    return _style.finish(figure, TITLE, _atlas.about(rows, ("a_H", "r")), notes, more=entries)
