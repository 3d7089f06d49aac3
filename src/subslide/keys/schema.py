"""The schema of a configuration: what each key means, its unit, default and range, in one file."""

import difflib
import functools
import json
import math
import re
from pathlib import Path

PATH = Path(__file__).with_name("config.schema.json")
EXPONENT = re.compile(r"[-+]?(\d+\.?\d*|\.\d+)[eE][-+]?\d+")


class ConfigError(ValueError):
    """Bad input: one line that names the key, its value and what is allowed."""


@functools.cache
def properties() -> dict[str, dict]:
    """Schema of each key, by name, in the order of the file; scenes are the files in their folder."""
    found = json.loads(PATH.read_text(encoding="utf-8"))["properties"]
    found["scene"]["enum"] = sorted(
        path.stem for path in PATH.parents[1].joinpath("scenes").glob("[a-z]*.py")
    )
    return found


@functools.cache
def _check(about: str):
    """Function that raises unless its argument satisfies a schema, given as JSON."""
    import fastjsonschema  # a tenth of the start-up time of jsonschema

    return fastjsonschema.compile(json.loads(about))


def is_axis(key: str) -> bool:
    """True if a study may give a list for this key, one run for each entry."""
    return properties()[key].get("axis", False)


def with_role(*roles: str) -> tuple[str, ...]:
    """Return the keys that have one of these roles (study, preset, physics, scene, method, output), in order."""
    return tuple(key for key, about in properties().items() if about["role"] in roles)


def checked(key: str, value, name: str = ""):
    """Value as the schema of `key` wants it; ConfigError, which calls the key `name`, if it is not allowed."""
    return conform(properties()[key], value, name or key)


def conform(about: dict, value, name: str):
    """Value as the schema `about` wants it; ConfigError, which calls it `name`, if it is not allowed."""
    import fastjsonschema

    value = _number_of_text(value)
    try:
        if not _finite(value):
            raise ConfigError
        _check(json.dumps(about))(value)
    except (ConfigError, fastjsonschema.JsonSchemaValueException, OverflowError):
        raise ConfigError(_refusal(about, value, name)) from None
    return int(value) if _is_integer(about) else value


def closest(name: str, names) -> str:
    """'; did you mean ...?' for the name that is nearest to a mistyped one, or nothing."""
    lower = {other.lower(): other for other in names}
    near = difflib.get_close_matches(str(name).lower(), lower, n=1, cutoff=0.5)
    return f"; did you mean '{lower[near[0]]}'?" if near else ""


def allowed(key: str) -> str:
    """Words for the values that a key may take, such as 'a number from 0 to below 1'."""
    return range_of(properties()[key])


def range_of(schema: dict) -> str:
    """Words for the values that a schema allows."""
    if "allowed" in schema:
        return schema["allowed"]
    if "enum" in schema:
        return ("one of " if len(schema["enum"]) > 1 else "only ") + ", ".join(map(str, schema["enum"]))
    if schema["type"] == "boolean":
        return "true or false"
    noun = "a whole number" if schema["type"] == "integer" else "a number"
    low = f"from {schema['minimum']:g}" if "minimum" in schema else f"above {schema['exclusiveMinimum']:g}"
    high = f"to {schema['maximum']:g}" if "maximum" in schema else f"to below {schema['exclusiveMaximum']:g}"
    return f"{noun} {low} {high}"


def unit(key: str) -> str:
    """Unit of a key for people, '' if it has none."""
    return unit_of(properties()[key])


def unit_of(about: dict) -> str:
    """Unit that a schema states, for people; '' if it has none."""
    text = about.get("unit", "")
    return "" if text == "1" else text


def show(value) -> str:
    """Short text of a value as a configuration would write it."""
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


def _refusal(about: dict, value, name: str) -> str:
    hint = closest(value, [str(v) for v in _names(about)]) if isinstance(value, str) else ""
    end = f" ({unit_of(about)})" if unit_of(about) else ""
    return f"{name}: {show(value)} is not allowed; allowed: {range_of(about)}{end}{hint}"


def _names(schema: dict) -> list:
    return [v for part in (schema, *schema.get("anyOf", ())) for v in part.get("enum", ())]


def _is_integer(schema: dict) -> bool:
    return schema.get("type") == "integer" or all(isinstance(v, int) for v in schema.get("enum", [""]))


def _number_of_text(value):
    """Number for text such as '1e-3', which YAML 1.1 reads as text; any other value unchanged."""
    if isinstance(value, list):
        return [_number_of_text(entry) if isinstance(entry, str) else entry for entry in value]
    return float(value) if isinstance(value, str) and EXPONENT.fullmatch(value) else value


def _finite(value) -> bool:
    values = value if isinstance(value, list) else [value]
    return all(not isinstance(v, float) or math.isfinite(v) for v in values)


def _looks_like_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


def metavar(key: str) -> str:
    """Short text that stands for a value of `key` in help, such as 'F' or 'ifcph|hll'."""
    about = properties()[key]
    if "enum" in about:
        return "|".join(map(str, about["enum"]))
    if about.get("type") == "object":
        return "NAME=VALUE,..."
    words = "".join(f"{name}|" for name in _names(about))
    letter = (
        "N" if about.get("type") == "integer" else {"degree": "DEG", "s": "S"}.get(about.get("unit"), "F")
    )
    return (
        words
        + letter
        + (",..." if any(part.get("type") == "array" for part in about.get("anyOf", ())) else "")
    )
