"""Pages of documentation: those that follow from the code alone, and those that quote the last run of a study.

A module of the first kind has `PATH`, from the root of the repository, and `text()`; `generated` lists them. One of the
second has `page(text, results)`, which returns a page with the tables of a study between its marks.
"""

import importlib

GENERATED = ("keys", "schema", "tables", "records")
"""Modules of pages that follow from the code."""


def generated() -> dict[str, str]:
    """Return the text of each page that follows from the code, by its path from the root of the repository."""
    pages = [importlib.import_module(f"{__name__}.{name}") for name in GENERATED]
    return {page.PATH: page.text() for page in pages}
