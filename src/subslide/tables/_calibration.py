"""Bands of discretisation error that were calibrated: on columns whose answer a grid of 6,400 cells gave.

Three grids of a front rarely fall in an order, since it errs by where it stands within a cell; but on one grid the
error is about the same number of cells whatever the column. So the band of a front is a number of cells, read off at
columns drawn at random, and that of a wave follows from the differences of the three grids.
"""

import math
from collections.abc import Collection
from typing import NamedTuple

import numpy as np

from subslide.naming import FRONT_LABELS
from subslide.points import Point
from subslide.study import choice

RANGE = {"a_H": (0.5, 10.0), "a_2": (0.3, 1.5), "r": (0.0, 0.8), "delta": (20.0, 40.0)}
"""Columns that were drawn."""

ARRIVED = 0.95
"""Fraction of L_f from which a front errs as one at rest does."""

NODES = (200, 400, 800, 1600)
"""Cells of the grids that were calibrated; between them bands are linear in the logarithm, beyond them the nearest."""

FINEST = {1: 1600, 2: 3200}
"""Most cells of a run that counts as calibrated, by order: at second order errors are as many cells from 400 on, and
the bands of 1,600 cells held 98 % of 896 values of 47 columns on 3,200 (no quantity below 91 %)."""

CELLS: dict[tuple[int, bool], tuple[tuple[float, ...], ...]] = {
    (2, False): ((3.0, 2.15, 2.25, 1.9), (1.8, 0.85, 0.45, 0.45), (1.1, 0.4, 0.5, 0.25)),
    (2, True): ((2.15, 1.2, 1.4, 1.45), (1.2, 0.65, 0.75, 0.65), (0.85, 0.5, 0.6, 0.55)),
    (1, False): ((7.2, 10.1, 13.3, 16.55), (3.6, 4.9, 6.4, 7.85), (2.05, 2.75, 3.3, 3.05)),
    (1, True): ((8.55, 11.0, 13.1, 14.95), (3.8, 4.6, 5.1, 6.3), (2.3, 2.8, 3.4, 4.2)),
}
"""Half-width of the bands of fronts, in cells, by order of the scheme and whether the front has arrived: a row for each
threshold of `FRONT_LABELS`, a number for each node."""


class Wave(NamedTuple):
    """Half-width of the band of a wave, the largest of |f1 - f2|, |f2 - f3| and value times dx/R, each so often."""

    last: float
    before: float
    cell: float


WAVES = {2: Wave(3.5, 1.0, 4.0), 1: Wave(6.0, 3.0, 13.0)}
"""By order of the scheme."""


SOLVERS = (("ifcph", 2, "exact"), ("ifcph", 1, "hll"))
"""Solvers that were calibrated, the default and the paper's: scheme, order and flux onto a dry bed."""


def is_alike(point: Point, solvers: Collection[tuple[str, int, str]]) -> bool:
    """Return whether a column lies in RANGE and is solved by one of some solvers."""
    inside = all(low <= getattr(point, key) <= high for key, (low, high) in RANGE.items())
    solver = (point.scheme, point.order, point.front_flux) in solvers and not choice.of(point).general
    return inside and solver and point.scene == "cylinder"


def is_calibrated(point: Point) -> bool:
    """Return whether a run is like those that were calibrated; if not, its three grids may widen its bands."""
    return is_alike(point, SOLVERS) and NODES[0] <= point.cells <= FINEST[point.order]


def front(point: Point, label: str, value: float, length: float) -> float:
    """Return the half-width (m) of the band of a front.

    Parameters
    ----------
    point
        The run's.
    label
        Label of the front's threshold, see `naming.FRONT_LABELS`.
    value, length
        Place (m) of the front, and its last one.
    """
    cells = CELLS[point.order, value >= ARRIVED * length][FRONT_LABELS[label]]
    return float(np.interp(math.log(point.cells), np.log(NODES), cells)) * point.dx


def wave(point: Point, f1: float, f2: float, f3: float) -> float:
    """Return the half-width (m) of the band of a displacement of the surface, from its values on three grids.

    Parameters
    ----------
    point
        The run's.
    f1, f2, f3
        Values (m) of the run, and of its companions with cells/2 and cells/4.
    """
    factor = WAVES[point.order]
    return max(
        factor.last * abs(f1 - f2), factor.before * abs(f2 - f3), factor.cell * abs(f1) * point.scaled_dx
    )
