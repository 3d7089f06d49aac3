"""Where a record comes from: its global attributes."""

import json
import platform
from typing import TYPE_CHECKING, Any

import numpy as np

import subslide
from subslide import points
from subslide.records import thinning
from subslide.records.variables import ASKED_ALONE, Variable

if TYPE_CHECKING:
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


def attributes(runs: list["Run"], variables: dict[str, Variable], keep: str) -> dict[str, Any]:
    """Return the global attributes of a record: conventions, versions, configuration and, for one run, its outcome.

    Parameters
    ----------
    runs
        Results of `solver.solve`.
    variables
        The record's variables by name.
    keep
        How much of them is kept, see `records.thinning.kept`.

    Returns
    -------
    dict
        Attributes by name: text and numbers.
    """
    import numba

    stated = (_shared if keep == "summary" else _each)([run.point for run in runs])
    attrs = {
        "Conventions": "CF-1.11",
        "title": "Collapse of submerged granular columns",
        "source": f"subslide {subslide.__version__}, two-layer Savage-Hutter model with Coulomb friction",
        "history": f"written by subslide {subslide.__version__} (sources {subslide.source_hash()})",
        "comment": f"time is elapsed time since release; {thinning.ABOUT[keep]}; runs with fewer samples end in NaN",
        "keep": keep,
        "version": subslide.__version__,
        "source_hash": subslide.source_hash(),
        "python_version": platform.python_version(),
        "numpy_version": np.__version__,
        "numba_version": numba.__version__,
        "machine": platform.machine(),
        "config": json.dumps(stated, allow_nan=False),
    }
    if "h2" not in variables:
        attrs["coordinates"] = "snapshot_time"  # xarray's convention: no variable along snapshots can name it
    if len(runs) == 1:
        attrs.update({name: variables[name].values[0] for name in STATED})
    return attrs


def _each(asked: list[points.Point]) -> Any:
    """Return the configuration of a run, or a list with that of each."""
    config = [points.to_dict(point) for point in asked]
    return config[0] if len(config) == 1 else config


def _shared(asked: list[points.Point]) -> dict[str, Any]:
    """Return the values that all runs share, by key, and lists of those that differ and are no variables."""
    alike = {key: len({getattr(point, key) for point in asked}) == 1 for key in points.RUN_KEYS}
    config = {key: value for key, value in points.to_dict(asked[0]).items() if alike[key]}
    for key in ASKED_ALONE:
        if not alike[key]:
            config[key] = [points.to_dict(point)[key] for point in asked]
    return config
