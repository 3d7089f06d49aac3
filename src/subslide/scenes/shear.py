"""Two uniform layers that slide over each other, with a small wave on their interface: for loss of hyperbolicity.

Grains 1 deep under water a_H deep, in the frame where they have no momentum together unless they drift. Above a shear
of 1 the wave speeds are complex and the wave grows as `exact.shear` says without friction (`delta: 0`); below it moves
on unchanged. The box needs `boundary: periodic`; the wave fits it `mode` times. Cells are ever more unstable than the
wave: at first order a box of 100 cells shows its growth by e^2 cleanly, at second order that by e^(1/4).
"""

from subslide.exact.shear import DEFAULTS, state
from subslide.scenes import SceneError, State, options

OPTIONS = {
    "shear": {
        "description": "u1 - u2 over the least one at which wave speeds become complex",
        "type": "number",
        "minimum": 0,
        "maximum": 10,
        "default": DEFAULTS["shear"],
    },
    "amplitude": {
        "description": "displacement of the layer that moves more, over H2; linear theory is exact as it goes to 0",
        "type": "number",
        "minimum": 0,
        "maximum": 0.1,
        "default": DEFAULTS["amplitude"],
    },
    "mode": {
        "description": "wavelengths in the box",
        "type": "integer",
        "minimum": 1,
        "maximum": 100,
        "default": DEFAULTS["mode"],
    },
    "drift": {
        "description": "speed added to both layers over sqrt(g H2)",
        "type": "number",
        "minimum": -10,
        "maximum": 10,
        "default": DEFAULTS["drift"],
    },
}


def symmetry(point):
    """Return the scene's symmetry."""
    return "line"


def check(point):
    """Raise a `SceneError` unless both layers are there in a box without ends."""
    if point.boundary != "periodic":
        raise SceneError(
            f"boundary: {point.boundary} is not allowed with scene: shear, whose layers move through the edges of the"
            " box; allowed: only periodic"
        )
    least = options(point)["amplitude"]
    if point.a_H <= least:
        raise SceneError(
            f"a_H: {point.a_H:g} is not allowed with scene: shear; allowed: a number above the amplitude of its wave,"
            f" {least:g}"
        )


def initial(grid, point):
    """Return the sliding layers with the wave."""
    h1, u1, h2, u2 = state(point, grid.centres, half_cell=0.5 * grid.dx)
    return State(h1, h2, u1=u1, u2=u2)
