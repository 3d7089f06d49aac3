"""Standing waves of small amplitude in both layers at rest, without friction, between walls.

Linear theory of two layers (Lamb 1932, Hydrodynamics, article 231, in shallow water): c^2 = g H / 2 (1 +- sqrt(1 -
4 (1-r) h1 h2 / H^2)), H = h1 + h2, and the layers move in the ratio dh2/dh1 = c^2 / (g h1) - 1. Errors are of the
order of the amplitude.
"""

import math

import numpy as np

from subslide.exact import frictionless, half_box, in_metres, scaled
from subslide.exact._bessel import bessel, zero_of_j1

DEFAULTS = {"kind": "surface", "shape": "line", "amplitude": 1e-5, "mode": 2}
"""Options of the scene that a point leaves out."""


def speed(kind, h1, h2, r, g=1.0):
    """Return the wave speed of the "surface" or the "internal" mode."""
    H = h1 + h2
    root = math.sqrt(max(0.0, 1 - 4 * (1 - r) * h1 * h2 / H**2))
    if kind == "surface":
        return math.sqrt(0.5 * g * H * (1 + root))
    return math.sqrt(2 * g * (1 - r) * h1 * h2 / (H * (1 + root)))


def parts(kind, h1, h2, r):
    """Return (dh1, dh2) of the mode, the larger of the two 1 in size and dh1 not negative."""
    ratio = speed(kind, h1, h2, r) ** 2 / h1 - 1
    size = max(1.0, abs(ratio))
    return 1.0 / size, ratio / size


def wave_number(shape, mode, half):
    """Return k of the wave with `mode` half wavelengths between walls at -half and half, or in the ring's radius."""
    return zero_of_j1(mode) / half if shape == "round" else mode * math.pi / (2 * half)


def form(shape, k, x, half):
    """Return the wave's form at x: 1 at the left wall of a line, or on the axis."""
    return bessel(0, k * np.asarray(x)) if shape == "round" else np.cos(k * (np.asarray(x) + half))


def form_mean(shape, k, edges, half):
    """Return the means (n) of the form over cells or rings between `edges` (n + 1)."""
    if shape == "round":
        return np.diff(edges * bessel(1, k * edges) / k) / (0.5 * np.diff(edges**2))
    return np.diff(np.sin(k * (edges + half)) / k) / np.diff(edges)


def amplitude(point, time):
    """Return the wave's amplitude over H2 when it turns, at any time."""
    return {**DEFAULTS, **dict(point.scene_options)}["amplitude"]


def solution(point, x, time):
    """Return h2 and eta (m) at x (m); known without friction, and for one layer where r = 0."""
    own = {**DEFAULTS, **dict(point.scene_options)}
    s, t = scaled(point, x, time)
    half = half_box(point)
    k = wave_number(own["shape"], own["mode"], half)
    omega = k * speed(own["kind"], point.a_H, 1.0, point.r)
    wave = own["amplitude"] * form(own["shape"], k, s, half) * math.cos(omega * t)
    if not frictionless(point):
        wave = np.full(s.shape, np.nan)
    dh1, dh2 = parts(own["kind"], point.a_H, 1.0, point.r)
    return in_metres(point, 1.0 + dh2 * wave, (dh1 + dh2) * wave)
