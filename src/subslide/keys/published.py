"""The schema of a study as others read it: JSON Schema 2020-12, for editors and for tools that write studies.

It says of each key and option what a value may be, and where a list may stand. Rules between keys stay in code: a file
that satisfies it may still ask for a model that cannot give a scene's answer.
"""

import json
from typing import Any

from subslide import catalogue
from subslide.keys import designs, schema
from subslide.keys.entries import ENTRIES, Entry
from subslide.keys.words import unit_of

DIALECT = "https://json-schema.org/draft/2020-12/schema"

OURS = ("role", "axis", "reads", "lean", "allowed", "presets", "unit", "description", "default")
"""Words of an entry that are not of JSON Schema, or stand beside its rule for a value."""


def text(options: dict[str, dict[str, Entry]]) -> str:
    """Return the published schema as the text of a file; see `study_schema`."""
    return json.dumps(study_schema(options), indent=2) + "\n"


def study_schema(options: dict[str, dict[str, Entry]]) -> dict[str, Any]:
    """Return the JSON Schema of a study.

    Parameters
    ----------
    options
        Entries of the options of each scene, by the scene's name and their own.
    """
    keys = {key: _property(about, schema.is_axis(key)) for key, about in ENTRIES.items()}
    keys["figures"]["anyOf"][1]["items"] = {"enum": catalogue.names("figures")}
    keys["scene_options"] |= {"properties": _options(options), "additionalProperties": False}
    axes = [key for key in (*schema.with_role("preset"), *schema.run_keys()) if schema.is_axis(key)]
    numbers = tuple(key for key in axes if schema.is_real(ENTRIES[key]))
    keys["design"] |= designs.DESIGN_SCHEMA
    lists = {key: {"$ref": f"#/properties/{key}/anyOf/1"} for key in axes}
    del keys["design"]["type"]
    case_keys = (*schema.with_role("preset", "design"), *schema.run_keys())
    keys["cases"]["items"] = _mapping({key: {"$ref": f"#/properties/{key}"} for key in case_keys})
    about = {
        "$schema": DIALECT,
        "title": "A study of subslide",
        "description": "Keys of a study. A key of a run may be a list where it is an axis: the study is the product of"
        " its axes and designs.",
    }
    return {**about, **_mapping(keys), "required": ["study"], "$defs": designs.definitions(lists, numbers)}


def _mapping(properties: dict[str, Any]) -> dict[str, Any]:
    """Return the schema of a mapping that has no keys but these."""
    return {"type": "object", "properties": properties, "additionalProperties": False}


def _options(options: dict[str, dict[str, Entry]]) -> dict[str, Any]:
    """Return the schema of each option of any scene; where scenes share a name, a value suits any of them."""
    by_name: dict[str, list[dict]] = {}
    for scene, entries in options.items():
        for name, about in entries.items():
            shown = _property(about, about.get("axis", True))
            shown["description"] = f"{scene}: {shown['description']}"
            by_name.setdefault(name, []).append(shown)
    return {name: many[0] if len(many) == 1 else {"anyOf": many} for name, many in sorted(by_name.items())}


def _property(about: Entry, axis: bool) -> dict[str, Any]:
    """Return the schema of a key by its entry: a value or, if it is an axis, a list of at least one too."""
    value = {word: rule for word, rule in about.items() if word not in OURS}
    if axis:
        listed = [{"type": "array", "items": value, "minItems": 1}]
        forms = [designs.FORM] if schema.is_real(about) or schema.is_integer(about) else []
        value = {"anyOf": [value, *listed, *forms]}
    unit = f" ({unit_of(about)})" if unit_of(about) else ""
    told = {"description": about["description"] + unit}
    if "default" in about:
        told["default"] = about["default"]
    return {**told, **json.loads(json.dumps(value))}
