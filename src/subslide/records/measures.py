"""What only some runs are asked for, as arrays along the runs of a record: gauges, footprints, runout by direction."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from subslide import naming

if TYPE_CHECKING:
    from subslide.solver.run import Run

Arrays = dict[str, tuple[tuple[str, ...], np.ndarray]]
"""Dimensions and values by name of variable."""


def arrays(runs: list["Run"], inside: Sequence[slice], dim: str) -> Arrays:
    """Return the variables that any run was asked for; NaN of those that were not.

    Parameters
    ----------
    runs
        Results of `solver.solve`, as a record keeps them.
    inside
        Where each run's cells lie along those of the record.
    dim
        Name of the dimension of cells along x.

    Returns
    -------
    Arrays
        Nothing where no run was asked for more than all are.
    """
    names = dict.fromkeys(name for run in runs for name in run.measured)
    if not names:
        return {}
    angles = np.unique(np.concatenate([run.directions for run in runs]))
    located = [np.array(run.point.gauges).reshape(-1, 2) for run in runs]
    gauges, samples = max(map(len, located)), max(len(run.time) for run in runs)
    cells = max((part.stop for part in inside), default=0)
    sizes = {"gauge": gauges, "step": samples, "direction": len(angles), "x": cells, "y": cells}
    sizes["front_threshold"] = len(naming.FRONT_THRESHOLDS)
    made: Arrays = {}
    for name in names:
        dims = naming.NAMES[name].dims
        kind = next(run.measured[name].dtype for run in runs if name in run.measured)
        joined = np.full((len(runs), *(sizes[of] for of in dims[1:])), np.nan, kind)
        for n, run in enumerate(runs):
            if name in run.measured:
                values, row = run.measured[name], joined[n, ...]
                cells = inside[n] if inside else slice(0)
                places: dict[str, slice | np.ndarray] = {
                    "x": cells,
                    "y": cells,
                    "direction": np.isin(angles, run.directions),
                }
                along = zip(dims[1:], values.shape, strict=True)
                row[tuple(places.get(of, slice(count)) for of, count in along)] = values
        made[name] = (*dims[:-1], dim if dims[-1] == "x" else dims[-1]), joined
    if gauges and "gauge_h2" in names:
        for axis, name in enumerate(("gauge_x", "gauge_y")):
            padded = np.full((len(runs), gauges), np.nan)
            for row, place in zip(padded, located, strict=True):
                row[: len(place)] = place[:, axis]
            made[name] = ("run", "gauge"), padded
    if angles.size:
        made["direction"] = ("direction",), angles
    return made
