"""Values checked by the entries of their keys, and the lists of keys that follow from the entries."""

import contextlib
import json
import math
from collections.abc import Callable, Iterator
from typing import Any

from subslide.keys.entries import ENTRIES, Entry
from subslide.keys.words import refusal, show

_checks: dict[int, tuple[Entry, Callable]] = {}
"""Compiled check of each entry, by the entry's place in memory."""


class ConfigError(ValueError):
    """Bad input: one line that names the key, its value and what is allowed."""


def refused(name: str, value: Any, allowed: str) -> ConfigError:
    """Return the error on a value that is not allowed.

    Parameters
    ----------
    name
        What the message calls its key.
    value
        What was given.
    allowed
        What is allowed, and a hint at it.

    Returns
    -------
    ConfigError
        To be raised.
    """
    return ConfigError(f"{name}: {show(value)} is not allowed; allowed: {allowed}")


@contextlib.contextmanager
def placed(place: str) -> Iterator[None]:
    """Put the place of a key before the message, which begins with the key, of a ConfigError raised in this context.

    Parameters
    ----------
    place
        What stands before the message.

    Yields
    ------
    None
        Nothing.
    """
    try:
        yield
    except ConfigError as error:
        raise ConfigError(f"{place}{error}") from None


def properties() -> dict[str, Entry]:
    """Return the entry of each key by name, in the order of tables and axes."""
    return ENTRIES


def with_role(*roles: str) -> tuple[str, ...]:
    """Return the keys that have one of these roles (study, preset, physics, scene, method, output), in order."""
    return tuple(key for key, about in ENTRIES.items() if about["role"] in roles)


def run_keys() -> tuple[str, ...]:
    """Return the keys that one run has a value of, in order."""
    return with_role("physics", "scene", "method", "output")


def is_axis(key: str) -> bool:
    """Return whether a study may give a list for this key, one run for each entry."""
    return ENTRIES[key].get("axis", False)


def is_integer(about: Entry) -> bool:
    """Return whether an entry takes whole numbers alone."""
    if "enum" in about:
        return all(type(value) is int for value in about["enum"])
    return about.get("type") == "integer"


def is_real(about: Entry) -> bool:
    """Return whether an entry takes numbers, alone or beside a word."""
    return any(part.get("type") == "number" for part in (about, *about.get("anyOf", ())))


def checked(key: str, value: Any, name: str = "") -> Any:
    """Return a value as its key wants it.

    Parameters
    ----------
    key
        Key of a study.
    value
        What a file or an option gives for it.
    name
        What messages call the key, if it is not its name.

    Returns
    -------
    object
        The value; a whole number as an integer where the key takes no other.

    Raises
    ------
    ConfigError
        If the value is not allowed: one line.
    """
    return conform(ENTRIES[key], value, name or key)


def conform(about: Entry, value: Any, name: str) -> Any:
    """Return a value as an entry wants it, such as that of a scene's option.

    Parameters
    ----------
    about
        Entry of a key or an option.
    value
        What a file or an option of the command line gives for it.
    name
        What messages call it.

    Returns
    -------
    object
        The value; a whole number as an integer where the entry takes no other.

    Raises
    ------
    ConfigError
        If the value is not allowed: one line.
    """
    import fastjsonschema

    try:
        if not _finite(value):
            raise ConfigError
        _check(about)(value)
    except (ConfigError, fastjsonschema.JsonSchemaValueException, OverflowError):
        raise ConfigError(refusal(about, value, name)) from None
    return int(value) if is_integer(about) else value


def _check(about: Entry) -> Callable:
    """Return the function that raises unless its argument satisfies an entry."""
    import fastjsonschema  # a tenth of the start-up time of jsonschema

    known, check = _checks.get(id(about), (None, None))
    if known is not about or check is None:
        check = fastjsonschema.compile(json.loads(json.dumps(about)))
        _checks[id(about)] = about, check  # kept with its entry, so that no other has its id
    return check


def _finite(value: Any) -> bool:
    """Return whether a value, or each of a list, and of lists in it, is finite where it is a number."""
    values = value if isinstance(value, list) else [value]
    inner = (v for part in values for v in (part if isinstance(part, list) else [part]))
    return all(not isinstance(v, float) or math.isfinite(v) for v in inner)
