"""What figures say: symbols, units that read well, and values with both."""

from typing import NamedTuple

import numpy as np

from subslide import naming

THRESHOLD = naming.FRONT_THRESHOLDS[0]
"""Depth that defines the front in figures, as a fraction of H2."""
FRONT = f"front where $h_2$ = {THRESHOLD:.0%} of $H_2$"
SYMBOLS = {
    "a_H": "$a_H$",
    "a_2": "$a_2$",
    "r": "$r$",
    "delta": "$\\delta$",
    "radius": "$R$",
    "x": "$x$",
    "time": "$t$",
    "h2": "$h_2$",
    "eta": "$\\eta$",
    "x_front": "$x_\\mathrm{front}$",
    "L_f": "$L_f$",
    "max_abs_eta": "max$\\,|\\eta|$",
}
"""Symbols of `subslide.naming` as print sets them."""


class Unit(NamedTuple):
    """A unit of an axis, and how many of it the SI unit holds."""

    name: str
    factor: float


def length_unit(*values):
    """Return the unit in which lengths (m) up to the largest of `values` read best."""
    return _unit(values, ((0.1, "mm", 1e3), (1.0, "cm", 1e2), (5e3, "m", 1.0), (np.inf, "km", 1e-3)))


def time_unit(*values):
    """Return the unit in which times (s) up to the largest of `values` read best."""
    return _unit(values, ((2.5, "ms", 1e3), (np.inf, "s", 1.0)))


def _unit(values, choices):
    finite = [float(np.nanmax(np.abs(v))) for v in values if np.isfinite(v).any()]
    largest = max(finite, default=0.0)
    return next(Unit(name, factor) for below, name, factor in choices if largest < below)


def label(name, unit):
    """Return the text of an axis: symbol and unit."""
    return f"{SYMBOLS[name]} ({unit.name})"


def number(value):
    """Return a parameter's value as a reader writes it."""
    return f"{value:.4g}" if isinstance(value, float | int | np.number) else str(value)


def equation(name, value):
    """Return 'symbol = value', with the unit where there is one."""
    return f"{SYMBOLS.get(name, name)} = {number(value)}" + ("°" if name == "delta" else "")


def panel(k, text):
    """Return the title of panel `k`."""
    return f"({chr(97 + k)}) {text}"


def moment(time, unit):
    """Return 't = ...' with its unit."""
    return f"{SYMBOLS['time']} = {time * unit.factor:.4g} {unit.name}"
