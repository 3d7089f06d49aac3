"""Scenes: initial states, one file each, scaled (depths by H2, lengths by R, speeds by sqrt(g H2)).

A scene module, found by listing this folder, has

- `OPTIONS`: JSON schema of each option of the scene by name, with its description and default;
- `symmetry(point)`: "round", "line", "quarter" (mirrors on both axes) or "none": see `models.choice`;
- `initial(grid, point)`: the `State`;
- if need be `check(point)`, which raises a `SceneError` where the scene makes no sense with the rest of a point;
- if need be `complete(options)`, which returns checked options with what follows from them filled in.
"""

from importlib import import_module
from pathlib import Path
from typing import NamedTuple

import numpy as np

NAMES = tuple(sorted(path.stem for path in Path(__file__).parent.glob("[a-z]*.py")))


class SceneError(ValueError):
    """A scene that does not go with the rest of its point: one line that names key, value and what is allowed."""


class State(NamedTuple):
    """An initial state: each a scalar or an array of the grid's shape (y first)."""

    h1: np.ndarray
    h2: np.ndarray
    u1: np.ndarray | float = 0.0
    v1: np.ndarray | float = 0.0
    u2: np.ndarray | float = 0.0
    v2: np.ndarray | float = 0.0


def load(name):
    """Return the scene module of that name."""
    return import_module(f"{__name__}.{name}")


def options(point):
    """Return the scene's options by name: the point's own, and the defaults of the others."""
    defaults = {
        name: about["default"] for name, about in load(point.scene).OPTIONS.items() if "default" in about
    }
    return {**defaults, **dict(point.scene_options)}


def symmetry(point):
    """Return the symmetry of the point's scene: "round", "line", "quarter" or "none"."""
    return load(point.scene).symmetry(point)


def check(point):
    """Raise a `SceneError` if the point's scene makes no sense with the rest of the point."""
    judge = getattr(load(point.scene), "check", None)
    if judge:
        judge(point)


def check_walls(point):
    """Raise a `SceneError` unless the box of a scene whose layers reach its edge has walls."""
    if point.boundary != "wall":
        raise SceneError(
            f"boundary: {point.boundary} is not allowed with scene: {point.scene}, whose layers reach the edge of the"
            " box; allowed: only wall"
        )


def level_off(h2, level):
    """Return (h1, h2) whose sum is `level` to the bit in the precision of `h2`."""
    h1 = level - h2
    return h1, level - h1


def still_water(h2, level):
    """Return the state at rest of grains `h2` under a flat surface at `level`."""
    return State(*level_off(h2, level))
