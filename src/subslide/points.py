"""Points: one run each, complete in itself, with an id that depends on its values alone."""

import functools
import hashlib
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, make_dataclass
from typing import TYPE_CHECKING, Any

from subslide import catalogue
from subslide.keys import values
from subslide.keys.entries import ENTRIES
from subslide.keys.values import RUN_KEYS

PAPER_RADIUS = ENTRIES["radius"]["default"]
"""Radius (m) of the paper's column."""

PAPER_WIDTH = 0.6
"""Width (m) of the paper's box, which `cells` parts."""

PAPER_TIMES = (0.08, 0.16, 0.24, 0.54)
"""Times (s) after release at which the paper shows its column."""

REST_CAP = 60.0
"""Cap on runs to rest, in R / sqrt(g H2 (1-r)): the paper's slowest column rests at 5, a_2 = 1.5, delta = 20 at 9."""

PAPER_BOX = 0.3 / PAPER_RADIUS
"""Half-width over R of the paper's box, where the water surface is watched in a box of any size."""


@functools.lru_cache(1024)
def paper_times(radius: float) -> tuple[float, ...]:
    """Return the paper's times (s) for a column of another radius (m), in proportion to its root."""
    return tuple(time * math.sqrt(radius / PAPER_RADIUS) for time in PAPER_TIMES)


def edge_time(a_H: float, a_2: float, radius: float, g: float) -> float:
    """Return when the first wave, from R at sqrt(g (H1 + H2)), is at the edge of the paper's box.

    Parameters
    ----------
    a_H, a_2
        H1/H2 and H2/R.
    radius
        Radius R (m).
    g
        Gravity (m s-2).

    Returns
    -------
    float
        Time (s) since release.
    """
    return (PAPER_BOX - 1) * radius / math.sqrt(g * a_2 * radius * (1 + a_H))


if TYPE_CHECKING:

    class Defaults(type):
        """Defaults of the values of a run, as attributes of the class."""

        def __getattr__(cls, key: str) -> Any:
            """Return the default of a key."""

    @dataclass(frozen=True, init=False)
    class Values(metaclass=Defaults):
        """Values of a run by key: whatever has an entry in `subslide.keys.entries`."""

        def __init__(self, **values: Any) -> None:
            """Take values by key, and defaults for the others."""

        def __getattr__(self, key: str) -> Any:
            """Return the value of a key."""

else:
    Values = make_dataclass(
        "Values", [(key, Any, values.default_of(key)) for key in RUN_KEYS], frozen=True, init=False
    )


