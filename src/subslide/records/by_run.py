"""Variables of a record run by run, as NumPy arrays: the reader of many runs."""

from collections.abc import Collection
from pathlib import Path
from typing import Any

import numpy as np

from subslide import naming
from subslide.files import RecordError
from subslide.records import netcdf, thinning
from subslide.records.variables import Variable

PLACES = ("id", "time", "snapshot_time", "h2", "grid", "cell_width")
"""Variables that tell where a run is in its record, and what of that is padding."""


class OfRun(dict[str, Any]):
    """Variables of a run by name; asking for one that its record lacks is a fault of the record."""

    def __init__(self, path: Path, values: dict[str, Any], keep: str = "all"):
        """Keep the path of the record, and how much it keeps of each run, for the message."""
        super().__init__(values)
        self.path, self.keep = path, keep

    def __missing__(self, name: str) -> Any:
        """Raise a RecordError: the record was written by another version, or keeps less."""
        why = "it is of another version; make the study again"
        if self.keep != "all" and name in naming.NAMES:
            why = f"it was made with keep: {self.keep}; make the study again with keep: all"
        raise RecordError(f"{self.path}: the record has no {name}: {why}")


def read(path: Path, ids: Collection[str], names: Collection[str]) -> dict[str, dict[str, Any]]:
    """Return variables of some runs of a record; nothing else stays in memory.

    Parameters
    ----------
    path
        The record, for which the checksum beside it was seen to vouch.
    ids
        Ids of the runs.
    names
        Names of the variables; what the record lacks is left out.

    Returns
    -------
    dict
        Variables by the id of the run and their name, without the dimension `run` and without padding. Cells of a run
        on a uniform grid are at `x` (x), whatever its record has; on a fitted one they move, `x` (snapshot, cell).

    Raises
    ------
    RecordError
        If the record is missing or damaged, or lacks a run.
    """
    variables, attrs = netcdf.read(path, {*names, *PLACES}, vouched=True)
    places = dict(zip(ids, _places(path, variables, ids), strict=True))
    wanted = {name: variables[name] for name in names if name in variables}
    runs: dict[str, dict[str, Any]] = {
        name: OfRun(path, _of_run(variables, wanted, places[name]), attrs.get("keep", "all")) for name in ids
    }
    if attrs.get("keep") == "summary":
        for name, one in runs.items():
            time = _of_run(variables, {"time": variables["time"]}, places[name])["time"]
            one.update({key: thinning.filled(time, one[key]) for key in thinning.SUMMARY if key in one})
    return runs


def _of_run(variables: dict[str, Variable], wanted: dict[str, Variable], place: int) -> dict[str, Any]:
    """Return the wanted variables of the run at a place of a record, without padding, as copies."""
    cells = np.isfinite(variables["h2"].values[place, 0]) if "h2" in variables else slice(None)
    kept = {
        "step": slice(int(np.isfinite(variables["time"].values[place]).sum())),
        "snapshot": slice(int(np.isfinite(variables["snapshot_time"].values[place]).sum())),
        "x": cells,
        "y": cells,
        "cell": cells,
    }
    still = "cell_width" in variables and variables["grid"].values[place] == "uniform"
    parts = {}
    for name, variable in wanted.items():
        dims, values = variable.dims, variable.values
        if dims[:1] == ("run",):
            dims, values = dims[1:], values[place]
        for axis, dim in enumerate(dims):
            values = values[(*[slice(None)] * axis, kept.get(dim, slice(None)))]
        if still and name == "x":
            values = values[0]
        parts[name] = values.copy() if dims else values
    if still:
        parts.pop("cell_width", None)
    return parts


def values(path: Path, ids: Collection[str], names: Collection[str]) -> dict[str, np.ndarray]:
    """Return numbers and texts of some runs of a record: what is of each run alone.

    Parameters
    ----------
    path
        The record, for which the checksum beside it was seen to vouch.
    ids
        Ids of the runs.
    names
        Names of the variables, whose first dimension is `run` and that need no padding.

    Returns
    -------
    dict
        Arrays by name, along the runs as they are asked for.

    Raises
    ------
    RecordError
        If the record is missing or damaged, or lacks a run or a variable.
    """
    variables, _ = netcdf.read(path, {*names, "id"}, vouched=True)
    places = _places(path, variables, ids)
    record = OfRun(path, variables)
    return {name: record[name].values[places] for name in names}


def _places(path: Path, variables: dict[str, Variable], ids: Collection[str]) -> list[int]:
    """Return where runs are in a record; RecordError if it lacks one."""
    known = {name: n for n, name in enumerate(variables["id"].values)}
    if lacking := sorted(set(ids) - set(known)):
        raise RecordError(f"{path}: the record lacks the run {lacking[0]}")
    return [known[name] for name in ids]
