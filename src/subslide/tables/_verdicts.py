"""Verdicts on observed orders of convergence: words, the orders that are expected, and those that are required."""

import math
from typing import TYPE_CHECKING

from subslide.keys import schema

if TYPE_CHECKING:
    import pandas as pd

METHOD = schema.with_role("method")
"""Keys of numerics, which tell runs of one scene apart."""

REACHED, BELOW, FIRST, FAILED, NONE = "reached", "below", "first grid", "failed", "no expectation"
STILL, MOVED = "still", "moved"
VERDICTS = {
    REACHED: "the observed order is at least the expected one",
    BELOW: "it is not",
    FIRST: "the study has no coarser run to compare with",
    FAILED: "the run ended before that time, or the coarser one did",
    NONE: "no order is expected",
    STILL: "grains at rest did not move by a bit",
    MOVED: "grains at rest moved",
}
EXPECTED = {
    "standing_wave": (0.9, 1.8),
    "paraboloid one-layer": (0.6, 1.6),
    "paraboloid": (0.6, 1.0),
    "dam_break": (0.6, 0.8),
    "riemann": (0.4, 0.8),
}
"""Least expected orders of schemes of first and second order, by scene, or by scene and model."""
REQUIRED = ("standing_wave", "paraboloid one-layer")
"""Keys of EXPECTED without which `subslide verify` fails; so do grains at rest that move."""


def order_between(coarse: "dict | pd.Series", fine: "dict | pd.Series") -> float:
    """Return the observed order between two rows; NaN where an error is 0 or unknown, or both have one grid."""
    if not (coarse["error"] > 0 and fine["error"] > 0 and coarse["cells"] != fine["cells"]):
        return math.nan
    return math.log(coarse["error"] / fine["error"]) / math.log(fine["cells"] / coarse["cells"])
