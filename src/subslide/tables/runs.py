"""Tidy tables of a study from its records: a row a run, a row a sample, and timings apart.

`COLUMNS` says what each column means; docs/tables.md is written from it.
"""

import functools
import itertools
import math
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pandas as pd
import xarray as xr

from subslide import naming
from subslide.files import replacing, write_text
from subslide.keys import schema, words
from subslide.points import PAPER_BOX, RUN_KEYS, Point, from_dict, options_text
from subslide.results import Results, trimmed
from subslide.study.config import COARSENING
from subslide.tables import bands

MOST_RUNS_IN_CSV = 1000
THRESHOLDS = bands.THRESHOLDS

COLUMNS = {
    "id": ("", "name of the run; depends on its values alone"),
    "numerics": ("", "named set of numerics that the study asked for"),
    **{
        key: (words.unit(key), schema.properties()[key]["description"])
        for key in RUN_KEYS
        if key != "snapshot_times"
    },
    "m": ("", "tan(delta)/a_2: with a_H and r, all that the scaled answer depends on"),
    "resolved_model": ("", "geometry that was solved; `model` is what was asked for"),
    "dx": ("m", "cell size"),
    "status": ("", "how the run ended: " + "; ".join(f"`{k}`: {v}" for k, v in naming.STATUSES.items())),
    "status_detail": ("", "what ended the run, in words"),
    "steps": ("", "number of time steps"),
    "time_at_rest": (
        "s",
        "time since which no grain has moved (late waves may nudge a few); empty if some move at the end",
    ),
    "box_half_width": ("m", "half-width of the box at the end"),
    **{
        f"L_f_{t}": (
            "m",
            f"length of the deposit along x at the end of the run; front where h2 = {t[:-2]} % of H2",
        )
        for t in THRESHOLDS
    },
    **{f"L_f_{t}_over_R": ("", f"the same over the initial radius ({t[:-2]} % front)") for t in THRESHOLDS},
    "max_abs_eta_peak": ("m", "largest displacement of the water surface, over the initial box and all time"),
    "max_abs_eta_peak_time": ("s", "time of that peak"),
    "max_abs_eta_outside_peak": ("m", "the same beyond x = R, where waves are not focused"),
    "max_abs_eta_outside_peak_time": ("s", "time of that peak"),
    "sediment_volume_error": (
        "",
        "largest relative change of the volume of grains while nothing can have left the box",
    ),
    "water_volume_error": ("", "the same for water"),
    "nonhyperbolic_cells_max": ("", "most cells, at any one time, where the wave speeds are complex"),
    "hyperbolic_margin_min": (
        "",
        "smallest margin to complex wave speeds at any time, a discriminant: 1 at rest, below 0 where complex",
    ),
    **{
        f"{name}_{part}": (bands.COLUMNS[part][0], f"`{part}` of {name} in bands.csv; empty without bands")
        for name in bands.ONCE
        for part in bands.SUMMARY
    },
}
TIMING = {
    "id": ("", "name of the run"),
    "steps": ("", "number of time steps"),
    "wall_seconds": ("s", "wall time of the time loop alone"),
    "cells_in_box": ("", "cells of the box at the end"),
    "cell_updates_per_second": ("s-1", "cells times steps over wall time"),
}
QUANTITIES = (*(f"x_front_{t}" for t in THRESHOLDS), *(name for name in naming.SERIES if name != "x_front"))


def write(folder: Path) -> list[Path]:
    """Paths of the tables of the study in `folder`, newly written."""
    results = Results(folder)
    many = len(results.points) > MOST_RUNS_IN_CSV
    tables = folder / "tables"
    tables.mkdir(exist_ok=True)
    paths = [
        tables / "runs.csv",
        tables / "timing.csv",
        tables / ("series.parquet" if many else "series.csv"),
    ]
    found = list(band_rows(results))
    if found:
        paths.append(tables / "bands.csv")
        write_text(
            paths[-1],
            pd.DataFrame(found, columns=list(bands.COLUMNS)).to_csv(index=False, lineterminator="\n"),
        )
    else:
        (tables / "bands.csv").unlink(missing_ok=True)
    summaries = bands.summaries(found)
    rows, timings = [], []
    for row, run in _runs(results):
        rows.append({**run_row(row, run), **summaries.get(row["id"], {})})
        timings.append(timing_row(run))
    write_text(paths[0], pd.DataFrame(rows, columns=list(COLUMNS)).to_csv(index=False, lineterminator="\n"))
    write_text(paths[1], pd.DataFrame(timings, columns=list(TIMING)).to_csv(index=False, lineterminator="\n"))
    with replacing(paths[2]) as temporary:
        (_write_parquet if many else _write_csv)(temporary, (series_rows(run) for _, run in _runs(results)))
    (tables / ("series.csv" if many else "series.parquet")).unlink(missing_ok=True)
    return paths


def band_rows(results: Results) -> Iterator[dict]:
    """Rows of the table of bands, by column, in the order of the runs; none if the study has no bands."""
    companions = {(row["of"], row["role"]): row for row in results.companions}
    if not companions:
        return
    batches = {row["id"]: row["batch"] for row in (*results.points, *companions.values())}
    measured = {}
    for batch in dict.fromkeys(batches.values()):
        data = _loaded(results, batch)
        for name in data["id"].values:
            if batches.get(name) == batch:
                measured[name] = bands.measure(trimmed(data, name))
    for row in results.points:
        names = (row["id"], *(companions[row["id"], role]["id"] for role in COARSENING))
        yield from bands.rows(_point(row), *(measured[name] for name in names))


