"""A standing wave of small amplitude in grains 1 deep under water a_H deep, at its turning point, between walls.

It fits the box that it gets, on a line or on a radius, and swings as `exact.standing_wave` says without friction.
"""

import math

import numpy as np

from subslide.keys.schema import ConfigError
from subslide.points import Point
from subslide.scenes import Grid, State, check_walls, options
from subslide.scenes._bessel import bessel, zero_of_j1

OPTIONS = {
    "kind": {
        "description": "mode of the two layers",
        "enum": ["surface", "internal"],
        "default": "surface",
    },
    "shape": {
        "description": "cosine on a line, or Bessel function J0 on a radius",
        "enum": ["line", "round"],
        "default": "line",
    },
    "amplitude": {
        "description": "displacement of the layer that moves more, over H2; the wave is exact as it goes to 0",
        "type": "number",
        "exclusiveMinimum": 0,
        "maximum": 0.1,
        "default": 1e-5,
    },
    "mode": {
        "description": "half wavelengths between the walls, or zeros of J1 from the axis to the wall",
        "type": "integer",
        "minimum": 1,
        "maximum": 100,
        "default": 2,
    },
}


def symmetry(point: Point) -> str:
    """Return the scene's symmetry."""
    return options(point)["shape"]


def check(point: Point) -> None:
    """Raise a ConfigError unless there are water and walls, and in the plane, whose walls are no circle."""
    check_walls(point)
    if point.a_H == 0:
        raise ConfigError(
            f"a_H: {point.a_H:g} is not allowed with scene: standing_wave; allowed: a number above 0"
        )
    if point.model in ("quarter", "plane"):
        raise ConfigError(
            f"model: {point.model} is not allowed with scene: standing_wave, whose wall is a circle or two points;"
            " allowed: auto, one-layer, radial, line"
        )


def initial(grid: Grid, point: Point) -> State:
    """Return both layers at rest, displaced by the wave."""
    chosen = options(point)
    half = grid.edges[-1]
    k = wave_number(chosen["shape"], chosen["mode"], half)
    wave = chosen["amplitude"] * form_mean(chosen["shape"], k, grid.edges, half)
    dh1, dh2 = parts(chosen["kind"], point.a_H, 1.0, point.r)
    return State(point.a_H + dh1 * wave, 1.0 + dh2 * wave)


def speed(kind: str, h1: float, h2: float, r: float, g: float = 1.0) -> float:
    """Return the speed of a wave on both layers at rest.

    Parameters
    ----------
    kind
        "surface" or "internal".
    h1, h2
        Depths of the layers.
    r
        Density of water over density of grains.
    g
        Gravity, 1 where depths are scaled.

    Returns
    -------
    float
        Speed c, of c^2 = g H / 2 (1 +- sqrt(1 - 4 (1-r) h1 h2 / H^2)), H = h1 + h2.
    """
    H = h1 + h2
    root = math.sqrt(max(0.0, 1 - 4 * (1 - r) * h1 * h2 / H**2))
    if kind == "surface":
        return math.sqrt(0.5 * g * H * (1 + root))
    return math.sqrt(2 * g * (1 - r) * h1 * h2 / (H * (1 + root)))


def parts(kind: str, h1: float, h2: float, r: float) -> tuple[float, float]:
    """Return the displacements of both layers in a mode.

    Parameters
    ----------
    kind
        "surface" or "internal".
    h1, h2
        Depths of the layers.
    r
        Density of water over density of grains.

    Returns
    -------
    tuple of float
        (dh1, dh2), the larger of the two 1 in size and dh1 not negative.
    """
    ratio = speed(kind, h1, h2, r) ** 2 / h1 - 1
    size = max(1.0, abs(ratio))
    return 1.0 / size, ratio / size


def wave_number(shape: str, mode: int, half: float) -> float:
    """Return the wave number of a wave that fits between walls.

    Parameters
    ----------
    shape
        "line", between walls at -half and half, or "round", within a wall of radius half.
    mode
        Half wavelengths, or zeros of J1 from the axis to the wall.
    half
        Half-width of the box, in any unit.

    Returns
    -------
    float
        Wave number in one over that unit.
    """
    return zero_of_j1(mode) / half if shape == "round" else mode * math.pi / (2 * half)


def form_mean(shape: str, k: float, edges: np.ndarray, half: float) -> np.ndarray:
    """Return the means (n) of the form over cells or rings between `edges` (n + 1)."""
    if shape == "round":
        return np.diff(edges * bessel(1, k * edges) / k) / (0.5 * np.diff(edges**2))
    return np.diff(np.sin(k * (edges + half)) / k) / np.diff(edges)
