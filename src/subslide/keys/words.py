"""Words about keys and their values: what messages, help and documentation call them."""

import difflib
import json
import math
import re
from collections.abc import Iterable
from typing import Any

from subslide.keys import plain
from subslide.keys.entries import ENTRIES, Entry

MOST = 300
"""Characters of a line to a user."""


def printable(text: str, most: int = MOST) -> str:
    """Return a message as one line that no terminal takes for orders.

    Parameters
    ----------
    text
        Message, with whatever the user gave in it.
    most
        Characters that it may have; a longer one is cut in the middle, since its end says what is allowed.

    Returns
    -------
    str
        The line; control characters, halves of pairs and the like are written out, as in Python.
    """
    text = _cut_in_the_middle(text, 10 * most)  # so that a huge one takes no time
    letters = (c if c.isprintable() else c.encode("unicode_escape").decode() for c in one_line(text))
    return _cut_in_the_middle("".join(letters), most)


def one_line(text: str) -> str:
    """Return a text with single spaces for its blanks and ends of lines; other characters that look so stay."""
    return re.sub("[ \t\r\n]+", " ", text).strip(" ")


def _cut_in_the_middle(text: str, most: int) -> str:
    """Return a text of at most so many characters: its beginning and its end."""
    half = (most - 3) // 2
    return text if len(text) <= most else f"{text[:half]}...{text[-half:]}"


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
    if isinstance(value, str):
        return cut(one_line(value) if plain.is_text(value) else f"'{value}'") or "''"
    try:
        return cut(one_line(json.dumps(value, default=str)))
    except (
        ValueError,
        TypeError,
        RecursionError,
    ):  # an integer of thousands of digits, a list within itself, ...
        return f"a value of type {type(value).__name__}"


def cut(text: str, most: int = 60) -> str:
    """Return the beginning of a long text.

    Parameters
    ----------
    text
        Any text.
    most
        Characters that it may have.

    Returns
    -------
    str
        The text, or its beginning and '...'.
    """
    return text if len(text) <= most else text[: most - 3] + "..."


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
    end = f" ({unit_of(about)})" if unit_of(about) else ""
    allows = f"allowed: {range_of(about)}{end}"
    once = any(part.get("uniqueItems") for part in (about, *about.get("anyOf", ())))
    if once and isinstance(value, list) and (twice := [v for n, v in enumerate(value) if v in value[:n]]):
        return f"{name}: {show(twice[0])} is there twice; {allows}, each once"
    if isinstance(value, str) and not plain.is_text(value) and _takes_others(about):
        return f"{name}: {show(value)} is text; {allows}, without quotes"
    if isinstance(value, int | float) and about.get("type") == "string" and "enum" not in about:
        kind = "true or false" if isinstance(value, bool) else "a number"
        return f"{name}: {show(value)} is {kind}; {allows}; as text it stands in quotes"
    hint = closest(value, map(str, choices(about))) if isinstance(value, str) else ""
    return f"{name}: {show(value)} is not allowed; {allows}{hint}"


def _takes_others(about: Entry) -> bool:
    """Return whether an entry takes numbers, or true and false, alone or beside words."""
    parts = (about, *about.get("anyOf", ()))
    return any(part.get("type") in ("number", "integer", "boolean") for part in parts) or any(
        not isinstance(value, str) for value in choices(about)
    )


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
    if about.get("type") == "array":
        return "X,Y;..."
    listed = "".join(f"{name}|" for name in choices(about))
    by_unit = {"degree": "DEG", "s": "S"}.get(about.get("unit", ""), "F")
    letter = "N" if about.get("type") == "integer" else by_unit
    many = ",..." if any(part.get("type") == "array" for part in about.get("anyOf", ())) else ""
    return listed + letter + many
