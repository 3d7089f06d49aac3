"""The points of a grid: the product of its axes, those of designs among them, each value checked once."""

import itertools
import math
from collections.abc import Iterable, Iterator, Sequence
from typing import Any, NamedTuple

import numpy as np

from subslide.keys import schema, words
from subslide.keys.designs import FRICTION
from subslide.keys.schema import ConfigError
from subslide.keys.values import held
from subslide.points import Point
from subslide.study import checking, forms, scene_options, together
from subslide.study.designs import Design

LABEL = "numerics"
Axis = tuple[tuple[str, ...], Sequence[tuple]]
"""Keys that change together along an axis, and their values, row by row."""
NONE: dict[str, Any] = {}
"""Options of a scene of which none is given."""


class Grid(NamedTuple):
    """Axes of a case, or of a study without cases.

    Attributes
    ----------
    place
        What stands before its keys in messages.
    axes
        Values along its axis, checked, of each key; scene options as given.
    designs
        Designs, each an axis of several keys, which come after the others.
    """

    place: str
    axes: dict[str, Any]
    designs: tuple[Design, ...] = ()

    @property
    def size(self) -> int:
        """Number of combinations, none of which is made."""
        lengths = (
            scene_options.count(values) if key == "scene_options" else len(values)
            for key, values in self.axes.items()
        )
        return math.prod(lengths) * math.prod(design.size for design in self.designs)

    def along(self) -> list[Axis]:
        """Return the keys and the rows of values of each axis; of scene options a mapping for each combination.

        Raises
        ------
        ConfigError
            If a list of scene options is empty.
        """
        axes = {
            key: scene_options.along_axes(values) if key == "scene_options" else values
            for key, values in self.axes.items()
        }
        lists: list[Axis] = [((key,), [(value,) for value in values]) for key, values in axes.items()]
        return [*lists, *((design.names, design.make()) for design in self.designs)]

    def check(self) -> None:
        """Check that each key has values in one place alone.

        Raises
        ------
        ConfigError
            If one has not: one line that begins with the design.
        """
        stated = dict.fromkeys(self.axes, "stands beside it")
        for design in self.designs:
            for name in design.names:
                if name in stated:
                    raise ConfigError(
                        f"{design.place}: {name}: {stated[name]} too; allowed: each key in one place"
                    )
            stated |= dict.fromkeys(design.names, f"is in {design.place}")
        if {FRICTION, "a_2", "delta"} <= set(stated):
            place = next(design.place for design in self.designs if FRICTION in design.names)
            raise ConfigError(f"{place}: m: a_2 and delta are stated too; allowed: one of them beside m")


def points(along: list[Axis]) -> Iterator[tuple[str, Point]]:
    """Give the label of the numerics, and the point, of each combination of a grid's axes, the last one fastest.

    Parameters
    ----------
    along
        Keys and rows of each axis, see `Grid.along`.

    Yields
    ------
    tuple of str and Point
        Label and point, checked.

    Raises
    ------
    ConfigError
        If values do not go with one another: one line.
    """
    stated = [key for names, _ in along for key in names]
    maker = Maker(stated)
    for parts in itertools.product(*([as_held(names, row) for row in rows] for names, rows in along)):
        yield maker.point(dict(zip(stated, itertools.chain(*parts), strict=True)))


def members(grid: Grid, along: list[Axis], ids: Sequence[str]) -> list[dict[str, Any]]:
    """Return what points.json says of the Saltelli designs of a grid, from the ids of its points in order.

    Parameters
    ----------
    grid
        The grid.
    along
        Keys and rows of each of its axes.
    ids
        Id of each combination, repeats among them, as `points` gives them.

    Returns
    -------
    list of dict
        For each such design and each combination of the other axes: kind, spec, names, the others' values, and
        ids (scramblings, blocks, points).
    """
    chosen = [design for design in grid.designs if design.kind == "saltelli"]
    if not chosen:
        return []
    every = np.array(ids, dtype=object).reshape([len(rows) for _, rows in along])
    listed = []
    for design in chosen:
        place = len(along) - len(grid.designs) + grid.designs.index(design)
        others = [axis for n, axis in enumerate(along) if n != place]
        names = [key for keys, _ in others for key in keys]
        blocks = np.moveaxis(every, place, -1).reshape(-1, *design.shape)
        for rows, block in zip(itertools.product(*(rows for _, rows in others)), blocks, strict=True):
            values = dict(zip(names, itertools.chain(*rows), strict=True))
            listed.append(
                {
                    "kind": design.kind,
                    "spec": design.spec,
                    "others": values,
                    "names": list(design.names),
                    "ids": block.tolist(),
                }
            )
    return listed


