"""Forms of a numeric axis, such as {linspace: [0, 1, 11]}, as the lists that they stand for."""

import math
from typing import Any

from subslide.keys import words
from subslide.keys.designs import FORMS, MOST_POINTS
from subslide.keys.schema import ConfigError, refused

ALMOST = 1e-9
"""Part of a step by which the last value of an arange may be missed, and still is hit."""


def rounded(value: float, scale: float = 0.0) -> float:
    """Return a number that was made, to 12 significant digits, so that no id hangs on a library's last bit.

    Parameters
    ----------
    value
        The number.
    scale
        Size of the numbers that it was made from: what is lost beside it is 0.

    Returns
    -------
    float
        The number that is meant.
    """
    return 0.0 if abs(value) < 1e-12 * scale else float(f"{value:.12g}")


def numbers(form: dict[str, Any], name: str) -> list[float]:
    """Return the list that a form stands for.

    Parameters
    ----------
    form
        Mapping with one of `FORMS`.
    name
        What messages call it.

    Returns
    -------
    list of float
        The numbers, to 12 digits; the first and the last as they were given.

    Raises
    ------
    ConfigError
        If it is no such mapping: one line.
    """
    kind = next(iter(form), None)
    if len(form) != 1 or kind not in FORMS:
        hint = words.closest(kind, FORMS) if len(form) == 1 else ""
        known = ", ".join(f"{{{key}: [{', '.join(parts)}]}}" for key, parts in FORMS.items())
        raise refused(name, form, f"a number, a list of numbers, {known}{hint}")
    given, name = form[kind], f"{name}: {kind}"
    if not are_numbers(given, len(FORMS[kind])):
        raise refused(name, given, f"[{', '.join(FORMS[kind])}], three numbers")
    first, last, third = given
    if kind == "arange":
        return _arange(first, last, third, name)
    if third != int(third) or not 2 <= third <= MOST_POINTS:
        raise ConfigError(
            f"{name}: a count of {words.show(third)} is not allowed; allowed: a whole number from 2 to {MOST_POINTS}"
        )
    steps = int(third) - 1
    if kind == "linspace":
        inner = [first + (last - first) * (n / steps) for n in range(1, steps)]
    else:
        if first * last <= 0:
            raise refused(name, given, "first and last above 0, or both below")
        inner = [first * (last / first) ** (n / steps) for n in range(1, steps)]
    return [first, *(rounded(value, max(abs(first), abs(last))) for value in inner), last]


def are_numbers(values: Any, count: int) -> bool:
    """Return whether a value is a list of so many finite numbers.

    Parameters
    ----------
    values
        What a file gives.
    count
        How many there should be.

    Returns
    -------
    bool
        False also for true and false, which are no numbers.
    """
    return (
        isinstance(values, list)
        and len(values) == count
        and all(isinstance(v, int | float) and not isinstance(v, bool) for v in values)
        and all(abs(v) <= 1e300 and math.isfinite(v) for v in values)
    )


def _arange(first: float, last: float, step: float, name: str) -> list[float]:
    """Return the numbers from the first by steps to the last, which is one of them where it is hit."""
    if step == 0 or (last - first) * step < 0:
        raise ConfigError(
            f"{name}: a step of {words.show(step)} is not allowed; allowed: a number that leads from first to last"
        )
    steps = (last - first) / step
    if not steps < MOST_POINTS:
        raise ConfigError(f"{name}: more than {MOST_POINTS} values; allowed: at most {MOST_POINTS}")
    whole = math.floor(steps + ALMOST)
    values = [first, *(rounded(first + n * step, max(abs(first), abs(last))) for n in range(1, whole + 1))]
    if whole and steps - whole < ALMOST:
        values[-1] = last
    return values
