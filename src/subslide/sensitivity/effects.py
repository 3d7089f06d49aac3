"""Main effects: the mean of an output over all other inputs, along one of them, with bands."""

from dataclasses import dataclass

import numpy as np

from subslide.sensitivity.banded import Banded
from subslide.sensitivity.failures import ranges
from subslide.sensitivity.jackknife import ratios

BINS = 12
"""Parts of equal probability that an input's range is cut into."""


@dataclass(frozen=True)
class Effect(Banded):
    """Main effect of an input: arrays (bins).

    Attributes
    ----------
    value
        Mean of the input in each bin.
    mean
        Mean of the output there, failed runs with the mean of all others.
    """

    value: np.ndarray
    mean: np.ndarray


def effect(
    outputs: np.ndarray, column: np.ndarray, half_widths: np.ndarray | None = None, bins: int = BINS
) -> Effect:
    """Return the main effect of an input.

    Parameters
    ----------
    outputs
        Outputs of the runs, shape (scramblings, ...), not a number where a run failed.
    column
        Values of the input, of the same shape; each block of a Saltelli design is a sample of it.
    half_widths
        Half-widths of the outputs' grid error, of the same shape; without them none.
    bins
        Parts of equal probability.

    Returns
    -------
    Effect
        Means in each part. The band of a mean is a jackknife over scramblings with Student's t.
    """
    count = len(outputs)
    outputs, column = outputs.reshape(count, -1), column.reshape(count, -1)
    places = np.minimum(
        column.ravel().argsort(kind="stable").argsort(kind="stable") * bins // column.size, bins - 1
    )
    member = (places.reshape(column.shape)[..., None] == np.arange(bins)).astype(float)

    def sums(values: np.ndarray) -> np.ndarray:
        """Return sums in each bin: (scramblings, bins)."""
        return np.einsum("sn,snb->sb", values, member)

    filled, low, high = ranges(outputs, (0, 1))
    sizes = member.sum(axis=1)
    total = sizes.sum(axis=0)
    errors = np.full_like(filled, np.nan) if half_widths is None else half_widths.reshape(count, -1)
    mean, sampling = ratios(sums(filled), sizes)
    with np.errstate(invalid="ignore"):  # fewer runs than bins leave some empty
        value, grid, least, most = (
            sums(values).sum(axis=0) / total for values in (column, errors, low, high)
        )
    return Effect(sampling, grid, least, most, value=value, mean=mean)
