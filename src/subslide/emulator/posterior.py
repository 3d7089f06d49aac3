"""A posterior by importance, without chance: quasi-random points of the prior, then mixtures that follow them."""

import math
from typing import NamedTuple

import numpy as np

from subslide.emulator.observed import Model

FIRST, NEXT = 13, 12
"""Powers of two: points of the prior, and of each mixture after it."""

ROUNDS = 5
ENOUGH = 2000.0
"""Effective number of points from which on no further mixture is drawn."""

CENTRES = 96
FREEDOM = 4
"""Of the t distributions of a mixture, whose tails reach beyond what was seen."""

CREDIBLE = 0.95


class Posterior(NamedTuple):
    """Weighted points of a posterior.

    Attributes
    ----------
    unit
        Places (n, free) in the unit cube of the prior.
    weight
        Their weights (n), of sum 1.
    log_likelihood
        Logarithms (n) of their likelihood.
    level
        Logarithm of the likelihood on the edge of the 95 % region: the smallest that has this share of the posterior.
    effective
        Number of points with equal weights that would tell as much.
    """

    unit: np.ndarray
    weight: np.ndarray
    log_likelihood: np.ndarray
    level: float
    effective: float

    def quantiles(self, values: np.ndarray, shares: tuple[float, ...]) -> np.ndarray:
        """Return weighted quantiles of values (n) of the points, for each of some shares."""
        order = np.argsort(values)
        return np.interp(shares, np.cumsum(self.weight[order]) - self.weight[order] / 2, values[order])


def sample(model: Model) -> Posterior:
    """Return the posterior of a model; the same to the last digit each time.

    Points of all rounds count together, each over the mean density of all rounds at its place (J.-M. Cornuet et al.,
    Scand. J. Stat. 39, 798, 2012).

    Parameters
    ----------
    model
        Data, emulator and what is known.

    Returns
    -------
    Posterior
        Its points.
    """
    from scipy.stats import qmc

    count = len(model.free)
    unit = qmc.Sobol(count, seed=1).random_base2(FIRST)
    logs = model.log_likelihood(unit)
    mixtures: list[tuple[np.ndarray, np.ndarray]] = []
    drawn = [len(unit)]
    density = np.full(len(unit), float(drawn[0]))
    while True:
        weight = np.exp(logs - logs.max()) / density
        weight /= weight.sum()
        effective = 1 / np.sum(weight**2)
        if effective >= ENOUGH or len(mixtures) == ROUNDS:
            break
        mixture = _mixture(unit, logs, density)
        mixtures.append(mixture)
        new = _drawn(mixture, len(mixtures))
        new = new[((new >= 0) & (new <= 1)).all(axis=1)]
        drawn.append(2**NEXT)
        density = density + drawn[-1] * _density(mixture, unit)
        of_new = float(drawn[0]) + sum(
            (number * _density(one, new) for number, one in zip(drawn[1:], mixtures, strict=True)),
            np.zeros(len(new)),
        )
        unit, density = np.concatenate([unit, new]), np.concatenate([density, of_new])
        logs = np.concatenate([logs, model.log_likelihood(new)])
    order = np.argsort(-logs)
    level = logs[order][np.searchsorted(np.cumsum(weight[order]), CREDIBLE)]
    return Posterior(unit, weight, logs, float(level), float(effective))


def _mixture(unit: np.ndarray, logs: np.ndarray, density: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return centres (k, free) of a mixture and the root (free, free) of their common covariance.

    Where few points have nearly all the weight, likelihoods are raised to a power below 1 until more count.
    """
    power = 1.0
    while True:
        weight = np.exp(power * (logs - logs.max())) / density
        weight /= weight.sum()
        if 1 / np.sum(weight**2) >= CENTRES / 2 or power < 1e-4:
            break
        power *= 0.7
    centres = unit[
        np.searchsorted(np.cumsum(weight), (np.arange(CENTRES) + 0.5) / CENTRES).clip(max=len(unit) - 1)
    ]
    mean = weight @ unit
    covariance = (unit - mean).T @ ((unit - mean) * weight[:, None]) + 1e-12 * np.eye(unit.shape[1])
    width = CENTRES ** (-1 / (unit.shape[1] + 4))
    return centres, width * np.linalg.cholesky(covariance)


def _drawn(mixture: tuple[np.ndarray, np.ndarray], seed: int) -> np.ndarray:
    """Return quasi-random points (n, free) of a mixture of t distributions."""
    from scipy.special import gammaincinv, ndtri
    from scipy.stats import qmc

    centres, root = mixture
    free = centres.shape[1]
    even = qmc.Sobol(free + 2, seed=seed).random_base2(NEXT).clip(1e-9, 1 - 1e-9)
    spread = np.sqrt(FREEDOM / (2 * gammaincinv(FREEDOM / 2, even[:, free])))
    place = (even[:, free + 1] * len(centres)).astype(int)
    return centres[place] + spread[:, None] * ndtri(even[:, :free]) @ root.T


def _density(mixture: tuple[np.ndarray, np.ndarray], unit: np.ndarray) -> np.ndarray:
    """Return the density (n) of a mixture of t distributions at points (n, free)."""
    centres, root = mixture
    free = unit.shape[1]
    inverse = np.linalg.inv(root)
    a, b = unit @ inverse.T, centres @ inverse.T
    square = np.maximum((a**2).sum(axis=1)[:, None] + (b**2).sum(axis=1) - 2 * a @ b.T, 0)
    constant = math.gamma((FREEDOM + free) / 2) / math.gamma(FREEDOM / 2) / (FREEDOM * math.pi) ** (free / 2)
    shape = (1 + square / FREEDOM) ** (-(FREEDOM + free) / 2)
    return constant / float(np.prod(np.diag(root))) * shape.mean(axis=1)