class Point(Values):
    """One run: all that its answer depends on, a value for each of `RUN_KEYS`, and what follows from them.

    Lengths are in m, times in s, angles in degrees; what is scaled is so by R along x, H2 = a_2 R for depths, and
    sqrt(g H2) for speeds. A point cannot be changed; `with_values` makes another one. ``scene_options`` are
    sorted pairs of name and value. Where a key takes a word beside numbers, None stands for the word: a ``t_end`` of
    None means until rest, ``snapshot_times`` of None the paper's times, scaled by sqrt(R).
    """

    def __init__(self, **chosen: Any) -> None:
        """Take values by key, and defaults for the others; TypeError if a run has no such key."""
        for key in chosen:
            if key not in RUN_KEYS:
                raise TypeError(f"{key}: a run has no such key")
        vars(self).update(chosen)

    @classmethod
    def of(cls, mapping: dict[str, Any]) -> "Point":
        """Return the point that keeps a mapping as it is, which nothing else may change.

        Parameters
        ----------
        mapping
            Values by key, as a point holds them; those that are left out are the defaults, which all points share.

        Returns
        -------
        Point
            The point.
        """
        point = cls.__new__(cls)
        object.__setattr__(point, "__dict__", mapping)
        return point

    @property
    def chosen(self) -> Mapping[str, Any]:
        """Values by key, defaults left out or not, and what is remembered of the point by other names."""
        return vars(self)

    @functools.cached_property
    def id(self) -> str:
        """Name of the point: 'p' and 12 hex digits, the same for equal values however they were written."""
        return "p" + hashlib.sha256(canonical(self).encode()).hexdigest()[:12]

    @property
    def has_weightless_water(self) -> bool:
        """Whether the water has no weight beside the grains, so that one layer is the whole model."""
        return self.r == 0

    @property
    def column_height(self) -> float:
        """Height H2 (m) of the column."""
        return self.a_2 * self.radius

    @property
    def scaled_level(self) -> float:
        """Height of the undisturbed water surface over H2."""
        return 1.0 + self.a_H

    @property
    def level(self) -> float:
        """Height (m) of the undisturbed water surface, H1 + H2."""
        return (1 + self.a_H) * self.a_2 * self.radius

    @property
    def time_scale(self) -> float:
        """Time (s) sqrt(R / (g a_2)), that of scaled time 1."""
        return math.sqrt(self.radius / (self.g * self.a_2))

    @property
    def speed_scale(self) -> float:
        """Speed (m/s) sqrt(g H2), that of scaled speed 1."""
        return math.sqrt(self.g * self.a_2 * self.radius)

    @property
    def wave_speed(self) -> float:
        """Speed (m/s) sqrt(g (H1 + H2)) of the fastest wave at rest."""
        return math.sqrt(self.g * self.a_2 * self.radius * (1 + self.a_H))

    def wave_reach(self, time: float) -> float:
        """Return how far from the axis, over R, the first wave from R is at a time (s)."""
        return 1.0 + self.wave_speed * time / self.radius

    @property
    def friction_number(self) -> float:
        """Number m = tan(delta)/a_2 by which Coulomb friction enters the scaled equations: scaled deceleration.

        Deviation from the friction of the scaled system in section 4: a_2 tan(delta) is printed. Dividing g (1-r) h2
        tan(delta) by g H2^2 / R leaves tan(delta)/a_2.
        """
        return math.tan(math.radians(self.delta)) / self.a_2

    @property
    def least_friction(self) -> float:
        """Least friction number of grains that move."""
        angle = min(self.delta, self.delta_2) if self.friction == "pouliquen" else self.delta
        return math.tan(math.radians(angle)) / self.a_2

    @property
    def latest_end(self) -> float:
        """Time (s) at which a run ends at the latest: `t_end`, or the cap on runs to rest."""
        return REST_CAP / math.sqrt(1.0 - self.r) * self.time_scale if self.t_end is None else self.t_end

    @property
    def turbulence(self) -> float:
        """Number g/(xi a_2) by which Voellmy's turbulence enters the scaled equations."""
        return self.g / (self.xi * self.a_2)

    @property
    def dx(self) -> float:
        """Cell size (m): 0.6 m / cells at the paper's radius of 0.0705 m, in proportion to the radius."""
        return PAPER_WIDTH / self.cells * (self.radius / PAPER_RADIUS)

    @property
    def scaled_dx(self) -> float:
        """Cell size over R."""
        return PAPER_WIDTH / self.cells / PAPER_RADIUS

    @property
    def half_cells(self) -> int:
        """Cells from the axis to the edge of the smallest box."""
        return -(-self.cells // 2)

    @property
    def half_box(self) -> float:
        """Half-width of the smallest box over R."""
        return self.half_cells * self.scaled_dx

    @property
    def profile_times(self) -> tuple[float, ...]:
        """Times (s) of the snapshots, in order."""
        if self.snapshot_times is None:
            return (0.0, *paper_times(self.radius))
        return tuple(sorted(self.snapshot_times))

    @property
    def similarity_key(self) -> tuple[float, float, float]:
        """Numbers (a_H, r, m) to 12 digits: runs that share them, and their numerics, have the same scaled answer."""
        a_H, r, m = (float(f"{value:.12g}") for value in (self.a_H, self.r, self.friction_number))
        return a_H, r, m

    def with_values(self, **values: Any) -> "Point":
        """Return a point that differs from this one in some values.

        Parameters
        ----------
        values
            New values by key of `RUN_KEYS`, as a point holds them.

        Returns
        -------
        Point
            The other point.

        Raises
        ------
        TypeError
            If a run has no such key.
        """
        return Point(**{key: getattr(self, key) for key in RUN_KEYS} | values)


def canonical(point: Point) -> str:
    """Return the text of a point in one number format and one order of keys; equal points give equal texts.

    A file that its scene reads is known by its content, which is one of the options, and not by its path.
    """
    return values.text(point.chosen, catalogue.options_that_read(point.scene))


def to_dict(point: Point, keys: Sequence[str] = RUN_KEYS) -> dict[str, Any]:
    """Return the values of a point by key, as a configuration would state them; numbers in one format.

    Parameters
    ----------
    point
        The point.
    keys
        Keys whose values are wanted.

    Returns
    -------
    dict
        Value by key.
    """
    return {key: values.stated(key, getattr(point, key)) for key in keys}


def options_text(point: Point) -> str:
    """Return the scene options of a point as compact JSON, in one order."""
    return values.compact(dict(point.scene_options)) if point.scene_options else "{}"


def from_dict(stated: dict[str, Any]) -> Point:
    """Return the point of checked values by key; the inverse of `to_dict`, with defaults for what is left out."""
    return Point(**{key: values.held(key, value) for key, value in stated.items()})
