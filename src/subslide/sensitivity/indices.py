"""Sobol' indices from Saltelli blocks, each with a band that holds sampling, grid error and failed runs.

Ours because no library takes bands from independent scramblings, bounds an index where runs failed, or does whole
series at once; their points are made by `scipy.stats.qmc`. With A and B two independent samples, AB_i the sample A with
column i of B, and BA_i the other way round, every moment is a mean of products of two differences, so that a shift of
the output drops out and a small effect has a small error:

    V       half the square of (A - B), and of each (AB_i - BA_i)
    V_i     - (BA_i - B) (AB_i - A) / 2
    V_Ti    ((AB_i - A)^2 + (BA_i - B)^2) / 4
    V_ij    ((BA_i - B) (AB_j - A) + (BA_j - B) (AB_i - A)) / 2
    V_{ij}  V_i + V_j + V_ij

The first three are those of Azzini, Mara and Rosati (Environ. Model. Softw. 144, 105167, 2021), Jansen's among them;
the fourth follows likewise, and is taken of the output less a sum of functions of one input each, which has no part in
it but its scatter. An index is the ratio of two means over all scramblings. Negative estimates are kept.
"""

import itertools
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from subslide.sensitivity.additive import Additive, ranks
from subslide.sensitivity.banded import Banded
from subslide.sensitivity.failures import ranges
from subslide.sensitivity.jackknife import ratios

DRAWS = 12
"""Independent perturbations within the half-widths of the outputs."""

Interval = tuple[np.ndarray, np.ndarray]
"""Lowest and highest of each of many numbers."""


class Label(NamedTuple):
    """What an index is of: its kind (`first`, `total`, `second` or `closed`), and the places of its inputs."""

    kind: str
    places: tuple[int, ...]


@dataclass(frozen=True)
class Indices(Banded):
    """Indices in the order of `labels`, each an array (indices, ...).

    Attributes
    ----------
    estimate
        The index; not a number where the output does not vary.
    """

    estimate: np.ndarray


def labels(inputs: int) -> list[Label]:
    """Return what the indices of so many inputs are of, in order.

    Parameters
    ----------
    inputs
        How many inputs there are.

    Returns
    -------
    list of Label
        First-order and total indices of each, then second-order and closed ones of each pair.
    """
    ones = [(i,) for i in range(inputs)]
    pairs = list(itertools.combinations(range(inputs), 2))
    kinds = (("first", ones), ("total", ones), ("second", pairs), ("closed", pairs))
    return [Label(kind, places) for kind, of in kinds for places in of]


def indices(
    outputs: np.ndarray, half_widths: np.ndarray | None = None, inputs: np.ndarray | None = None
) -> Indices:
    """Return the indices of an output, or of many at once.

    Failed runs are never left out: the estimate has the others' mean in their place, and its bounds let each of them
    have any output from the others' least to their largest, each on its own (interval arithmetic, so that the bounds
    are never too narrow).

    The grid error of the outputs is unknown within their half-widths, and may be of any kind: the same for all runs, a
    trend along an input, or of each run on its own as where a front stands within its cell. So the outputs are
    perturbed by all of these, whole half-widths up and down for the first two (the worst of them counts), half of one
    as the standard deviation of the third (95 % within the half-width; here the mean change counts and twice its
    scatter). All errors at their worst at once would be no error of any grid.

    Parameters
    ----------
    outputs
        Outputs of the runs, shape (scramblings, 2 + 2 inputs, points, ...), blocks in the order A, B, AB_1.., BA_1..;
        not a number where a run failed.
    half_widths
        Half-widths of their grid error, of the same shape; without them none.
    inputs
        Inputs of the runs, shape (scramblings, 2 + 2 inputs, points, inputs): for trends along each, and for second
        orders without the scatter of first ones.

    Returns
    -------
    Indices
        Arrays of shape (indices, ...), in the order of `labels`.
    """
    first = outputs[:1, :1, :1]
    filled, low, high = ranges(outputs - np.where(np.isnan(first), 0.0, first), (0, 1, 2))
    additive = Additive(inputs)
    sums = additive.of(filled)
    estimate, sampling = _ratios(_moments((filled, filled), sums)[0])
    least, most = (estimate, estimate) if low is high else _bounds(_moments((low, high), sums))
    grid = np.full_like(estimate, np.nan)
    if half_widths is not None:
        trends = [] if inputs is None else [ranks(column) for column in np.moveaxis(inputs, -1, 0)]
        grid = _of_grid(filled, np.nan_to_num(half_widths), trends, additive, estimate)
    return Indices(sampling, grid, least, most, estimate=estimate)


