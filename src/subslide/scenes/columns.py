"""One or two round columns of grains of radius 1 and height 1, at rest under still water, anywhere in the box.

Where two columns overlap the height is 1. The front is measured from the middle of the box, along x.
"""

import math
from typing import Any

import numpy as np

from subslide.keys.schema import ConfigError
from subslide.points import Point
from subslide.scenes import Grid, State, cylinder, options, still_water
from subslide.scenes._cells import over_plane
from subslide.scenes._discs import ellipse_area, fraction

OPTIONS = {
    "count": {"description": "number of columns", "enum": [1, 2], "default": 1},
    "distance": {
        "description": "distance of the centres of two columns, along x, over R",
        "type": "number",
        "minimum": 0,
        "maximum": 100,
        "default": 2.5,
    },
    **{
        axis: {
            "description": f"place of the column, or of the middle of two, along {axis} over R",
            "type": "number",
            "minimum": -100,
            "maximum": 100,
            "default": 0.0,
        }
        for axis in ("x", "y")
    },
}


def spread(chosen: dict[str, Any]) -> float:
    """Return half the distance of the centres."""
    return 0.5 * chosen["distance"] if chosen["count"] == 2 else 0.0


def symmetry(point: Point) -> str:
    """Return the scene's symmetry."""
    chosen = options(point)
    if chosen["x"] or chosen["y"]:
        return "none"
    return "quarter" if spread(chosen) else "round"


def check(point: Point) -> None:
    """Raise a ConfigError unless all columns stand in the smallest box."""
    chosen = options(point)
    for axis, reach in (("x", 1.0 + spread(chosen)), ("y", 1.0)):
        if abs(chosen[axis]) + reach > point.half_box:
            raise ConfigError(
                f"scene_options: {axis}: {chosen[axis]:g} puts a column beyond the box, which ends at"
                f" {point.half_box:.4g} R; allowed with these columns: at most {point.half_box - reach:.4g} in size"
            )


def front(point: Point) -> float | None:
    """Return how far the columns reach along the x axis; None if they do not reach it beyond 0."""
    chosen = options(point)
    if abs(chosen["y"]) >= 1:
        return None
    reach = chosen["x"] + spread(chosen) + math.sqrt(1 - chosen["y"] ** 2)
    return reach if reach > 0 else None


def is_column(point: Point) -> bool:
    """Return whether there is one column, about the axis."""
    return symmetry(point) == "round"


def initial(grid: Grid, point: Point) -> State:
    """Return the columns at rest under still water."""
    chosen = options(point)
    symmetric = symmetry(point)
    if symmetric == "round":
        return cylinder.initial(grid, point)
    place, half = (chosen["x"], chosen["y"]), spread(chosen)
    if symmetric == "quarter":
        h2 = over_plane(grid, lambda e: union(e, e, place, half))
    else:
        h2 = union(grid.edges, grid.edges, place, half)
        if chosen["y"] == 0:  # mirrors change no bit
            h2 = 0.5 * (h2 + h2[::-1])
        if chosen["x"] == 0:
            h2 = 0.5 * (h2 + h2[:, ::-1])
    return still_water(h2, point.scaled_level)


def union(x_edges: np.ndarray, y_edges: np.ndarray, place: tuple[float, float], half: float) -> np.ndarray:
    """Return the fraction (ny, nx) of each cell within 1 of a centre at place[0] - half or + half along x.

    On either side of the line between the centres the nearer disc is the union of both.
    """
    left = ellipse_area(np.minimum(x_edges, place[0]), y_edges, (place[0] - half, place[1]))
    right = ellipse_area(np.maximum(x_edges, place[0]), y_edges, (place[0] + half, place[1]))
    return fraction(left + right, x_edges, y_edges)
