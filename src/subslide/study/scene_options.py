"""Options of scenes in a configuration: checked against what the scene's module says, and their product along axes."""

import itertools
import math
import re
from collections.abc import Callable
from typing import Any

from subslide import scenes
from subslide.keys import schema, words
from subslide.keys.schema import ConfigError
from subslide.study import forms


def checked(scene: str, given: dict[str, Any], key: str) -> dict[str, Any]:
    """Return every option of a scene by name, in one number format.

    Parameters
    ----------
    scene
        Name of the scene.
    given
        Options that are stated; the others have their defaults.
    key
        What messages call the mapping of options.

    Returns
    -------
    dict
        Values by option, also those that follow from the others.

    Raises
    ------
    ConfigError
        If there is no such option, one is missing, or a value is not allowed.
    """
    module = scenes.load(scene)
    for name, value in given.items():
        if name not in module.OPTIONS:
            hint = words.closest(name, module.OPTIONS)
            known = "" if hint else f"; allowed: {', '.join(module.OPTIONS) or 'none'}"
            raise ConfigError(
                f"{key}: {words.show(name)}: the scene {scene} has no such option"
                f" (its value: {words.show(value)}){hint}{known}"
            )
    options = {}
    for name, about in module.OPTIONS.items():
        if name not in given and "default" not in about:
            raise ConfigError(
                f"{key}: {name}: the scene {scene} needs this option; allowed: {words.range_of(about)}"
            )
        value = schema.conform(about, given.get(name, about.get("default")), f"{key}: {name}")
        options[name] = float(value) + 0.0 if about.get("type") == "number" else value
    try:
        return module.complete(options) if hasattr(module, "complete") else options
    except ConfigError as error:
        raise ConfigError(f"{key}: {error}") from None


def along_axes(given: dict[str, Any]) -> list[dict[str, Any]]:
    """Return mappings with one value for each option: the product of those that have a list and may be an axis.

    Parameters
    ----------
    given
        Value or list by option; `count` tells how many mappings that makes.

    Returns
    -------
    list of dict
        Value by option of each.

    Raises
    ------
    ConfigError
        If a list is empty.
    """
    lists = _lists(given)
    for name, values in lists.items():
        if not values:
            raise ConfigError(
                f"scene_options: {name}: [] makes an empty grid; allowed: a value or a list of at least one"
            )
    return [dict(zip(lists, values, strict=True)) for values in itertools.product(*lists.values())]


def count(given: dict[str, Any]) -> int:
    """Return how many mappings `along_axes` makes of options, at least 1: an empty list is refused there."""
    return math.prod(max(len(values), 1) for values in _lists(given).values())


def _lists(given: dict[str, Any]) -> dict[str, list]:
    """Return the values along its axis of each option; one where it has no list, or form of one, or is no axis."""
    lists = {}
    for name, value in given.items():
        if isinstance(value, dict) and _is_axis(name):
            value = forms.numbers(value, f"scene_options: {name}")
        lists[name] = value if isinstance(value, list) and _is_axis(name) else [value]
    return lists


def _is_axis(name: str) -> bool:
    """Return whether no scene says that its option of that name is no axis."""
    return all(scenes.load(scene).OPTIONS.get(name, {}).get("axis", True) for scene in scenes.NAMES)


def of_text(text: str, value_of_text: Callable[[str], Any]) -> dict[str, Any]:
    """Return the options that a text such as 'elongation=2,angle=30' states.

    A comma parts options only before a NAME=, so that `file=a,b.nc` is one option; a value with a comma is text.

    Parameters
    ----------
    text
        Options, parted by commas.
    value_of_text
        Function that reads a value.

    Returns
    -------
    dict
        Values by name.

    Raises
    ------
    ConfigError
        If a part is not NAME=VALUE, or a name comes twice.
    """
    options = {}
    for part in filter(None, re.split(r",(?=\s*\w*\s*=|\s*$)", text)):
        name, sign, value = (piece.strip() for piece in part.partition("="))
        if not (name and sign and value):
            raise ConfigError(
                f"--scene-options: {words.show(part)} is not allowed; allowed: NAME=VALUE, several parted by commas"
            )
        if name in options:
            raise ConfigError(f"--scene-options: {name}: given twice; allowed: each option once")
        options[name] = value if "," in value else value_of_text(value)
    return options
