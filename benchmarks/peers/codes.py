"""The column in each code: `subslide`, `geoclaw` and `pyclaw` return a `Result` in the same terms."""

import csv
import json
import subprocess
import tempfile
from pathlib import Path
from typing import NamedTuple

import numpy as np
from install import GEOCLAW, HERE, PYTHON

from subslide import solver
from subslide.models.grid import make_grid
from subslide.points import Point
from subslide.scenes.cylinder import quadrant_depth

COLUMN = Point(delta=0.0)
"""The paper's column, without friction: a_H = 1, a_2 = 0.56, r = 0.4, R = 0.0705 m, g = 9.81 m/s2."""

HALF_WIDTH = 0.3
H2 = COLUMN.a_2 * COLUMN.radius
LEVEL = (1.0 + COLUMN.a_H) * H2
DRY_TOLERANCE = 1e-4
"""m, for Clawpack: a quarter of the depth that defines the front (1 % of H2). With 1e-5 GeoClaw's runs farther."""

CASE = {
    "half_width": HALF_WIDTH,
    "g": COLUMN.g,
    "level": LEVEL,
    "densities": [1000.0, 1000.0 / COLUMN.r],
    "dry_tolerance": DRY_TOLERANCE,
    "dt_initial": 1e-4,
    "order": 1,
}
GHOSTS = 2
COMPONENTS = 8
"""Of a cell in GeoClaw's files: h, hu, hv of each layer, then the surface of each."""

GEOCLAW_CASE = {"eigen_method": 4, "inundation_method": 5, "transverse_waves": 0, "cfl": 0.45, "cfl_max": 0.5}
PYCLAW_CASE = {"cfl": 0.9, "cfl_max": 1.0}


class Frame(NamedTuple):
    """What a code had done by a time (s): wall seconds, steps, cells times steps, and the grains on x > 0 (m)."""

    seconds: float
    steps: int
    updates: int
    x: np.ndarray
    h2: np.ndarray
    max_abs_eta: float


class Result(NamedTuple):
    """One run: `frames` by time. `stopped` says why it ended before the last time, else it is empty."""

    code: str
    model: str
    order: int
    cells: int
    frames: dict[float, Frame]
    stopped: str = ""


def subslide(order, cells, times, **options):
    """Return subslide's run on one core; its box grows where grains would leave it before the last time.

    Only the last frame has seconds, as the box of a shorter run may be smaller. options: other keys of the point.
    """
    keys = {
        "model": "plane",
        "order": order,
        "cells": cells,
        "t_end": times[-1],
        "snapshot_times": tuple(times),
    }
    point = COLUMN.with_values(**keys | options)
    run = solver.solve(point, threads=1)
    if run.status != "ok":
        raise RuntimeError(f"subslide: {run.status_detail}")
    count = len(run.x) ** (2 if point.model == "plane" else 1)
    right = run.x > 0
    frames = {}
    for k, t in enumerate(times):
        steps = int(np.searchsorted(run.time, t * (1 - 1e-12)))
        frames[t] = Frame(
            seconds=run.wall_seconds if t == times[-1] else np.nan,
            steps=steps,
            updates=count * steps,
            x=run.x[right],
            h2=run.h2[k][right],
            max_abs_eta=float(np.abs(run.eta[k]).max()),
        )
    return Result(
        "subslide", "one layer" if point.model == "one-layer" else "two layers", order, cells, frames
    )


def geoclaw(cells, times):
    """Return GeoClaw's two-layer run, first order."""
    with tempfile.TemporaryDirectory(prefix="geoclaw-", dir=GEOCLAW.parent) as name:
        folder = Path(name)
        write_column(folder / "column.txt", cells)
        case = json.dumps(CASE | GEOCLAW_CASE | {"cells": cells, "times": list(times)})
        called("setrun.py", PYTHON, HERE / "geoclaw" / "setrun.py", case, cwd=folder)
        output = called("GeoClaw", GEOCLAW, cwd=folder)
        with open(folder / "timing.csv", newline="", encoding="utf-8") as file:
            timing = list(csv.DictReader(file, skipinitialspace=True))
        frames = {}
        for k, row in enumerate(timing[1:], 1):  # frame 0 is the start
            h2, eta = read_frame(folder, k, cells)
            updates = round(float(row["cells updated ( 1)"]))
            x, along = half_profile(h2)
            frames[times[k - 1]] = Frame(
                float(row["total_wall_time"]),
                updates // cells**2,
                updates,
                x,
                along,
                float(np.abs(half_profile(eta)[1] - LEVEL).max()),
            )
    complaints = ("Imaginary", "Unhandled", "not yet handled")
    said = [line.strip() for line in output.splitlines() if any(words in line for words in complaints)]
    stopped = "" if len(frames) == len(times) else (said or ["it ended early"])[0]
    return Result("GeoClaw", "two layers", 1, cells, frames, stopped)


