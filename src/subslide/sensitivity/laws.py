"""Power laws of many runs: fitted in logarithms, with cross-validated errors and bands of exponents."""

from typing import NamedTuple

import numpy as np

from subslide.sensitivity.jackknife import CONFIDENCE

RESAMPLES = 2000


class Law(NamedTuple):
    """Power law y = C x_1^p_1 x_2^p_2 ...

    Attributes
    ----------
    terms
        C, then the exponents.
    low, high
        Ends of their bands; not numbers without two groups.
    predicted
        Values (groups, points) of the law fitted without the group that a point belongs to.
    errors
        Relative errors of these, absolute values, not a number where there is no logarithm.
    explained
        Share of the variance of the logarithm of y that these explain.
    """

    terms: np.ndarray
    low: np.ndarray
    high: np.ndarray
    predicted: np.ndarray
    errors: np.ndarray
    explained: float


def fit(values: np.ndarray, variables: np.ndarray) -> Law:
    """Return the power law that fits values best, in logarithms.

    Groups are left out in turn for the error, and resampled with repeats for the bands (a bootstrap): points of one
    scrambling of a design depend on one another, groups do not. What too few points do not tell is not a number.

    Parameters
    ----------
    values
        Values (groups, points); those that are not above 0, or not numbers, are left out.
    variables
        Variables (groups, points, number of them), all above 0.

    Returns
    -------
    Law
        The law.
    """
    kept = values > 0
    logarithms = np.log(np.where(kept, values, 1.0))
    ones = np.ones((*values.shape, 1))
    design = np.concatenate([ones, np.log(variables)], axis=-1) * kept[..., None]
    squares = np.einsum("gpi,gpj->gij", design, design)
    products = np.einsum("gpi,gp->gi", design, logarithms)

    def solved(weights: np.ndarray) -> np.ndarray:
        """Return the terms (n, terms) by weights (n, groups) of the groups."""
        left, right = np.tensordot(weights, squares, 1), np.tensordot(weights, products, 1)
        told = np.linalg.matrix_rank(left, hermitian=True) == left.shape[-1]
        answer = np.full(right.shape, np.nan)
        answer[told] = np.linalg.solve(left[told], right[told][..., None])[..., 0]
        return answer

    groups = len(values)
    terms = solved(np.ones((1, groups)))[0]
    without = solved(1.0 - np.eye(groups))
    drawn = np.random.default_rng(1).multinomial(groups, np.full(groups, 1 / groups), RESAMPLES)
    resampled = solved(drawn.astype(float))
    predicted = np.einsum("gpi,gi->gp", np.concatenate([ones, np.log(variables)], axis=-1), without)
    left = np.where(kept, predicted - logarithms, np.nan)
    some = np.isfinite(left)
    explained = 1 - np.mean(left[some] ** 2) / np.var(logarithms[some]) if some.any() else np.nan
    tails = ((1 - CONFIDENCE) / 2, (1 + CONFIDENCE) / 2)
    whole = resampled[np.isfinite(resampled[:, 0])]
    low, high = (
        np.quantile(whole, tails, axis=0) if groups > 1 and len(whole) else np.full((2, len(terms)), np.nan)
    )
    for one in (terms, low, high):
        one[0] = np.exp(one[0])
    return Law(terms, low, high, np.exp(predicted), abs(np.expm1(left)), float(explained))