def _moments(outputs: Interval, sums: np.ndarray) -> Interval:
    """Return V and then the moments in the order of `labels`, of each scrambling: (1 + indices, scramblings, ...)."""
    k = outputs[0].shape[1] // 2 - 1
    blocks = _blocks(outputs)
    of_a, of_b = _changes(blocks)
    varied = [_less(blocks[0], blocks[1]), *(_less(blocks[2 + i], blocks[2 + k + i]) for i in range(k))]
    rest_a, rest_b = _changes(_blocks((outputs[0] - sums, outputs[1] - sums)))
    pairs = list(itertools.combinations(range(k), 2))
    first = [_mean(-0.5, _times(of_b[i], of_a[i])) for i in range(k)]
    total = [_mean(0.25, _square(of_a[i]), _square(of_b[i])) for i in range(k)]
    second = [_mean(0.5, _times(rest_b[i], rest_a[j]), _times(rest_b[j], rest_a[i])) for i, j in pairs]
    closed = [
        (first[i][0] + first[j][0] + both[0], first[i][1] + first[j][1] + both[1])
        for (i, j), both in zip(pairs, second, strict=True)
    ]
    variance = _mean(1 / (2 * len(varied)), *map(_square, varied))
    moments = [variance, *first, *total, *second, *closed]
    return np.stack([low for low, _ in moments]), np.stack([high for _, high in moments])


def _blocks(outputs: Interval) -> list[Interval]:
    """Return the blocks of outputs: A, B, each AB_i, each BA_i."""
    return [(outputs[0][:, place], outputs[1][:, place]) for place in range(outputs[0].shape[1])]


def _changes(blocks: list[Interval]) -> tuple[list[Interval], list[Interval]]:
    """Return each AB_i - A, and each BA_i - B."""
    k = len(blocks) // 2 - 1
    return [_less(one, blocks[0]) for one in blocks[2 : 2 + k]], [
        _less(one, blocks[1]) for one in blocks[2 + k :]
    ]


def _less(x: Interval, y: Interval) -> Interval:
    """Return x - y."""
    return x[0] - y[1], x[1] - y[0]


def _times(x: Interval, y: Interval) -> Interval:
    """Return the product of two intervals of different numbers."""
    ends = [p * q for p in x for q in y]
    return np.minimum.reduce(ends), np.maximum.reduce(ends)


def _square(x: Interval) -> Interval:
    """Return the square of an interval."""
    low, high = np.square(x[0]), np.square(x[1])
    return np.where((x[0] < 0) & (x[1] > 0), 0, np.minimum(low, high)), np.maximum(low, high)


def _mean(factor: float, *terms: Interval) -> Interval:
    """Return the mean over points of a factor times the sum of terms."""
    low, high = (factor * np.sum([term[end] for term in terms], axis=0).mean(axis=1) for end in (0, 1))
    return (low, high) if factor > 0 else (high, low)


def _ratios(moments: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the moments over V, and the half-widths of their bands."""
    by_scrambling = np.moveaxis(moments, 1, 0)
    return ratios(by_scrambling[:, 1:], by_scrambling[:, :1])


def _bounds(moments: Interval) -> Interval:
    """Return the least and the largest ratio of means over scramblings, of moments within intervals."""
    low, high = (end.mean(axis=1) for end in moments)
    with np.errstate(all="ignore"):
        quotients = [numerator / variance[0] for numerator in (low[1:], high[1:]) for variance in (low, high)]
        return np.minimum.reduce(quotients), np.maximum.reduce(quotients)


def _of_grid(
    outputs: np.ndarray,
    half_widths: np.ndarray,
    trends: list[np.ndarray],
    additive: Additive,
    estimate: np.ndarray,
) -> np.ndarray:
    """Return the half-widths of indices for errors of the outputs within half-widths, see `indices`."""
    shape = (*outputs.shape[:3], *[1] * (outputs.ndim - 3))

    def change(error: np.ndarray) -> np.ndarray:
        """Return how an error of the outputs, in half-widths, changes the estimates."""
        perturbed = outputs + error.reshape(shape) * half_widths
        return _ratios(_moments((perturbed, perturbed), additive.of(perturbed))[0])[0] - estimate

    worst = [abs(change(sign * trend)) for trend in (np.ones(shape), *trends) for sign in (-1, 1)]
    random = np.random.default_rng(1)
    drawn = np.stack([change(random.normal(0, 0.5, shape)) for _ in range(DRAWS)])
    return np.maximum.reduce([*worst, abs(drawn.mean(axis=0)) + 2 * drawn.std(axis=0, ddof=1)])
