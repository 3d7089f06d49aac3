"""Tables: each is one module of this folder, found by listing it; a study gets those whose needs it meets.

A module has

TITLE : str
    Its label in the report, which shows a table that has a caption, ``workflow/report/NAME.rst``.
ABOUT : str
    What docs/tables.md says of it before its columns; or a function ``about()`` that returns this text.
COLUMNS : dict of str to tuple
    Unit and meaning of each column by its name, in order.
READS : tuple of str
    What it is made from: ``records``, or names of other tables; a study that does not get one of these tables has none
    to wait for.
needs(study) -> str
    Return '' if a study (`study.config.Study`) is to have the table, else words for what it lacks, such as
    ``bands: true``.
table(results) -> iterable of dict, or pandas.DataFrame
    Return the rows of a finished study (`results.Results`) by COLUMNS; what a row leaves out stays empty. Raise a
    ConfigError if the study has none.

    In its place, of tables with a row of every run: ``columns(results)``, which returns the entries of each column by
    its name as arrays or lists.

and, only where it needs them,

WORDS : tuple of str
    Columns that hold words, or true and false; all others but keys of words hold numbers, and a file where they do not
    is refused. Without it, nothing is asked of them.
FLOAT_FORMAT : str
    How numbers are written, such as ``%.10g``; without it, all digits.
CATEGORY : str
    Its heading in the report, if it is not that of the other tables.
KERNELS : tuple of str
    Compiled code, as ``model:dtype[:general]``, of a table that solves runs of its own.
text(results) -> str
    Return the table in words, from its file, for the command line to print.
html(rows) -> str
    Return a page of the table, which is written beside it.
filename(points, keep) -> str
    Return the name of its file in a study of such runs, of which so much is kept, if that is not always NAME.csv.
more(points) -> dict of str to tuple
    Return the columns after COLUMNS, with unit and meaning, of a study of such runs.
BESIDE : dict of str to function
    Files beside it, by name; a function picks their columns from the entries by column that ``columns`` returns.
write(path, results) -> None
    Write the file, in place of ``table``, where rows are too many to be held.

TITLE, CATEGORY, READS and KERNELS are literals, read without importing the module. Planning a study imports it to ask
``needs``, so libraries that start slowly (pandas, xarray) and compiled code are imported within functions. Names
that begin with '_' are helpers. A module imports no other table but those that it reads.
"""

import importlib
from collections.abc import Sequence
from types import ModuleType
from typing import TYPE_CHECKING

from subslide import catalogue
from subslide.keys import words
from subslide.keys.schema import ConfigError

if TYPE_CHECKING:
    from subslide.points import Point
    from subslide.study.config import Study


def load(name: str) -> ModuleType:
    """Return the module of a table by its name; ConfigError without one."""
    known = catalogue.names("tables")
    if name not in known:
        raise ConfigError(
            f"table: {name} is not allowed; allowed: {', '.join(known)}{words.closest(name, known)}"
        )
    return importlib.import_module(f"{__name__}.{name}")


def files(name: str, points: Sequence["Point"], keep: str) -> list[str]:
    """Return the names of a table's files: the table, and what it has beside it.

    Parameters
    ----------
    name
        Name of the table.
    points
        Runs of the study.
    keep
        What is kept of each, one of `subslide.keys.kept.WORDS`.

    Returns
    -------
    list of str
        Names in the study's folder of tables.
    """
    module = load(name)
    filename = module.filename(points, keep) if hasattr(module, "filename") else f"{name}.csv"
    return [filename, *getattr(module, "BESIDE", ()), *([f"{name}.html"] if hasattr(module, "html") else [])]


def columns(name: str, points: Sequence["Point"]) -> dict[str, tuple[str, str]]:
    """Return the columns of a table, with unit and meaning.

    Parameters
    ----------
    name
        Name of the table.
    points
        Runs of the study.

    Returns
    -------
    dict
        Unit and meaning by column, in order.
    """
    module = load(name)
    return {**module.COLUMNS, **(module.more(points) if hasattr(module, "more") else {})}


def of_study(study: "Study") -> dict[str, list[str]]:
    """Return the names of the files of each table that a study is to have, by the table's name.

    Parameters
    ----------
    study
        The study.

    Returns
    -------
    dict
        Names of files by name of table.
    """
    names = (name for name in catalogue.names("tables") if not load(name).needs(study))
    points = [point for _, point in study.runs]
    return {name: files(name, points, study.keep) for name in names}


def about(name: str) -> str:
    """Return what a table says of itself in the documentation."""
    module = load(name)
    return module.about() if hasattr(module, "about") else module.ABOUT
