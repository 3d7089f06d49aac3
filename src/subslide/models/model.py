"""What the solver calls of a model, whatever its geometry."""

import math
from abc import ABC, abstractmethod

import numpy as np

from subslide.kernels.arrays import Cells, Settings, Track
from subslide.models.limits import first_sheared, first_suspect, inner


class Model(ABC):
    """State on a grid, and the time loop that moves it.

    Attributes
    ----------
    name
        The model's name, one of `keys.names.MODELS`.
    settings
        Scaled numbers in the working precision.
    variables
        Fields of `cells` that make the state.
    cells
        State of the padded grid.
    level
        The undisturbed surface over H2, in the working precision.
    half_width
        The end of the box over R.
    dimensions
        2 in the plane and on a radius, 1 on a line.
    copies
        How many times the grid makes up the whole: 4 for a quarter, else 1.
    free_until
        Scaled time from which an open sea has an end.
    """

    name: str
    settings: Settings
    variables: tuple[str, ...]
    cells: Cells
    level: float
    half_width: float
    dimensions: int
    copies: int
    free_until: float = math.inf

    @property
    @abstractmethod
    def x(self) -> np.ndarray:
        """Centres (nx) of the cells along x now, over R."""

    @property
    def width(self) -> np.ndarray | None:
        """Widths (nx) of cells that move, now, over R; None where they do not."""
        return None

    def state(self) -> dict[str, np.ndarray]:
        """Return what steps move on, by name: views of the cells without ghosts, and what a model has beside them."""
        return inner(self.cells, self.variables)

    def resume(self, state: dict[str, np.ndarray]) -> None:
        """Put back what `state` returned of a model of the same point and box."""
        for name, values in inner(self.cells, self.variables).items():
            values[...] = state[name]

    def make_room(self, now: float) -> None:  # noqa: B027
        """Give an open sea, which has come to the end of its arrays at the scaled time `now`, longer ones."""

    def release(self) -> None:  # noqa: B027
        """Give what later runs can use to them; nothing but the model's sizes and numbers counts from then on."""

    @abstractmethod
    def advance(self, thresholds: tuple[float, ...], track: Track) -> None:
        """Run the time loop until the clock's stop, the end of the run, or no room for samples.

        Parameters
        ----------
        thresholds
            Depths over H2 at which a front ends, in the working precision.
        track
            Clock, samples and counters, which the loop moves on.
        """

    @abstractmethod
    def profile(self) -> dict[str, np.ndarray]:
        """Return h2 and eta - level over H2 along x, each (nx), as float64 copies by name."""

    def fields(self) -> dict[str, np.ndarray] | None:
        """Return h2 and eta - level over H2, each (ny, nx), as float64 copies by name; None but in the plane."""
        return None

    def suspect(self) -> str:
        """Return where the state is first not finite or negative, and what stands there, in words."""
        return first_suspect(self.cells, self.variables, self._moving)

    def sheared(self) -> str:
        """Return where wave speeds are first complex, and the state there, in words; '' if nowhere."""
        return first_sheared(self.cells, self.variables, self.settings, self._moving)

    @property
    def _moving(self) -> np.ndarray | None:
        """Centres of cells whose number alone does not say where they are; None where it does."""
        return None if self.width is None else self.x
