"""Coordinates of the emulator: what answers vary smoothly with."""

import math

import numpy as np

RANGE = {
    "a_H": (0.5, 10.0),
    "r": (0.0, 0.8),
    "m": (math.tan(math.radians(20)) / 1.5, math.tan(math.radians(40)) / 0.3),
}
"""Columns that may be learned: those at which bands were calibrated, in the similarity variables (a_H, r, m)."""

GRAINS, WATER = "grains", "water"
"""Kinds of coordinates: grains go by ln m, water by ln(m sqrt((1-r)/(1+a_H))), a wave's time over that of arrest."""

CENTRE = {
    kind: tuple(np.mean(ends) for ends in ((math.log(0.5), math.log(10)), (0, 0.8), third))
    for kind, third in (
        (GRAINS, (math.log(RANGE["m"][0]), math.log(RANGE["m"][1]))),
        (WATER, (-3.4, 0.9)),
    )
}
HALF = {GRAINS: (1.4979, 0.4, 1.2224), WATER: (1.4979, 0.4, 2.1)}
"""Middle, and half of the range, of each coordinate."""


def of(kind: str, inputs: np.ndarray) -> np.ndarray:
    """Return coordinates of about -1 to 1.

    Parameters
    ----------
    kind
        GRAINS or WATER.
    inputs
        Rows (n, 3) of a_H, r and m.

    Returns
    -------
    ndarray
        Coordinates (n, 3).
    """
    a_H, r, m = inputs.T
    third = np.log(m)
    if kind == WATER:
        third = third + 0.5 * np.log((1 - r) / (1 + a_H))
    return (np.stack([np.log(a_H), r, third], axis=1) - CENTRE[kind]) / HALF[kind]


def of_errors(z: np.ndarray) -> np.ndarray:
    """Return `quadratic` and powers of the third coordinate, (n, 12): errors are largest at either end of it."""
    return np.concatenate([quadratic(z), z[:, 2:] ** 3, z[:, 2:] ** 4], axis=1)


def quadratic(z: np.ndarray) -> np.ndarray:
    """Return 1, the coordinates and their products in pairs, (n, 10), of coordinates (n, 3)."""
    x, y, w = z.T
    return np.stack([np.ones(len(z)), x, y, w, x * x, x * y, x * w, y * y, y * w, w * w], axis=1)
