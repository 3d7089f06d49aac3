"""Words of a configuration for many values at once: forms of a numeric axis, designs of points, distributions.

Options of designs are entries, in the words of `subslide.keys.entries`; what they make is in `subslide.study`.
"""

from typing import Any

Entry = dict[str, Any]

MOST_POINTS = 200_000
"""Points of a study, at most."""

FORMS = {
    "linspace": ("first", "last", "count"),
    "geomspace": ("first", "last", "count"),
    "arange": ("first", "last", "step"),
}
"""Numbers of each form of a numeric axis, which may stand for its list."""

DISTRIBUTIONS = {
    "uniform": ("low", "high"),
    "log_uniform": ("low", "high"),
    "truncated_normal": ("mean", "sd", "low", "high"),
    "file": (),
}
"""Numbers of each distribution; `file` has the path of a CSV file in their place."""

FRICTION = "m"
"""What a design calls the friction number, which sets delta, or a_2 where delta is stated."""

FRICTION_ENTRY: Entry = {
    "description": "friction number tan(delta)/a_2: sets delta at the point's a_2, or a_2 where delta is stated",
    "type": "number",
    "minimum": 0,
    "maximum": 1e5,
}

PATH: Entry = {
    "description": "path of a CSV file, from the folder where the command runs",
    "type": "string",
    "minLength": 1,
    "allowed": "the path of a CSV file",
}

POINTS: Entry = {"description": "number of points", "type": "integer", "minimum": 1, "maximum": MOST_POINTS}
SEED: Entry = {
    "description": "where its random numbers begin",
    "type": "integer",
    "minimum": 0,
    "maximum": 2**32 - 1,
    "default": 0,
}
SCRAMBLINGS: Entry = {
    "description": "independent scramblings of the design",
    "type": "integer",
    "minimum": 1,
    "maximum": 10_000,
    "default": 16,
}
OVER: Entry = {
    "description": "distribution of each key, or of m",
    "type": "object",
    "minProperties": 1,
    "allowed": "a mapping from keys, or m, to distributions",
}

SAMPLED = {"points": POINTS, "seed": SEED, "over": OVER}
DESIGNS: dict[str, tuple[str, dict[str, Entry]]] = {
    "zip": ("lists of one length, side by side: a point for each place", {}),
    "file": ("the rows of a CSV file, whose columns are keys", {}),
    "latin_hypercube": ("a Latin hypercube: each value in a stratum of its own", SAMPLED),
    "sobol": (
        "a scrambled Sobol' sequence, best of 2^n points; more points leave the first as they are",
        SAMPLED,
    ),
    "saltelli": (
        "blocks A, B, AB_i (A with column i of B) and BA_i of a scrambled Sobol' sequence, for indices",
        {"points": POINTS, "seed": SEED, "scramblings": SCRAMBLINGS, "over": OVER},
    ),
}
"""What each design is, and the entries of its options; zip and file have none."""

ALLOWED = f"one of {', '.join(DESIGNS)}, or a list of such mappings"
ENTRY: Entry = {
    "description": "points whose values are chosen together, joined with the lists as one more axis each: zip, file,"
    " latin_hypercube, sobol or saltelli; see docs/designs.md",
    "type": ["object", "array"],
    "default": [],
    "allowed": f"a mapping with {ALLOWED}",
}


FORM = {"$ref": "#/$defs/form"}
"""JSON Schema of a form that stands for the list of a numeric axis."""

DESIGN = {"$ref": "#/$defs/design"}
DESIGN_SCHEMA: Entry = {"anyOf": [DESIGN, {"type": "array", "items": DESIGN}]}
"""JSON Schema of the key `design`: one design, or a list of them."""


def definitions(lists: dict[str, Entry], numbers: tuple[str, ...]) -> dict[str, Entry]:
    """Return the parts of the published schema to which those of keys refer.

    Parameters
    ----------
    lists
        JSON Schema of the list of each key that may be an axis.
    numbers
        Those of them that take numbers.

    Returns
    -------
    dict
        JSON Schema of a form, a design, what it goes over, and a distribution, by name.
    """
    over = {**OVER, "properties": {key: {"$ref": "#/$defs/distribution"} for key in (*numbers, FRICTION)}}
    over["additionalProperties"] = False
    kinds: dict[str, Entry] = {"file": PATH}
    m = {word: FRICTION_ENTRY[word] for word in ("type", "minimum", "maximum")}
    columns = {**lists, FRICTION: {"type": "array", "items": m, "minItems": 1}}
    kinds["zip"] = {
        "type": "object",
        "properties": columns,
        "additionalProperties": False,
        "minProperties": 1,
    }
    for kind, (_, options) in DESIGNS.items():
        if options:
            properties = {
                name: {"$ref": "#/$defs/over"} if name == "over" else about for name, about in options.items()
            }
            needed = [name for name, about in options.items() if "default" not in about]
            kinds[kind] = {"type": "object", "properties": properties, "additionalProperties": False}
            kinds[kind]["required"] = needed
        kinds[kind] = {**kinds[kind], "description": DESIGNS[kind][0]}
    one = _one_of({kind: kinds[kind] for kind in DESIGNS})
    return {"form": _form(), "design": one, "over": over, "distribution": _distribution()}


def _form() -> Entry:
    """Return the JSON Schema of a form; its numbers must lie in the range of the key."""
    number: Entry = {"type": "number"}
    counted = [number, number, {"type": "integer", "minimum": 2, "maximum": MOST_POINTS}]
    return _one_of(
        {name: _tuple([number] * 3 if "step" in parts else counted) for name, parts in FORMS.items()}
    )


def _distribution() -> Entry:
    """Return the JSON Schema of a distribution."""
    numbers = {
        name: _tuple([{"type": "number"}] * len(parts)) for name, parts in DISTRIBUTIONS.items() if parts
    }
    return {"anyOf": [numbers["uniform"], _one_of({**numbers, "file": PATH})]}


def _tuple(items: list[Entry]) -> Entry:
    """Return the JSON Schema of a list with these items."""
    return {"type": "array", "prefixItems": items, "items": False, "minItems": len(items)}


def _one_of(properties: dict[str, Entry]) -> Entry:
    """Return the JSON Schema of a mapping with one of these keys."""
    return {
        "type": "object",
        "properties": properties,
        "additionalProperties": False,
        "minProperties": 1,
        "maxProperties": 1,
    }
