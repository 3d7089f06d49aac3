"""Figures: each is one module of this folder, found by listing it.

A module has TITLE (text), CATEGORY (text: the heading in the report), NEEDS (for each key of a run, the
values that a study must have for the figure to make sense) and `draw(results)`, which returns a
matplotlib figure. The constants are literals: they are read without importing the module, so that
planning a study does not wait for plotting libraries. Names that begin with '_' are helpers.
"""

import ast
import functools
from pathlib import Path
from typing import NamedTuple

FOLDER = Path(__file__).resolve().parent


class About(NamedTuple):
    """What a figure says of itself: title, heading in the report, and the values its study must have by key."""

    title: str
    category: str
    needs: dict[str, tuple]


def names() -> list[str]:
    """Names of all figures, sorted."""
    return sorted(path.stem for path in FOLDER.glob("*.py") if not path.stem.startswith("_"))


@functools.cache
def about(name: str) -> About:
    """Title, category and needs of a figure, read from its source without importing it."""
    tree = ast.parse((FOLDER / f"{name}.py").read_text(encoding="utf-8"))
    literals = {
        statement.targets[0].id: statement.value
        for statement in tree.body
        if isinstance(statement, ast.Assign) and isinstance(statement.targets[0], ast.Name)
    }
    title, category, needs = (
        ast.literal_eval(literals[key]) if key in literals else default
        for key, default in (("TITLE", name), ("CATEGORY", "Figures"), ("NEEDS", {}))
    )
    return About(title, category, needs)
