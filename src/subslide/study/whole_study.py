"""The keys that say something of a whole study and nothing of one run: its name, figures, bands, records, limits."""

import functools
from collections.abc import Callable, Collection
from typing import Any

from subslide import catalogue
from subslide.keys import schema, words
from subslide.keys.schema import ConfigError
from subslide.points import Point


def values_of(values: dict, names: dict[str, str] | None = None) -> dict[str, Any]:
    """Return the checked values of the keys of a whole study but its cases, with defaults for what is left out.

    Parameters
    ----------
    values
        Value by key, as a file states them.
    names
        What messages call a key, where that is not its name.

    Returns
    -------
    dict
        Value by key; `study` is left out if the file has none.

    Raises
    ------
    ConfigError
        If a value is not allowed, or there is no figure of a name: one line.
    """
    whole = {}
    for key in schema.with_role("study"):
        if key in values and key != "cases":
            whole[key] = schema.checked(key, values[key], (names or {}).get(key, key))
        elif "default" in schema.properties()[key]:
            whole[key] = schema.properties()[key]["default"]
    listed = whole["figures"] if isinstance(whole["figures"], list) else []
    known = catalogue.names("figures") if listed else []
    for name in listed:
        if name not in known:
            key, hint = (names or {}).get("figures", "figures"), words.closest(name, known)
            raise ConfigError(
                f"{key}: {words.show(name)} is not allowed; allowed: {', '.join(known) or 'none'}{hint}"
            )
    return whole


def figures_of(chosen: Any, points: list[Point], designs: Collection[str] = ()) -> tuple[str, ...]:
    """Return the names of the figures of a study, in one order.

    Parameters
    ----------
    chosen
        Checked value of `figures`.
    points
        Runs of the study.
    designs
        Kinds of its designs that figures may need.

    Returns
    -------
    tuple of str
        Those asked for, or all whose runs it has.

    Raises
    ------
    ConfigError
        If a figure needs runs that the study does not have.
    """
    known = catalogue.names("figures")
    present = _present(points, designs)
    if chosen == "none":
        return ()
    if chosen == "auto":
        return tuple(name for name in known if not _lacking(name, present))
    for name in chosen:
        if lack := _lacking(name, present):
            raise ConfigError(f"figures: {name} needs runs with {lack}, which this study does not have")
    return tuple(name for name in known if name in chosen)


def lacking(name: str, points: list[Point], designs: Collection[str] = ()) -> str:
    """Return the first 'key: value' that a figure needs and no point has, or ''.

    Parameters
    ----------
    name
        Name of the figure.
    points
        Runs of the study.
    designs
        Kinds of its designs.

    Returns
    -------
    str
        What is lacking, as a configuration would state it.
    """
    return _lacking(name, _present(points, designs))


def _present(points: list[Point], designs: Collection[str]) -> Callable[[str], set]:
    """Return a function that gives the values which a study has of a key, and looks at the points once for each."""
    return functools.cache(
        lambda key: set(designs) if key == "design" else {getattr(point, key) for point in points}
    )


def _lacking(name: str, present: Callable[[str], set]) -> str:
    """Return the first 'key: value' that a figure needs and no point has, or ''."""
    for key, needed in catalogue.figure(name).needs.items():
        for value in needed:
            if value not in present(key):
                return f"{key}: {value}"
    return ""
