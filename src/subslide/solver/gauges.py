"""Gauges: the surface, the depth of grains and the velocities at places, at every sample."""

import numpy as np

from subslide import naming
from subslide.kernels.arrays import GHOSTS
from subslide.models.model import Model
from subslide.points import Point
from subslide.study import choice


class Gauges:
    """Values at the gauges of a run, bilinear between centres of cells; what lies beyond the last centre has its value.

    A quarter's values are mirrored, and what moves along a radius is turned into parts along x and y.

    Parameters
    ----------
    point
        The run.
    """

    def __init__(self, point: Point) -> None:
        """Take the places, over R."""
        self.geometry = choice.of(point).geometry
        self.dx = point.scaled_dx
        self.x, self.y = np.array(point.gauges).T / point.radius
        self.speeds = ("u1", "v1", "u2", "v2") if self.geometry in choice.PLANE else ("u1", "u1", "u2", "u2")
        self.rows: list[np.ndarray] = []
        self._located = -1  # cells along x, for which those below hold
        self._cells: tuple[np.ndarray, ...] = ()
        self._weights = np.empty(0)

    def state(self) -> dict[str, np.ndarray]:
        """Return what `resume` takes: values (samples, series, gauges), scaled."""
        return {"gauges": np.array(self.rows)}

    def resume(self, state: dict[str, np.ndarray]) -> None:
        """Put a state back."""
        self.rows = list(state["gauges"])

    def observe(self, model: Model, sample: int, now: float) -> None:
        """Put the values of a model's state in the place of a sample.

        Parameters
        ----------
        model
            What is run.
        sample
            Number of the sample that was taken of that state; it may be shown again.
        now
            Scaled time.
        """
        if self._located != model.x.size:  # an open sea grows
            self._locate(model.x)
            self._located = model.x.size
        del self.rows[sample:]
        cells = model.cells
        h2 = cells.h2[self._cells]
        picked = [
            cells.h1[self._cells] + h2,
            h2,
            *(getattr(cells, name)[self._cells] for name in self.speeds),
        ]
        values = (np.array(picked, np.float64) * self._weights).sum(axis=1)
        values[0] -= model.level
        if model.settings.layers == 1:
            values[[0, 2, 3]] = np.nan
        self.rows.append(values)

    def series(self, point: Point) -> dict[str, np.ndarray]:
        """Return the series (gauges, samples) in SI units by name."""
        speed = point.radius / point.time_scale
        scales = {"gauge_eta": point.column_height, "gauge_h2": point.column_height}
        values = np.array(self.rows)
        return {
            name: np.ascontiguousarray(values[:, n].T) * scales.get(name, speed)
            for n, name in enumerate(naming.GAUGES)
        }

    def _locate(self, x: np.ndarray) -> None:
        """Find the padded cells (cells, gauges) around each gauge, and their weights (series, cells, gauges)."""
        mirrored = self.geometry in ("radius", "quarter")
        if self.geometry in choice.PLANE:
            (columns, across, turn_u), (rows, up, turn_v) = (
                beside(places, x, self.dx, mirrored) for places in (self.x, self.y)
            )
            of_row, of_column = [0, 0, 1, 1], [0, 1, 0, 1]
            self._cells = rows[of_row], columns[of_column]
            weight = up[of_row] * across[of_column]
            along_x, along_y = turn_u[of_column] * weight, turn_v[of_row] * weight
        elif self.geometry == "line":
            columns, weight, _ = beside(self.x, x, self.dx, mirrored)
            self._cells, along_x, along_y = (columns,), weight, 0 * weight
        else:
            distance = np.hypot(self.x, self.y)
            columns, weight, turn = beside(distance, x, self.dx, mirrored)
            unit = turn * weight / np.where(distance > 0, distance, 1.0)
            self._cells, along_x, along_y = (columns,), unit * self.x, unit * self.y
        self._weights = np.array([weight, weight, along_x, along_y, along_x, along_y])


def beside(
    place: np.ndarray, x: np.ndarray, dx: float, mirrored: bool
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the two cells beside each place on an axis.

    Parameters
    ----------
    place
        Places (n) over R.
    x, dx
        Centres (nx) of cells, which are `dx` apart.
    mirrored
        Whether the axis is one half, and mirrors the other.

    Returns
    -------
    tuple of ndarray
        Padded indices, weights, and 1 or -1, by which velocities along the axis are taken, each (2, n).
    """
    side = np.where(mirrored & (place < 0), -1.0, 1.0)
    steps = (place * side - x[0]) / dx
    before = np.floor(steps).astype(np.int64)
    share = steps - before
    indices = np.array([before, before + 1])
    turns = np.where(mirrored & (indices < 0), -1.0, 1.0) * side
    if mirrored:
        indices = np.where(indices < 0, -1 - indices, indices)
    return np.clip(indices, 0, len(x) - 1) + GHOSTS, np.array([1 - share, share]), turns
