"""A round paraboloid of grains, 1 - x^2 to its rim at radius 1, at rest under still water or alone.

Without friction and with r = 0 it spreads as `exact.paraboloid` says.
"""

import numpy as np

from subslide.exact.paraboloid import depth, ring_mean
from subslide.scenes import still_water
from subslide.scenes._cells import means, over_plane

OPTIONS = {}


def symmetry(point):
    """Return the scene's symmetry."""
    return "round"


def initial(grid, point):
    """Return the paraboloid at rest under still water."""
    if grid.geometry == "radius":
        h2 = ring_mean(grid.edges, 0.0)
    else:
        h2 = over_plane(grid, lambda edges: means(lambda x, y: depth(np.hypot(x, y), 0.0), edges, edges))
    return still_water(h2, 1.0 + point.a_H)
