"""Bands of discretisation error on fitted grids: a share of the value, calibrated on columns that 12,800 cells solved.

Errors change sign from one fitted grid to the next, so that two grids say nothing of a third; but on one grid they are
about the same share of a front's place whatever the column, and larger where dense water is shallow. So there are no
companions: the band is a share read off at columns, times 1 + (1 + 2 r)/a_H.
"""

import numpy as np

from subslide.naming import FRONT_LABELS
from subslide.points import Point
from subslide.tables import _calibration as uniform

NODES = (24, 34, 48, 64, 110)
"""Cells of the grids that were calibrated; between them logarithms of shares are linear in that of the cells, beyond
them the nearest counts."""

SHARES: dict[str, tuple[tuple[float, ...], ...]] = {
    "moving": (
        (0.0087, 0.0043, 0.0024, 0.0019, 0.0012),
        (0.0035, 0.0018, 0.0014, 0.0012, 0.0006),
        (0.0029, 0.0022, 0.0018, 0.0014, 0.0007),
    ),
    "arrived": (
        (0.0071, 0.0029, 0.0023, 0.0021, 0.0013),
        (0.0058, 0.0058, 0.0038, 0.0027, 0.0016),
        (0.0064, 0.0045, 0.0029, 0.0026, 0.0018),
    ),
    "arrest": (
        (0.0206, 0.0159, 0.0083, 0.0066, 0.0036),
        (0.0400, 0.0964, 0.0300, 0.0253, 0.0156),
        (0.1071, 0.1230, 0.0325, 0.0349, 0.0243),
    ),
}
"""Half-width over the value, of fronts on their way and at rest, and of times of arrest: a row for each threshold of
`FRONT_LABELS`, a number for each node. In deep water; `factor` has the rest."""

DENSE = 2.0
"""Bands grow by (1 + DENSE r) / a_H."""

OUTSIDE = 4.0
"""Times that bands are as wide where nothing was calibrated; again so many at first order."""

LEAST_FRICTION = (0.1, 0.24)
"""Friction numbers m: below the second, that of the range, slow grains at rest err by 1/m^3, to the first."""


def is_calibrated(point: Point) -> bool:
    """Return whether a run is like those that were calibrated."""
    return uniform.is_alike(point, uniform.SOLVERS[:1]) and NODES[0] <= point.cells <= NODES[-1]


def factor(point: Point) -> float:
    """Return by how much bands are wider than in deep water."""
    depth = max(point.a_H, uniform.RANGE["a_H"][0]) if point.r > 0 else 1.0  # water without weight has no say
    return 1 + (1 + DENSE * point.r) / depth


def widening(point: Point, moving: bool) -> float:
    """Return how many times as wide bands are for a run unlike those that were calibrated, at least `OUTSIDE`."""
    if is_calibrated(point):
        return 1.0
    low, high = LEAST_FRICTION
    slow = 1.0 if moving else max(1.0, high / max(low, point.least_friction)) ** 3
    return OUTSIDE ** (3 - point.order) * max(1.0, NODES[0] / point.cells) ** 2 * slow


def half_width(point: Point, quantity: str, value: float, length: float) -> float:
    """Return the half-width of the band of a value, in its unit.

    Parameters
    ----------
    point
        The run's.
    quantity
        Name of a quantity of bands.csv, which ends with the label of a threshold.
    value
        The front's place, or its time of arrest.
    length
        Last place of that front.

    Returns
    -------
    float
        Half-width, wider where nothing was calibrated.
    """
    name, _, label = quantity.rpartition("_")
    moving = name == "x_front" and value < uniform.ARRIVED * length
    kind = "arrest" if name == "time_of_arrest" else "moving" if moving else "arrived"
    shares = SHARES[kind][FRONT_LABELS[label]]
    share = float(np.exp(np.interp(np.log(point.cells), np.log(NODES), np.log(shares))))
    return share * factor(point) * widening(point, moving) * value
