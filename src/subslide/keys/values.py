"""Values of a run by key: as a configuration states them, as a point holds them, and as the text that gives its id."""

import functools
import json
from collections.abc import Collection, Mapping
from typing import Any

from subslide.keys import names, schema
from subslide.keys.entries import ENTRIES

RUN_KEYS = schema.run_keys()
"""Keys that a run has a value of, in the order of tables and axes."""

FLOATS = frozenset(key for key in RUN_KEYS if schema.is_real(ENTRIES[key]))
INTEGERS = frozenset(key for key in RUN_KEYS if schema.is_integer(ENTRIES[key]))

STANDS_FOR = {key: ENTRIES[key]["default"] for key in RUN_KEYS if "anyOf" in ENTRIES[key]}
"""Word, such as 'rest', that None stands for in a point, of each key that takes one beside numbers."""


def default_of(key: str) -> Any:
    """Return the value that a point has of a key by default.

    Parameters
    ----------
    key
        One of `RUN_KEYS`.

    Returns
    -------
    object
        The value, as a point holds it.
    """
    return held(key, ENTRIES[key]["default"])


def held(key: str, value: Any) -> Any:
    """Return the checked value of a key as a point holds it.

    Parameters
    ----------
    key
        One of `RUN_KEYS`.
    value
        Its value as a configuration states it.

    Returns
    -------
    object
        The value, in one number format; None for a word that stands beside numbers.
    """
    if value is None or value == STANDS_FOR.get(key):
        return None
    if key == "scene_options":
        return tuple(sorted(value.items()))
    if key == "snapshot_times":
        return tuple(sorted({float(t) for t in value}))
    if key == "gauges":
        return tuple(tuple(map(float, place)) for place in value)
    if key in FLOATS:
        return float(value)
    return int(value) if key in INTEGERS else value


def stated(key: str, value: Any) -> Any:
    """Return the value of a key as a configuration would state it; the inverse of `held`.

    Parameters
    ----------
    key
        One of `RUN_KEYS`.
    value
        Its value as a point holds it.

    Returns
    -------
    object
        The value, in one number format.
    """
    if value is None:
        return STANDS_FOR[key]
    if key == "scene_options":
        return dict(value)
    if key == "snapshot_times":
        return [float(t) + 0.0 for t in value]
    if key == "gauges":
        return [[x + 0.0, y + 0.0] for x, y in value]
    return float(value) + 0.0 if key in FLOATS else value  # -0.0 becomes 0.0


def text(values: Mapping[str, Any], left_out: Collection[str]) -> str:
    """Return the text of a run's values in one number format and one order of keys.

    A value that has meant something else before has another word there, and a key that came later is left out where it
    changes nothing.

    Parameters
    ----------
    values
        Value by key as a point holds it; defaults stand for what is left out, and other keys say nothing.
    left_out
        Options of the scene that the text is to be without.

    Returns
    -------
    str
        Compact JSON.
    """
    parts = _PARTS.copy()
    for key, value in values.items():
        if key in FLOATS and value is not None:
            parts[key] = f'"{key}":{float(value) + 0.0!r}'
        elif key == "scene_options":
            if value:
                parts[key] = _part(key, tuple(pair for pair in value if pair[0] not in left_out))
        elif key in parts:
            parts[key] = _word(key, value) if isinstance(value, str | int) else _part(key, value)
    return "{" + ",".join(filter(None, parts.values())) + "}"


def compact(value: Any) -> str:
    """Return a value as compact JSON, in one order.

    Parameters
    ----------
    value
        Numbers, texts, lists and mappings.

    Returns
    -------
    str
        JSON.
    """
    return json.dumps(value, separators=(",", ":"), sort_keys=True)


def _part(key: str, value: Any) -> str:
    """Return the text of a key and its value in the text of a run, '' if it is left out."""
    if key in names.LATER and value == names.LATER[key]:
        return ""
    if key in names.KNOWN_AS:
        value = names.KNOWN_AS[key].get(value, value)
    return f'"{key}":{compact(stated(key, value))}'


_word = functools.lru_cache(4096, typed=True)(_part)
"""The same for words, true and false, and whole numbers, of which a study has few."""

_PARTS = {key: _part(key, default_of(key)) for key in sorted(RUN_KEYS)}
"""Texts of the defaults, in the order that they have in the text of a run."""
