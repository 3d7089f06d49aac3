"""A Gaussian process in place of the solver: fits, predictions with bands, calibration by data.

`Emulator` answers by numpy alone, from a file of numbers; what it learns and how stands in docs/emulator.md.
"""

from subslide.emulator.model import Emulator, Predicted

__all__ = ["Emulator", "Predicted"]
