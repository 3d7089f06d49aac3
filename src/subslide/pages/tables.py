"""The page on tables, docs/tables.md: what each table says of itself, and its columns."""

from subslide import catalogue, tables
from subslide.pages._rows import row

PATH = "docs/tables.md"
ORDER = (
    "runs",
    "timing",
    "series",
    "bands",
    "claims",
    "errors",
    "work_precision",
    "cheapest",
    "atlas",
    "cfl",
)
"""Tables that come first on the page; any others follow by name."""
INTRODUCTION = """# Tables

<!-- written by `make docs` from the modules in src/subslide/tables -->

Written to `results/<study>/tables/`, each by `subslide table NAME results/<study>`. Rows follow the order of the
study's lists; an empty entry is a value that the run does not have. Runs that failed are rows too: see `status`.

"""


def text() -> str:
    """Return the page."""
    names = sorted(catalogue.names("tables"), key=lambda name: (*ORDER, name).index(name))
    return INTRODUCTION + "\n".join(section(name) for name in names)


def section(name: str) -> str:
    """Return the section (Markdown) on a table: its title, what it says of itself, and its columns."""
    lines = [f"## {name}.csv", "", tables.about(name), "", "| name | unit | meaning |", "|---|---|---|"]
    columns = tables.load(name).COLUMNS.items()
    lines += [row(f"`{column}`", unit, meaning) for column, (unit, meaning) in columns]
    return "\n".join(lines) + "\n"
