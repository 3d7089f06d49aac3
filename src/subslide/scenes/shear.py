"""Two uniform layers that slide over each other, with a small wave on their interface: for loss of hyperbolicity.

Grains 1 deep under water a_H deep, in the frame where they have no momentum together unless they drift. Above a shear
of 1 the wave speeds are complex and the wave grows as `exact.shear` says without friction (`delta: 0`); below it moves
on unchanged. The box needs `boundary: periodic`; the wave fits it `mode` times. Cells are ever more unstable than the
wave: at first order a box of 100 cells shows its growth by e^2 cleanly, at second order that by e^(1/4).
"""

import math

import numpy as np

from subslide.keys.schema import ConfigError
from subslide.points import Point
from subslide.scenes import Grid, State, options

OPTIONS = {
    "shear": {
        "description": "u1 - u2 over the least one at which wave speeds become complex",
        "type": "number",
        "minimum": 0,
        "maximum": 10,
        "default": 1.2,
    },
    "amplitude": {
        "description": "displacement of the layer that moves more, over H2; linear theory is exact as it goes to 0",
        "type": "number",
        "minimum": 0,
        "maximum": 0.1,
        "default": 1e-4,
    },
    "mode": {
        "description": "wavelengths in the box",
        "type": "integer",
        "minimum": 1,
        "maximum": 100,
        "default": 1,
    },
    "drift": {
        "description": "speed added to both layers over sqrt(g H2)",
        "type": "number",
        "minimum": -10,
        "maximum": 10,
        "default": 0.0,
    },
}


def symmetry(point: Point) -> str:
    """Return the scene's symmetry."""
    return "line"


def check(point: Point) -> None:
    """Raise a ConfigError unless both layers are there in a box without ends."""
    if point.boundary != "periodic":
        raise ConfigError(
            f"boundary: {point.boundary} is not allowed with scene: shear, whose layers move through the edges of the"
            " box; allowed: only periodic"
        )
    least = options(point)["amplitude"]
    if point.a_H <= least:
        raise ConfigError(
            f"a_H: {point.a_H:g} is not allowed with scene: shear; allowed: a number above the amplitude of its wave,"
            f" {least:g}"
        )


def initial(grid: Grid, point: Point) -> State:
    """Return the sliding layers with the wave."""
    h1, u1, h2, u2 = state(point, grid.centres, half_cell=0.5 * grid.dx)
    return State(h1, h2, u1=u1, u2=u2)


def state(
    point: Point, x: float | np.ndarray, t: float = 0.0, half_cell: float = 0.0
) -> tuple[np.ndarray, ...]:
    """Return the layers with the wave, as means over cells.

    Parameters
    ----------
    point
        The run's.
    x
        Centres (n) of the cells over R.
    t
        Scaled time.
    half_cell
        Half the size of the cells over R; 0 for the values at `x`.

    Returns
    -------
    tuple of ndarray
        (h1, u1, h2, u2), each (n), scaled.
    """
    layers = base(point)
    k = wave_number(point)
    c, wave = mode(*layers, point.r)
    size = options(point)["amplitude"] * np.sinc(k * half_cell / math.pi)
    form = size * np.exp(1j * k * (np.asarray(x) - c * t))
    return tuple(value + (part * form).real for value, part in zip(layers, wave, strict=True))


def speeds(h1: float, u1: float, h2: float, u2: float, r: float) -> np.ndarray:
    """Return the four wave speeds (complex), by real part, of a pair the one that decays first."""
    first = np.poly1d([1, -2 * u1, u1 * u1 - h1])
    second = np.poly1d([1, -2 * u2, u2 * u2 - h2])
    roots = (first * second - r * h1 * h2).roots.astype(complex)
    return roots[np.lexsort((roots.imag, np.round(roots.real, 9)))]


def discriminant(h1: float, h2: float, shear: float, r: float) -> float:
    """Return the discriminant of the quartic of the speeds, (4 I^3 - J^2) / 27: negative where a pair is complex."""
    d2 = shear * shear / 4
    p = -2 * d2 - h1 - h2
    q = shear * (h2 - h1)
    s = (d2 - h1) * (d2 - h2) - r * h1 * h2
    i = 12 * s + p * p
    j = 72 * p * s - 27 * q * q - 2 * p**3
    return (4 * i**3 - j * j) / 27


def critical_shear(h1: float, h2: float, r: float) -> float:
    """Return the least |u1 - u2| at which wave speeds become complex; its limit at r = 0, where none ever does.

    A shear of sqrt(h1) + sqrt(h2) always has a complex pair, and below it the verdict changes once: with the shear
    the largest product of (h1 - (x - u1)^2) and (h2 - (x - u2)^2) between the layers' own speeds falls, and a pair is
    complex where it is less than r h1 h2.
    """
    low, high = 0.0, math.sqrt(h1) + math.sqrt(h2)
    if r == 0:
        return high
    while low < (middle := 0.5 * (low + high)) < high:
        if discriminant(h1, h2, middle, r) < 0:
            high = middle
        else:
            low = middle
    return low


def velocities(h1: float, h2: float, r: float, shear: float, drift: float = 0.0) -> tuple[float, float]:
    """Return (u1, u2) that differ by `shear`, in the frame where r h1 u1 + h2 u2 = 0, plus `drift`."""
    mass = r * h1 + h2
    return drift + shear * h2 / mass, drift - shear * r * h1 / mass


def mode(h1: float, u1: float, h2: float, u2: float, r: float) -> tuple[complex, np.ndarray]:
    """Return the speed and the form of the wave on the interface.

    Of the inner pair it is the wave that grows, or the faster one where none does.

    Parameters
    ----------
    h1, u1, h2, u2
        Depths and speeds of the layers, scaled.
    r
        Density of water over density of grains.

    Returns
    -------
    tuple of complex and ndarray
        Speed, and (dh1, du1, dh2, du2), complex, with max(abs(dh1), abs(dh2)) = 1.
    """
    four = speeds(h1, u1, h2, u2, r)
    complex_pair = four[np.abs(four.imag) > 1e-7 * np.abs(four).max()]
    c = complex_pair[np.argmax(complex_pair.imag)] if complex_pair.size else four[2].real
    dh1 = 1.0 + 0j
    dh2 = (c - u1) ** 2 / h1 - 1
    wave = np.array([dh1, (c - u1) * dh1 / h1, dh2, (c - u2) * dh2 / h2])
    return c, wave / max(abs(dh1), abs(dh2))


def base(point: Point) -> tuple[float, float, float, float]:
    """Return (h1, u1, h2, u2) of the point's layers without the wave."""
    chosen = options(point)
    h1, h2 = point.a_H, 1.0
    u1, u2 = velocities(h1, h2, point.r, chosen["shear"] * critical_shear(h1, h2, point.r), chosen["drift"])
    return h1, u1, h2, u2


def wave_number(point: Point) -> float:
    """Return the scaled wave number of the point's wave, which fits the periodic box `mode` times."""
    return options(point)["mode"] * math.pi / point.half_box
