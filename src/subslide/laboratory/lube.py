"""What laboratories measured, in the units of the study."""

import math


def runout(a_2: float) -> float:
    """Return the runout over R of dry columns of aspect ratio a_2: 1 + 1.24 a_2 below 1.7, 1 + 1.6 sqrt(a_2) above.

    G. Lube, H. E. Huppert, R. S. J. Sparks and M. A. Hallworth, J. Fluid Mech. 508, 175 (2004).
    """
    return 1 + 1.24 * a_2 if a_2 < 1.7 else 1 + 1.6 * math.sqrt(a_2)


def duration(height: float, g: float) -> float:
    """Return the time in which dry round columns come to rest, 3.0 sqrt(height / g), by the same authors.

    Parameters
    ----------
    height
        Height (m) of the column.
    g
        Gravity (m s-2).

    Returns
    -------
    float
        Time (s) since release.
    """
    return 3.0 * math.sqrt(height / g)
