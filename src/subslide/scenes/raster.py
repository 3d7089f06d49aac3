"""Grains of any form at rest under still water, from a raster in a NetCDF file.

The file has a variable h2(y, x) and coordinates x and y, all in m, with equal steps; (0, 0) is the middle of the box,
and there are no grains beyond the raster. Scales are still R and H2 = a_2 R, and the water stands (1 + a_H) H2 deep.
The file's SHA-256 becomes one of the options, so that a run's id follows what the file holds. Packed and unsigned
values are read as CF says; missing ones (masked, out of the valid range, not finite) are refused. By `conservative` a
pixel is flat, so cells finer than pixels see stairs, whose steps slump: choose `bilinear` for them.
"""

import functools
from typing import Any

import numpy as np

from subslide.keys.entries import Entry
from subslide.keys.schema import ConfigError
from subslide.points import Point
from subslide.scenes import Grid, State, _raster_file, options, still_water

EVEN = 1e-4
"""Part of a step by which a coordinate may be off an even grid, beside what its type rounds."""

FINER = 0.9
"""Cell size over that of a pixel below which a cell sees the steps between pixels."""

OPTIONS: dict[str, Entry] = {
    "file": {
        "description": "path of the NetCDF file, from the folder where the command runs; not an axis",
        "type": "string",
        "minLength": 1,
        "axis": False,
        "reads": True,
        "allowed": _raster_file.ALLOWED,
    },
    "method": {
        "description": "what a cell takes: conservative, its share of the raster's pixels, or bilinear, the raster at"
        " its centre",
        "enum": ["conservative", "bilinear"],
        "default": "conservative",
    },
    "sha256": {
        "description": "SHA-256 of the file; filled in, and compared if it is given",
        "type": "string",
        "pattern": "^([0-9a-f]{64})?$",
        "axis": False,
        "default": "",
        "allowed": "64 hex digits",
    },
}


def symmetry(point: Point) -> str:
    """Return the scene's symmetry."""
    return "none"


def complete(chosen: dict[str, Any]) -> dict[str, Any]:
    """Return the options with the file's SHA-256; a ConfigError if it cannot be read, or is not the one given."""
    sha256 = _raster_file.content(chosen["file"])
    if chosen["sha256"] not in ("", sha256):
        raise ConfigError(
            f"file: {_raster_file.shown(chosen['file'])} has changed: its SHA-256 is not {chosen['sha256'][:12]}..."
        )
    return {**chosen, "sha256": sha256}


def check(point: Point) -> None:
    """Raise a ConfigError unless the file is there, unchanged, and holds grains under the water and in the box."""
    chosen = complete(options(point))
    raster = read(chosen["file"], chosen["sha256"])
    name = f"scene_options: file: {_raster_file.shown(chosen['file'])}"
    level = point.level
    highest = float(raster.h2.max())
    if highest > level * (1 + 1e-9) + raster.rounding:
        raise ConfigError(
            f"{name}: grains of {highest:.6g} m stand above the water's level; allowed: to {level:.6g} m"
        )
    half = point.half_box * point.radius
    if any(np.any(np.abs(axis[used]) > half) for axis, used in raster.used()):
        raise ConfigError(
            f"{name}: there are grains beyond the box; allowed: within {half:.6g} m along x and y"
        )


def initial(grid: Grid, point: Point) -> State:
    """Return the raster's grains at rest under still water."""
    chosen = complete(options(point))
    raster = read(chosen["file"], chosen["sha256"])
    edges = grid.edges * point.radius
    share = overlap if chosen["method"] == "conservative" else hats
    h2 = share(edges, raster.y) @ raster.h2 @ share(edges, raster.x).T / point.column_height
    return still_water(np.minimum(h2, point.scaled_level), point.scaled_level)


def has_stairs(point: Point) -> bool:
    """Return whether cells are finer than the pixels that they take their shares of, so that they see their steps."""
    chosen = options(point)
    if chosen["method"] != "conservative":
        return False
    try:
        raster = read(chosen["file"], chosen["sha256"])
    except ConfigError:  # a finished study may be read without it
        return False
    return bool(point.dx < FINER * min(raster.x[1] - raster.x[0], raster.y[1] - raster.y[0]))


class Raster:
    """Depths h2 (ny, nx) at the centres x (nx) and y (ny) of pixels, in m, in increasing order.

    `rounding` is how far the type in the file may have rounded h2, in m.
    """

    def __init__(self, x: np.ndarray, y: np.ndarray, h2: np.ndarray, rounding: float):
        """Put the raster in increasing order."""
        self.x, self.y = np.sort(x), np.sort(y)
        self.h2 = h2[np.argsort(y)][:, np.argsort(x)]
        self.rounding = rounding

    def used(self) -> tuple[tuple[np.ndarray, np.ndarray], tuple[np.ndarray, np.ndarray]]:
        """Return (coordinates, whether there are grains) along x and along y."""
        return (self.x, np.any(self.h2, axis=0)), (self.y, np.any(self.h2, axis=1))


def overlap(edges: np.ndarray, centres: np.ndarray) -> np.ndarray:
    """Return the share (n, pixels) of each cell between `edges` (n + 1) that lies in each pixel."""
    half = 0.5 * (centres[1] - centres[0])
    upper = np.minimum(edges[1:, None], centres + half)
    lower = np.maximum(edges[:-1, None], centres - half)
    return np.maximum(0.0, upper - lower) / np.diff(edges)[:, None]


def hats(edges: np.ndarray, centres: np.ndarray) -> np.ndarray:
    """Return the weights (n, pixels) of linear interpolation to the middles of cells."""
    middles = 0.5 * (edges[1:] + edges[:-1])
    return np.maximum(0.0, 1.0 - np.abs(middles[:, None] - centres) / (centres[1] - centres[0]))


@functools.lru_cache(maxsize=4)
def read(path: str, sha256: str) -> Raster:
    """Return the `Raster` of a file with that content; a ConfigError if it is not as the scene wants it."""
    name = f"scene_options: file: {_raster_file.shown(path)}"
    parts = _raster_file.read(path, sha256)
    lowest = float(parts["h2"].values.min())
    if lowest < 0:
        raise ConfigError(f"{name}: h2 is {lowest:.6g} m somewhere; allowed: depths from 0")
    x, y = (_even(parts[key], f"{name}: {key}") for key in ("x", "y"))
    return Raster(x, y, *parts["h2"])


def _even(coordinate: _raster_file.Values, name: str) -> np.ndarray:
    """Return the even grid that a coordinate was stored from; a ConfigError if its steps are not equal."""
    values, rounding = coordinate
    even = np.linspace(values[0], values[-1], len(values))
    step = abs(even[1] - even[0]) if len(even) > 1 else 0.0
    if not step or np.abs(values - even).max() > EVEN * step + 2 * rounding or 4 * rounding > step:
        raise ConfigError(f"{name} has unequal steps; allowed: two coordinates or more, with equal steps")
    return even
