"""When a front has arrived: a time that converges, where that of the last grain at rest does not."""

import math

import numpy as np

from subslide.naming import ARREST


def time_of_arrest(time: np.ndarray, front: np.ndarray) -> float:
    """Return since when a front has been as near to its last place as `naming.ARREST` says.

    Parameters
    ----------
    time, front
        Times (samples) in s, and the front (samples) in m, NaN where there is none.

    Returns
    -------
    float
        Time (s), linear between samples; the first of all if the front was never farther off, NaN if it ends nowhere
        or at 0.
    """
    final = front[-1]
    if not final > 0:
        return math.nan
    away = front / final - 1
    outside = np.flatnonzero(~(np.abs(away) <= ARREST))
    if not outside.size:
        return float(time[0])
    last = outside[-1]
    left, came = away[last], away[last + 1]
    if np.isnan(left):
        return float(time[last + 1])
    share = (abs(left) - ARREST) / abs(left - came)
    return float(time[last] + share * (time[last + 1] - time[last]))
