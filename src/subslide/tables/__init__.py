"""Tables: each is one module of this folder, found by listing it; a study gets those whose needs it meets.

A module has

- `TITLE`: its label in the report, which shows a table that has a caption, workflow/report/NAME.rst;
- `ABOUT`: what docs/tables.md says of it before its columns, or a function `about()` that returns this text;
- `COLUMNS`: unit and meaning of each column by its name, in order;
- `READS`: names of what it is made from: `records`, or other tables of the study; a study that does not get one of
  these tables has none to wait for;
- `needs(study)`: '' if a study is to have the table, else words for what it lacks, such as 'bands: true';
- `table(results)`: its rows, as dictionaries by `COLUMNS` (what one leaves out stays empty) or as a DataFrame;
  ConfigError if the study has none.

and, only where it needs them,

- `FLOAT_FORMAT`: how numbers are written, such as '%.10g'; without it, all digits;
- `CATEGORY`: its heading in the report, if it is not that of the other tables;
- `KERNELS`: compiled code, as 'model:dtype[:general]', of a table that solves runs of its own;
- `text(results)`: the table in words, from its file, which the command line prints;
- `html(rows)`: a page of the table, written beside it;
- `filename(runs)`: the name of its file in a study of so many runs, if that is not always NAME.csv;
- `write(path, results)`: writes the file itself, in place of `table`, where rows are too many to be held.

`TITLE`, `CATEGORY`, `READS` and `KERNELS` are literals, read without importing the module. Planning a study imports it
to ask `needs`, so libraries that start slowly (pandas, xarray) and compiled code are imported within functions. Names
that begin with '_' are helpers. A module imports no other table but those that it reads.
"""

import importlib
from types import ModuleType

from subslide import catalogue
from subslide.keys import words
from subslide.keys.schema import ConfigError


def load(name: str) -> ModuleType:
    """Return the module of a table by its name; ConfigError without one."""
    known = catalogue.names("tables")
    if name not in known:
        raise ConfigError(
            f"table: {name} is not allowed; allowed: {', '.join(known)}{words.closest(name, known)}"
        )
    return importlib.import_module(f"{__name__}.{name}")


def files(name: str, runs: int) -> list[str]:
    """Return the names of a table's files in a study of so many runs: the table, and its page if it has one."""
    module = load(name)
    filename = module.filename(runs) if hasattr(module, "filename") else f"{name}.csv"
    return [filename, *([f"{name}.html"] if hasattr(module, "html") else [])]


def about(name: str) -> str:
    """Return what a table says of itself in the documentation."""
    module = load(name)
    return module.about() if hasattr(module, "about") else module.ABOUT
