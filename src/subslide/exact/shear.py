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

from subslide.exact import frictionless, half_box, in_metres, scaled

DEFAULTS = {"shear": 1.2, "amplitude": 1e-4, "mode": 1, "drift": 0.0}
"""Options of the scene that a point leaves out."""


def speeds(h1, u1, h2, u2, r):
    """Return the four wave speeds (complex), by real part, of a pair the one that decays first."""
    first = np.poly1d([1, -2 * u1, u1 * u1 - h1])
    second = np.poly1d([1, -2 * u2, u2 * u2 - h2])
    found = (first * second - r * h1 * h2).roots.astype(complex)
    return found[np.lexsort((found.imag, np.round(found.real, 9)))]


def discriminant(h1, h2, shear, r):
    """Return the discriminant of the quartic of the speeds, (4 I^3 - J^2) / 27: negative where a pair is complex."""
    d2 = shear * shear / 4
    p = -2 * d2 - h1 - h2
    q = shear * (h2 - h1)
    s = (d2 - h1) * (d2 - h2) - r * h1 * h2
    i = 12 * s + p * p
    j = 72 * p * s - 27 * q * q - 2 * p**3
    return (4 * i**3 - j * j) / 27


def critical_shear(h1, h2, r):
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


def velocities(h1, h2, r, shear, drift=0.0):
    """Return (u1, u2) that differ by `shear`, in the frame where r h1 u1 + h2 u2 = 0, plus `drift`."""
    mass = r * h1 + h2
    return drift + shear * h2 / mass, drift - shear * r * h1 / mass


def mode(h1, u1, h2, u2, r):
    """Return the speed of the wave on the interface, and (dh1, du1, dh2, du2) of it: complex, max(|dh1|, |dh2|) = 1.

    Of the inner pair it is the wave that grows, or the faster one where none does.
    """
    found = speeds(h1, u1, h2, u2, r)
    complex_pair = found[np.abs(found.imag) > 1e-7 * np.abs(found).max()]
    c = complex_pair[np.argmax(complex_pair.imag)] if complex_pair.size else found[2].real
    dh1 = 1.0 + 0j
    dh2 = (c - u1) ** 2 / h1 - 1
    wave = np.array([dh1, (c - u1) * dh1 / h1, dh2, (c - u2) * dh2 / h2])
    return c, wave / max(abs(dh1), abs(dh2))


def base(point):
    """Return (h1, u1, h2, u2) of the point's layers without the wave."""
    own = {**DEFAULTS, **dict(point.scene_options)}
    h1, h2 = point.a_H, 1.0
    u1, u2 = velocities(h1, h2, point.r, own["shear"] * critical_shear(h1, h2, point.r), own["drift"])
    return h1, u1, h2, u2


def wave_number(point):
    """Return the scaled wave number of the point's wave, which fits the periodic box `mode` times."""
    return {**DEFAULTS, **dict(point.scene_options)}["mode"] * math.pi / half_box(point)


def growth_rate(point):
    """Return the rate (1/s) at which the amplitude of the point's wave grows: k Im(c), 0 where the wave is neutral."""
    layers = base(point)
    rate = wave_number(point) * complex(mode(*layers, point.r)[0]).imag
    return rate / math.sqrt(point.radius / (point.g * point.a_2))


def amplitude(point, time):
    """Return the wave's amplitude over H2 at the time (s)."""
    start = {**DEFAULTS, **dict(point.scene_options)}["amplitude"]
    return start * math.exp(growth_rate(point) * time)


def state(point, x, t=0.0, half_cell=0.0):
    """Return (h1, u1, h2, u2) with the wave at scaled places x (n) and time t: means over x -+ half_cell."""
    layers = base(point)
    k = wave_number(point)
    c, wave = mode(*layers, point.r)
    size = amplitude(point, 0.0) * np.sinc(k * half_cell / math.pi)
    form = size * np.exp(1j * k * (np.asarray(x) - c * t))
    return tuple(value + (part * form).real for value, part in zip(layers, wave, strict=True))


def solution(point, x, time):
    """Return h2 and eta (m) at x (m) by linear theory; known without friction."""
    s, t = scaled(point, x, time)
    h1, _, h2, _ = state(point, s, t)
    if not frictionless(point):
        h1 = h2 = np.full(s.shape, np.nan)
    return in_metres(point, h2, h1 + h2 - (1.0 + point.a_H))


def amplitudes(point, x, profiles):
    """Return the amplitude of the point's wave in each of the profiles (snapshots, x): its Fourier coefficient.

    x (m) are the cell centres of the whole box; the result has the profiles' unit.
    """
    turns = np.exp(-1j * wave_number(point) * np.asarray(x) / point.radius)
    return 2 * np.abs(np.asarray(profiles) @ turns) / len(x)


def measured_growth(point, x, times, profiles):
    """Return the rate (1/s) at which the point's wave grows in profiles of h2 or eta (snapshots, x) at `times` (s).

    It is the slope of the line that fits log(amplitude) best; NaN for less than two times, or no finite amplitude.
    """
    times = np.asarray(times, float)
    found = amplitudes(point, x, profiles)
    if np.ptp(times) == 0 or not (np.isfinite(found) & (found > 0)).all():
        return math.nan
    return float(np.polyfit(times, np.log(found), 1)[0])
