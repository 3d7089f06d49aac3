"""An elliptic column of grains of height 1 and of the cylinder's area, pi, at rest under still water."""

import math

from subslide.points import Point
from subslide.scenes import Grid, State, cylinder, options, still_water
from subslide.scenes._cells import over_plane
from subslide.scenes._discs import ellipse_area, fraction

OPTIONS = {
    "elongation": {
        "description": "first semi-axis over the second",
        "type": "number",
        "minimum": 0.0625,
        "maximum": 16,
        "default": 1.5,
    },
    "angle": {
        "description": "angle from the x axis to the first semi-axis",
        "type": "number",
        "minimum": -180,
        "maximum": 180,
        "default": 0.0,
        "unit": "degree",
    },
}


def symmetry(point: Point) -> str:
    """Return the scene's symmetry."""
    chosen = options(point)
    if chosen["elongation"] == 1:
        return "round"
    return "quarter" if chosen["angle"] % 90 == 0 else "none"


def front(point: Point) -> float:
    """Return how far the ellipse reaches along x from its centre."""
    chosen = options(point)
    a, turned = math.sqrt(chosen["elongation"]), math.radians(chosen["angle"] % 180)
    return 1 / math.hypot(math.cos(turned) / a, math.sin(turned) * a)


def initial(grid: Grid, point: Point) -> State:
    """Return the column at rest under still water."""
    chosen = options(point)
    symmetric = symmetry(point)
    if symmetric == "round":
        return cylinder.initial(grid, point)
    a = math.sqrt(chosen["elongation"])
    if symmetric == "quarter":
        axes = (a, 1 / a) if chosen["angle"] % 180 == 0 else (1 / a, a)
        h2 = over_plane(grid, lambda e: fraction(ellipse_area(e, e, semi_axes=axes), e, e))
    else:
        e = grid.edges
        h2 = fraction(ellipse_area(e, e, semi_axes=(a, 1 / a), angle=math.radians(chosen["angle"])), e, e)
        h2 = 0.5 * (h2 + h2[::-1, ::-1])  # half a turn changes no bit
    return still_water(h2, point.scaled_level)
