"""Whether the values of a point, each allowed, go with one another."""

from subslide import scenes
from subslide.keys import words
from subslide.keys.schema import ConfigError
from subslide.points import Point
from subslide.study import choice

MOST_PLANE_CELLS = 10_000
PLANE = ("quarter", "plane")
GEOMETRIES = {
    ("fields", True): PLANE,
    ("as_printed", "upwinding"): PLANE,  # of tangential momentum, which a line or a radius does not have
    ("boundary", "periodic"): ("line", "plane"),
}
"""Geometries to which a value of a key is limited."""


def check(point: Point) -> None:
    """Raise a ConfigError, of one line, if values of a point do not go with one another."""
    if point.model == "one-layer" and point.r != 0:
        raise ConfigError(f"model: one-layer is not allowed with r: {point.r:g}; allowed: only with r: 0")
    if point.friction == "pouliquen" and point.delta_2 <= point.delta:
        raise ConfigError(
            f"delta_2: {point.delta_2:g} is not allowed with friction: pouliquen and delta: {point.delta:g}; allowed:"
            f" above delta, {point.delta:g} to below 90 (degree)"
        )
    scenes.check(point)
    models = choice.exact_models(point)
    if point.model not in ("auto", *models):
        raise ConfigError(
            f"model: {point.model} is not allowed with scene: {point.scene}, a"
            f" {choice.WORDS[scenes.symmetry(point)]}; allowed: auto, {', '.join(models)}"
        )
    model, geometry, reason, _ = choice.of(point)
    for (key, value), geometries in GEOMETRIES.items():
        if getattr(point, key) == value and geometry not in geometries:
            raise ConfigError(
                f"{key}: {words.show(value)} is not allowed with model: {model} ({reason});"
                f" allowed: {', '.join(geometries)}"
            )
    if geometry in PLANE and point.cells > MOST_PLANE_CELLS:
        raise ConfigError(
            f"cells: {point.cells} is not allowed in the plane; allowed: at most {MOST_PLANE_CELLS}"
        )
