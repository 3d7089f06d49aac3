"""Bands of what follows from many runs: of sampling, of grid error, and of runs that failed."""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Banded:
    """Parts of the bands of some numbers, each an array as these are.

    Attributes
    ----------
    sampling
        Half-width for the sampling alone.
    grid
        Half-width for the grid error of the outputs; not a number without half-widths of theirs.
    least, most
        Bounds of the number where failed runs may have any output that others have.
    """

    sampling: np.ndarray
    grid: np.ndarray
    least: np.ndarray
    most: np.ndarray

    @property
    def low(self) -> np.ndarray:
        """Lower end of the band."""
        return self.least - self.sampling - np.nan_to_num(self.grid)

    @property
    def high(self) -> np.ndarray:
        """Upper end of the band."""
        return self.most + self.sampling + np.nan_to_num(self.grid)
