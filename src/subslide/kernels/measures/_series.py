"""What a measure says of each series that it gives."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

SUM, LARGEST, SMALLEST = range(3)
"""How the values of rows join into that of the plane."""


class Scales(NamedTuple):
    """What scaled numbers are in SI units.

    R and H2 (m), g (m/s2), the volume R^2 H2 (m3; on a line R H2, m2) times the copies of a quarter, and their number.
    """

    length: float
    height: float
    g: float
    volume: float
    copies: int


class Series(NamedTuple):
    """A series: how rows join, from which value on; its SI values from scaled ones; and the layers that it takes.

    Waves are unknown on grids that do not resolve them.
    """

    join: int
    si: Callable[[np.ndarray, Scales], np.ndarray]
    start: float = 0.0
    layers: int = 1
    wave: bool = False