def run_row(row: dict, run: xr.Dataset) -> dict:
    """Row of the table of runs, by column. row: the point's values; run: its record."""
    point = _point(row)
    found = {key: row[key] for key in ("id", "numerics", *RUN_KEYS) if key != "snapshot_times"}
    found["scene_options"] = options_text(point)
    found.update(m=point.friction_number, resolved_model=str(run["model"].values))
    for name in ("dx", "steps", "time_at_rest", "box_half_width", "status", "status_detail"):
        found[name] = run[name].item()
    for label, n in THRESHOLDS.items():
        found[f"L_f_{label}"] = run["L_f"].values[n]
        found[f"L_f_{label}_over_R"] = run["L_f"].values[n] / point.radius
    for name in ("max_abs_eta", "max_abs_eta_outside"):
        found[f"{name}_peak"], found[f"{name}_peak_time"] = _peak(run[name].values, run["time"].values)
    last = samples_inside(run)
    for name in ("sediment_volume", "water_volume"):
        found[f"{name}_error"] = _relative_change(run[name].values[:last])
    found["nonhyperbolic_cells_max"] = int(np.nan_to_num(run["nonhyperbolic_cells"].values).max())
    found["hyperbolic_margin_min"] = float(run["hyperbolic_margin"].min())
    return found


def timing_row(run: xr.Dataset) -> dict:
    """Row of the table of timings, by column."""
    across = round(float(run["box_half_width"] / run["dx"]))
    cells = {"quarter": across**2, "plane": 4 * across**2, "line": 2 * across}.get(
        str(run["model"].values), across
    )
    steps, seconds = int(run["steps"]), float(run["wall_seconds"])
    speed = cells * steps / seconds if seconds > 0 else math.nan
    return dict(zip(TIMING, (run["id"].item(), steps, seconds, cells, speed), strict=True))


def series_rows(run: xr.Dataset) -> pd.DataFrame:
    """Tidy rows of a run: id, time, quantity, value, a row for each sample; quantities it lacks are left out."""
    time = run["time"].values
    values = {f"x_front_{label}": run["x_front"].values[n] for label, n in THRESHOLDS.items()}
    values.update((name, run[name].values) for name in QUANTITIES if name not in values)
    values = {name: entries for name, entries in values.items() if np.isfinite(entries).any()}
    return pd.DataFrame(
        {
            "id": run["id"].item(),
            "time": np.tile(time, len(values)),
            "quantity": np.repeat(list(values), len(time)),
            "value": np.concatenate(list(values.values())),
        }
    )


def samples_inside(run: xr.Dataset) -> int:
    """Number of samples up to which nothing can have left the box: a step carries a change `order` cells at most.

    Unless the box is open nothing ever leaves, and every sample counts.
    """
    if str(run["boundary"].values) != "open":
        return run.sizes["step"]
    radius, dx = float(run["radius"]), float(run["dx"])
    cells = (min(PAPER_BOX * radius, float(run["box_half_width"])) - radius) / dx
    return max(1, int(cells / int(run["order"])) - 1)


def _runs(results: Results) -> Iterator[tuple[dict, xr.Dataset]]:
    """Values and record, without profiles, of each run in the order of the tables."""

    @functools.lru_cache(maxsize=16)
    def loaded(batch: str) -> xr.Dataset:
        return _loaded(results, batch)

    for row in results.points:
        yield row, trimmed(loaded(row["batch"]), row["id"])


def _point(row: dict) -> Point:
    """Point of a row of points.json."""
    return from_dict({key: row[key] for key in RUN_KEYS})


def _loaded(results: Results, batch: str) -> xr.Dataset:
    """Record of a batch in memory, without profiles."""
    return results.batch(batch).drop_dims(["x", "y"], errors="ignore").load()


def _peak(values: np.ndarray, time: np.ndarray) -> tuple[float, float]:
    """Largest value, and when it was first reached; NaN if there is none."""
    if not np.isfinite(values).any():
        return math.nan, math.nan
    place = int(np.nanargmax(values))
    return float(values[place]), float(time[place])


def _relative_change(values: np.ndarray) -> float:
    with np.errstate(invalid="ignore", divide="ignore"):
        changes = np.abs(values / values[0] - 1)
    return float(np.nanmax(changes)) if np.isfinite(changes).any() else math.nan


def _write_csv(path: Path, frames: Iterator[pd.DataFrame]) -> None:
    with open(path, "w", encoding="utf-8", newline="") as file:
        for n, frame in enumerate(frames):
            frame.to_csv(file, index=False, header=n == 0, float_format="%.10g", lineterminator="\n")


def _write_parquet(path: Path, frames: Iterator[pd.DataFrame]) -> None:
    import pyarrow as pa
    import pyarrow.parquet as pq

    layout = pa.schema(
        [("id", pa.string()), ("time", pa.float64()), ("quantity", pa.string()), ("value", pa.float64())]
    )
    with pq.ParquetWriter(path, layout) as writer:
        while chunk := list(itertools.islice(frames, 250)):
            writer.write_table(pa.Table.from_pandas(pd.concat(chunk), layout, preserve_index=False))
