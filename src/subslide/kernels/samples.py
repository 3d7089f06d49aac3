"""Columns of a sample: time, fronts, gauge, and what `measures` gives of a state, in the order of `measures.SERIES`."""

import math

from subslide.kernels import measures
from subslide.kernels.jit import inlined
from subslide.naming import FRONT_THRESHOLDS

TIME = 0
FRONT = 1
FRONTS = len(FRONT_THRESHOLDS)
GAUGE = FRONT + FRONTS
MEASURED = GAUGE + 1
COLUMNS = MEASURED + measures.COUNT
COLUMN = {name: MEASURED + place for name, place in measures.PLACE.items()}
"""Column of each measured series."""

ETA, ETA_OUTSIDE = COLUMN["max_abs_eta"], COLUMN["max_abs_eta_outside"]
GRAINS, WATER, ENERGY = COLUMN["sediment_volume"], COLUMN["water_volume"], COLUMN["energy"]
COMPLEX, MARGIN = COLUMN["nonhyperbolic_cells"], COLUMN["hyperbolic_margin"]


@inlined
def is_finite(sample):
    """Return whether volumes and energy are finite, which they are not if any depth or velocity is not."""
    return math.isfinite(sample[ENERGY]) and math.isfinite(sample[WATER] + sample[GRAINS])
