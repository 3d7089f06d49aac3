"""Least squares from many starts at once, some coordinates held: the best fit, and profiles of the likelihood."""

import numpy as np

from subslide.emulator.observed import Model
from subslide.emulator.posterior import Posterior

STEPS = 25
DIFFERENCE = 1e-5
STARTS = 12
GRID = 31
"""Values of a parameter along its profile."""


def descend(model: Model, unit: np.ndarray, held: int | None = None) -> tuple[np.ndarray, np.ndarray]:
    """Return where Levenberg and Marquardt's steps end, and the logarithms (n) of the likelihood there.

    Parameters
    ----------
    model
        What is fitted.
    unit
        Starts (n, free) in the unit cube, which no step leaves.
    held
        Coordinate that stays as it is.

    Returns
    -------
    tuple of ndarray
        Places (n, free) and logarithms (n), of each the best that was seen.
    """
    free = [k for k in range(unit.shape[1]) if k != held]
    best, damping = unit.copy(), np.full(len(unit), 1e-3)
    logs = model.log_likelihood(best)
    for _ in range(STEPS if free else 0):
        place, deviation = model.fronts(best)
        residual = (model.data.place - place) / deviation
        slopes = []
        for k in free:
            moved = best.copy()
            step = np.where(best[:, k] > 0.5, -DIFFERENCE, DIFFERENCE)
            moved[:, k] += step
            slopes.append((model.fronts(moved)[0] - place) / deviation / step[:, None])
        jacobian = np.stack(slopes, axis=2)
        normal = np.einsum("nik,nil->nkl", jacobian, jacobian)
        right = np.einsum("nik,ni->nk", jacobian, residual)
        scale = np.einsum("nkk->nk", normal)[:, None, :] * np.eye(len(free)) + 1e-9 * np.eye(len(free))
        step = np.linalg.solve(normal + damping[:, None, None] * scale, right[..., None])[..., 0]
        tried = best.copy()
        tried[:, free] = np.clip(best[:, free] + step, 0, 1)
        new = model.log_likelihood(tried)
        better = new > logs
        best[better], logs[better] = tried[better], new[better]
        damping = np.clip(np.where(better, damping / 4, damping * 4), 1e-9, 1e6)
    return best, logs


def best_fit(model: Model, posterior: Posterior) -> tuple[np.ndarray, float]:
    """Return where the likelihood is greatest, and its logarithm.

    Parameters
    ----------
    model
        What is fitted.
    posterior
        Points to start from.

    Returns
    -------
    tuple
        Place (free) in the unit cube, and the logarithm.
    """
    starts = posterior.unit[np.argsort(-posterior.log_likelihood)[:STARTS]]
    places, logs = descend(model, starts)
    n = int(np.argmax(logs))
    return places[n], float(logs[n])


def profile(model: Model, posterior: Posterior, best: np.ndarray, k: int) -> tuple[np.ndarray, np.ndarray]:
    """Return values of one coordinate, and by how much the others' best fit falls short there.

    Parameters
    ----------
    model
        What is fitted.
    posterior
        Points to start from.
    best
        Place of the best fit.
    k
        The coordinate.

    Returns
    -------
    tuple of ndarray
        Places (GRID) of the coordinate, as far as the posterior reaches, and -2 ln of the likelihood there.
    """
    low, high = posterior.quantiles(posterior.unit[:, k], (0.0005, 0.9995))
    room = 0.5 * (high - low)
    grid = np.linspace(max(0.0, low - room), min(1.0, high + room), GRID)
    near = np.abs(posterior.unit[:, k][None] - grid[:, None]) / max(high - low, 1e-9)
    score = posterior.log_likelihood[None] - 1e3 * np.maximum(near - 1 / GRID, 0)
    starts = np.concatenate([posterior.unit[np.argmax(score, axis=1)], np.tile(best, (GRID, 1))])
    starts[:, k] = np.tile(grid, 2)
    _, logs = descend(model, starts, held=k)
    return grid, -2 * logs.reshape(2, GRID).max(axis=0)
