"""Whether the values of a point, each allowed, go with one another."""

import math

from subslide import scenes
from subslide.keys import words
from subslide.keys.schema import ConfigError
from subslide.points import Point
from subslide.study import choice
from subslide.study.remembering import Remembered

MOST_PLANE_CELLS = 10_000
GEOMETRIES = {
    ("fields", True): choice.PLANE,
    (
        "as_printed",
        "upwinding",
    ): choice.PLANE,  # of tangential momentum, which a line or a radius does not have
    ("boundary", "periodic"): ("line", "plane"),
}
"""Geometries to which a value of a key is limited."""


LEAST_SINGLE, MOST_SINGLE, LOST_SINGLE = 1.18e-38, 3.4e38, 6e-8
"""Least and greatest number of float32, and what is lost beside 1. float64 holds whatever the keys allow."""


@Remembered
def check(point: Point) -> None:
    """Raise a ConfigError, of one line, if values of a point do not go with one another."""
    if point.dtype == "float32":
        _check_single(point)
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
    model, geometry, reason, *_ = choice.of(point)
    for (key, value), geometries in GEOMETRIES.items():
        if getattr(point, key) == value and geometry not in geometries:
            raise ConfigError(
                f"{key}: {words.show(value)} is not allowed with model: {model} ({reason});"
                f" allowed: {', '.join(geometries)}"
            )
    if point.runout_directions and geometry == "line":
        raise ConfigError(
            f"runout_directions: {point.runout_directions} is not allowed with model: {model} ({reason}); allowed:"
            " radial, quarter, plane"
        )
    _check_gauges(point, geometry)
    if point.grid == "fitted" and (unfit := choice.unfit(point, geometry)):
        raise ConfigError(f"grid: fitted is not allowed where {unfit}; allowed: uniform, or auto")
    if geometry in choice.PLANE and point.cells > MOST_PLANE_CELLS:
        raise ConfigError(
            f"cells: {point.cells} is not allowed in the plane; allowed: at most {MOST_PLANE_CELLS}"
        )


def _check_gauges(point: Point, geometry: str) -> None:
    """Raise a ConfigError if a gauge lies outside the smallest box."""
    for x, y in point.gauges:
        half = point.half_box * point.radius
        bounded = geometry == "radius" and not choice.at_sea(point)
        if max(abs(x), abs(y), math.hypot(x, y) if bounded else 0.0) > half:
            raise ConfigError(
                f"gauges: {words.show([x, y])} lies outside the box; allowed: {'at' if bounded else 'x and y'} up to"
                f" {half:.6g} m from the axis"
            )


def _check_single(point: Point) -> None:
    """Raise a ConfigError unless float32 holds what the values become in scaled equations."""
    if 0 < point.a_H < LOST_SINGLE:
        raise ConfigError(
            f"a_H: {point.a_H:g} is lost beside 1 in float32; allowed: 0, from {LOST_SINGLE:g}, or dtype: float64"
        )
    scaled = {"delta": point.friction_number, "xi": point.turbulence, **dict(point.scene_options)}
    for name, value in scaled.items():
        if isinstance(value, float) and value and not LEAST_SINGLE <= abs(value) <= MOST_SINGLE:
            raise ConfigError(
                f"{name}: {value:g}, as it enters the equations, is no number of float32; allowed: 0, from"
                f" {LEAST_SINGLE:g} to {MOST_SINGLE:g}, or dtype: float64"
            )
