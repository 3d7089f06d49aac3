"""From values on several grids to those of ever finer ones, with what is left in doubt."""

import numpy as np

from subslide.emulator import coordinates

TAILS = 0.02
"""Share of slopes, at either end, that are drawn in before a smooth one is laid through all."""


def limit(values: np.ndarray, cells: np.ndarray, z: np.ndarray | None) -> tuple[np.ndarray, np.ndarray]:
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
    tuple of ndarray
        Limits (n), and standard deviations (n): of residuals where slopes are pooled, else a share of how far the limit
        lies from the finest grid.
    """
    h = 1 / np.asarray(cells, float)
    weight = h**-2 / np.sum(h**-2)
    mean, middle = values @ weight, h @ weight
    slope = (values - mean[:, None]) @ (weight * (h - middle)) / (weight @ (h - middle) ** 2)
    if z is None:
        result = mean - slope * middle
        return result, OF_EXTRAPOLATION * np.abs(result - values[:, np.argmin(h)])
    size = np.maximum(np.abs(mean), 1e-12)
    relative = slope / size
    drawn_in = np.clip(relative, *np.nanquantile(relative, [TAILS, 1 - TAILS]))
    good = np.isfinite(drawn_in)
    basis = coordinates.quadratic(z)
    relative = basis @ np.linalg.lstsq(basis[good], drawn_in[good], rcond=None)[0]
    result = mean - relative * size * middle
    residual = values - result[:, None] - np.outer(relative * size, h)
    return result, OF_RESIDUALS * np.sqrt(residual**2 @ weight)


OF_RESIDUALS = 1.7
"""Doubt of a front's limit over its residuals: grids share a part of what they err by."""

OF_EXTRAPOLATION = 0.15
"""Doubt of a wave's limit over how far it was extrapolated: see docs/emulator.md."""
