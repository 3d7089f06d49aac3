"""Words about keys and their values: what messages, help and documentation call them."""

import difflib
import json
import math
from collections.abc import Iterable
from typing import Any

from subslide.keys.entries import ENTRIES, Entry


def closest(name: Any, known: Iterable[str]) -> str:
    """Return a hint at the known name that is nearest to a mistyped one.

    Parameters
    ----------
    name
        What was given, text as a rule.
    known
        Names that are allowed.

    Returns
    -------
    str
        "; did you mean '...'?", or '' if none is near.
    """
    lower = {other.lower(): other for other in known}
    near = difflib.get_close_matches(str(name).lower(), lower, n=1, cutoff=0.5)
    return f"; did you mean '{lower[near[0]]}'?" if near else ""


def allowed(key: str) -> str:
    """Return words for the values that a key may take, such as 'a number from 0 to below 1'."""
    return range_of(ENTRIES[key])


def range_of(about: Entry) -> str:
    """Return words for the values that an entry, of a key or of a scene's option, allows."""
    if "allowed" in about:
        return about["allowed"]
    if "enum" in about:
        return ("one of " if len(about["enum"]) > 1 else "only ") + ", ".join(map(str, about["enum"]))
    if about["type"] == "boolean":
        return "true or false"
    noun = "a whole number" if about["type"] == "integer" else "a number"
    low = f"from {about['minimum']:g}" if "minimum" in about else f"above {about['exclusiveMinimum']:g}"
    high = f"to {about['maximum']:g}" if "maximum" in about else f"to below {about['exclusiveMaximum']:g}"
    return f"{noun} {low} {high}"


def unit(key: str) -> str:
    """Return the unit of a key for people, '' if it has none."""
    return unit_of(ENTRIES[key])


def unit_of(about: Entry) -> str:
    """Return the unit that an entry states, for people; '' if it has none."""
    text = about.get("unit", "")
    return "" if text == "1" else text


def show(value: Any) -> str:
    """Return short text of a value as a configuration would write it."""
    if value is None:
        return "nothing"
    if isinstance(value, float) and not math.isfinite(value):
        return {"nan": ".nan", "inf": ".inf", "-inf": "-.inf"}[str(value)]
    if isinstance(value, str) and _looks_like_number(value):
        value = f"'{value}'"
    try:
        text = value if isinstance(value, str) else json.dumps(value, default=str)
    except (ValueError, TypeError, RecursionError):
        text = repr(value)
    text = " ".join(text.split()) or "''"
    return text if len(text) <= 60 else text[:57] + "..."


def refusal(about: Entry, value: Any, name: str) -> str:
    """Return the message on a value that an entry does not allow.

    Parameters
    ----------
    about
        Entry of a key or an option.
    value
        What was given for it.
    name
        What the message calls it.

    Returns
    -------
    str
        One line: the name, the value, what is allowed, and the nearest word to a mistyped one.
    """
    hint = closest(value, map(str, choices(about))) if isinstance(value, str) else ""
    end = f" ({unit_of(about)})" if unit_of(about) else ""
    return f"{name}: {show(value)} is not allowed; allowed: {range_of(about)}{end}{hint}"


def choices(about: Entry) -> list:
    """Return the values that an entry lists one by one."""
    return [value for part in (about, *about.get("anyOf", ())) for value in part.get("enum", ())]


def metavar(key: str) -> str:
    """Return short text that stands for a value of a key in help, such as 'F' or 'ifcph|hll'."""
    about = ENTRIES[key]
    if "enum" in about:
        return "|".join(map(str, about["enum"]))
    if about.get("type") == "object":
        return "NAME=VALUE,..."
    listed = "".join(f"{name}|" for name in choices(about))
    by_unit = {"degree": "DEG", "s": "S"}.get(about.get("unit", ""), "F")
    letter = "N" if about.get("type") == "integer" else by_unit
    many = ",..." if any(part.get("type") == "array" for part in about.get("anyOf", ())) else ""
    return listed + letter + many


def _looks_like_number(text: str) -> bool:
    """Return whether text would be read as a number without quotes."""
    try:
        float(text)
    except ValueError:
        return False
    return True
