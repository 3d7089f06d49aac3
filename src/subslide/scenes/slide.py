"""A uniform layer of grains, 1 deep, that slides to the right under still water or alone: for friction laws.

Away from the walls at the ends of the line it keeps its depth and loses speed as `exact.slide` says.
The box needs `boundary: wall`.
"""

import numpy as np

from subslide.points import Point
from subslide.scenes import Grid, State, check_walls, options, still_water

OPTIONS = {
    "speed": {
        "description": "speed at the start over sqrt(g H2)",
        "type": "number",
        "minimum": 0,
        "maximum": 10,
        "default": 1.0,
    },
}


def symmetry(point: Point) -> str:
    """Return the scene's symmetry."""
    return "line"


def check(point: Point) -> None:
    """Raise a ConfigError unless the layer ends at walls."""
    check_walls(point)


def initial(grid: Grid, point: Point) -> State:
    """Return the sliding layer under still water."""
    return still_water(np.ones(len(grid.centres)), point.scaled_level)._replace(u2=options(point)["speed"])