def pyclaw(cells, times):
    """Return PyClaw's run of the grains alone, one layer, first order."""
    with tempfile.TemporaryDirectory(prefix="pyclaw-", dir=GEOCLAW.parent) as name:
        folder = Path(name)
        write_column(folder / "column.txt", cells)
        case = json.dumps(CASE | PYCLAW_CASE | {"times": list(times)})
        called("PyClaw", PYTHON, HERE / "pyclaw_column.py", case, cwd=folder)
        found = json.loads((folder / "pyclaw.json").read_text(encoding="utf-8"))
    frames = {
        frame["time"]: Frame(
            frame["seconds"],
            frame["steps"],
            frame["steps"] * cells**2,
            *half_profile(np.array(frame["depth"])),
            max_abs_eta=np.nan,
        )
        for frame in found
    }
    return Result("PyClaw", "one layer", 1, cells, frames)


def called(label, *command, cwd):
    """Return what a command printed; RuntimeError with its last line if it failed."""
    done = subprocess.run(
        [str(part) for part in command], cwd=cwd, capture_output=True, text=True, check=False
    )
    if done.returncode:
        last = (done.stderr.strip() or done.stdout.strip() or "no message").splitlines()[-1]
        raise RuntimeError(f"{label}: exit status {done.returncode}: {last}")
    return done.stdout


def write_column(path, cells):
    """Nothing; the file holds the cells along a side, the level and the column's depth (m), and area fractions."""
    quarter = quadrant_depth(make_grid("quarter", 2 * HALF_WIDTH / COLUMN.radius / cells, cells // 2).edges)
    half = np.concatenate([quarter[::-1], quarter])
    whole = np.concatenate([half[:, ::-1], half], axis=1)
    with open(path, "w", encoding="utf-8") as file:
        file.write(f"{cells} {LEVEL!r} {H2!r}\n")
        np.savetxt(file, whole, "%.17g")


def read_frame(folder, number, cells):
    """Return the depth of the grains and the height of the water's surface (m), each (cells, cells), y first.

    GeoClaw cuts the box into patches and writes each with its ghost cells, one after the other.
    """
    dx = 2 * HALF_WIDTH / cells
    lines = (folder / f"fort.q{number:04d}").read_text(encoding="utf-8").splitlines()
    header = [line.split()[0] for line in lines if line.strip()]
    raw = np.fromfile(folder / f"fort.b{number:04d}")
    whole = np.full((cells, cells, COMPONENTS), np.nan)
    read = 0
    for patch in range(0, len(header), 8):
        nx, ny = (int(value) for value in header[patch + 2 : patch + 4])
        left, low = (round((float(value) + HALF_WIDTH) / dx) for value in header[patch + 4 : patch + 6])
        shape = (ny + 2 * GHOSTS, nx + 2 * GHOSTS, COMPONENTS)
        values = raw[read : read + np.prod(shape)].reshape(shape)
        read += values.size
        whole[low : low + ny, left : left + nx] = values[GHOSTS:-GHOSTS, GHOSTS:-GHOSTS]
    if read != raw.size or np.isnan(whole).any():
        raise RuntimeError(f"GeoClaw: frame {number} is not the {cells} x {cells} cells that were asked for")
    return whole[:, :, 3], whole[:, :, 6]


def half_profile(field):
    """Return x (m) and the mean of the two rows beside the x axis, for x > 0."""
    n = len(field) // 2
    x = (np.arange(n) + 0.5) * HALF_WIDTH / n
    return x, 0.5 * (field[n - 1, n:] + field[n, n:])


def front(frame, threshold):
    """Return the farthest x (m) where the depth is `threshold` of H2, between cell centres; 0 where none reaches it."""
    reached = np.flatnonzero(frame.h2 >= threshold * H2)
    if len(reached) == 0:
        return 0.0
    i = reached[-1]
    if i + 1 == len(frame.h2):
        return float(frame.x[i])
    step = (frame.h2[i] - threshold * H2) / (frame.h2[i] - frame.h2[i + 1])
    return float(frame.x[i] + step * (frame.x[i + 1] - frame.x[i]))


def difference(frame, other):
    """Return the relative L1 difference of two profiles of the grains, on the cells of the first in the box."""
    inside = frame.x < HALF_WIDTH
    expected = np.interp(frame.x[inside], other.x, other.h2)
    return float(np.abs(frame.h2[inside] - expected).sum() / expected.sum())
