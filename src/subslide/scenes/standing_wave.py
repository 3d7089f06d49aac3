"""A standing wave of small amplitude in grains 1 deep under water a_H deep, at its turning point, between walls.

It fits the box that it gets, on a line or on a radius, and swings as `exact.standing_wave` says without friction.
"""

from subslide.exact.standing_wave import DEFAULTS, form_mean, parts, wave_number
from subslide.scenes import SceneError, State, check_walls, options

OPTIONS = {
    "kind": {
        "description": "mode of the two layers",
        "enum": ["surface", "internal"],
        "default": DEFAULTS["kind"],
    },
    "shape": {
        "description": "cosine on a line, or Bessel function J0 on a radius",
        "enum": ["line", "round"],
        "default": DEFAULTS["shape"],
    },
    "amplitude": {
        "description": "displacement of the layer that moves more, over H2; the wave is exact as it goes to 0",
        "type": "number",
        "exclusiveMinimum": 0,
        "maximum": 0.1,
        "default": DEFAULTS["amplitude"],
    },
    "mode": {
        "description": "half wavelengths between the walls, or zeros of J1 from the axis to the wall",
        "type": "integer",
        "minimum": 1,
        "maximum": 100,
        "default": DEFAULTS["mode"],
    },
}


def symmetry(point):
    """Return the scene's symmetry."""
    return options(point)["shape"]


def check(point):
    """Raise a `SceneError` unless there are water and walls, and in the plane, whose walls are no circle."""
    check_walls(point)
    if point.a_H == 0:
        raise SceneError(
            f"a_H: {point.a_H:g} is not allowed with scene: standing_wave; allowed: a number above 0"
        )
    if point.model in ("quarter", "plane"):
        raise SceneError(
            f"model: {point.model} is not allowed with scene: standing_wave, whose wall is a circle or two points;"
            " allowed: auto, one-layer, radial, line"
        )


def initial(grid, point):
    """Return both layers at rest, displaced by the wave."""
    own = options(point)
    half = grid.edges[-1]
    k = wave_number(own["shape"], own["mode"], half)
    wave = own["amplitude"] * form_mean(own["shape"], k, grid.edges, half)
    dh1, dh2 = parts(own["kind"], point.a_H, 1.0, point.r)
    return State(point.a_H + dh1 * wave, 1.0 + dh2 * wave)
