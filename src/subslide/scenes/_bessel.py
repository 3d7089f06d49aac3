"""Bessel functions J0 and J1 from Bessel's integral: the trapezoid rule converges faster than any power."""

import math

import numpy as np


def bessel(n: int, x: float | np.ndarray) -> np.ndarray:
    """Return J_n(x), the mean over a turn of cos(n t - x sin t), to round-off.

    Parameters
    ----------
    n
        0 or 1.
    x
        Arguments, -1000 to 1000.

    Returns
    -------
    ndarray
        Values, of the shape of `x`.
    """
    x = np.asarray(x, float)
    points = 64 + 2 * int(np.max(np.abs(x), initial=0.0))
    total = np.zeros(x.shape)
    for t in np.arange(points) * (2 * math.pi / points):
        total += np.cos(n * t - x * math.sin(t))
    return total / points


def zero_of_j1(n: int) -> float:
    """Return the n-th positive zero of J1, where J0 has slope 0: Newton's method from McMahon's estimate."""
    x = (n + 0.25) * math.pi
    for _ in range(8):
        j1 = float(bessel(1, x))
        x -= j1 / (float(bessel(0, x)) - j1 / x)
    return x
