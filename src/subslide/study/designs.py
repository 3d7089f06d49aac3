"""Designs of a study: points whose values are chosen together, from lists, files, and samples of distributions."""

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple

from subslide.files import file_hash
from subslide.keys import schema, words
from subslide.keys.designs import ALLOWED, DESIGNS, FRICTION, FRICTION_ENTRY, MOST_POINTS, OVER, PATH
from subslide.keys.schema import ConfigError, Entry, refused
from subslide.points import RUN_KEYS
from subslide.study import csv_files, distributions, forms

if TYPE_CHECKING:
    import numpy as np

COLUMNS = tuple(key for key in (*schema.with_role("preset"), *RUN_KEYS) if schema.is_axis(key))
"""Keys that a design may give values of, in one order; m comes after them."""

REALS = tuple(key for key in COLUMNS if schema.is_real(schema.properties()[key]))
"""Those that a distribution may be over."""


class Design(NamedTuple):
    """A design, checked: an axis of a study along which several keys change together.

    Attributes
    ----------
    kind
        One of `subslide.keys.designs.DESIGNS`.
    place
        What messages call it.
    names
        Keys, or m, whose values it gives, in one order.
    shape
        Numbers of its points: one, but of a Saltelli design scramblings, blocks and points of each.
    spec
        Its options as checked, with their defaults.
    make
        Function that returns the values of each point, in the order of `names`.
    """

    kind: str
    place: str
    names: tuple[str, ...]
    shape: tuple[int, ...]
    spec: dict[str, Any]
    make: Callable[[], list[tuple]]

    @property
    def size(self) -> int:
        """Number of points."""
        return math.prod(self.shape)


def checked(given: Any) -> list[Design]:
    """Return the designs that the key `design` states; none is made yet.

    Parameters
    ----------
    given
        Mapping with one of `DESIGNS`, or a list of such.

    Returns
    -------
    list of Design
        Each, in the order of the file.

    Raises
    ------
    ConfigError
        If one is none: one line that begins with its place.
    """
    if isinstance(given, list):
        return [_design(one, f"design[{n}]") for n, one in enumerate(given)]
    return [_design(given, "design")]


def entry_of(name: str) -> Entry:
    """Return the entry of a key, or of m.

    Parameters
    ----------
    name
        The key.

    Returns
    -------
    Entry
        What it allows.
    """
    return FRICTION_ENTRY if name == FRICTION else schema.properties()[name]


def _design(given: Any, place: str) -> Design:
    """Return one design; ConfigError if it is none."""
    kind = next(iter(given), None) if isinstance(given, dict) and len(given) == 1 else None
    if not isinstance(given, dict) or kind not in DESIGNS:
        hint = words.closest(kind, DESIGNS) if kind else ""
        raise refused(place, given, f"a mapping with {ALLOWED}{hint}")
    value, place = given[kind], f"{place}: {kind}"
    if kind == "zip":
        return _zipped(value, place)
    return _file(value, place) if kind == "file" else _sampled(kind, value, place)


def _zipped(given: Any, place: str) -> Design:
    """Return the design of lists side by side."""
    if not (isinstance(given, dict) and given):
        raise refused(place, given, "a mapping from keys to lists")
    columns = {}
    for name in _in_order(given, (*COLUMNS, FRICTION), place):
        values = given[name]
        if isinstance(values, dict):
            values = forms.numbers(values, f"{place}: {name}")
        if not (isinstance(values, list) and values):
            raise ConfigError(
                f"{place}: {name}: {words.show(values)} is not allowed; allowed: a list of at least one"
            )
        columns[name] = [schema.conform(entry_of(name), value, f"{place}: {name}") for value in values]
    lengths = {name: len(values) for name, values in columns.items()}
    if len(set(lengths.values())) > 1:
        told = ", ".join(f"{name} has {length} values" for name, length in lengths.items())
        raise ConfigError(f"{place}: {told}; allowed: lists of one length")
    return _of_columns("zip", place, columns, columns)


def _file(given: Any, place: str) -> Design:
    """Return the design of the rows of a file."""
    path = schema.conform(PATH, given, place)
    with schema.placed(f"{place}: "):
        table = csv_files.read(path, (*COLUMNS, FRICTION))
        names = _in_order(table.columns, (*COLUMNS, FRICTION), table.path)
        columns = {name: table.values(name, entry_of(name)) for name in names}
    return _of_columns("file", place, columns, {"path": path, "sha256": file_hash(path)})


