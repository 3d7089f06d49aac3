"""Fronts that somebody measured, and how likely they are by the emulator."""

import math
from typing import NamedTuple

import numpy as np

from subslide.emulator import measures as named
from subslide.emulator.model import Emulator
from subslide.keys import schema
from subslide.keys.schema import ConfigError
from subslide.naming import FRONT_THRESHOLDS
from subslide.points import Point
from subslide.study import csv_files

COLUMNS = ("time", "x_front", "error")
FREE = ("a_H", "r", "delta")
"""Parameters that data may choose."""

STEEPEST = math.tan(math.radians(89))
"""Tangent of the largest friction angle that a run may have."""

OF_95 = 1.96
"""Half-width of a 95 % band over the standard deviation."""


BETWEEN = 0.0035
"""Standard deviation, over a front's place, of a threshold that lies between two of those that are emulated: against
profiles of 60 columns, on their way and at rest, the errors are 0.2 % in the median and 0.7 % at 95 %."""


class Data(NamedTuple):
    """Fronts (n) that were measured.

    Attributes
    ----------
    time
        Times (s) since release; NaN for the deposit.
    place, error
        Distances (m) from the axis, and their standard deviations.
    threshold
        Depth that defines them, a share of the column's height.
    """

    time: np.ndarray
    place: np.ndarray
    error: np.ndarray
    threshold: float


def read(path: str, threshold: float) -> Data:
    """Return the data of a CSV file with the columns time (s; empty for the deposit), x_front (m) and error (m).

    Parameters
    ----------
    path
        The file.
    threshold
        Depth that defines its fronts, over the column's height.

    Returns
    -------
    Data
        Its rows.

    Raises
    ------
    ConfigError
        If a column is missing, a value is none, or the threshold is not emulated: one line.
    """
    low, high = FRONT_THRESHOLDS[0], FRONT_THRESHOLDS[-1]
    if not low <= threshold <= high:
        raise ConfigError(
            f"--threshold: {100 * threshold:g}% is not emulated; allowed: {100 * low:g}% to {100 * high:g}%"
        )
    table = csv_files.read(path, COLUMNS)
    for column in COLUMNS:
        if column not in table.columns:
            raise ConfigError(f"{table.path}: there is no column {column}; allowed: {', '.join(COLUMNS)}")
    positive: schema.Entry = {"type": "number", "exclusiveMinimum": 0, "maximum": 1e6}
    moments: schema.Entry = {
        "anyOf": [{"type": "null"}, {"type": "number", "minimum": 0, "maximum": 1e9}],
        "allowed": "seconds from 0, or nothing for the deposit",
    }
    time, place, error = (
        np.array([math.nan if value is None else float(value) for value in table.values(column, about)])
        for column, about in zip(COLUMNS, (moments, positive, positive), strict=True)
    )
    return Data(time, place, error, threshold)


