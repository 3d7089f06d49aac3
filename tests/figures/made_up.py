"""Made-up studies with plausible shapes, in the interface that figures read; no solver."""

from types import SimpleNamespace

import numpy as np
import pandas as pd
import xarray as xr

from subslide import naming

TIMES = (0.0, 0.08, 0.16, 0.24, 0.54)
DEFAULTS = {
    "numerics": "paper",
    "a_2": 0.56,
    "delta": 32.0,
    "radius": 0.0705,
    "g": 9.81,
    "scene": "cylinder",
    "model": "quarter",
    "scheme": "ifcph",
    "order": 1,
    "cells": 200,
    "dtype": "float64",
    "cfl": 0.9,
    "boundary": "paper",
    "t_end": "rest",
    "resolved_model": "quarter",
    "resolved_grid": "uniform",
    "status": "ok",
    "status_detail": "",
}


RESOLVED = {
    "numerics": "resolved",
    "model": "auto",
    "order": 2,
    "cells": 800,
    "resolved_model": "radial",
    "boundary": "open",
}
"""What differs in runs with resolved numerics."""
BANDED = ("L_f_1pc", "x_front_1pc", "max_abs_eta", "max_abs_eta_outside")


class MadeUpResults:
    """A study of runs with given values; `records` holds one dataset each.

    bands: whether it has bands: of one per cent when resolved, and none (not converged) with the paper's numerics.
    """

    def __init__(self, runs, bands=False):
        self.records = {f"p{k:012d}": made_up_run({**DEFAULTS, **values}) for k, values in enumerate(runs)}
        self.runs = pd.DataFrame({"id": key, **data.attrs["row"]} for key, data in self.records.items())
        self.series = pd.concat([tidy(key, data) for key, data in self.records.items()], ignore_index=True)
        point = SimpleNamespace(profile_times=[t * s for t in TIMES for s in scales(self.runs)])
        self.runs_of_study = [SimpleNamespace(id=key, point=point) for key in self.records]
        rows = (
            [row for key, data in self.records.items() for row in made_up_bands(key, data)] if bands else []
        )
        self.bands = pd.DataFrame(rows, columns=["id", "quantity", "time", "value", "band", "convergence"])

    def select(self, **values):
        """Return the rows of the table of runs whose columns equal the given values."""
        return self.runs[np.logical_and.reduce([self.runs[key] == value for key, value in values.items()])]

    def record(self, name):
        """Return the dataset of one run."""
        return self.records[name]

    profiles = record

    def curves(self, quantity, ids):
        """Return times and values of a series of some runs, by their ids."""
        rows = self.series[(self.series["quantity"] == quantity) & self.series["id"].isin(ids)]
        return {
            key: (of_run["time"].to_numpy(), of_run["value"].to_numpy())
            for key, of_run in rows.groupby("id", sort=False)
        }


def scales(runs):
    """Return the ratios of the paper's times to those of columns of other radii."""
    return np.sqrt(runs["radius"].unique() / 0.0705)