def _of_columns(kind: str, place: str, columns: dict[str, list], spec: dict[str, Any]) -> Design:
    """Return the design of columns by name."""
    rows = list(zip(*columns.values(), strict=True))
    return Design(kind, place, tuple(columns), (len(rows),), spec, lambda: rows)


def _sampled(kind: str, given: Any, place: str) -> Design:
    """Return a design that samples distributions."""
    about = DESIGNS[kind][1]
    if not isinstance(given, dict):
        raise refused(place, given, f"a mapping of {', '.join(about)}")
    _in_order(given, tuple(about), place)
    spec = {}
    for option, entry in about.items():
        if option not in given and "default" not in entry:
            raise ConfigError(f"{place}: {option}: this is missing; allowed: {words.range_of(entry)}")
        spec[option] = schema.conform(entry, given.get(option, entry.get("default")), f"{place}: {option}")
    over = {}
    for name in _in_order(
        schema.conform(OVER, spec["over"], f"{place}: over"), (*REALS, FRICTION), f"{place}: over"
    ):
        over[name] = distributions.checked(
            name, spec["over"][name], _number(entry_of(name)), f"{place}: over: {name}"
        )
    spec["over"] = {name: one.spec for name, one in over.items()}
    points, seed, inputs = spec["points"], spec["seed"], len(over)
    shape: tuple[int, ...] = (points,)
    if kind == "saltelli":
        shape = (spec["scramblings"], 2 + 2 * inputs, points)
    if math.prod(shape) > MOST_POINTS:
        raise ConfigError(f"{place}: {math.prod(shape)} points; allowed: at most {MOST_POINTS} in all")

    def make() -> list[tuple]:
        shares = SHARES[kind](points, inputs, seed, *shape[:1])
        columns = [one.quantiles(shares[:, n]) for n, one in enumerate(over.values())]
        return list(zip(*columns, strict=True))

    return Design(kind, place, tuple(over), shape, spec, make)


def _number(about: Entry) -> Entry:
    """Return the entry of the numbers that a key takes, without words beside them."""
    parts = [part for part in about.get("anyOf", ()) if part.get("type") == "number"]
    return {**parts[0], "unit": about.get("unit", "")} if parts else about


def _in_order(given: Any, known: tuple[str, ...], place: str) -> list[str]:
    """Return the names that are given in the order of the known ones; ConfigError if one is unknown."""
    for name in given:
        if name not in known:
            hint = words.closest(name, known) or f"; allowed: {', '.join(known)}"
            raise ConfigError(f"{place}: {words.show(name)}: there is no such key here{hint}")
    return [name for name in known if name in given]


def _latin_hypercube(points: int, inputs: int, seed: int, _: int) -> "np.ndarray":
    """Return shares (points, inputs) with one of each column in each of its strata."""
    from scipy.stats import qmc

    return qmc.LatinHypercube(inputs, rng=seed).random(points)


def _sobol(points: int, inputs: int, seed: int | tuple[int, ...], _: int = 0) -> "np.ndarray":
    """Return the first shares (points, inputs) of a scrambled Sobol' sequence, as of any number of points."""
    import numpy as np
    from scipy.stats import qmc

    engine = qmc.Sobol(inputs, scramble=True, rng=np.random.default_rng(seed))
    balanced = 1 << (points - 1).bit_length()  # of other numbers of points the library warns
    return engine.random(balanced)[:points]


def _saltelli(points: int, inputs: int, seed: int, scramblings: int) -> "np.ndarray":
    """Return shares (scramblings * (2 + 2 inputs) * points, inputs): blocks A, B, each AB_i, each BA_i."""
    import numpy as np

    blocks = []
    for scrambling in range(scramblings):
        both = _sobol(points, 2 * inputs, (seed, scrambling))
        first, second = both[:, :inputs], both[:, inputs:]
        blocks += [first, second]
        for base, other in ((first, second), (second, first)):
            for n in range(inputs):
                blocks.append(base.copy())
                blocks[-1][:, n] = other[:, n]
    return np.concatenate(blocks)


SHARES = {"latin_hypercube": _latin_hypercube, "sobol": _sobol, "saltelli": _saltelli}
"""Shares from 0 to 1 of each design that samples distributions."""
