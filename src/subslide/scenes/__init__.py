"""Scenes: initial states, one file each, scaled (depths by H2, lengths by R, speeds by sqrt(g H2)).

A scene is one module of this folder, found by listing it; names that begin with ``_`` are helpers. It has

``OPTIONS``
    Entry of each option of the scene by name, in the words of `subslide.keys.entries`. An option is an axis unless its
    entry says ``"axis": False``; without a ``default`` it must be given.
``symmetry(point) -> str``
    ``round``, ``line``, ``quarter`` (mirrors on both axes) or ``none``: which models may solve it (`study.choice`).
``initial(grid, point) -> State``
    The initial state on a `Grid`, as means over its cells (see `_cells`).
``check(point)``, if need be
    Raise a ConfigError where the scene makes no sense with the rest of the point.
``complete(options) -> dict``, if need be
    Return checked options with what follows from them filled in; a ConfigError where that cannot be.

Its docstring is its section of config/README.md. Formulas that the initial state needs stand in the module; those that
judge how it goes on are in `subslide.exact`, under the scene's name.
"""

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


def load(name: str) -> ModuleType:
    """Return the scene module of that name."""
    return import_module(f"{__name__}.{name}")


def defaults(name: str) -> dict[str, Any]:
    """Return the options of a scene by name that have a default, with it."""
    return {option: about["default"] for option, about in load(name).OPTIONS.items() if "default" in about}


def options(point: Point) -> dict[str, Any]:
    """Return the options of a point's scene by name: those it states, and the defaults of the others."""
    return {**defaults(point.scene), **dict(point.scene_options)}


def symmetry(point: Point) -> str:
    """Return the symmetry of the point's scene: "round", "line", "quarter" or "none"."""
    return load(point.scene).symmetry(point)


def check(point: Point) -> None:
    """Raise a ConfigError if the point's scene makes no sense with the rest of the point."""
    judge = getattr(load(point.scene), "check", None)
    if judge:
        judge(point)


def check_walls(point: Point) -> None:
    """Raise a ConfigError unless the box of a scene whose layers reach its edge has walls."""
    if point.boundary != "wall":
        raise ConfigError(
            f"boundary: {point.boundary} is not allowed with scene: {point.scene}, whose layers reach the edge of the"
            " box; allowed: only wall"
        )


def level_off(h2: np.ndarray, level: float) -> tuple[np.ndarray, np.ndarray]:
    """Return (h1, h2) whose sum is `level` to the bit in the precision of `h2`."""
    h1 = level - h2
    return h1, level - h1


def still_water(h2: np.ndarray, level: float) -> State:
    """Return the state at rest of grains `h2` under a flat surface at `level`."""
    return State(*level_off(h2, level))
