"""Options of scenes in a configuration: checked against what the scene's module says, and their product along axes."""

import itertools
import math

from subslide import scenes
from subslide.keys import schema
from subslide.keys.schema import ConfigError

MOST_COMBINATIONS = 200_000


def checked(scene: str, given: dict, key: str) -> dict:
    """Every option of a scene by name, in one number format; `key` is the mapping's name in messages."""
    module = scenes.load(scene)
    for name, value in given.items():
        if name not in module.OPTIONS:
            hint = schema.closest(name, module.OPTIONS)
            known = "" if hint else f"; allowed: {', '.join(module.OPTIONS) or 'none'}"
            raise ConfigError(
                f"{key}: {schema.show(name)}: the scene {scene} has no such option"
                f" (its value: {schema.show(value)}){hint}{known}"
            )
    found = {}
    for name, about in module.OPTIONS.items():
        if name not in given and "default" not in about:
            raise ConfigError(
                f"{key}: {name}: the scene {scene} needs this option; allowed: {schema.range_of(about)}"
            )
        value = schema.conform(about, given.get(name, about.get("default")), f"{key}: {name}")
        found[name] = float(value) + 0.0 if about.get("type") == "number" else value
    try:
        return module.complete(found) if hasattr(module, "complete") else found
    except scenes.SceneError as error:
        raise ConfigError(f"{key}: {error}") from None


def along_axes(given: dict) -> list[dict]:
    """Mappings with one value for each option: the product of those that have a list and may be an axis."""
    lists = {}
    for name, value in given.items():
        lists[name] = value if isinstance(value, list) and _is_axis(name) else [value]
        if not lists[name]:
            raise ConfigError(
                f"scene_options: {name}: [] makes an empty grid; allowed: a value or a list of at least one"
            )
    count = math.prod(map(len, lists.values()))
    if count > MOST_COMBINATIONS:
        raise ConfigError(f"scene_options: {count} combinations; allowed: at most {MOST_COMBINATIONS}")
    return [dict(zip(lists, values, strict=True)) for values in itertools.product(*lists.values())]


def _is_axis(name: str) -> bool:
    """True unless a scene says that its option of that name is no axis."""
    return all(scenes.load(scene).OPTIONS.get(name, {}).get("axis", True) for scene in scenes.NAMES)


def of_text(text: str, value_of_text) -> dict:
    """Values by name of text such as 'elongation=2,angle=30', each as value_of_text reads it."""
    found = {}
    for part in filter(None, text.split(",")):
        name, sign, value = (piece.strip() for piece in part.partition("="))
        if not (name and sign and value):
            raise ConfigError(
                f"--scene-options: {schema.show(part)} is not allowed; allowed: NAME=VALUE, several parted by commas"
            )
        if name in found:
            raise ConfigError(f"--scene-options: {name}: given twice; allowed: each option once")
        found[name] = value_of_text(value)
    return found
