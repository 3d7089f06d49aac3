"""A pile of grains of height 1 with a dry foot, at rest under still water, a little less steep than friction allows.

|grad h2| is `steepness` tan(delta) everywhere, so that a scheme that respects rest keeps it still (Theorem 3.1 of the
paper).
"""

import math
from collections.abc import Callable

import numpy as np

from subslide.keys.schema import ConfigError
from subslide.points import Point
from subslide.scenes import Grid, State, options, still_water
from subslide.scenes._cells import means, over_plane

OPTIONS = {
    "shape": {"description": "form of the pile", "enum": ["cone", "pyramid"], "default": "cone"},
    "angle": {
        "description": "angle of a pyramid's square to the grid",
        "type": "number",
        "minimum": -180,
        "maximum": 180,
        "default": 0.0,
        "unit": "degree",
    },
    "steepness": {
        "description": "slope over tan(delta); from 1 on the pile slides",
        "type": "number",
        "exclusiveMinimum": 0,
        "maximum": 10,
        "default": 0.95,
    },
}


def symmetry(point: Point) -> str:
    """Return the scene's symmetry."""
    chosen = options(point)
    if chosen["shape"] == "cone":
        return "round"
    return "quarter" if chosen["angle"] % 45 == 0 else "none"


def check(point: Point) -> None:
    """Raise a ConfigError without friction, which no pile can rest on."""
    if point.delta == 0:
        raise ConfigError(
            "delta: 0 is not allowed with scene: pile, whose slope is by tan(delta); allowed: above 0"
        )


def initial(grid: Grid, point: Point) -> State:
    """Return the pile at rest under still water; cells hold the mean depth, whose slope is never the steeper."""
    chosen = options(point)
    slope = chosen["steepness"] * point.friction_number
    if grid.geometry == "radius":
        h2 = cone_rings(grid.edges, slope)
    elif chosen["shape"] == "cone":
        h2 = over_plane(
            grid, lambda e: means(lambda x, y: np.maximum(0.0, 1.0 - slope * np.hypot(x, y)), e, e)
        )
    else:
        shape = pyramid(slope, chosen["angle"])
        if symmetry(point) == "quarter":
            h2 = over_plane(grid, lambda e: means(shape, e, e))
        else:
            h2 = means(shape, grid.edges, grid.edges)
            h2 = 0.5 * (h2 + h2[::-1, ::-1])  # half a turn changes no bit
    return still_water(h2, point.scaled_level)


def cone_rings(edges: np.ndarray, slope: float) -> np.ndarray:
    """Return the mean depth (n) of a cone over the rings between the radii `edges` (n + 1)."""
    s = np.minimum(edges, 1.0 / slope)
    return np.diff(s**2 / 2 - slope * s**3 / 3) / (np.diff(edges**2) / 2)


def pyramid(slope: float, degrees: float) -> Callable[[np.ndarray, np.ndarray], np.ndarray]:
    """Return the depth, as a function of x and y, of a pyramid on a square that is turned by an angle."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return lambda x, y: np.maximum(
        0.0, 1.0 - slope * np.maximum(np.abs(c * x + s * y), np.abs(c * y - s * x))
    )
