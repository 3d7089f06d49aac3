"""Grains of any form at rest under still water, from a raster in a NetCDF file.

The file has a variable h2(y, x) and coordinates x and y, all in m, with equal steps; (0, 0) is the middle of the box,
and there are no grains beyond the raster. Scales are still R and H2 = a_2 R, and the water stands (1 + a_H) H2 deep.
The file's SHA-256 becomes one of the options, so that a run's id follows what the file holds.
"""

import functools
import hashlib
import os
from typing import TYPE_CHECKING, Any

import numpy as np

from subslide.keys.entries import Entry
from subslide.keys.schema import ConfigError
from subslide.points import Point
from subslide.scenes import Grid, State, options, still_water

if TYPE_CHECKING:
    import netCDF4

OPTIONS: dict[str, Entry] = {
    "file": {
        "description": "path of the NetCDF file, from the folder where the command runs; not an axis",
        "type": "string",
        "minLength": 1,
        "axis": False,
        "reads": True,
        "allowed": "the path of a NetCDF file",
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
    sha256 = content(chosen["file"])
    if chosen["sha256"] not in ("", sha256):
        raise ConfigError(
            f"file: {chosen['file']} has changed: its SHA-256 is not {chosen['sha256'][:12]}..."
        )
    return {**chosen, "sha256": sha256}


def check(point: Point) -> None:
    """Raise a ConfigError unless the file is there, unchanged, and holds grains under the water and in the box."""
    chosen = complete(options(point))
    raster = read(chosen["file"], chosen["sha256"])
    name = f"scene_options: file: {chosen['file']}"
    level = point.level
    highest = float(raster.h2.max())
    if highest > level * (1 + 1e-9):
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


class Raster:
    """Depths h2 (ny, nx) at the centres x (nx) and y (ny) of pixels, in m, in increasing order."""

    def __init__(self, x: np.ndarray, y: np.ndarray, h2: np.ndarray):
        """Put the raster in increasing order."""
        self.x, self.y = np.sort(x), np.sort(y)
        self.h2 = h2[np.argsort(y)][:, np.argsort(x)]

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


def content(path: str) -> str:
    """Return the SHA-256 (hex) of a file's content."""
    try:
        about = os.stat(path)
        return _content(path, about.st_mtime_ns, about.st_size)
    except FileNotFoundError:
        raise ConfigError(
            f"file: {path}: there is no such file; allowed: {OPTIONS['file']['allowed']}"
        ) from None
    except OSError as error:
        raise ConfigError(f"file: {path} cannot be read: {error.strerror}") from None


@functools.lru_cache(maxsize=64)
def _content(path: str, changed: int, size: int) -> str:
    """Return the hash of a file, anew once its time or size has changed."""
    with open(path, "rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


@functools.lru_cache(maxsize=4)
def read(path: str, sha256: str) -> Raster:
    """Return the `Raster` of a file with that content; a ConfigError if it is not as the scene wants it."""
    import netCDF4

    name = f"scene_options: file: {path}"
    try:
        with netCDF4.Dataset(path) as data:
            variables = {key: _variable(data, key, name) for key in ("x", "y", "h2")}
            if data["h2"].dimensions != data["y"].dimensions + data["x"].dimensions:
                raise ConfigError(f"{name}: h2{data['h2'].dimensions} is not allowed; allowed: h2(y, x)")
    except OSError:
        raise ConfigError(f"{name}: not a NetCDF file; allowed: {OPTIONS['file']['allowed']}") from None
    for key in ("x", "y"):
        steps = np.diff(variables[key])
        if not (steps.size and steps[0] and np.allclose(steps, steps[0], rtol=1e-4, atol=0)):
            raise ConfigError(
                f"{name}: {key} has unequal steps; allowed: two coordinates or more, with equal steps"
            )
    if variables["h2"].min() < 0:
        raise ConfigError(f"{name}: h2 is {variables['h2'].min():.6g} m somewhere; allowed: depths from 0")
    return Raster(**variables)


def _variable(data: "netCDF4.Dataset", key: str, name: str) -> np.ndarray:
    """Return a variable in m as finite float64."""
    if key not in data.variables:
        known = ", ".join(data.variables) or "none"
        raise ConfigError(f"{name}: there is no variable {key}; allowed: h2(y, x), x and y; found: {known}")
    variable = data[key]
    unit = getattr(variable, "units", "m")
    if unit not in ("m", "metre", "meter", "metres", "meters"):
        raise ConfigError(f"{name}: {key} is in {unit}; allowed: m")
    values = variable[...]
    if values.dtype.kind not in "fiu" or values.ndim != (2 if key == "h2" else 1) or not values.size:
        raise ConfigError(f"{name}: {key} is not an array of numbers; allowed: h2(y, x), x and y")
    values = np.ma.filled(values.astype(float), np.nan)
    if not np.isfinite(values).all():
        raise ConfigError(f"{name}: {key} has missing or infinite values; allowed: finite numbers")
    return values