class Maker:
    """Points of values by key, for grids whose points share much: what was worked out once is kept.

    Parameters
    ----------
    stated
        Keys that the values state, m among them; the preset of `numerics` has no say in these.
    name
        What messages call the scene's options.
    """

    def __init__(self, stated: Iterable[str], name: str = "scene_options") -> None:
        """Keep what holds for all points."""
        self.stated, self.name = set(stated), name
        self.set_by_friction, self.given = ("a_2", "delta") if "delta" in self.stated else ("delta", "a_2")
        self.presets: dict[str, dict[str, Any]] = {}
        self.options: dict[tuple[str, int], tuple] = {}

    def point(self, values: dict[str, Any]) -> tuple[str, Point]:
        """Return the label of the numerics, and the point, of a value for each of the stated keys.

        Parameters
        ----------
        values
            Value by key as a point holds it, but for the scene's options, which are unchecked.

        Returns
        -------
        tuple of str and Point
            Label and point, checked.

        Raises
        ------
        ConfigError
            If values do not go with one another: one line.
        """
        label: str = values.get(LABEL) or schema.properties()[LABEL]["default"]
        values = self._preset(label) | values
        values.pop(LABEL, None)
        values["scene_options"] = self._options(
            values.get("scene", Point.scene), values.get("scene_options", NONE)
        )
        if FRICTION in values:
            self._obey_friction(values)
        point = Point.of(values)
        together.check(point)
        checking.mark(point)
        return label, point

    def _preset(self, label: str) -> dict[str, Any]:
        """Return what a value of `numerics` sets of the keys that are not stated."""
        if label not in self.presets:
            preset = schema.properties()[LABEL]["presets"][label]
            self.presets[label] = {key: held(key, v) for key, v in preset.items() if key not in self.stated}
        return self.presets[label]

    def _options(self, scene: str, given: dict[str, Any]) -> tuple:
        """Return the options of a scene as a point holds them, checked; those of one mapping once."""
        key = (scene, id(given))  # which lives as long as the grid
        if key not in self.options:
            self.options[key] = held("scene_options", scene_options.checked(scene, given, self.name))
        return self.options[key]

    def _obey_friction(self, values: dict[str, Any]) -> None:
        """Set delta or a_2 in values by m, which is taken out of them; ConfigError if that is out of its range."""
        m, key = values.pop(FRICTION), self.set_by_friction
        other = values.get(self.given, getattr(Point, self.given))
        if key == "delta":
            made = math.degrees(math.atan(m * other))
        else:
            made = math.tan(math.radians(other)) / m if m else math.inf
        try:
            values[key] = float(schema.checked(key, forms.rounded(made)))
        except ConfigError:
            raise ConfigError(
                f"m: {m:g} is not allowed with {self.given}: {other:g}, since it makes {key} {made:.6g}; allowed:"
                f" such as make {key} {words.allowed(key)}"
            ) from None


def as_held(keys: Iterable[str], row: Iterable[Any]) -> tuple:
    """Return checked values as points hold them; the scene's options, and m, as they are.

    Parameters
    ----------
    keys
        Key of each value.
    row
        The values.

    Returns
    -------
    tuple
        The values, numbers in one format.
    """
    return tuple(
        value if key in (LABEL, "scene_options", FRICTION) else held(key, value)
        for key, value in zip(keys, row, strict=True)
    )
