"""A round paraboloid of grains alone that spreads without friction (numerically, the radial dry dam break).

Thacker (1981, J. Fluid Mech. 107, 499) gives the family of such solutions, in a basin; this one has a flat bed.
"""

import numpy as np

from subslide.exact import frictionless, in_metres, scaled


def radius(t, h0=1.0, R0=1.0, g=1.0):
    """Return R(t) = sqrt(R0^2 + 2 g h0 t^2), where the depth ends."""
    return np.sqrt(R0**2 + 2 * g * h0 * t**2)


def depth(x, t, h0=1.0, R0=1.0, g=1.0):
    """Return h = h0 (R0/R)^2 (1 - x^2/R^2), 0 beyond R; it solves the shallow-water equations with u = x R'/R."""
    R = radius(t, h0, R0, g)
    return h0 * (R0 / R) ** 2 * np.maximum(0.0, 1.0 - (x / R) ** 2)


def ring_mean(edges, t, h0=1.0, R0=1.0, g=1.0):
    """Return the mean depth (n) of the rings between the radii `edges` (n + 1)."""
    R = radius(t, h0, R0, g)
    s = np.minimum(edges / R, 1.0) ** 2
    volume = h0 * R0**2 * (s / 2 - s**2 / 4)  # over 2 pi, within each radius
    return np.diff(volume) / (np.diff(edges**2) / 2)


def solution(point, x, time):
    """Return h2 and eta (m) at x (m); known without friction and where no water weighs on the grains (r = 0)."""
    s, t = scaled(point, x, time)
    nothing = np.full(s.shape, np.nan)
    known = frictionless(point) and point.r == 0
    return in_metres(point, depth(s, t) if known else nothing, nothing)
