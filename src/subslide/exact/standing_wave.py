"""Standing waves of small amplitude in both layers at rest, without friction, between walls.

Linear theory of two layers (Lamb 1932, Hydrodynamics, article 231, in shallow water): c^2 = g H / 2 (1 +- sqrt(1 -
4 (1-r) h1 h2 / H^2)), H = h1 + h2, and the layers move in the ratio dh2/dh1 = c^2 / (g h1) - 1. Errors are of the
order of the amplitude.
"""

import math

import numpy as np

from subslide.exact import Profiles, frictionless, in_metres, scaled
from subslide.points import Point
from subslide.scenes import options
from subslide.scenes._bessel import bessel
from subslide.scenes.standing_wave import parts, speed, wave_number


def form(shape: str, k: float, x: float | np.ndarray, half: float) -> np.ndarray:
    """Return the wave's form at x: 1 at the left wall of a line, or on the axis."""
    return bessel(0, k * np.asarray(x)) if shape == "round" else np.cos(k * (np.asarray(x) + half))


def amplitude(point: Point, time: float) -> float:
    """Return the wave's amplitude over H2 when it turns, at any time."""
    return options(point)["amplitude"]


def solution(point: Point, x: float | np.ndarray, time: float) -> Profiles:
    """Return h2 and eta (m) at x (m); known without friction, and for one layer where r = 0."""
    chosen = options(point)
    s, t = scaled(point, x, time)
    half = point.half_box
    k = wave_number(chosen["shape"], chosen["mode"], half)
    omega = k * speed(chosen["kind"], point.a_H, 1.0, point.r)
    wave = chosen["amplitude"] * form(chosen["shape"], k, s, half) * math.cos(omega * t)
    if not frictionless(point):
        wave = np.full(s.shape, np.nan)
    dh1, dh2 = parts(chosen["kind"], point.a_H, 1.0, point.r)
    return in_metres(point, 1.0 + dh2 * wave, (dh1 + dh2) * wave)
