"""The keys of a study: what each means, its unit, default and range, in the order of tables and axes.

An entry is a mapping in the words of JSON Schema (``type``, ``minimum``, ``enum``, ``anyOf``, ...), as the options of
scenes are, with

- ``description`` and, where there is one, ``unit`` (UDUNITS) and ``default``;
- ``role``: what the key says something of (see the constants);
- ``axis``: whether a study may give a list for it, one run for each value;
- ``lean``: the values that the lean kernels know, where there are others (see `subslide.keys.names`);
- ``allowed``: the range in words, where it cannot be told from the rest;
- ``presets``: the keys that each value of ``numerics`` sets.

To add a key, write its entry and the code that uses it: points, checks, ids, options of the command line, records,
tables and documentation follow from here.
"""

from collections.abc import Callable
from typing import Any

from subslide import catalogue
from subslide.keys import designs, kept, measured, names

Entry = dict[str, Any]

STUDY, PRESET, DESIGN = "study", "preset", "design"
"""Roles of keys of a whole study, of the one that sets several others, and of the one that joins several."""

PHYSICS, SCENE, METHOD, OUTPUT = "physics", "scene", "method", "output"
"""Roles of keys of a run: column and material; initial state, box and end; how it is solved; what is kept."""


def number(role: str, description: str, default: float, unit: str = "1", **limits: float) -> Entry:
    """Return the entry of a key that takes a number.

    Parameters
    ----------
    role, description, default, unit
        What the entry says, see above.
    limits
        Range, in the words of JSON Schema: ``minimum``, ``exclusiveMaximum``, ...

    Returns
    -------
    Entry
        The entry, of an axis.
    """
    about = {"type": "number", **limits, "default": default, "unit": unit}
    return {"role": role, "description": description, **about, "axis": True}


def choice(role: str, description: str, default: Any, values: Any, listed: Callable = list) -> Entry:
    """Return the entry of a key that takes one of some values.

    Parameters
    ----------
    role, description, default
        What the entry says, see above.
    values
        Values, or a mapping of `subslide.keys.names`, which says which of them are lean.
    listed
        Function that puts them in order.

    Returns
    -------
    Entry
        The entry, of an axis.
    """
    about = {"enum": list(listed(values)), "default": default, "axis": True}
    if isinstance(values, dict) and not all(values.values()):
        about["lean"] = list(names.lean(values))
    return {"role": role, "description": description, **about}


def limit(description: str, default: float, unit: str, minimum: float, maximum: float) -> Entry:
    """Return the entry of a limit on what a study costs.

    Parameters
    ----------
    description, default, unit, minimum, maximum
        What the entry says, see above.

    Returns
    -------
    Entry
        The entry, of a key of a whole study.
    """
    text = f"{description}; a study, or one run, that needs more is refused before it starts"
    about = {"type": "number", "minimum": minimum, "maximum": maximum, "default": default, "unit": unit}
    return {"role": STUDY, "description": text, **about}


