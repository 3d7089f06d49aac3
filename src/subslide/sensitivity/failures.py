"""Failed runs, which are never left out: what their outputs may have been."""

import numpy as np


def ranges(outputs: np.ndarray, axes: tuple[int, ...]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return outputs with numbers in place of those of failed runs.

    Parameters
    ----------
    outputs
        Outputs of the runs, not a number where one failed.
    axes
        Axes along which the runs lie.

    Returns
    -------
    tuple of ndarray
        The outputs with the mean, the least and the largest output of the others where a run failed; the outputs
        themselves, three times, if none did.
    """
    failed = np.isnan(outputs)
    if not failed.any():
        return outputs, outputs, outputs
    with np.errstate(all="ignore"):
        mean = np.where(failed, 0, outputs).sum(axes, keepdims=True) / (~failed).sum(axes, keepdims=True)
    least = np.where(failed, np.inf, outputs).min(axes, keepdims=True)
    most = np.where(failed, -np.inf, outputs).max(axes, keepdims=True)
    filled, low, high = (np.where(failed, one, outputs) for one in (mean, least, most))
    return filled, low, high
