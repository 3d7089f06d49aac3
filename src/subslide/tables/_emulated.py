"""Indices of the emulator's answers: another way to the same numbers, from many more points and no grid."""

from typing import Any

import numpy as np

from subslide.emulator import Emulator
from subslide.emulator.model import SHIPPED
from subslide.emulator.training import refuse
from subslide.keys.schema import ConfigError
from subslide.points import Point
from subslide.sensitivity import indices as sobol
from subslide.study.designs import SHARES
from subslide.study.distributions import Distribution
from subslide.tables._saltelli import FRICTION, Design

SCRAMBLINGS, POINTS = 16, 512
"""Size of the Saltelli blocks, whatever that of the design."""


def estimates(design: Design, points: list[Point], names: list[str]) -> dict[str, np.ndarray]:
    """Return the indices of a design's inputs by output, none where the emulator does not know such columns.

    Parameters
    ----------
    design
        The design.
    points
        Points of all runs of the study.
    names
        Outputs.
    """
    if not SHIPPED.is_file():
        return {}
    chosen = [points[place] for place in np.unique(design.runs)]
    try:
        for point in chosen:
            refuse(point)
    except ConfigError:
        return {}
    emulator = Emulator.load()
    inputs = len(design.names)
    shares = SHARES["saltelli"](POINTS, inputs, 1, SCRAMBLINGS)
    columns: dict[str, Any] = {key: getattr(chosen[0], key) for key in ("a_H", "a_2", "r", "delta")}
    columns |= {name: _quantiles(design, n, shares[:, n]) for n, name in enumerate(design.names)}
    through = ("a_H", "r", FRICTION) if FRICTION in columns else ("a_H", "r", "a_2", "delta")
    wanted = [name for name in names if name in emulator.quantities]
    try:
        answers = emulator.predict(**{key: columns[key] for key in through}, quantities=wanted)
    except ConfigError:
        return {}
    shape = (SCRAMBLINGS, 2 + 2 * inputs, POINTS)
    return {name: sobol.indices(answers[name].value.reshape(shape)).estimate for name in wanted}


def _quantiles(design: Design, place: int, shares: np.ndarray) -> np.ndarray:
    """Return the values of an input below which shares of its distribution lie; of a file's, by those in the design."""
    kind, numbers = next(iter(design.over[design.names[place]].items()))
    if kind == "file":
        return np.quantile(design.inputs[:, :2, :, place], shares)
    return np.array(Distribution(kind, tuple(numbers), {}).quantiles(shares))
