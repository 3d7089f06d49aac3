"""Texts of options of the command line as values of keys, read by the rules of files."""

import functools
from typing import Any

from subslide.keys import plain, schema, words
from subslide.keys.schema import ConfigError
from subslide.study import scene_options


def value_of(key: str, text: Any, name: str) -> Any:
    """Return the value, unchecked, of a key that the text of its option stands for.

    Parameters
    ----------
    key
        Key of a run, or of a limit.
    text
        The text: a value, values between commas, lists of these between semicolons where the key takes such, or options
        of a scene. Anything else is the value itself.
    name
        What messages call the option.

    Returns
    -------
    object
        The value, as a file would state it.

    Raises
    ------
    ConfigError
        If the text cannot be read: one line.
    """
    if not isinstance(text, str):
        return text
    if key == "scene_options":
        return scene_options.of_text(text, functools.partial(_listed, name=name))
    if schema.properties()[key].get("type") == "array":
        return [_listed(part, name) for part in text.split(";")]
    return _listed(text, name)


def _listed(text: str, name: str) -> Any:
    """Return what a text stands for: a value as in a file, or a list of such values parted by commas."""
    if plain.control(text):
        raise ConfigError(f"{name}: {words.show(text)} has a control character; allowed: text in one line")
    values = []
    for part in map(str.strip, text.split(",")):
        if not part and "," in text:
            raise ConfigError(f"{name}: {words.show(text)} has an empty part; allowed: values between commas")
        try:
            values.append(plain.value_of(part))
        except ValueError as error:
            raise ConfigError(f"{name}: {words.cut(part)} {error}") from None
    return values if "," in text else values[0]