class Model(NamedTuple):
    """What data are held against.

    Attributes
    ----------
    emulator
        Gives the fronts.
    data
        The data.
    column
        Point with the radius, g and a_2 that are known.
    fixed
        Parameters of FREE that are known too.
    discrepancy
        Standard deviation of the model's own error, over a front's place.
    """

    emulator: Emulator
    data: Data
    column: Point
    fixed: dict[str, float]
    discrepancy: float

    @property
    def free(self) -> tuple[str, ...]:
        """Parameters that the data choose, in the order of FREE."""
        return tuple(key for key in FREE if key not in self.fixed)

    @property
    def ends(self) -> dict[str, tuple[float, float]]:
        """Least and greatest value of each parameter: all that the emulator answers for at the column's a_2."""
        range_of = self.emulator.range
        angles = tuple(math.degrees(math.atan(m * self.column.a_2)) for m in range_of["m"])
        return {"a_H": range_of["a_H"], "r": range_of["r"], "delta": (angles[0], angles[1])}

    def parameters(self, unit: np.ndarray) -> np.ndarray:
        """Return a_H, r and delta (n, 3) of places (n, free) in the unit cube of the prior.

        The prior is even in ln a_H, r and delta.
        """
        columns = []
        for key in FREE:
            if key in self.fixed:
                columns.append(np.full(len(unit), self.fixed[key]))
                continue
            low, high = self.ends[key]
            share = unit[:, self.free.index(key)]
            columns.append(low * (high / low) ** share if key == "a_H" else low + share * (high - low))
        return np.stack(columns, axis=1)

    def unit(self, parameters: dict[str, float]) -> np.ndarray:
        """Return the place (1, free) in the unit cube of parameters by name."""
        shares = []
        for key in self.free:
            (low, high), value = self.ends[key], parameters[key]
            shares.append(
                math.log(value / low) / math.log(high / low) if key == "a_H" else (value - low) / (high - low)
            )
        return np.array([shares])

    def fronts(self, unit: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return places (n, data) in m of the fronts at places (n, free) of the unit cube, and standard deviations.

        The deviations hold the data's errors, the emulator's and the model's discrepancy.
        """
        a_H, r, delta = self.parameters(unit).T
        m = np.clip(np.tan(np.radians(delta)) / self.column.a_2, *self.emulator.range["m"])
        rest = np.isnan(self.data.time)
        times = np.where(rest, 0.0, self.data.time) / self.column.time_scale
        shares = weights_of(self.data.threshold)
        names = [name for n in shares for name in (named.LENGTHS[n], named.FRONTS[n])]
        answer = self.emulator.predict(a_H, r, m, quantities=names, times=times)
        place = band = np.zeros((len(unit), len(rest)))
        for n, weight in shares.items():
            length, front = answer[named.LENGTHS[n]], answer[named.FRONTS[n]]
            place = place + weight * np.where(rest, length.value[:, None], front.value)
            band = band + weight * np.where(rest, length.band[:, None], front.band)
        place, band = place * self.column.radius, band * self.column.radius
        share = math.hypot(self.discrepancy, BETWEEN if len(shares) > 1 else 0.0)
        return place, np.sqrt(self.data.error**2 + (band / OF_95) ** 2 + (share * place) ** 2)

    def log_likelihood(self, unit: np.ndarray) -> np.ndarray:
        """Return the logarithm (n) of the likelihood at places (n, free) of the unit cube."""
        place, deviation = self.fronts(unit)
        return -0.5 * (((self.data.place - place) / deviation) ** 2 + 2 * np.log(deviation)).sum(axis=1)


def weights_of(threshold: float) -> dict[int, float]:
    """Return by how much each threshold of `naming.FRONT_THRESHOLDS`, by its place, counts for one between them.

    Parameters
    ----------
    threshold
        Share of the column's height.

    Returns
    -------
    dict
        One weight of 1, or two on a line in the root of the threshold: behind a front depth grows about as the square
        of the distance.
    """
    roots = np.sqrt(FRONT_THRESHOLDS)
    place = float(np.interp(math.sqrt(threshold), roots, np.arange(len(roots))))
    low = int(place)
    share = place - low
    return {low: 1.0} if share < 1e-9 else {low: 1 - share, low + 1: share}


def check_known(model: Model) -> None:
    """Raise a ConfigError unless known values lie where the emulator answers, and some parameter is free."""
    steepest = STEEPEST / model.emulator.range["m"][1]
    if model.column.a_2 > steepest:
        raise ConfigError(
            f"a_2: {model.column.a_2:g} is outside what the emulator learned; allowed: up to {steepest:.3g}"
        )
    for key, value in model.fixed.items():
        low, high = model.ends[key]
        if not low <= value <= high:
            raise ConfigError(
                f"{key}: {value:g} is outside what the emulator learned; allowed at a_2 = {model.column.a_2:g}:"
                f" {low:.6g} to {high:.6g}"
            )
    if not model.free:
        raise ConfigError("a_H, r and delta: all are given; allowed: leave out what the data are to choose")
