"""Where a record comes from: its global attributes."""

import json
import platform
from typing import TYPE_CHECKING, Any

import numpy as np

import subslide
from subslide import points
from subslide.records import thinning

if TYPE_CHECKING:
    from subslide.records.variables import Variable
    from subslide.solver.run import Run

STATED = (
    "scheme",
    "order",
    "model",
    "model_reason",
    "grid",
    "grid_reason",
    "cells",
    "dtype",
    "status",
    "status_detail",
    "steps",
    "wall_seconds",
)
"""Variables that a record of a single run also states as attributes."""


def attributes(runs: list["Run"], variables: dict[str, "Variable"]) -> dict[str, Any]:
    """Return the global attributes of a record: conventions, versions, configuration and, for one run, its outcome.

    Parameters
    ----------
    runs
        Results of `solver.solve`.
    variables
        The record's variables by name.

    Returns
    -------
    dict
        Attributes by name: text and numbers.
    """
    import numba

    config = [points.to_dict(run.point) for run in runs]
    attrs = {
        "Conventions": "CF-1.11",
        "title": "Collapse of submerged granular columns",
        "source": f"subslide {subslide.__version__}, two-layer Savage-Hutter model with Coulomb friction",
        "history": f"written by subslide {subslide.__version__} (sources {subslide.source_hash()})",
        "comment": "time is elapsed time since release; sample 0 is the start, then one sample each time step, none"
        f" left out of runs of up to {thinning.LONGEST} samples; longer ones keep the first {thinning.HEAD} and then"
        " the extremes of every series in each of many blocks of steps; runs with fewer samples end in NaN",
        "version": subslide.__version__,
        "source_hash": subslide.source_hash(),
        "python_version": platform.python_version(),
        "numpy_version": np.__version__,
        "numba_version": numba.__version__,
        "machine": platform.machine(),
        "config": json.dumps(config[0] if len(config) == 1 else config, allow_nan=False),
    }
    if len(runs) == 1:
        attrs.update({name: variables[name].values[0] for name in STATED})
    return attrs
