"""From the runs of a study to an emulator, and what leave-one-out says of it."""

from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from subslide.emulator import coordinates, fitting, grids
from subslide.emulator import measures as named
from subslide.emulator.group import Group
from subslide.emulator.model import Emulator
from subslide.keys.schema import ConfigError
from subslide.naming import FINISHED
from subslide.points import Point
from subslide.study import choice

if TYPE_CHECKING:
    from subslide.results import Companion, Results, StudyRun

FEWEST = 20
"""Columns from which anything is learned."""

LACKING = 0.1
"""Share of the columns that may lack a quantity; one that more lack is left out."""


class Measured(NamedTuple):
    """A run and what is learned of it, by quantity."""

    point: Point
    values: dict[str, float]


class Limits(NamedTuple):
    """What finer and finer grids would give.

    Attributes
    ----------
    quantities
        Quantities (q) of a group.
    inputs
        Columns (n, 3): a_H, r and m.
    values, noise, bias
        Values (n, q) and their standard deviations, see `grids.Limit`.
    lost
        Columns that are left out, since a run of theirs lacks a value.
    """

    quantities: tuple[str, ...]
    inputs: np.ndarray
    values: np.ndarray
    noise: np.ndarray
    bias: np.ndarray
    lost: int

    def first(self, count: int | None) -> "Limits":
        """Return those of the first columns, as many as a group keeps."""
        names = ("inputs", "values", "noise", "bias")
        return self._replace(**{name: getattr(self, name)[:count] for name in names})


class LeftOut(NamedTuple):
    """Predictions and values in pairs (n), with 95 % bands, and their columns (n, 3): a_H, r and m."""

    inputs: np.ndarray
    predicted: np.ndarray
    value: np.ndarray
    band: np.ndarray

    @property
    def error(self) -> np.ndarray:
        """Relative errors (n)."""
        return (self.predicted - self.value) / np.abs(self.value)

    @property
    def covered(self) -> float:
        """Share of the bands that hold the value."""
        return float(np.mean(np.abs(self.predicted - self.value) <= self.band))


class Training(NamedTuple):
    """An emulator, leave-one-out by quantity, and how many columns it knows and had to leave out, by group."""

    emulator: Emulator
    left_out: dict[str, LeftOut]
    known: dict[str, int]
    dropped: dict[str, int]


def of_study(results: "Results") -> list[Measured]:
    """Return what is learned of each run of a study that ended well, of its companions too.

    Raises
    ------
    ConfigError
        If a run is none that an emulator can learn from: one line.
    """
    both: tuple[StudyRun | Companion, ...] = (*results.runs_of_study, *results.companions)
    runs = {run.id: run for run in both}
    for run in runs.values():
        refuse(run.point)
    names = tuple(dict.fromkeys(name for needed in named.NEEDED.values() for name in needed))
    measured = []
    for run, record in results.each(*names, among=sorted(runs.values(), key=lambda one: one.batch)):
        if record["status"] in FINISHED:
            measured.append(Measured(run.point, named.measure(run.point, record)))
    return measured


def refuse(point: Point) -> None:
    """Raise a ConfigError unless an emulator can learn from a run: a cylinder of the range, by Coulomb's law."""
    if point.scene != "cylinder" or point.friction != "coulomb" or point.boundary != "open":
        raise ConfigError(
            f"{point.id}: scene {point.scene}, friction {point.friction}, boundary {point.boundary}; allowed: cylinder,"
            " coulomb and open, which an emulator learns"
        )
    for key, value in zip(coordinates.RANGE, point.similarity_key, strict=True):
        low, high = coordinates.RANGE[key]
        if not low * (1 - 1e-6) <= value <= high * (1 + 1e-6):
            raise ConfigError(
                f"{point.id}: {key} is {value:g}; allowed in an emulator: {low:.6g} to {high:.6g}"
            )


