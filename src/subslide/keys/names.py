"""Names that choose a part of the model or of its numerics, each declared once, and whether lean kernels know it.

The lean kernels leave out what is rarely asked for, for speed; a run that chooses a ``GENERAL`` name has the general
ones. Kernels know a name as an integer, its place in its mapping (`flags`): a new name goes to the end.
"""

LEAN, GENERAL = True, False

SCHEMES = {"rusanov": LEAN, "hll": LEAN, "ifcp": LEAN, "ifcph": LEAN, "roe": GENERAL}
"""Riemann solvers, the plainest first."""

LAWS = {"coulomb": LEAN, "voellmy": GENERAL, "pouliquen": GENERAL}
"""Friction laws of the grains."""

TREATMENTS = {"real": LEAN, "hll": GENERAL, "friction": GENERAL, "stop": GENERAL}
"""What is done where wave speeds are complex."""

FRONT_FLUXES = {"exact": LEAN, "hll": LEAN}
"""Fluxes of grains onto a dry bed."""

SPEEDS = {"exact": LEAN, "approximate": GENERAL}
"""Wave speeds of the Riemann solver."""

AS_PRINTED = {"none": LEAN, "friction": GENERAL, "upwinding": GENERAL}
"""Formulas of the paper that are taken literally."""

BOUNDARIES = {"open": LEAN, "wall": LEAN, "periodic": LEAN, "paper": LEAN}
"""Edges of the box."""

GRIDS = {"uniform": LEAN, "fitted": LEAN, "auto": LEAN}
"""Grids along a radius or line."""

LEAVING = ("open", "paper")
"""Edges that let waves and grains out."""

KNOWN_AS = {"boundary": {"open": "sea"}}
"""Words that ids have for values which once meant something else, by key: the zero gradient is `paper` now."""

LATER = {"grid": "uniform", "gauges": (), "runout_directions": 0, "footprints": False}
"""Keys that were not there from the start, by the value that all runs had until then: ids leave it out."""

MODELS = {"one-layer": LEAN, "radial": LEAN, "line": LEAN, "quarter": LEAN, "plane": LEAN}
"""Geometries that are solved, the cheapest first."""


NUMERICS: dict[str, dict[str, str | int]] = {
    "default": {},
    "paper": {
        "model": "quarter",
        "scheme": "ifcph",
        "front_flux": "hll",
        "order": 1,
        "cells": 200,
        "boundary": "paper",
    },
    "resolved": {"model": "auto", "scheme": "ifcph", "order": 2, "cells": 3200},
    "fronts": {"quantities": "grains", "grid": "fitted", "cells": 48},
}
"""Named sets of numerics: values by key."""


def flags(mapping: dict[str, bool]) -> dict[str, int]:
    """Return the integer by which kernels know each name of a mapping of this module."""
    return {name: place for place, name in enumerate(mapping)}


def lean(mapping: dict[str, bool]) -> tuple[str, ...]:
    """Return the names of a mapping of this module that the lean kernels know, in order."""
    return tuple(name for name, kind in mapping.items() if kind is LEAN)


def best_first(mapping: dict[str, bool]) -> tuple[str, ...]:
    """Return the names of a mapping whose best comes last, the best of the lean ones first, then the general ones."""
    general = (name for name, kind in mapping.items() if kind is GENERAL)
    return (*reversed(lean(mapping)), *general)
