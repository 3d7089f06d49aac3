"""The choice of model: the cheapest that is exact for what is asked of a point. Imports no kernels."""

import functools
import itertools
from typing import NamedTuple

from subslide import scenes
from subslide.keys import names
from subslide.keys.entries import ENTRIES
from subslide.points import RUN_KEYS, Point
from subslide.study.remembering import Remembered

EXACT = {
    "round": ("radial", "quarter", "plane"),
    "line": ("line",),
    "quarter": ("quarter", "plane"),
    "none": ("plane",),
}
"""Models that give the answer for scenes of each symmetry, the cheapest first."""

PLANE = ("quarter", "plane")
"""Models, and geometries, of the plane."""

WORDS = {
    "round": "round scene",
    "line": "scene on a line",
    "quarter": "scene with two mirrors",
    "none": "scene without mirrors",
}

LEAN = {key: tuple(ENTRIES[key]["lean"]) for key in RUN_KEYS if "lean" in ENTRIES[key]}
"""Values that the lean kernels know, of each key that has others."""


KNOWN = "_choice"
"""Attribute by which a point, which cannot change, has its choice."""


class Choice(NamedTuple):
    """How a point is solved.

    Attributes
    ----------
    model
        Model, one of `subslide.keys.names.MODELS`.
    geometry
        Geometry of its grid: ``radius``, ``line``, ``quarter`` or ``plane``.
    reason
        Why it has that model, in words.
    grid
        Grid that is solved on: ``uniform`` or ``fitted``.
    grid_reason
        Why it has that grid, in words.
    general
        Whether it needs the general kernels: whatever the lean ones leave out for speed.
    """

    model: str
    geometry: str
    reason: str
    grid: str
    grid_reason: str
    general: bool


def of(point: Point) -> Choice:
    """Return how a point is solved: by its own model, or for `auto` by the cheapest that gives all that is asked."""
    if KNOWN not in vars(point):
        vars(point)[KNOWN] = _choice(point)
    return vars(point)[KNOWN]


@Remembered
def _choice(point: Point) -> Choice:
    """Return how a point is solved."""
    symmetry = scenes.symmetry(point)
    model, reason = point.model, "asked for"
    if model == "auto":
        models = exact_models(point)
        if point.quantities != "grains":
            models = tuple(name for name in models if name != "one-layer")
        reason = f"auto: {WORDS[symmetry]}"
        if point.fields and set(models) & set(PLANE):
            models = tuple(name for name in models if name in PLANE)
            reason += ", fields asked for" if EXACT[symmetry][0] not in PLANE else ""
        model = models[0]
        if model == "one-layer":
            reason += ", r = 0 and grains alone asked for"
    general = any(getattr(point, key) not in known for key, known in LEAN.items())
    geometry = _geometry(model, symmetry)
    return Choice(model, geometry, reason, *_grid(point, geometry), general)


def unfit(point: Point, geometry: str) -> str:
    """Return why a point can have no fitted grid.

    Parameters
    ----------
    point
        The run.
    geometry
        Geometry that it is solved in.

    Returns
    -------
    str
        Words; '' if it can.
    """
    if not scenes.is_column(point):
        return "the scene is not one column about the axis"
    if geometry not in ("radius", "line"):
        return "the model is of the plane"
    if point.boundary != "open":
        return f"the boundary is {point.boundary}, not open"
    for key in ("gauges", "footprints"):
        if getattr(point, key):
            return f"{key} are asked for"
    if point.as_printed != "none":
        return "a formula is taken as printed"  # its friction blows up on some columns
    return ""


def exact_models(point: Point) -> tuple[str, ...]:
    """Return the models that give the answer for the point's scene and densities, the cheapest first."""
    symmetry = scenes.symmetry(point)
    alone = ("one-layer",) if symmetry in ("round", "line") and point.has_weightless_water else ()
    return alone + EXACT[symmetry]


def is_fitted(point: Point) -> bool:
    """Return whether a point is solved on a grid that is fitted to its grains."""
    return of(point).grid == "fitted"


def at_sea(point: Point) -> bool:
    """Return whether a point is solved on an open sea that is lengthened as need be, so that it has no box."""
    return point.boundary == "open" and of(point).geometry in ("radius", "line")


def kernels(point: Point) -> str:
    """Return the name of the compiled code that a point needs: ``model:dtype``, then ``:fitted``, then ``:general``."""
    choice = of(point)
    fitted = ":fitted" if choice.grid == "fitted" else ""
    return f"{choice.model}:{point.dtype}{fitted}" + (":general" if choice.general else "")


@functools.cache
def all_kernels() -> tuple[str, ...]:
    """Return the names of all compiled code that a point may need, see `kernels`."""
    kinds = itertools.product(names.MODELS, ENTRIES["dtype"]["enum"], ("", ":fitted"), ("", ":general"))
    return tuple(f"{model}:{dtype}{fitted}{general}" for model, dtype, fitted, general in kinds)


def _grid(point: Point, geometry: str) -> tuple[str, str]:
    """Return the grid of a point that is solved in a geometry, and why it has that, in words."""
    if point.grid != "auto":
        return point.grid, "asked for"
    if point.quantities != "grains":
        return "uniform", "auto: more than grains asked for"
    why = unfit(point, geometry)
    return ("uniform", f"auto: {why}") if why else ("fitted", "auto: a column, and grains alone asked for")


def _geometry(model: str, symmetry: str) -> str:
    """Return the geometry of a model's grid for scenes of a symmetry."""
    if model == "one-layer":
        return "line" if symmetry == "line" else "radius"
    return {"radial": "radius"}.get(model, model)
