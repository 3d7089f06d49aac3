"""When a front has arrived: a time that converges, where that of the last grain at rest does not."""

import math

import numpy as np

from subslide.naming import ARREST
from subslide.solver.compiled import sparing


@sparing
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
    final = front[len(front) - 1]
    if not final > 0.0:
        return math.nan
    last = len(front) - 1
    while last >= 0 and abs(front[last] / final - 1.0) <= ARREST:
        last -= 1
    if last < 0:
        return time[0]
    left, came = front[last] / final - 1.0, front[last + 1] / final - 1.0
    if math.isnan(left):
        return time[last + 1]
    share = (abs(left) - ARREST) / abs(left - came)
    return time[last] + share * (time[last + 1] - time[last])
