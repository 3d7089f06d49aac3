"""How far a run's profiles and fronts are from the exact solution of its scene."""

import math
from collections.abc import Iterator
from types import ModuleType

import numpy as np

from subslide.naming import FRONT_LABELS
from subslide.points import Point
from subslide.results import positions
from subslide.study import choice

GAUSS = ((-math.sqrt(0.6), 5 / 18), (0.0, 8 / 18), (math.sqrt(0.6), 5 / 18))
"""Places in a cell from -1 to 1 and weights of Gauss's quadrature."""


def errors_at(answer: ModuleType, point: Point, record: dict, time: float) -> Iterator[tuple[str, float]]:
    """Give quantity and error of each known answer at one time; NaN if the run ended before.

    Parameters
    ----------
    answer
        Module of the exact solution.
    point, record
        The run's point, and its variables by name.
    time
        Elapsed time (s).
    """
    if hasattr(answer, "stays"):
        if answer.stays(point) and record["x"].ndim == 1:  # cells that move are not those of the start
            yield "h2_change", change(point, profile(record, "h2", time), profile(record, "h2", 0.0))
        return
    known = cell_means(answer, point, record, time)
    weight = weights(point, record, time)
    for quantity, values in known.items():
        if not np.isfinite(record[quantity]).any():  # water of a model without water
            continue
        size = scale(answer, point, quantity, time, values, weight)
        if np.isfinite(values).all() and size > 0:
            solved = profile(record, quantity, time)
            yield quantity, float((weight * np.abs(solved - values)).sum() / size)
    if point.delta > 0 and hasattr(answer, "edge_known") and answer.edge_known(point, time):
        edge = answer.edge_position(point, time)
        for label, n in FRONT_LABELS.items():
            yield f"x_front_{label}", 1 - front(record, n, time) / edge


def cell_means(answer: ModuleType, point: Point, record: dict, time: float) -> dict[str, np.ndarray]:
    """Return the exact h2 and eta by cell or ring, of Gauss's quadrature with three points.

    Parameters
    ----------
    answer
        Module of the exact solution.
    point, record
        The run's point, and its variables by name.
    time
        Elapsed time (s).

    Returns
    -------
    dict
        Means (m) over each cell of the profile, by quantity; on a radius each ring's, weighted by |x|.
    """
    x, width = cells_at(record, time)
    ring = is_round(point)
    total: dict[str, np.ndarray] = {}
    size = np.zeros(len(x))
    for place, part in GAUSS:
        spot = x + 0.5 * width * place
        share = part * np.abs(spot) if ring else part
        size = size + share
        for quantity, values in answer.solution(point, spot, time).items():
            total[quantity] = total.get(quantity, 0.0) + share * values
    return {quantity: values / size for quantity, values in total.items()}


def is_round(point: Point) -> bool:
    """Return whether the cells of a run's profiles stand for rings."""
    return choice.of(point).geometry != "line"


def cells_at(record: dict, time: float) -> tuple[np.ndarray, np.ndarray | float]:
    """Return the centres (m) of a run's cells at the snapshot nearest to a time, and their widths (m)."""
    place = nearest(record, time)
    width = record["cell_width"][place] if record["x"].ndim > 1 else float(record["dx"])
    return positions(record, place), width


def weights(point: Point, record: dict, time: float) -> np.ndarray:
    """Return the relative sizes of the cells or rings of a profile at a time."""
    x, width = cells_at(record, time)
    size = np.abs(x) if is_round(point) else np.ones(len(x))
    return size * (width / np.mean(width))


def scale(
    answer: ModuleType, point: Point, quantity: str, time: float, values: np.ndarray, weight: np.ndarray
) -> float:
    """Return what an error is relative to, in the unit of sum(weight * |error|); 0 where nothing is compared."""
    height = point.a_2 * point.radius
    if hasattr(answer, "amplitude"):
        return float(weight.sum()) * answer.amplitude(point, time) * height
    if point.scene == "dam_break" and quantity == "eta":
        values = values + (1 + point.a_H) * height
    return float((weight * np.abs(values)).sum())


def profile(record: dict, quantity: str, time: float) -> np.ndarray:
    """Return the profile (m) at a time, NaN if the run has none."""
    place = nearest(record, time)
    near = abs(record["snapshot_time"][place] - time) <= 1e-9 * max(time, 1e-12)
    values = record[quantity][place]
    return values if near else np.full(len(values), math.nan)


def nearest(record: dict, time: float) -> int:
    """Return the place of the snapshot nearest to a time."""
    return int(np.argmin(np.abs(record["snapshot_time"] - time)))


def change(point: Point, later: np.ndarray, start: np.ndarray) -> float:
    """Return the largest change of the depth of grains over H2."""
    return float(np.max(np.abs(later - start))) / (point.a_2 * point.radius)


def front(record: dict, n: int, time: float) -> float:
    """Return the front (m) at threshold n and a time, NaN if the run ended before."""
    return float(np.interp(time, record["time"], record["x_front"][n], right=math.nan))
