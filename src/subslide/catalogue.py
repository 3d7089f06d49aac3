"""The catalogue: what the folders of plug-ins hold, told from their names and source text; nothing is imported.

Scenes, exact solutions, tables and figures are one module each, found by listing their folder. Planning a study asks
what there is and what it needs, and must not wait for the libraries that draw or tabulate it.
"""

import ast
import functools
from pathlib import Path
from typing import Any, NamedTuple

PACKAGE = Path(__file__).resolve().parent


class About(NamedTuple):
    """What a figure says of itself: title, heading in the report, and the values its study must have by key."""

    title: str
    category: str
    needs: dict[str, tuple]


def names(folder: str) -> list[str]:
    """Return the names of the plug-ins in a folder of the package, sorted.

    Parameters
    ----------
    folder
        Name of the folder, such as ``scenes``. Its modules whose names begin with ``_`` are helpers, no plug-ins.
    """
    return sorted(path.stem for path in (PACKAGE / folder).glob("[!_]*.py"))


def literals(path: Path | str) -> dict[str, Any]:
    """Return the literal constants at the top of a module by name, read from its source.

    Parameters
    ----------
    path
        Python file, absolute or from the folder of the package.

    Returns
    -------
    dict
        Value of each ``NAME = literal``; a name that is given anything else is left out.
    """
    tree = ast.parse((PACKAGE / path).read_text(encoding="utf-8"))
    values = {}
    for statement in tree.body:
        if isinstance(statement, ast.Assign) and isinstance(statement.targets[0], ast.Name):
            try:
                values[statement.targets[0].id] = ast.literal_eval(statement.value)
            except ValueError:
                continue
    return values


@functools.cache
def figure(name: str) -> About:
    """Return what a figure says of itself; ``name`` is one of ``names("figures")``."""
    stated = literals(f"figures/{name}.py")
    return About(stated.get("TITLE", name), stated.get("CATEGORY", "Figures"), stated.get("NEEDS", {}))
