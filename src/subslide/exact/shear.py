"""Small waves on two uniform layers that slide over each other without friction: linear theory of shallow layers.

A wave exp(i k (x - c t)) has a speed c that solves ((c - u1)^2 - h1) ((c - u2)^2 - h2) = r h1 h2, whatever its length.
From the shear `critical_shear` on, two of the four speeds are a complex pair and the wave grows at the rate k Im(c),
up to a shear so large that the four speeds part again.

No wave grows fastest: the rate rises with k without end, so that on a grid the errors of single cells outgrow any wave
in time. A scheme of first order is linear in small waves and errs by round-off alone, a share of 1e-16 / amplitude;
on n cells a wavelength its fastest waves are 4 or 5 cells long and grow n/9 times as fast as the wave (their rate less
the scheme's viscosity, measured), so that with an amplitude of 1e-5 growth by e^G is clean while G < 25 / (n/9 - 1).
The limiter of second order errs at each crest by (2 pi/n)^2 or so, and its fastest waves grow n/6 times as fast: G up
to 1/4 is clean on n from 50 to 200. Errors of linear theory are of the order of the amplitude at the end.
"""

import math

import numpy as np

from subslide.exact import Profiles, frictionless, in_metres, scaled
from subslide.points import Point
from subslide.scenes import options
from subslide.scenes.shear import base, mode, state, wave_number


def growth_rate(point: Point) -> float:
    """Return the rate (1/s) at which the amplitude of the point's wave grows: k Im(c), 0 where the wave is neutral."""
    layers = base(point)
    rate = wave_number(point) * complex(mode(*layers, point.r)[0]).imag
    return rate / point.time_scale


def amplitude(point: Point, time: float) -> float:
    """Return the wave's amplitude over H2 at the time (s)."""
    start = options(point)["amplitude"]
    return start * math.exp(growth_rate(point) * time)


def solution(point: Point, x: float | np.ndarray, time: float) -> Profiles:
    """Return h2 and eta (m) at x (m) by linear theory; known without friction."""
    s, t = scaled(point, x, time)
    h1, _, h2, _ = state(point, s, t)
    if not frictionless(point):
        h1 = h2 = np.full(s.shape, np.nan)
    return in_metres(point, h2, h1 + h2 - point.scaled_level)


def amplitudes(point: Point, x: np.ndarray, profiles: np.ndarray) -> np.ndarray:
    """Return the amplitude of the point's wave in each of the profiles (snapshots, x): its Fourier coefficient.

    x (m) are the cell centres of the whole box; the result has the profiles' unit.
    """
    turns = np.exp(-1j * wave_number(point) * np.asarray(x) / point.radius)
    return 2 * np.abs(np.asarray(profiles) @ turns) / len(x)


def measured_growth(point: Point, x: np.ndarray, times: np.ndarray, profiles: np.ndarray) -> float:
    """Return the rate (1/s) at which the point's wave grows in profiles of h2 or eta (snapshots, x) at `times` (s).

    It is the slope of the line that fits log(amplitude) best; NaN for less than two times, or no finite amplitude.
    """
    times = np.asarray(times, float)
    sizes = amplitudes(point, x, profiles)
    if np.ptp(times) == 0 or not (np.isfinite(sizes) & (sizes > 0)).all():
        return math.nan
    return float(np.polyfit(times, np.log(sizes), 1)[0])