def learn(measured: Iterable[Measured], about: Mapping[str, object]) -> Training:
    """Return the emulator of measured runs.

    Parameters
    ----------
    measured
        Runs on at least two grids of a kind, fitted or uniform, for each column.
    about
        What the file says of where it comes from.

    Returns
    -------
    Training
        The emulator, and what leave-one-out says of it.

    Raises
    ------
    ConfigError
        If the columns or grids are too few.
    """
    groups: dict[str, Group] = {}
    left_out: dict[str, list[LeftOut]] = {}
    known = {name: one.first(named.MOST.get(name)) for name, one in limits(measured).items()}
    peak_band = None
    for name, one in known.items():
        if len(one.inputs) < FEWEST:
            raise ConfigError(f"{name}: {len(one.inputs)} columns are known; allowed: at least {FEWEST}")
        kind = named.LEARNED[name][0]
        learned = fitting.learn(kind, one.quantities, one.inputs, one.values, one.noise, one.bias)
        groups[name] = learned.group
        if name == "gauge":
            exact, guess = one.values.max(axis=1), learned.left_out.max(axis=1)
            bias = one.bias[np.arange(len(exact)), one.values.argmax(axis=1)]
            peak_band = fitting.band_of(kind, one.inputs, learned.nearer * (guess / exact - 1), bias / exact)
            share = np.exp(coordinates.of_errors(coordinates.of(kind, one.inputs)) @ peak_band)
            left_out[named.PEAK] = [LeftOut(one.inputs, guess, exact, share * guess / learned.nearer)]
            continue
        for q, quantity in enumerate(one.quantities):
            each = LeftOut(one.inputs, learned.left_out[:, q], one.values[:, q], learned.bands[:, q])
            left_out.setdefault(quantity.partition("@")[0], []).append(each)
    if not groups:
        raise ConfigError("no run ended well; allowed: a study with runs to learn from")
    together = {
        name: LeftOut(*map(np.concatenate, zip(*parts, strict=True))) for name, parts in left_out.items()
    }
    bounds = {}
    for n, (key, ends) in enumerate(coordinates.RANGE.items()):
        lows, highs = zip(*(_bounds(one.inputs[:, n], *ends) for one in known.values()), strict=True)
        bounds[key] = [max(lows), min(highs)]
    columns = {name: len(one.inputs) for name, one in known.items()}
    said = {**about, "range": bounds, "columns": columns, "leave_one_out": _told(together)}
    return Training(
        Emulator(groups, peak_band, said), together, columns, {k: one.lost for k, one in known.items()}
    )


def limits(measured: Iterable[Measured]) -> dict[str, Limits]:
    """Return limits as cells shrink, by group, of what was measured.

    Parameters
    ----------
    measured
        Runs on at least two grids of a kind, fitted or uniform, for each column.

    Returns
    -------
    dict
        By group, those that the runs have.
    """
    by_grid: dict[str, dict[tuple[float, ...], dict[int, dict[str, float]]]] = {"fitted": {}, "uniform": {}}
    for point, values in measured:
        kind = "fitted" if choice.is_fitted(point) else "uniform"
        by_grid[kind].setdefault(point.similarity_key, {})[point.cells] = values
    answers = {}
    for name, (kind, quantities) in named.LEARNED.items():
        columns = by_grid["fitted" if kind == coordinates.GRAINS else "uniform"]
        if not columns:
            continue
        inputs, array, cells = _together(columns, quantities, name)
        complete = np.isfinite(array).all(axis=1)
        few = complete.mean(axis=0) >= 1 - LACKING
        if not few.any() or (name == "gauge" and not few.all()):
            continue
        good = complete[:, few].all(axis=1)
        inputs, array = (part[good] for part in (inputs, array[:, :, few]))
        z = coordinates.of(kind, inputs) if name in named.POOLED else None
        parts = zip(*(grids.limit(array[:, :, q], cells, z) for q in range(array.shape[2])), strict=True)
        value, noise, bias = (np.stack(part, axis=1) for part in parts)
        names = tuple(np.array(quantities)[few].tolist())
        answers[name] = Limits(names, inputs, value, noise, bias, int(len(columns) - good.sum()))
    return answers


def _together(
    columns: dict[tuple[float, ...], dict[int, dict[str, float]]], quantities: Sequence[str], name: str
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return columns (n, 3), their values (n, grids, q) on the grids that most of them have, and those grids' cells."""
    counts: dict[int, int] = {}
    for grids_of in columns.values():
        for cells in grids_of:
            counts[cells] = counts.get(cells, 0) + 1
    shared = sorted(cells for cells, count in counts.items() if count > len(columns) / 2)
    if len(shared) < 2:
        raise ConfigError(
            f"{name}: columns are solved on one grid; allowed: at least two numbers of cells, such as [96, 192], which"
            " tell what a finer one would give"
        )
    whole = {key: of for key, of in columns.items() if all(cells in of for cells in shared)}
    values = [[[of[cells][quantity] for quantity in quantities] for cells in shared] for of in whole.values()]
    return np.array(list(whole)), np.array(values), np.array(shared)


def _bounds(values: np.ndarray, low: float, high: float) -> tuple[float, float]:
    """Return between which values of a_H, r or m a group answers, from those that it knows, at most low and high.

    Even points of a design leave a gap of about 1/n of its width at either end.
    """
    logs = low > 0
    spread = np.log(values) if logs else values
    gap = 2 / len(values) * np.ptp(spread)
    ends = spread.min() - gap, spread.max() + gap
    first, last = np.exp(ends) if logs else ends
    return float(max(low, first)), float(min(high, last))


def _told(left_out: dict[str, LeftOut]) -> dict[str, dict[str, float]]:
    """Return relative errors of leave-one-out, coverage and the median band, by quantity, as the file states them."""
    told = {}
    for name, one in left_out.items():
        size = np.abs(one.error)
        numbers = (*np.quantile(size, [0.5, 0.95, 1.0]), one.covered, np.median(one.band / np.abs(one.value)))
        names = ("median", "of_95_percent", "worst", "covered", "median_band")
        told[name] = {key: float(f"{value:.3g}") for key, value in zip(names, numbers, strict=True)}
    return told
