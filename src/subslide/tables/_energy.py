"""How much a run's energy rises, where it should only fall: the measure of what a scheme feeds into its answer."""

import math

import numpy as np

from subslide.points import Point


def rise(point: Point, model: str, half_width: float, energy, water, grains) -> float:
    """Return the largest rise of the energy after any moment, over what the start can release: its own less at rest.

    model: the one solved; half_width (m) of its box, which nothing leaves. energy, water, grains: series of energy and
    volumes as in a record; NaN where not known. NaN if the start has nothing to release.
    """
    energy = energy[np.isfinite(energy)]
    released = energy[0] - at_rest(point, model, half_width, water[0], grains[0])
    largest = float((energy - np.minimum.accumulate(energy)).max())
    return largest / released if released > 1e-12 * abs(energy[0]) else math.nan


def at_rest(point: Point, model: str, half_width: float, water: float, grains: float) -> float:
    """Return the energy, as records have it, of volumes of water and grains that lie flat in a box."""
    width = 2 * half_width
    area = {"line": width, "quarter": width**2, "plane": width**2}.get(model, math.pi * half_width**2)
    if model == "one-layer" and not _round(point):
        area = width
    h1, h2 = (0.0 if math.isnan(volume) else volume / area for volume in (float(water), float(grains)))
    return point.g * area * (point.r * h1 * (0.5 * h1 + h2) + 0.5 * h2 * h2)


def _round(point: Point) -> bool:
    """Return whether the scene of a point is round."""
    from subslide import scenes

    return scenes.symmetry(point) == "round"
