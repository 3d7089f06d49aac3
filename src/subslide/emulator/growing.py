"""An emulator that asks for the runs it lacks: columns are added where it is least sure, until leave-one-out holds."""

import json
import math
import os
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np

from subslide import checksums, source_hash
from subslide.emulator import coordinates, training
from subslide.emulator import measures as named
from subslide.emulator.group import kernel
from subslide.emulator.training import Measured, Training
from subslide.files import RecordError, write_text
from subslide.keys.schema import ConfigError
from subslide.naming import FINISHED
from subslide.points import Point, from_dict, to_dict

CANDIDATES = 1024
"""Columns, of a Sobol' sequence, among which those to add are chosen."""

SEED = 20261127
"""Of that sequence; designs that hold columns out have others."""

AT_ONCE = 32
"""Columns that are added before the emulator is made anew."""

NUGGET = 1e-6
"""Of the kernel where its variance is only compared."""

ADDED = "emulator_points.json"
"""File in a study's folder with what was learned of the columns that were added."""


class Goal(NamedTuple):
    """What is to hold: the quantity's error of leave-one-out at 95 %, and how many columns may be added for it."""

    quantity: str
    error: float
    most: int


def grow(
    measured: Sequence[Measured], about: dict, goal: Goal, processes: int, say: Callable[[str], object]
) -> tuple[Training, list[Measured]]:
    """Return an emulator that holds a goal, or has been given as many columns as it may, and the runs that were added.

    Parameters
    ----------
    measured
        Runs that it has.
    about
        What the file says of where it comes from.
    goal
        When to end.
    processes
        Processes that solve.
    say
        Function that is called with a line as columns are added.

    Returns
    -------
    tuple
        The emulator and the added runs.
    """
    added: list[Measured] = []
    columns = 0
    while True:
        trained = training.learn((*measured, *added), about)
        error = reached(trained, goal.quantity)
        say(f"{goal.quantity}: {100 * error:.3g} % at 95 % by leave-one-out, {columns} columns added")
        if error <= goal.error or columns >= goal.most:
            return trained, added
        chosen = least_sure(trained, goal.quantity, min(AT_ONCE, goal.most - columns))
        columns += len(chosen)
        added += solved([point for row in chosen for point in like(measured, row)], processes)


def reached(trained: Training, quantity: str) -> float:
    """Return the relative error of a quantity that 95 % of leave-one-out stay below.

    Parameters
    ----------
    trained
        What was learned.
    quantity
        One of its quantities.

    Returns
    -------
    float
        The error.

    Raises
    ------
    ConfigError
        If no run has the quantity.
    """
    if quantity not in trained.left_out:
        known = ", ".join(trained.left_out)
        raise ConfigError(f"--quantity: {quantity} is not in the study's runs; allowed: {known}")
    return float(np.quantile(np.abs(trained.left_out[quantity].error), 0.95))


def least_sure(trained: Training, quantity: str, count: int) -> np.ndarray:
    """Return the columns where an emulator knows least: its band is widest, and no point that it has is near.

    Parameters
    ----------
    trained
        What was learned.
    quantity
        What it is to know better.
    count
        Columns to choose.

    Returns
    -------
    ndarray
        Rows (count, 3) of a_H, r and m. Each is chosen as if those before it were known.
    """
    from scipy.stats import qmc

    emulator = trained.emulator
    group = next(
        group
        for group in emulator.groups.values()
        if any(name.partition("@")[0] == quantity for name in group.names)
        or (quantity == named.PEAK and set(group.names) == set(named.WINDOWS))
    )
    unit = qmc.Sobol(3, seed=SEED).random(CANDIDATES)
    low, high = np.array(list(emulator.range.values())).T
    logs = np.array([True, False, True])
    ends = [np.where(logs, np.log(np.where(logs, end, 1)), end) for end in (low, high)]
    rows = ends[0] + unit * (ends[1] - ends[0])
    rows = np.where(logs, np.exp(rows), rows)
    value, band = emulator.predict(*rows.T, quantities=[quantity])[quantity]
    unsure = (band / value).reshape(len(rows), -1).max(axis=1)
    z = coordinates.of(group.kind, rows) / group.process.lengths
    points, chosen = group.process.points, []
    covariance = kernel(points, points) + NUGGET * np.eye(len(points))
    root = np.linalg.solve(np.linalg.cholesky(covariance), kernel(points, z))
    left = np.maximum(1 - (root**2).sum(axis=0), NUGGET)
    for _ in range(count):
        place = int(np.argmax(unsure * np.sqrt(left)))
        chosen.append(place)
        shared = (kernel(z[[place]], z) - root[:, place] @ root) / math.sqrt(left[place])
        root = np.concatenate([root, shared])
        left = np.maximum(left - shared[0] ** 2, NUGGET**2)
    return rows[chosen]


def like(measured: Sequence[Measured], row: np.ndarray) -> list[Point]:
    """Return the points of a column: as those of the first one that is known, but for a_H, r and delta.

    Parameters
    ----------
    measured
        Runs.
    row
        The column's a_H, r and m.

    Returns
    -------
    list of Point
        One for each grid.
    """
    first = measured[0].point.similarity_key
    a_H, r, m = (float(f"{value:.9g}") for value in row)
    templates = {one.point.id: one.point for one in measured if one.point.similarity_key == first}
    return [
        point.with_values(a_H=a_H, r=r, delta=math.degrees(math.atan(m * point.a_2)))
        for point in templates.values()
    ]


def solved(points: Iterable[Point], processes: int) -> list[Measured]:
    """Return what is learned of points, those that end well, solved in processes.

    Parameters
    ----------
    points
        What to solve.
    processes
        How many at once.

    Returns
    -------
    list of Measured
        In the order of the points.
    """
    import multiprocessing
    from concurrent.futures import ProcessPoolExecutor

    points = list(points)
    spawn = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(processes, mp_context=spawn) as pool:
        values = pool.map(_values, points, chunksize=max(1, min(16, len(points) // (4 * processes))))
        return [Measured(point, one) for point, one in zip(points, values, strict=True) if one is not None]


def _values(point: Point) -> dict[str, float] | None:
    """Return what is learned of a point's run; None if it did not end well."""
    from subslide.solver import solve

    run = solve(point)
    if run.status not in FINISHED:
        return None
    names = dict.fromkeys(name for needed in named.NEEDED.values() for name in needed)
    return named.measure(point, {name: getattr(run, name) for name in names})


def keep(folder: Path, added: Sequence[Measured]) -> None:
    """Write what was learned of added columns into a study's folder, with its checksum.

    Parameters
    ----------
    folder
        Folder of the study.
    added
        All of them.
    """
    rows = [{"point": to_dict(one.point), "values": one.values} for one in added]
    write_text(folder / ADDED, json.dumps({"sources": source_hash("table"), "runs": rows}) + "\n")
    checksums.seal(folder / ADDED)


def kept(folder: Path) -> list[Measured]:
    """Return what was learned of columns that were added before, by the same sources; RecordError if it is damaged."""
    path = folder / ADDED
    if not os.path.exists(path):
        return []
    checksums.verify(path)
    told = json.loads(path.read_text(encoding="utf-8"))
    if told.get("sources") != source_hash("table"):
        return []
    try:
        return [Measured(from_dict(row["point"]), row["values"]) for row in told["runs"]]
    except (KeyError, TypeError) as error:
        raise RecordError(f"{path} is damaged ({error}); remove it to make it again") from None
