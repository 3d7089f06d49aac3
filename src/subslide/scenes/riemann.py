"""A Riemann problem: on a line, two uniform states of both layers meet at x = 0.

As it stands a dam of grains, 1 deep, breaks onto a dry bed under still water, which `exact.riemann` knows with the pull
of the water on the grains (r > 0, a_H from 2 on, `delta: 0`). The box needs `boundary: wall`.
"""

import numpy as np

from subslide.keys.entries import Entry
from subslide.keys.schema import ConfigError
from subslide.points import Point
from subslide.scenes import Grid, State, check_walls, options
from subslide.scenes.dam_break import step

SIDES = ("left", "right")
STATES = {
    "h2": ("depth of the grains over H2", 0, 100, (1.0, 0.0)),
    "surface": ("height of the water surface over H1 + H2", 0, 100, (1.0, 1.0)),
    "u1": ("speed of the water over sqrt(g H2)", -10, 10, (0.0, 0.0)),
    "u2": ("speed of the grains over sqrt(g H2)", -10, 10, (0.0, 0.0)),
}
"""Meaning, least and greatest value, and defaults on the left and right, of what makes a state."""

OPTIONS: dict[str, Entry] = {
    f"{name}_{side}": {
        "description": f"{meaning}, on the {side}",
        "type": "number",
        "minimum": least,
        "maximum": most,
        "default": default,
    }
    for name, (meaning, least, most, defaults) in STATES.items()
    for side, default in zip(SIDES, defaults, strict=True)
}


def symmetry(point: Point) -> str:
    """Return the scene's symmetry."""
    return "line"


def check(point: Point) -> None:
    """Raise a ConfigError unless the box has walls, and the surface lies nowhere below the grains."""
    check_walls(point)
    chosen = options(point)
    for side in SIDES:
        surface, h2 = chosen[f"surface_{side}"] * point.scaled_level, chosen[f"h2_{side}"]
        if surface < h2:
            raise ConfigError(
                f"scene_options: surface_{side}: {chosen[f'surface_{side}']:g} lies below the grains; allowed here:"
                f" from {h2 / point.scaled_level:.6g}"
            )


def initial(grid: Grid, point: Point) -> State:
    """Return the two states; dry ones do not move."""
    chosen = options(point)
    x = grid.centres

    def either(name: str) -> np.ndarray:
        return step(x, chosen[f"{name}_left"], chosen[f"{name}_right"])

    level = either("surface") * point.scaled_level
    h1 = level - either("h2")
    h2 = level - h1
    return State(h1, h2, u1=np.where(h1 > 0, either("u1"), 0.0), u2=np.where(h2 > 0, either("u2"), 0.0))