ENTRIES: dict[str, Entry] = {
    "study": {
        "role": STUDY,
        "description": "name of the study and of its folder under results/",
        "type": "string",
        "pattern": "^[a-z0-9_-]+$",
        "maxLength": 64,
        "allowed": "at most 64 lower-case letters, digits, '_' and '-'",
    },
    "figures": {
        "role": STUDY,
        "description": "figures to draw: auto (every figure whose runs the study has), none, or a list of names",
        "anyOf": [
            {"enum": ["auto", "none"]},
            {"type": "array", "items": {"type": "string"}, "uniqueItems": True},
        ],
        "allowed": "auto, none or a list of names of figures",
        "default": "auto",
    },
    "bands": {
        "role": STUDY,
        "description": "state the discretisation error beside each quantity; on a uniform grid also an estimate of the"
        " limit, from runs on grids of cells/2 and cells/4: cells is then a multiple of 4 from 40",
        "type": "boolean",
        "default": False,
    },
    "cases": {
        "role": STUDY,
        "description": "grids that are joined into one study: a list of mappings, each the product of its own lists,"
        " with the other keys of the file as its defaults",
        "type": "array",
        "minItems": 1,
        "allowed": "a list of mappings of keys of a run",
        "default": [{}],
    },
    "keep": {"role": STUDY, **kept.ENTRY},
    "design": {"role": DESIGN, **designs.ENTRY},
    "batch_seconds": {"role": STUDY, **kept.BATCH_SECONDS},
    "max_core_hours": limit("hours on one core, as estimated, that a study may take", 100, "h", 1e-3, 1e7),
    "max_memory": limit("memory, as estimated, that the largest run may take", 8, "GB", 0.1, 1e5),
    "max_disk": limit("disk, as estimated, that records and tables may take", 20, "GB", 1e-3, 1e6),
    "numerics": {
        "role": PRESET,
        "description": "named set of model, scheme, order, cells, grid, front_flux, boundary and quantities; keys"
        " written out win over it",
        "enum": list(names.NUMERICS),
        "default": "default",
        "axis": True,
        "presets": names.NUMERICS,
    },
    "a_H": number(
        PHYSICS, "water depth above the column over the column's height, H1/H2", 1, minimum=0, maximum=1000
    ),
    "a_2": number(PHYSICS, "aspect ratio of the column, H2/R", 0.56, minimum=1e-3, maximum=100),
    "r": number(PHYSICS, "density of water over density of grains", 0.4, minimum=0, maximum=0.99999),
    "delta": number(PHYSICS, "Coulomb friction angle", 32, "degree", minimum=0, maximum=89),
    "radius": number(PHYSICS, "initial radius R of the column", 0.0705, "m", minimum=1e-6, maximum=1e6),
    "g": number(PHYSICS, "acceleration of gravity", 9.81, "m s-2", minimum=1e-6, maximum=1000),
    "scene": {
        "role": SCENE,
        "description": "initial state; see Scenes",
        "type": "string",
        "default": "cylinder",
        "axis": True,
        "enum": catalogue.names("scenes"),
    },
    "scene_options": {
        "role": SCENE,
        "description": "options of the scene by name, each with its own range, and each an axis; see Scenes",
        "type": "object",
        "default": {},
        "allowed": "a mapping of options of the scene",
    },
    "quantities": choice(
        OUTPUT,
        "what is asked of a run: all, or grains alone (front, deposit, volume; nothing of the water)",
        "all",
        ["all", "grains"],
    ),
    "friction": choice(
        PHYSICS,
        "friction law of the grains: coulomb, voellmy (Coulomb and turbulence, as McDougall and Hungr use it) or"
        " pouliquen (between delta and delta_2)",
        "coulomb",
        names.LAWS,
    ),
    "xi": number(
        PHYSICS, "turbulence coefficient of voellmy friction", 500, "m s-2", minimum=1e-3, maximum=1e9
    ),
    "delta_2": number(
        PHYSICS,
        "friction angle of pouliquen friction in fast or thin flow, above delta, which is the one at rest",
        42,
        "degree",
        minimum=0,
        maximum=89,
    ),
    "pouliquen_length": number(
        PHYSICS,
        "length L/beta of pouliquen friction: grains this deep at Froude number 1 are 1/e of the way down from"
        " delta_2 to delta",
        0.005,
        "m",
        minimum=1e-6,
        maximum=1e6,
    ),
    "model": choice(
        METHOD,
        "geometry that is solved; auto takes the cheapest one that gives the scene's answer",
        "auto",
        ["auto", *names.MODELS],
    ),
    "scheme": choice(METHOD, "Riemann solver", "ifcph", names.SCHEMES, names.best_first),
    "front_flux": choice(
        METHOD,
        "flux of grains onto a dry bed in ifcph and roe, of the one-layer model too: exact (the fan of a dam break of"
        " grains alone), or the HLL flux, in two layers with the speeds of the whole system (as in the paper)",
        "exact",
        names.FRONT_FLUXES,
    ),
    "wave_speeds": choice(
        METHOD,
        "wave speeds of the Riemann solver: exact, or approximate (Schijf and Schonfeld 1953; only to be compared)",
        "exact",
        names.SPEEDS,
    ),
    "treatment": choice(
        METHOD,
        "what is done where wave speeds are complex: real (their real parts), hll (HLL at such edges), friction"
        " (between the layers of such cells, until their shear is the largest that is hyperbolic), or stop (end the"
        " run)",
        "real",
        names.TREATMENTS,
    ),
    "as_printed": choice(
        METHOD,
        "formula of the paper taken literally, to see what it does: none, friction (its test of rest compares m/s with"
        " m/s2, and nothing stops), or upwinding (Eq. 13; in the plane only)",
        "none",
        names.AS_PRINTED,
    ),
    "friction_in_viscosity": {
        "role": METHOD,
        "description": "let the viscosity see what friction holds (Eq. 8); without it piles whose velocity is 0 creep,"
        " so that t_end: rest comes too early",
        "type": "boolean",
        "default": True,
        "axis": True,
        "lean": [True],
    },
    "order": choice(METHOD, "order of accuracy in space and time", 2, [1, 2]),
    "cells": {
        "role": METHOD,
        "description": "cell size as a count: dx = 0.6 m / cells at R = 0.0705 m, in proportion to R elsewhere; on a"
        " fitted grid the number of cells, best a multiple of 8 (of 16 in float32), such as 48",
        "type": "integer",
        "minimum": 10,
        "maximum": 100000,
        "default": 200,
        "unit": "1",
        "axis": True,
    },
    "grid": choice(
        METHOD,
        "cells of one size (uniform); or of a column on a radius or line some that follow its front, so that 48 give"
        " what 800 do for fronts and deposits, but nothing of the wave, which is missing then (fitted); auto takes"
        " fitted with quantities: grains, where the scene has such a grid",
        "uniform",
        names.GRIDS,
    ),
    "dtype": choice(METHOD, "floating-point type of the state", "float64", ["float64", "float32"]),
    "cfl": number(
        METHOD,
        "Courant number of the time step; up to 1 every solver is meant to be stable, beyond it only the search for the"
        " limit belongs",
        0.9,
        minimum=0.01,
        maximum=4,
    ),
    "boundary": choice(
        SCENE,
        "edge of the box: open (a sea that no wave comes back from: without an end on a radius or line, in the plane an"
        " edge that lets round waves out), paper (zero gradient at the end of the paper's box, or of a larger one that"
        " the front does not reach), wall, or periodic (on a line or in the whole plane)",
        "open",
        names.BOUNDARIES,
    ),
    "t_end": {
        "role": SCENE,
        "description": "end time, or rest: until the grains are at rest and the last snapshot is taken, up to a cap in"
        " scaled time",
        "anyOf": [{"enum": ["rest"]}, {"type": "number", "minimum": 1e-9, "maximum": 1e9}],
        "allowed": "rest or a number from 1e-09 to 1e+09",
        "default": "rest",
        "unit": "s",
        "axis": True,
    },
    "snapshot_times": {
        "role": OUTPUT,
        "description": "times of the profiles; paper is 0, 0.08, 0.16, 0.24 and 0.54 s at R = 0.0705 m, in proportion"
        " to sqrt(R) elsewhere; the end of the run is always added. A step ends at each, so many times shorten steps"
        " and change the answer: at 400 cells 54 times change L_f by up to 0.1 %, 270 by 0.9 %, and these the peak of"
        " max|eta| by 9 % (at first order by 29 %)",
        "anyOf": [
            {"enum": ["paper"]},
            {"type": "array", "items": {"type": "number", "minimum": 0, "maximum": 1e9}, "maxItems": 1000},
        ],
        "allowed": "paper or a list of at most 1,000 numbers from 0 to 1e+09",
        "default": "paper",
        "unit": "s",
    },
    **{key: {"role": OUTPUT, **about} for key, about in measured.ENTRIES.items()},
}
"""Entry of each key by name."""
