"""The wave at the gauge: a peak that has a limit as cells shrink."""

import numpy as np

from subslide.naming import GAUGE
from subslide.points import Point

MEANING = (
    f"largest displacement of the water surface at the gauge ({GAUGE:g} R along x), up or down, in the mean over the"
    " time that a wave takes to go R, R / sqrt(g (H1 + H2))"
)


def peak(point: Point, time: np.ndarray, eta: np.ndarray) -> tuple[float, float]:
    """Return the largest running mean of the surface at the gauge, by size, and when.

    The head of a wave is a jump that each finer grid makes higher and narrower; what passes in a stated time converges.
    Over half that time one of 40 columns changed by 1.3 % from 3,200 to 6,400 cells, over all of it none by 0.6 %.
    Of 16 corners of the range one (a_H 0.5, a_2 0.3, r 0.8, delta 40) changes by 1.04 %, others by 0.55 % at most.

    Parameters
    ----------
    point
        The run's, which sets the time.
    time, eta
        Times (samples) in s and displacement (samples) in m at them, thought linear between.

    Returns
    -------
    tuple of float
        The size (m) of the mean and the middle (s) of its time; NaN without water, or of a shorter run.
    """
    from subslide.records import reductions

    span = point.radius / point.wave_speed
    mean, start = reductions.running_mean_peak(eta, time, span)
    return mean, start + span / 2
