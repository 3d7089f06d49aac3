"""Bands of ratios of means over independent scramblings of a design."""

import numpy as np

CONFIDENCE = 0.95


def ratios(numerators: np.ndarray, denominators: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the ratio of two means over scramblings, and the half-width of its band.

    A jackknife over scramblings, with Student's t: points of one scrambling depend on one another, so that a bootstrap
    of rows would over-cover; scramblings do not.

    Parameters
    ----------
    numerators, denominators
        Numbers of each scrambling, shapes (scramblings, ...) that broadcast.

    Returns
    -------
    tuple of ndarray
        Ratios and half-widths (...); not numbers where all denominators are 0, half-widths also where all but one are.
    """
    from scipy import stats

    count = len(numerators)
    above, below = numerators.sum(axis=0), denominators.sum(axis=0)
    with np.errstate(all="ignore"):
        ratio = above / below
        others = (above - numerators) / (below - denominators)
        scatter = np.sqrt((count - 1) / count * np.square(others - others.mean(axis=0)).sum(axis=0))
    return ratio, float(stats.t.ppf((1 + CONFIDENCE) / 2, count - 1)) * scatter