def made_up_run(row):
    """Return the dataset of one run: a front that eases to its final length, a paraboloid under it, a ring of waves."""
    radius, height = row["radius"], row["a_2"] * row["radius"]
    fitted = row["resolved_grid"] == "fitted"
    dx = 0.6 / row["cells"] * radius / 0.0705
    x = (np.arange(row["cells"] // 2) + 0.5) * dx
    scale = np.sqrt(radius / 0.0705)
    rest = 0.2 * scale / np.sqrt(1 - row["r"])
    final = radius * (1.9 + 0.1 * np.log(row["a_H"]) - 0.2 * row["r"]) * (1.1 if row["order"] == 2 else 1.0)
    failed = row["status"] == "diverged"
    time = np.linspace(0, row.pop("until", 0.6) * scale, 60)
    if failed:
        time = time[time < 0.11 * scale]
    front = radius + (final - radius) * np.sin(np.pi / 2 * np.minimum(time / rest, 1)) ** 1.2
    wave = (
        0.1 * height / row["a_H"] * (1 - 0.6 * row["r"]) * np.sin(np.pi * np.minimum(time / 0.3 / scale, 1))
    )
    shots = np.array([t * scale for t in TIMES if t * scale < time[-1]] + [time[-1]])
    speed = np.sqrt(row["g"] * height * (1 + row["a_H"]))
    x = np.outer(np.interp(shots, time, front) / radius, x) if fitted else np.tile(x, (len(shots), 1))
    h2 = np.array(
        [depth(at, np.interp(t, time, front), radius, height) for t, at in zip(shots, x, strict=True)]
    )
    eta = np.array(
        [
            np.interp(t, time, wave) * np.cos((at - speed * t) / radius * 2) / (1 + at / radius)
            for t, at in zip(shots, x, strict=True)
        ]
    )
    if fitted or row["resolved_model"] == "one-layer":
        eta, wave = eta * np.nan, wave * np.nan
    if failed:
        front[-1] = wave[-1] = np.nan
    thresholds = np.array(naming.FRONT_THRESHOLDS)
    fronts = front * (1 - 4 * (thresholds[:, None] - 0.01))
    lengths = np.full(3, np.nan) if failed else fronts[:, -1]
    row = {**row, "dx": np.nan if fitted else dx, "time_at_rest": np.nan if failed else rest}
    free = {"paper": (row["cells"] / 2 * dx - radius) / speed, "open": 2 * time[-1]}
    wet = row["resolved_model"] != "one-layer"
    row["wave_free_until"] = free.get(row["boundary"], np.nan) if wet else np.nan
    for name, value in zip(("L_f_1pc", "L_f_3pc", "L_f_5pc"), lengths, strict=True):
        row |= {
            name: value,
            f"{name}_over_R": value / radius,
            name.replace("L_f", "time_of_arrest"): 0.9 * rest,
        }
    along = ("snapshot", "cell" if fitted else "x")
    return xr.Dataset(
        {
            "time": ("step", time),
            "x_front": (("front_threshold", "step"), fronts),
            "max_abs_eta": ("step", wave),
            "max_abs_eta_outside": ("step", 0.7 * wave),
            "snapshot_time": ("snapshot", shots),
            "h2": (along, h2),
            "eta": (along, eta),
            "L_f": ("front_threshold", lengths),
            "time_at_rest": row["time_at_rest"],
            "status": row["status"],
        },
        {"x": (along, x) if fitted else x[0], "front_threshold": thresholds},
        {"row": row},
    )


def made_up_bands(name, data):
    """Return the rows of the table of bands of a run: id, quantity, time, value, band, convergence."""
    known = data.attrs["row"]["numerics"] == "resolved"
    values = {("L_f_1pc", np.nan): float(data["L_f"][0])}
    series = {"x_front_1pc": data["x_front"].values[0], **{key: data[key].values for key in BANDED[2:]}}
    times = data["snapshot_time"].values[1:-1]
    values |= {(key, t): np.interp(t, data["time"], entry) for key, entry in series.items() for t in times}
    for (quantity, time), value in values.items():
        band = 0.01 * abs(value) if known else np.nan
        yield name, quantity, time, value, band, "converging" if known else "not converged"


def depth(x, front, radius, height):
    """Return the depth that holds the column's volume between the axis and `front`."""
    steep = np.clip((front - radius) / radius, 0.02, None)
    shape = np.clip(1 - (x / front) ** (2 / steep), 0, None)
    return shape * min(height, height * radius**2 / max(np.sum(2 * shape * x) * (x[1] - x[0]), 1e-12))


def tidy(name, data):
    """Return the series of a dataset as rows of id, time, quantity, value."""
    values = {
        f"x_front_{100 * t:.0f}pc": data["x_front"].values[k] for k, t in enumerate(naming.FRONT_THRESHOLDS)
    }
    values |= {key: data[key].values for key in ("max_abs_eta", "max_abs_eta_outside")}
    parts = (
        pd.DataFrame({"time": data["time"].values, "quantity": key, "value": v}) for key, v in values.items()
    )
    return pd.concat(parts, ignore_index=True).assign(id=name)


def grid(a_H, r, **values):
    """Return the values of runs: every a_H with every r."""
    return [{"a_H": float(a), "r": float(b), **values} for a in a_H for b in r]
