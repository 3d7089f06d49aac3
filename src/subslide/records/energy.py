"""How much a run's energy rises, where it should only fall: the measure of what a scheme feeds into its answer."""

import math
from collections.abc import Mapping

import numpy as np

from subslide import scenes
from subslide.points import Point

GAINED = 0.1
"""Rise of the energy, over what the start can release, from which an answer is wrong although the run ended well."""


def rise(
    point: Point,
    model: str,
    half_width: float,
    series: Mapping[str, np.ndarray],
    until: float = math.inf,
) -> float:
    """Return the largest rise of the energy after any moment, over what the start can release: its own less at rest.

    Parameters
    ----------
    point
        The run's.
    model
        The one that was solved.
    half_width
        Of the box (m), which nothing leaves.
    series
        Series (samples) of `time` (s), `energy` (m5 s-2), `water_volume` and `sediment_volume` (m3) as in a record; NaN
        where not known.
    until
        Time (s) from which energy passes an open edge, and no sample counts; NaN as if it never does.

    Returns
    -------
    float
        The rise over what can be released; NaN if the start has nothing to release.
    """
    from subslide.records import reductions

    first, largest = reductions.rise(series["energy"], series["time"], until)
    water, grains = (float(series[name][0]) for name in ("water_volume", "sediment_volume"))
    released = first - at_rest(point, model, half_width, water, grains)
    return largest / released if released > 1e-12 * abs(first) else math.nan


def at_rest(point: Point, model: str, half_width: float, water: float, grains: float) -> float:
    """Return the energy, as records have it, of volumes of water and grains that lie flat in a box.

    E = g A (r h1 (h1/2 + h2) + h2²/2) on the area A of the box, with the depths h1 and h2 of flat layers.

    Parameters
    ----------
    point, model, half_width
        As in `rise`.
    water, grains
        Volumes (m3, on a line m2); NaN for water of a model without it.

    Returns
    -------
    float
        Energy (m5 s-2) over the density of grains.
    """
    width = 2 * half_width
    area = {"line": width, "quarter": width**2, "plane": width**2}.get(model, math.pi * half_width**2)
    if model == "one-layer" and not _round(point):
        area = width
    h1, h2 = (0.0 if math.isnan(volume) else volume / area for volume in (float(water), float(grains)))
    return point.g * area * (point.r * h1 * (0.5 * h1 + h2) + 0.5 * h2 * h2)


def _round(point: Point) -> bool:
    """Return whether the scene of a point is round."""
    return scenes.symmetry(point) == "round"
