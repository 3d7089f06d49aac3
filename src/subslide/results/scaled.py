"""Series of many runs, filled in and laid on a common scaled time, as lazy as they were."""

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from subslide import naming
from subslide.records import thinning

if TYPE_CHECKING:
    import xarray as xr

DIM = "scaled_time"


def filled(data: "xr.Dataset") -> "xr.Dataset":
    """Return runs of summaries whose series have a value at each sample of the run, as those of other records."""

    def fill(time: np.ndarray, values: np.ndarray) -> np.ndarray:
        """Return series (runs, ..., samples) filled in."""
        rows = [thinning.filled(*run) for run in zip(time, values, strict=True)]
        return np.stack(rows).astype(values.dtype) if rows else values

    return _of_series(data, fill, [name for name in thinning.SUMMARY if name in data], "step", data.sizes["step"])


def on_common_time(data: "xr.Dataset", count: int) -> "xr.Dataset":
    """Return runs with series on a common scaled time, t / sqrt(R / (g a_2)), from 0 to the latest end of a run.

    Values between samples of a run are on straight lines. Beyond its end a run that ended well keeps its last value;
    one that failed has none. `scaled_end` says where each ends, `time_scale` the time (s) of scaled time 1.

    Parameters
    ----------
    data
        Dataset by run.
    count
        Number of samples.

    Returns
    -------
    xarray.Dataset
        The same with the dimension `scaled_time` in place of `step`.
    """
    scale = np.sqrt(data["radius"].values / (data["g"].values * data["a_2"].values))
    ends = data["time"].max("step").values / scale
    common = np.linspace(0, ends.max(), count)
    holds = np.isin(data["status"].values.astype(str), naming.FINISHED)
    about = {"units": "1", "long_name": "elapsed time since release over sqrt(R / (g a_2))"}
    data = data.assign_coords(
        time_scale=("run", scale, {"units": "s", "long_name": "time of scaled time 1, sqrt(R / (g a_2))"}),
        scaled_end=("run", ends, {"units": "1", "long_name": "end of the run, as scaled time"}),
        held=("run", holds),
    )

    def lay(time: np.ndarray, values: np.ndarray, scale: np.ndarray, holds: np.ndarray) -> np.ndarray:
        """Return series (runs, ..., samples) on the common time."""
        laid = np.full((*values.shape[:-1], count), np.nan, values.dtype)
        for run in range(len(values)):
            for row, of_run in zip(
                laid[run].reshape(-1, count), values[run].reshape(-1, values.shape[-1]), strict=True
            ):
                row[:] = interpolated(common, time[run] / scale[run], of_run, bool(holds[run]))
        return laid

    names = [name for name in (*naming.SERIES, *naming.GAUGES) if name in data]
    data = _of_series(data, lay, names, DIM, count, "time_scale", "held").drop_vars(["time", "step", "held"])
    return data.assign_coords({DIM: (DIM, common, about)})


def interpolated(common: np.ndarray, time: np.ndarray, values: np.ndarray, hold: bool) -> np.ndarray:
    """Return a series at other times: on straight lines between the samples that it has.

    Parameters
    ----------
    common
        The times.
    time, values
        Times and values (samples) of the series; missing values are no samples, missing times no part of the run.
    hold
        Whether what the run ends with goes on; else, and where the run's last value is missing, nothing does.

    Returns
    -------
    ndarray
        Values, missing before the first sample.
    """
    there = np.isfinite(time)
    known = there & np.isfinite(values)
    if not known.any():
        return np.full(common.shape, np.nan)
    last = hold and known[np.flatnonzero(there)[-1]]
    return np.interp(common, time[known], values[known], left=np.nan, right=None if last else np.nan)


def _of_series(
    data: "xr.Dataset", function: Callable, names: list[str], dim: str, size: int, *beside: str
) -> "xr.Dataset":
    """Return runs with some series changed by a function of times, the series and values of each run beside it."""
    import xarray as xr

    time = data.variables["time"].chunk(step=-1)
    laid = {}
    for name in names:
        series = data.variables[name]  # without their many coordinates, which cost a second
        inner = [of for of in series.dims if of not in ("run", "step")]
        values = xr.apply_ufunc(
            function,
            time,
            series.chunk({"step": -1, **dict.fromkeys(inner, -1)}),
            *(data.variables[other] for other in beside),
            input_core_dims=[["step"], [*inner, "step"], *([] for _ in beside)],
            output_core_dims=[[*inner, dim]],
            exclude_dims={"step"} if dim != "step" else set(),
            dask="parallelized",
            output_dtypes=[series.dtype],
            dask_gufunc_kwargs={"output_sizes": {dim: size}},
        )
        laid[name] = (values.dims, values.data, series.attrs)
    return data.drop_vars(names).assign(laid)
