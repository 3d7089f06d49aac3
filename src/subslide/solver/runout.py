"""Runout of the deposit in every direction, its area and centroid, from the last state of a run."""

import numpy as np

from subslide.models.model import Model
from subslide.naming import FINISHED, RUNOUT
from subslide.solver.loop import thresholds
from subslide.solver.run import Run
from subslide.study import choice

SAME = 1e-9
"""Share of a runout below which others are as large: directions that mirror each other differ by round-off."""


def measured(run: Run, model: Model) -> dict[str, np.ndarray]:
    """Return the runout of a run in as many directions as it asks for, and what goes with it.

    Parameters
    ----------
    run
        The run.
    model
        What was run, in its last state.

    Returns
    -------
    dict
        Values in SI units by the names of `naming.RUNOUT`; NaN if the run failed.
    """
    angles, radius = run.directions, run.point.radius
    depths = [float(depth) for depth in thresholds(model)]
    centroid = np.zeros(2)
    if run.status not in FINISHED:
        runout = np.full((len(depths), len(angles)), np.nan)
        area, centroid = np.full(len(depths), np.nan), np.full(2, np.nan)
    elif choice.of(run.point).geometry == "radius":
        runout = np.repeat(run.L_f[:, None], len(angles), axis=1)
        area = np.array([area_of_rings(model.profile()["h2"], model.x, depth) for depth in depths])
    else:
        h2, quarter = (model.fields() or {})["h2"], model.copies == 4
        rays = [along_ray(h2, model.x, angle, depths, quarter) for angle in angles]
        runout = np.array(rays).T * radius
        area = np.array([area_above(h2, model.x, depth, quarter) for depth in depths])
        if not quarter:
            centroid = np.array([h2.sum(axis=0) @ model.x, h2.sum(axis=1) @ model.x]) / h2.sum()
    reached = np.nan_to_num(runout, nan=-1.0)
    largest = reached.max(axis=1)
    there = largest >= 0
    farthest = (reached >= largest[:, None] * (1 - SAME)).argmax(axis=1)
    values = (
        runout,
        np.where(there, largest, np.nan),
        np.where(there, angles[farthest], np.nan),
        area * radius**2,
        *(centroid * radius),
    )
    return dict(zip(RUNOUT, map(np.asarray, values), strict=True))


def along_ray(
    h2: np.ndarray, x: np.ndarray, angle: float, depths: list[float], quarter: bool = False
) -> np.ndarray:
    """Return the distance of the farthest point on a ray from the axis where a field exceeds each of some depths.

    The field is bilinear between centres of cells, and thought linear between the lines through these that the ray
    crosses, as the front is along an axis.

    Parameters
    ----------
    h2
        Field (nx, nx).
    x
        Centres (nx) of its cells along both axes.
    angle
        Direction (degree), anticlockwise from the x axis.
    depths
        Depths.
    quarter
        Whether the field is the quarter x, y > 0 of the whole.

    Returns
    -------
    ndarray
        Distances, one for each depth; NaN where the field exceeds it nowhere on the ray.
    """
    turn = np.deg2rad(angle)
    way = np.array([np.cos(turn), np.sin(turn)])
    way[np.abs(way) < 1e-12] = 0.0
    if quarter:
        way = np.abs(way)
    dx = x[1] - x[0]
    lines = np.concatenate([x / part for part in way if part])
    ends = (x[-1] + dx / 2) / np.abs(way).max()
    distance = np.sort(lines[(lines > 0) & (lines <= ends)])
    padded = np.pad(h2, 1, mode="edge")  # what mirrors a quarter too
    steps = np.outer(way, distance) / dx + (1 - x[0] / dx)
    before = np.clip(np.floor(steps).astype(np.int64), 0, len(x))
    (i, j), (right, up) = before, steps - before
    lower = (1 - right) * padded[j, i] + right * padded[j, i + 1]
    upper = (1 - right) * padded[j + 1, i] + right * padded[j + 1, i + 1]
    values = (1 - up) * lower + up * upper
    farthest = np.full(len(depths), np.nan)
    for n, depth in enumerate(depths):
        above = np.flatnonzero(values >= depth)
        if above.size:
            here = above[-1]
            beyond = min(here + 1, len(values) - 1)
            drop = values[here] - values[beyond]
            share = (values[here] - depth) / drop if drop > 0 else 0.0
            farthest[n] = distance[here] + share * (distance[beyond] - distance[here])
    return farthest


def area_above(h2: np.ndarray, x: np.ndarray, depth: float, quarter: bool = False) -> float:
    """Return the area where a field exceeds a depth.

    Each square between four centres is parted into triangles by the diagonals, and the field is linear on each.

    Parameters
    ----------
    h2
        Field (nx, nx).
    x
        Centres (nx) of its cells along both axes.
    depth
        The depth.
    quarter
        Whether the field is the quarter x, y > 0 of the whole, whose area is meant.

    Returns
    -------
    float
        The area.
    """
    padded = np.pad(h2, 1, mode="edge") - depth
    corners = padded[:-1, :-1], padded[:-1, 1:], padded[1:, 1:], padded[1:, :-1]
    middle = 0.25 * (corners[0] + corners[1] + corners[2] + corners[3])
    weight = np.ones(len(x) + 1)
    weight[[0, -1]] = 0.5  # half of these squares lies outside the box
    total = 0.0
    for n in range(4):
        low, mid, high = np.sort([corners[n - 1], corners[n], middle], axis=0)
        with np.errstate(divide="ignore", invalid="ignore"):
            tip = high**2 / ((high - low) * (high - mid))
            base = 1 - low**2 / ((low - high) * (low - mid))
        share = np.where(low >= 0, 1.0, np.where(high < 0, 0.0, np.where(mid < 0, tip, base)))
        total += float(weight @ share @ weight) / 4
    return total * (x[1] - x[0]) ** 2 * (4 if quarter else 1)


def area_of_rings(h2: np.ndarray, x: np.ndarray, depth: float) -> float:
    """Return the area where a round field exceeds a depth, linear between centres of cells.

    Parameters
    ----------
    h2
        Profile (n) along a radius.
    x
        Centres (n) of its cells.
    depth
        The depth.

    Returns
    -------
    float
        The area.
    """
    places, over = np.append(0.0, x), np.append(h2[0], h2) - depth
    (here, beyond), (low, high) = (over[:-1], over[1:]), (places[:-1], places[1:])
    passed = (here >= 0) != (beyond >= 0)
    crossing = low + here / np.where(passed, here - beyond, 1.0) * (high - low)
    inner, outer = np.where(here >= 0, low, crossing), np.where(beyond >= 0, high, crossing)
    return float(np.pi * np.sum((outer**2 - inner**2)[(here >= 0) | (beyond >= 0)]))
