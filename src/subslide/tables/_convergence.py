"""From one quantity on three grids, each twice as fine as the next, to its limit and a band of error.

Richardson's extrapolation and the grid convergence index (P. J. Roache, J. Fluids Eng. 116, 405, 1994; I. B. Celik et
al., J. Fluids Eng. 130, 078001, 2008); where three values have no order, thrice their range (L. Eca and M. Hoekstra, J.
Comput. Phys. 262, 104, 2014). The band bounds the error of the discretisation alone: nothing is said of the
model, of its parameters, or of the threshold that defines a front.
"""

import math
from typing import NamedTuple

import numpy as np

RATIO = 2.0
"""Of the cell sizes of one grid and the next."""

SAFETY = 1.25
"""Roache's factor of safety where three grids give the order; it makes the band a bound in about 95 % of cases."""

LOWEST_ORDER = 0.3
"""Below it the extrapolation is more than 1 / (2^0.3 - 1) = 4.3 times the last difference, and means nothing."""

ROUND_OFF = 64.0
"""Differences of so many units in the last place are no differences: the solver's own margin for sums."""

SPREAD = 3.0
"""Eca and Hoekstra's factor of the range of three values that have no order."""

FORMAL_ORDER = 1.0
"""Best order of fronts and waves in either scheme: the column is let go with a jump, and no scheme is better than first
order at what comes of one. Measured at second order (a_H 1 and 10; r 0, 0.4 and 0.8; 234 values on 200 to 1600 cells):
the band holds the limit from 6400 cells in 94 %; Roache's index with an order up to that of the scheme did in 46 %."""

CONVERGING, NOT_CONVERGED, NO_LIMIT = "converging", "not converged", "no limit"
ONE_GRID = "one grid"
"""Word on a value whose band follows from its own grid alone."""

UNORDERED = (NOT_CONVERGED, NO_LIMIT)
"""Words on values whose three grids give no order."""


class Estimate(NamedTuple):
    """Observed order, estimate of the limit, half-width of the band about the finest value, and a word on it all.

    What does not exist is NaN: the limit unless `convergence` is 'converging', the order where the two finest values
    agree to round-off or the differences change sign, everything where a value is missing.
    """

    order: float
    limit: float
    band: float
    convergence: str


UNKNOWN = Estimate(math.nan, math.nan, math.nan, NOT_CONVERGED)
LIMITLESS = Estimate(math.nan, math.nan, math.nan, NO_LIMIT)


def estimate(
    f1: float, f2: float, f3: float, formal: float, *, scale: float = 0.0, dtype: str = "float64"
) -> Estimate:
    """Return the `Estimate` of a quantity from its values on three grids, each twice as fine as the next.

    Order p = log2((f3 - f2)/(f2 - f1)), limit f1 + (f1 - f2)/(2^p - 1), band 1.25 |f3 - f2|/2^q/(2^q - 1) with
    q = min(p, formal).

    Where p <= formal the band is Roache's index times |f1|,
    1.25 |f1 - f2|/(2^p - 1). A p above it says that f1 and f2 agree by chance, on their way through a turning point or
    before the leading error rules. Then their difference is no measure of the error, in whatever formula, and what the
    coarser pair would leave at the formal order takes its place. The limit takes p itself, as it states where the three
    values point; it is never farther from f1 than 0.8 of the band.

    Differences that change sign, or that shrink slower than h^0.3 or not at all, are 'not converged', without a limit,
    and the band is thrice the range of the values: small where only a last digit still moves. Where the two
    finest values agree to round-off p is beyond telling: 'converging', the limit is f1, and q the formal order, so
    that the band vanishes where all three agree. A value that is not finite is 'not converged', without a band.

    Parameters
    ----------
    f1, f2, f3
        Values on the finest grid, and with half and a quarter of its cells.
    formal
        Order at which the quantity can converge at best.
    scale
        Size of the numbers from which the quantity was a difference, such as the depth of water for a displacement of
        its surface; it tells what is round-off.
    dtype
        Floating-point type of the run.

    References
    ----------
    P. J. Roache, J. Fluids Eng. 116, 405 (1994); L. Eca and M. Hoekstra, J. Comput. Phys. 262, 104 (2014).
    """
    if not all(map(math.isfinite, (f1, f2, f3))):
        return UNKNOWN
    last, before = f2 - f1, f3 - f2
    if abs(last) <= ROUND_OFF * float(np.finfo(dtype).eps) * max(abs(f1), abs(f2), scale):
        return Estimate(math.nan, f1, _band(before, formal), CONVERGING)
    ratio = before / last
    order = math.log(ratio, RATIO) if ratio > 0 else math.nan
    if not order >= LOWEST_ORDER:
        return Estimate(order, math.nan, SPREAD * (max(f1, f2, f3) - min(f1, f2, f3)), NOT_CONVERGED)
    return Estimate(order, f1 - last / (ratio - 1), _band(before, min(order, formal)), CONVERGING)


def _band(before: float, order: float) -> float:
    """Return the half-width of the band, from the difference of the two coarser values if it falls at this order."""
    return SAFETY * abs(before) / RATIO**order / (RATIO**order - 1)
