"""A round paraboloid of grains, 1 - x^2 to its rim at radius 1, at rest under still water or alone.

Without friction and with r = 0 it spreads as `exact.paraboloid` says.
"""

import numpy as np

from subslide.keys.entries import Entry
from subslide.points import Point
from subslide.scenes import Grid, State, still_water
from subslide.scenes._cells import means, over_plane

OPTIONS: dict[str, Entry] = {}


def symmetry(point: Point) -> str:
    """Return the scene's symmetry."""
    return "round"


def initial(grid: Grid, point: Point) -> State:
    """Return the paraboloid at rest under still water."""
    if grid.geometry == "radius":
        h2 = ring_mean(grid.edges)
    else:
        h2 = over_plane(grid, lambda edges: means(lambda x, y: depth(np.hypot(x, y)), edges, edges))
    return still_water(h2, point.scaled_level)


def depth(x: float | np.ndarray, rim: float | np.ndarray = 1.0) -> np.ndarray:
    """Return h = (1 - x^2/rim^2) / rim^2, 0 beyond the rim: the paraboloid, spread without loss of volume.

    Parameters
    ----------
    x, rim
        Distances from the axis, and radius where the depth ends, over R.

    Returns
    -------
    ndarray
        Depths over H2, of the shape of `x`.
    """
    return (1.0 / rim) ** 2 * np.maximum(0.0, 1.0 - (x / rim) ** 2)


def ring_mean(edges: np.ndarray, rim: float | np.ndarray = 1.0) -> np.ndarray:
    """Return the mean depth of rings.

    Parameters
    ----------
    edges
        Radii (n + 1) between them, over R.
    rim
        Radius where the depth ends, over R.

    Returns
    -------
    ndarray
        Depths (n) over H2.
    """
    s = np.minimum(edges / rim, 1.0) ** 2
    volume = s / 2 - s**2 / 4  # over 2 pi, within each radius
    return np.diff(volume) / (np.diff(edges**2) / 2)
