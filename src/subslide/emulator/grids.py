"""From values on several grids to those of ever finer ones, with what is left in doubt."""

from typing import NamedTuple

import numpy as np

from subslide.emulator import coordinates

TAILS = 0.02
"""Share of slopes, at either end, that are drawn in before a smooth one is laid through all."""


class Limit(NamedTuple):
    """Limits as cells shrink, and how far they may err, as standard deviations.

    Attributes
    ----------
    value
        Limits (n).
    noise
        What differs from column to column (n): leave-one-out sees it.
    bias
        What is wrong with all alike (n): leave-one-out cannot see it.
    """

    value: np.ndarray
    noise: np.ndarray
    bias: np.ndarray


def limit(values: np.ndarray, cells: np.ndarray, z: np.ndarray | None) -> Limit:
    """Return limits as cells shrink, and their doubt, of values that err in proportion to 1/cells.

    A line in 1/cells is fitted with the weights cells^2. Fronts err by a number of cells that is about the same for all
    columns, and jumps from grid to grid: there one slope, quadratic in the coordinates, does for all columns and halves
    the error. Waves have slopes of their own.

    Parameters
    ----------
    values
        Values (n, k) on k grids.
    cells
        Their numbers of cells (k), at least two.
    z
        Coordinates (n, 3) in which slopes are pooled; None if each column has its own.

    Returns
    -------
    Limit
        Where slopes are pooled, noise is that of residuals, and bias a multiple of what the finest grid changed (noise
        too of two grids). Else both are a share of how far limits lie from the finest grid.
    """
    if z is None:
        value, _, _ = _line(values, cells, None)
        doubt = OF_EXTRAPOLATION * np.abs(value - values[:, np.argmax(cells)])
        return Limit(value, doubt, doubt)
    value, slope, weight = _line(values, cells, z)
    residual = values - value[:, None] - slope[:, None] / cells
    noise = OF_RESIDUALS * np.sqrt(residual**2 @ weight)
    if len(cells) == 2:
        return Limit(value, noise, noise)
    coarse = np.argsort(cells)[:-1]
    change = value - _line(values[:, coarse], cells[coarse], z)[0]
    return Limit(value, noise, OF_CHANGE * np.abs(change))


def _line(
    values: np.ndarray, cells: np.ndarray, z: np.ndarray | None
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return limits (n) and slopes (n) over 1/cells, these smooth in z if there is one, and the grids' weights (k)."""
    h = 1 / np.asarray(cells, float)
    weight = h**-2 / np.sum(h**-2)
    mean, middle = values @ weight, h @ weight
    slope = (values - mean[:, None]) @ (weight * (h - middle)) / (weight @ (h - middle) ** 2)
    if z is not None:
        size = np.maximum(np.abs(mean), 1e-12)
        relative = slope / size
        drawn_in = np.clip(relative, *np.nanquantile(relative, [TAILS, 1 - TAILS]))
        good = np.isfinite(drawn_in)
        basis = coordinates.quadratic(z)
        slope = basis @ np.linalg.lstsq(basis[good], drawn_in[good], rcond=None)[0] * size
    return mean - slope * middle, slope, weight


OF_RESIDUALS = 1.7
"""Doubt of a front's limit over its residuals: grids share a part of what they err by."""

OF_EXTRAPOLATION = 0.15
"""Doubt of a wave's limit over how far it was extrapolated: see docs/emulator.md."""

OF_CHANGE = 2.0
"""Bias of a front's limit over what the finest grid changed in it."""
