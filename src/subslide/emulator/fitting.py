"""Gaussian processes of scaled values: kernels by scikit-learn, leave-one-out errors, and bands that hold them."""

import warnings
from typing import NamedTuple

import numpy as np

from subslide.emulator import coordinates
from subslide.emulator.group import Group, Process, kernel, single

MOST_TUNED = 400
"""Points that the kernel's lengths are found from: more change them little and cost their cube."""

COVERED = 0.95
"""Share of errors that a band holds."""

ANYWHERE = 1024
"""Columns at random, by which `_nearer` goes."""

LEAST = 1e-7
"""Relative errors below it count as it."""


class Learned(NamedTuple):
    """A group as it was learned.

    Attributes
    ----------
    group
        The group.
    left_out, bands
        What leave-one-out predicts of each column, and bands of that (n, q): wider than the group's by 1/nearer.
    nearer
        By what errors of leave-one-out are multiplied for those of a column at random, see `_nearer`.
    """

    group: Group
    left_out: np.ndarray
    bands: np.ndarray
    nearer: float


def learn(
    kind: str,
    names: tuple[str, ...],
    inputs: np.ndarray,
    values: np.ndarray,
    noise: np.ndarray,
    bias: np.ndarray,
) -> Learned:
    """Return a group of quantities with one kernel.

    Each is a law, exp of a quadratic in the coordinates, times a quadratic and a Gaussian process (Matern 5/2).

    Parameters
    ----------
    kind
        Its coordinates, see `coordinates.of`.
    names
        Its quantities (q).
    inputs
        Rows (n, 3) of a_H, r and m.
    values, noise, bias
        Values (n, q) and their standard deviations from the grids, see `grids.Limit`.

    Returns
    -------
    Learned
        The group, and what leave-one-out says of it.
    """
    z = coordinates.of(kind, inputs)
    basis = coordinates.quadratic(z)
    law = np.stack([_law(basis, column) for column in values.T], axis=1)
    scale = np.exp(basis @ law)
    trend = np.linalg.lstsq(basis, values / scale, rcond=None)[0]
    rest = values / scale - basis @ trend
    spread = np.maximum(rest.std(axis=0), LEAST)
    variance = np.median((noise / scale / spread) ** 2, axis=1) + 1e-10
    lengths, white = _tuned(z, rest / spread, variance)
    lengths = single(lengths)
    points = single(z / lengths)  # as the file has them, so that weights fit them
    covariance = kernel(points, points) + np.diag(variance / white[0] + white[1])
    inverse = np.linalg.inv(covariance)
    weights = inverse @ (rest / spread)
    hat = basis @ np.linalg.pinv(basis)
    of_trend = np.sum(inverse * hat, axis=1) / (1 - np.diag(hat))  # the trend too is found without the point
    error = (weights * spread + of_trend[:, None] * rest) / np.diag(inverse)[:, None] * scale
    nearer = _nearer(kind, inputs, lengths, points, covariance, inverse)
    spread_of = coordinates.of_errors(z)
    bands = np.stack(
        [_band(spread_of, nearer * e / s, d / s) for e, s, d in zip(error.T, scale.T, bias.T, strict=True)],
        axis=1,
    )
    process = Process(points, lengths, weights * spread)
    group = Group(kind, names, law, trend, bands, process)
    return Learned(group, values - error, np.exp(spread_of @ bands) * scale / nearer, nearer)


def band_of(kind: str, inputs: np.ndarray, errors: np.ndarray, bias: np.ndarray) -> np.ndarray:
    """Return the coefficients (12) of the logarithm of a relative band.

    Parameters
    ----------
    kind
        Coordinates.
    inputs
        Rows (n, 3) of a_H, r and m.
    errors, bias
        Relative errors (n) of leave-one-out, and what they cannot show: by how much all values may be wrong alike.

    Returns
    -------
    ndarray
        Coefficients of `coordinates.of_errors`.
    """
    return _band(coordinates.of_errors(coordinates.of(kind, inputs)), errors, bias)


def _law(basis: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Return the coefficients of the logarithm of a positive quadratic law through sizes of values."""
    size = np.maximum(np.abs(values), 1e-3 * np.median(np.abs(values)))
    return np.linalg.lstsq(basis, np.log(size), rcond=None)[0]


def _tuned(z: np.ndarray, rest: np.ndarray, noise: np.ndarray) -> tuple[np.ndarray, tuple[float, float]]:
    """Return the kernel's lengths (3), and its variance and white noise over it, of likelihood greatest."""
    from sklearn.exceptions import ConvergenceWarning
    from sklearn.gaussian_process import GaussianProcessRegressor
    from sklearn.gaussian_process.kernels import ConstantKernel, Matern, WhiteKernel

    some = slice(MOST_TUNED)
    prior = ConstantKernel(10, (1e-2, 1e4)) * Matern([1, 1, 1], (0.05, 20), nu=2.5) + WhiteKernel(
        1e-3, (1e-9, 1)
    )
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ConvergenceWarning)  # a length at its end is one that does not matter
        fitted = GaussianProcessRegressor(prior, alpha=noise[some], random_state=0).fit(z[some], rest[some])
    product, white = fitted.kernel_.k1, fitted.kernel_.k2
    variance = product.k1.constant_value
    return product.k2.length_scale, (variance, white.noise_level / variance)


def _nearer(
    kind: str,
    inputs: np.ndarray,
    lengths: np.ndarray,
    points: np.ndarray,
    covariance: np.ndarray,
    inverse: np.ndarray,
) -> float:
    """Return the deviation of columns at random, by the kernel, over that of columns left out.

    Points of an even design keep apart, so that one left out is further from the others than a column at random.
    """
    ratio = np.array([0, 1, 0])  # r, which may be 0
    logs = np.log(inputs + ratio)
    low, high = logs.min(axis=0), logs.max(axis=0)
    rows = np.exp(low + np.random.default_rng(0).random((ANYWHERE, 3)) * (high - low)) - ratio
    shared = kernel(coordinates.of(kind, rows) / lengths, points)
    white = np.median(np.diag(covariance)) - 1
    there = 1 + white - np.sum((shared @ inverse) * shared, axis=1)
    return float(
        np.exp(0.5 * np.mean(np.log(np.maximum(there, white))) + 0.5 * np.mean(np.log(np.diag(inverse))))
    )


def _band(basis: np.ndarray, errors: np.ndarray, bias: np.ndarray) -> np.ndarray:
    """Return the coefficients of ln(band): a smooth function through ln|error|, moved so that it holds COVERED of them.

    How far each error lies from it is judged without that error, and the next one counts too: with few points a
    function follows them, and the 95 % of them that it holds would be far less of others.
    """
    size = np.log(np.sqrt(errors**2 + bias**2 + LEAST**2))
    inverse = np.linalg.pinv(basis)
    coefficients = inverse @ size
    apart = (size - basis @ coefficients) / (1 - np.sum(basis * inverse.T, axis=1))
    coefficients[0] += np.quantile(apart, min(1.0, COVERED * (1 + 1 / len(size))))
    return coefficients
