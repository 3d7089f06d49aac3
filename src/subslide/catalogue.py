"""What the package can be given by adding a file: scenes, exact solutions, tables and figures, listed by their folders.

Nothing is imported to list it, and constants that are literals are read from the source, so that planning a study does
not wait for plotting libraries. A file whose name begins with '_' is a helper and is not listed.
"""

import ast
import functools
import importlib
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

from subslide._sources import PACKAGE, is_module


class Figure(NamedTuple):
    """What a figure says of itself: title, heading in the report, and the values its study must have by key."""

    title: str
    category: str
    needs: dict[str, tuple]


class Table(NamedTuple):
    """What a table says of itself: title, heading in the report, what it is made from, compiled kernels it needs."""

    title: str
    category: str
    reads: tuple[str, ...]
    kernels: tuple[str, ...]


class Layout(NamedTuple):
    """Columns of a table in order, and those that hold numbers alone."""

    columns: tuple[str, ...]
    numbers: tuple[str, ...]


def names(room: str) -> list[str]:
    """Return the names of the plug-ins in a room.

    Parameters
    ----------
    room
        Folder of the package: `scenes`, `exact`, `tables` or `figures`.

    Returns
    -------
    list of str
        Names of the files without '.py', sorted.
    """
    paths = (PACKAGE / room).glob("[a-z]*.py")
    return sorted(path.stem for path in paths if is_module(path.relative_to(PACKAGE)))


@functools.cache
def figure(name: str) -> Figure:
    """Return what a figure says of itself."""
    said = literals("figures", name)
    return Figure(said.get("TITLE", name), said.get("CATEGORY", "Figures"), said.get("NEEDS", {}))


@functools.cache
def table(name: str) -> Table:
    """Return what a table says of itself."""
    said = literals("tables", name)
    return Table(said["TITLE"], said.get("CATEGORY", "5 Tables"), said["READS"], said.get("KERNELS", ()))


def literals(room: str, name: str) -> dict[str, Any]:
    """Return the constants of a plug-in, by name, whose values are literals in its source.

    Parameters
    ----------
    room
        Folder of the package, as for `names`.
    name
        Name of the plug-in.

    Returns
    -------
    dict
        Values by the constants' names.
    """
    constants = {}
    for constant, value in _constants(room, name).items():
        try:
            constants[constant] = ast.literal_eval(value)
        except ValueError:
            continue
    return constants


@functools.cache
def options_that_read(scene: str) -> frozenset[str]:
    """Return the names of a scene's options that are paths of files it reads."""
    stated = _constants("scenes", scene).get("OPTIONS") if scene in names("scenes") else None
    entries = zip(stated.keys, stated.values, strict=True) if isinstance(stated, ast.Dict) else ()
    return frozenset(
        str(name.value)
        for name, entry in entries
        if isinstance(name, ast.Constant) and isinstance(entry, ast.Dict)
        if any(isinstance(word, ast.Constant) and word.value == "reads" for word in entry.keys)
    )


def layout(name: str, points: Sequence[Any] = ()) -> Layout:
    """Return the columns of a table, by importing its module.

    Parameters
    ----------
    name
        Name of the table.
    points
        Runs of the study that it is of.

    Returns
    -------
    Layout
        Its columns.
    """
    module = importlib.import_module(f"{PACKAGE.name}.tables.{name}")
    others = getattr(module, "WORDS", module.COLUMNS)
    numbers = tuple(column for column in module.COLUMNS if column not in others)
    return Layout((*module.COLUMNS, *(module.more(points) if hasattr(module, "more") else ())), numbers)


def _constants(room: str, name: str) -> dict[str, ast.expr]:
    """Return the expression that a plug-in's source gives each of its constants, with or without a type, by name."""
    constants = {}
    for statement in _tree(PACKAGE / room / f"{name}.py").body:
        if not isinstance(statement, ast.Assign | ast.AnnAssign) or statement.value is None:
            continue
        target = statement.targets[0] if isinstance(statement, ast.Assign) else statement.target
        if isinstance(target, ast.Name):
            constants[target.id] = statement.value
    return constants


@functools.cache
def _tree(path: Path) -> ast.Module:
    """Return the syntax tree of a source file."""
    return ast.parse(path.read_text(encoding="utf-8"))
