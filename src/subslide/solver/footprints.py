"""Footprints: the largest depth and displacement of each cell over all steps, and when grains and waves came."""

import numpy as np

from subslide.kernels.arrays import GHOSTS
from subslide.models.model import Model
from subslide.naming import ARRIVAL, LARGEST
from subslide.points import Point


class Footprints:
    """Largest values and times of arrival of the cells of a run, scaled; NaN where there is none.

    Parameters
    ----------
    model
        What is run, in its first state.
    """

    def __init__(self, model: Model) -> None:
        """Begin with nothing in any cell."""
        self.x = model.x
        shape = tuple(size - 2 * GHOSTS for size in model.cells.h1.shape)
        self.values = {name: np.full(shape, np.nan) for name in LARGEST}

    def state(self) -> dict[str, np.ndarray]:
        """Return what `resume` takes: values by name, and the centres of their cells."""
        return {**self.values, "footprint_x": self.x}

    def resume(self, state: dict[str, np.ndarray]) -> None:
        """Put a state back."""
        self.values = {name: state[name] for name in LARGEST}
        self.x = state["footprint_x"]

    def observe(self, model: Model, sample: int, now: float) -> None:
        """Join a model's state to what was seen before.

        Parameters
        ----------
        model
            What is run.
        sample
            Number of the sample that was taken of that state; it may be shown again.
        now
            Scaled time.
        """
        if model.x.size != self.x.size:  # an open sea grows by still cells like its last ones
            before = int(np.searchsorted(model.x, self.x[0]))
            ends = before, model.x.size - before - self.x.size
            self.values = {name: np.pad(values, ends, mode="edge") for name, values in self.values.items()}
            self.x = model.x
        inner = (slice(GHOSTS, -GHOSTS),) * model.cells.h1.ndim
        h2 = model.cells.h2[inner]
        self._take(h2, "largest_h2", "arrival_h2", now)
        if model.settings.layers == 2:
            eta = np.abs((model.cells.h1[inner] + h2).astype(np.float64) - float(model.level))
            self._take(eta, "largest_abs_eta", "arrival_eta", now)

    def _take(self, seen: np.ndarray, largest: str, arrival: str, now: float) -> None:
        """Join the values of all cells at a time to those of two footprints."""
        values, times = self.values[largest], self.values[arrival]
        arrived = (seen >= ARRIVAL) & ~(values >= ARRIVAL)
        times[arrived] = now
        np.fmax(values, seen, out=values)

    def fields(self, point: Point, x: np.ndarray) -> dict[str, np.ndarray]:
        """Return the footprints in SI units by name of variable.

        Parameters
        ----------
        point
            The run.
        x
            Centres (nx) in m of the cells that its profiles have.

        Returns
        -------
        dict
            Values (nx) or, in the plane, (ny, nx), float32 as fields are.
        """
        first = int(np.argmin(np.abs(self.x * point.radius - x[0])))
        part, height = slice(first, first + len(x)), point.column_height
        scales = {"largest_h2": height, "largest_abs_eta": height}
        return {
            name + "_field" * (values.ndim - 1): (
                values[(part,) * values.ndim] * scales.get(name, point.time_scale)
            ).astype(np.float32)
            for name, values in self.values.items()
        }
