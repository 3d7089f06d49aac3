"""A dam at x = 0: on a line, a layer at rest that is deeper on the left is let go.

Grains are 1 deep and rest under still water, or alone in the model one-layer. Water is 1 + a_H deep, over a bare bed.
The box needs `boundary: wall`. The answer is known exactly without friction, at r = 0 or with water alone.
"""

import numpy as np

from subslide.points import Point
from subslide.scenes import Grid, State, check_walls, options, still_water

OPTIONS = {
    "layer": {
        "description": "layer behind the dam",
        "enum": ["grains", "water"],
        "default": "grains",
    },
    "downstream": {
        "description": "depth beyond the dam over the depth behind it; 0 is dry",
        "type": "number",
        "minimum": 0,
        "exclusiveMaximum": 1,
        "default": 0.0,
    },
}


def symmetry(point: Point) -> str:
    """Return the scene's symmetry."""
    return "line"


def check(point: Point) -> None:
    """Raise a ConfigError unless the box has walls for the grains behind the dam to lean on."""
    if options(point)["layer"] == "grains":
        check_walls(point)


def initial(grid: Grid, point: Point) -> State:
    """Return the layer at rest behind its dam."""
    chosen = options(point)
    level = point.scaled_level
    if chosen["layer"] == "water":
        return State(step(grid.centres, level, chosen["downstream"] * level), np.zeros(len(grid.centres)))
    return still_water(step(grid.centres, 1.0, chosen["downstream"]), level)


def step(x: np.ndarray, left: float, right: float) -> np.ndarray:
    """Return the depth before the dam is let go.

    Parameters
    ----------
    x
        Places (n), the dam at 0.
    left, right
        Depths before the dam and from there on.

    Returns
    -------
    ndarray
        Depths (n).
    """
    return np.where(x < 0, left, right)
