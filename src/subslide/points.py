"""Points: one run each, complete in itself, with an id that depends on its values alone."""

import hashlib
import json
import math
from dataclasses import asdict, dataclass, fields, replace
from functools import cached_property

PAPER_RADIUS = 0.0705
"""Radius (m) of the paper's column."""

PAPER_TIMES = (0.08, 0.16, 0.24, 0.54)
"""Times (s) after release at which the paper shows its column."""


PAPER_BOX = 0.3 / PAPER_RADIUS
"""Half-width over R of the paper's box, where the water surface is watched in a box of any size."""


def paper_times(radius: float) -> tuple[float, ...]:
    """The paper's times (s) for a column of another radius (m), in proportion to its root."""
    return tuple(time * math.sqrt(radius / PAPER_RADIUS) for time in PAPER_TIMES)


def edge_time(a_H: float, a_2: float, radius: float, g: float) -> float:
    """Time (s) when the first wave, from R at sqrt(g (H1 + H2)), is at the edge of the paper's box."""
    return (PAPER_BOX - 1) * radius / math.sqrt(g * a_2 * radius * (1 + a_H))


@dataclass(frozen=True)
class Point:
    """One run: all that its answer depends on. Lengths in m, times in s, angles in degrees.

    scene_options are sorted pairs of name and value. t_end None means until rest; snapshot_times None means the
    paper's times, scaled by sqrt(radius).
    """

    a_H: float = 1.0
    a_2: float = 0.56
    r: float = 0.4
    delta: float = 32.0
    radius: float = PAPER_RADIUS
    g: float = 9.81
    scene: str = "cylinder"
    scene_options: tuple[tuple[str, float | str], ...] = ()
    quantities: str = "all"
    friction: str = "coulomb"
    xi: float = 500.0
    delta_2: float = 42.0
    pouliquen_length: float = 0.005
    model: str = "auto"
    scheme: str = "ifcph"
    front_flux: str = "exact"
    wave_speeds: str = "exact"
    treatment: str = "real"
    as_printed: str = "none"
    friction_in_viscosity: bool = True
    order: int = 2
    cells: int = 200
    dtype: str = "float64"
    cfl: float = 0.9
    boundary: str = "open"
    t_end: float | None = None
    snapshot_times: tuple[float, ...] | None = None
    fields: bool = False

    @cached_property
    def id(self) -> str:
        """Name of the point: 'p' and 12 hex digits, the same for equal values however they were written."""
        return "p" + hashlib.sha256(canonical(self).encode()).hexdigest()[:12]

    @property
    def dx(self) -> float:
        """Cell size (m): 0.6 m / cells at the paper's radius of 0.0705 m, in proportion to the radius."""
        return 0.6 / self.cells * (self.radius / PAPER_RADIUS)


RUN_KEYS = tuple(field.name for field in fields(Point))
FLOATS = ("a_H", "a_2", "r", "delta", "radius", "g", "xi", "delta_2", "pouliquen_length", "cfl", "t_end")


def canonical(point: Point) -> str:
    """Text of a point in one number format and one order of keys; equal points give equal texts."""
    return json.dumps(to_dict(point), separators=(",", ":"), sort_keys=True)


def to_dict(point: Point) -> dict:
    """Values of a point by key, as a configuration would state them; numbers in one format."""
    values = asdict(point)
    for key in FLOATS:
        if values[key] is not None:
            values[key] = float(values[key]) + 0.0  # -0.0 becomes 0.0
    if values["t_end"] is None:
        values["t_end"] = "rest"
    values["scene_options"] = dict(point.scene_options)
    times = values["snapshot_times"]
    values["snapshot_times"] = "paper" if times is None else [float(t) + 0.0 for t in times]
    return values


def options_text(point: Point) -> str:
    """Scene options of a point as compact JSON, in one order."""
    return json.dumps(dict(point.scene_options), separators=(",", ":"), sort_keys=True)


def from_dict(values: dict) -> Point:
    """Point of checked values by key; the inverse of `to_dict`."""
    values = dict(values)
    for key in FLOATS:
        if key in values and values[key] != "rest":
            values[key] = float(values[key])
    if values.get("t_end") == "rest":
        values["t_end"] = None
    values["scene_options"] = tuple(sorted(values.get("scene_options", {}).items()))
    times = values.get("snapshot_times", "paper")
    values["snapshot_times"] = None if times == "paper" else tuple(sorted({float(t) for t in times}))
    for key in ("order", "cells"):
        if key in values:
            values[key] = int(values[key])
    return replace(Point(), **values)


def friction_number(point: Point) -> float:
    """m = tan(delta)/a_2, the one number by which friction enters the scaled equations."""
    return math.tan(math.radians(point.delta)) / point.a_2


def similarity_key(point: Point) -> tuple[float, float, float]:
    """(a_H, r, m), each to 12 digits: runs that share it, and their numerics, have the same scaled answer."""
    return tuple(float(f"{value:.12g}") for value in (point.a_H, point.r, friction_number(point)))
