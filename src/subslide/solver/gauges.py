"""Gauges: the surface, the depth of grains and the velocities at places, at every sample."""

import numpy as np

from subslide import naming
from subslide.kernels.arrays import GHOSTS
from subslide.models.model import Model
from subslide.points import Point
from subslide.study import choice

PARTS = {"gauge_u1": ("u1", "v1"), "gauge_u2": ("u2", "v2")}
"""Velocity along x, by the name of its series, and what models call its parts."""


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
        self.distance = np.hypot(self.x, self.y)
        self.rows: list[np.ndarray] = []
        self._cells: tuple[np.ndarray, ...] = ()
        self._weights = self._along_x = self._along_y = np.empty(0)
        self._located = -1

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
        self.rows.append(np.array(list(self._values(model).values())))

    def series(self, point: Point) -> dict[str, np.ndarray]:
        """Return the series (gauges, samples) in SI units by name."""
        speed = point.radius / point.time_scale
        scales = {"gauge_eta": point.column_height, "gauge_h2": point.column_height}
        values = np.array(self.rows)
        return {
            name: np.ascontiguousarray(values[:, n].T) * scales.get(name, speed)
            for n, name in enumerate(naming.GAUGES)
        }

    def _values(self, model: Model) -> dict[str, np.ndarray]:
        """Return the scaled values (gauges) by name of series, in its order."""
        cells, nothing = model.cells, np.full(len(self.x), np.nan)
        wet = model.settings.layers == 2
        surface = self._at(cells.h1, cells.h2) - float(model.level) if wet else nothing
        values = {"gauge_eta": surface, "gauge_h2": self._at(cells.h2)}
        for name, (u, v) in PARTS.items():
            if name == "gauge_u1" and not wet:
                along = nothing, nothing
            elif self.geometry == "line":
                along = self._at(getattr(cells, u)), np.zeros_like(nothing)
            elif self.geometry == "radius":
                outwards = self._at(getattr(cells, u), turn=self._along_x)
                unit = np.divide(1.0, self.distance, out=np.zeros_like(self.x), where=self.distance > 0)
                along = outwards * self.x * unit, outwards * self.y * unit
            else:
                along = (
                    self._at(getattr(cells, u), turn=self._along_x),
                    self._at(getattr(cells, v), turn=self._along_y),
                )
            values[name], values[name.replace("u", "v")] = along
        return values

    def _at(self, *parts: np.ndarray, turn: np.ndarray | float = 1.0) -> np.ndarray:
        """Return the weighted sum (gauges) of what cells hold, added up from its parts as profiles are."""
        picked = [part[self._cells] for part in parts]
        total = sum(picked[1:], picked[0]).astype(np.float64)
        values: np.ndarray = (self._weights * turn * total).sum(axis=0)
        return values

    def _locate(self, x: np.ndarray) -> None:
        """Find the padded cells beside each gauge, their weights, and which velocities of theirs are turned."""
        mirrored = self.geometry in ("radius", "quarter")
        if self.geometry in ("radius", "line"):
            place = self.distance if self.geometry == "radius" else self.x
            columns, weights, turns = beside(place, x, self.dx, mirrored)
            self._cells, self._weights, self._along_x = (columns,), weights, turns
            return
        columns, across, turn_x = beside(self.x, x, self.dx, mirrored)
        rows, up, turn_y = beside(self.y, x, self.dx, mirrored)
        of_row, of_column = [0, 0, 1, 1], [0, 1, 0, 1]
        self._cells = rows[of_row], columns[of_column]
        self._weights = up[of_row] * across[of_column]
        self._along_x, self._along_y = turn_x[of_column], turn_y[of_row]


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
