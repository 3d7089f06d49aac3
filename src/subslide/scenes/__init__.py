"""Scenes: initial states, one file each, scaled (depths by H2, lengths by R, speeds by sqrt(g H2)).

A scene is one module of this folder, found by listing it; names that begin with ``_`` are helpers. It has

OPTIONS : dict of str to Entry
    Entry of each option of the scene by name, in the words of `subslide.keys.entries`. An option is an axis unless its
    entry says ``"axis": False``; without a ``default`` it must be given.
symmetry(point) -> str
    Return ``round``, ``line``, ``quarter`` (mirrors on both axes) or ``none``, by which `study.choice` knows the models
    that may solve the point.
initial(grid, point) -> State
    Return the initial state of the point on a `Grid`, as means over its cells (see `_cells`).

and, only where it needs them,

check(point) -> None
    Raise a ConfigError where the scene makes no sense with the rest of the point.
front(point) -> float or None
    Return where the grains end at the start on the positive x axis, over R, if there is an upright side; else None.
    Without it the front is read off the grid, which smears such a side over two cells.
is_column(point) -> bool
    Return whether the grains are one column of radius, or half-width, 1 about the axis, at rest under still water: such
    as have a fitted grid.
complete(chosen) -> dict
    Return the options ``chosen``, by name and checked each for itself, with what follows from them filled in; raise a
    ConfigError where that cannot be.

Its docstring is its section of config/README.md. Formulas that the initial state needs stand in the module; those that
judge how it goes on are in `subslide.exact`, under the scene's name.
"""

import functools
from importlib import import_module
from types import ModuleType
from typing import Any, NamedTuple

import numpy as np

from subslide import catalogue
from subslide.keys.schema import ConfigError
from subslide.points import Point

NAMES = tuple(catalogue.names("scenes"))


class Grid(NamedTuple):
    """Grid that a scene fills.

    Attributes
    ----------
    geometry
        ``radius``, ``line``, ``quarter`` or ``plane``.
    dx
        Cell size over R.
    edges
        Edges (n + 1) of the cells along each axis over R; the axis of the scene is at 0.
    """

    geometry: str
    dx: float
    edges: np.ndarray

    @property
    def centres(self) -> np.ndarray:
        """Centres (n) of the cells."""
        return 0.5 * (self.edges[1:] + self.edges[:-1])


class State(NamedTuple):
    """Initial state: scaled depths and speeds, each a scalar or an array of the grid's shape (y first)."""

    h1: np.ndarray
    h2: np.ndarray
    u1: np.ndarray | float = 0.0
    v1: np.ndarray | float = 0.0
    u2: np.ndarray | float = 0.0
    v2: np.ndarray | float = 0.0


@functools.cache
def load(name: str) -> ModuleType:
    """Return the scene module of that name."""
    return import_module(f"{__name__}.{name}")


def defaults(name: str) -> dict[str, Any]:
    """Return the options of a scene by name that have a default, with it."""
    return {option: about["default"] for option, about in load(name).OPTIONS.items() if "default" in about}


def options(point: Point) -> dict[str, Any]:
    """Return the options of a point's scene by name: those it states, and the defaults of the others."""
    return {**defaults(point.scene), **dict(point.scene_options)}


def files(point: Point) -> list[str]:
    """Return the paths of the files that the point's scene reads: its options marked as `reads`.

    Parameters
    ----------
    point
        The run.

    Returns
    -------
    list of str
        Paths as the options state them; empty for most scenes.
    """
    about = load(point.scene).OPTIONS
    return [str(value) for name, value in options(point).items() if about[name].get("reads")]


def symmetry(point: Point) -> str:
    """Return the symmetry of the point's scene: "round", "line", "quarter" or "none"."""
    return load(point.scene).symmetry(point)


def check(point: Point) -> None:
    """Raise a ConfigError if the point's scene makes no sense with the rest of the point."""
    judge = getattr(load(point.scene), "check", None)
    if judge:
        judge(point)


def front(point: Point) -> float | None:
    """Return where the upright side of the grains stands at the start on the positive x axis, over R, if there is one.

    Parameters
    ----------
    point
        The run.

    Returns
    -------
    float or None
        The place; None where the scene has none there.
    """
    place = getattr(load(point.scene), "front", None)
    return place(point) if place else None


def is_column(point: Point) -> bool:
    """Return whether a point's grains are one column about the axis, which a fitted grid can be made for."""
    judge = getattr(load(point.scene), "is_column", None)
    return bool(judge and judge(point))


def check_walls(point: Point) -> None:
    """Raise a ConfigError unless the box of a scene whose layers reach its edge has walls."""
    if point.boundary != "wall":
        raise ConfigError(
            f"boundary: {point.boundary} is not allowed with scene: {point.scene}, whose layers reach the edge of the"
            " box; allowed: only wall"
        )


def level_off(h2: np.ndarray, level: float) -> tuple[np.ndarray, np.ndarray]:
    """Return the depths of both layers whose sum is the level to the bit.

    Parameters
    ----------
    h2
        Depth of the grains over H2, an array in the working precision.
    level
        Height of the surface over H2.

    Returns
    -------
    tuple of ndarray
        (h1, h2), of the shape of `h2` and in its precision; h2 differs from what was given by round-off.
    """
    h1 = level - h2
    return h1, level - h1


def still_water(h2: np.ndarray, level: float) -> State:
    """Return the state at rest of grains under a flat surface.

    Parameters
    ----------
    h2
        Depth of the grains over H2, an array of the grid's shape.
    level
        Height of the surface over H2.

    Returns
    -------
    State
        Depths, and speeds of 0.
    """
    return State(*level_off(h2, level))
