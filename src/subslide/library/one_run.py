"""One run in a program: keys in, the data set of its record out."""

import contextlib
import inspect
import threading
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

from subslide import jobs
from subslide.keys import schema
from subslide.library import given
from subslide.points import RUN_KEYS, Point
from subslide.study import config, notes, shown
from subslide.study import progress as lines

if TYPE_CHECKING:
    import xarray as xr

    from subslide.solver.run import Run

OF_FILES = ("coordinates", "_FillValue")
"""Attributes that xarray keeps apart when it opens a file."""

_alone = threading.Lock()
"""Held by the thread that solves: runs share arrays, and numba's number of threads."""


def solve(
    *, threads: int = 1, progress: bool | Callable[[float], object] | None = None, **keys: Any
) -> "xr.Dataset":
    """Return the solution of one collapse, such as `solve(a_H=2, r=0.6)`.

    Keys, units, defaults, ranges and messages are those of a study's file (config/README.md), and so are the bits of
    the answer. A run that fails numerically is data: its `status` says how it ended. Regions of parameters that are
    unsafe are warned of (`subslide.Caution`).

    Parameters
    ----------
    threads
        Cores for a run in the plane; no answer depends on it.
    progress
        True for a line on stderr while a run takes more than two seconds, or a function that is called now and then
        with the time (s) that the run has reached.
    keys
        One value for each key that is not to have its default, of Python or numpy.

    Returns
    -------
    xarray.Dataset
        What `subslide run` writes into its record (docs/records.md), in memory and without the dimension `run`.

    Raises
    ------
    ConfigError
        If a key is unknown or a value is not allowed: a ValueError of one line, and nothing is solved.
    """
    point = _point(given.mapping(keys, "solve"))
    show = lines.of_run(point) if progress is True else progress or None
    with at_work():
        run = jobs.solved(point, threads, show)
    return dataset(run)


def _point(values: dict[str, Any]) -> Point:
    """Return the point that keys ask for, checked, with a warning where that is due."""
    if isinstance(values.get("snapshot_times"), int | float):
        values["snapshot_times"] = [values["snapshot_times"]]
    point = config.make_point(values)
    given.warn([point], notes.left_out(values))
    return point


@contextlib.contextmanager
def at_work() -> Iterator[None]:
    """Hold a block in which the program solves: no other thread does, and its number of threads for numba stays."""
    import numba

    before = 0
    with contextlib.suppress(
        ImportError, RuntimeError, ValueError
    ):  # of no threading layer, as the solver will say
        before = numba.get_num_threads()
    with _alone:
        try:
            yield
        finally:
            if before:
                numba.set_num_threads(before)


def dataset(run: "Run") -> "xr.Dataset":
    """Return the data set of a run: that of its record, opened.

    Parameters
    ----------
    run
        Run, as `jobs.solved` gives it.

    Returns
    -------
    xarray.Dataset
        Held in memory, without the dimension `run`.
    """
    import xarray as xr

    from subslide.records import netcdf

    variables, attrs = netcdf.contents([run])
    beside = {
        name for variable in variables.values() for name in variable.attrs.get("coordinates", "").split()
    }
    beside |= {name for name, variable in variables.items() if variable.dims == (name,)}
    held = {}
    for name, (dims, values, about) in variables.items():
        one, rest = (values[0], dims[1:]) if dims[:1] == ("run",) else (values, dims)
        told = {key: value for key, value in about.items() if key not in OF_FILES}
        held[name] = xr.Variable(rest, np.asarray(one, str if values.dtype.kind == "O" else None), told)
    coords = {name: held.pop(name) for name in tuple(held) if name in beside}
    coords |= {name: coords.pop(name) for name in shown.MAIN}  # texts of a data set are cut in the middle
    return given.outcome_first(xr.Dataset(held, coords, attrs))


def _signature() -> inspect.Signature:
    """Return the signature of `solve` with the keys of a run by name, for help and completion."""
    first, second, rest = inspect.signature(solve).parameters.values()
    entries = schema.properties()
    keys = [
        inspect.Parameter(key, inspect.Parameter.KEYWORD_ONLY, default=entries[key]["default"])
        for key in RUN_KEYS
    ]
    return inspect.Signature([*keys, first, second, rest], return_annotation="xarray.Dataset")


vars(solve)["__signature__"] = _signature()
