"""Verbs that write the tables of a study: `table` for any of them, and a verb each for some."""

import os
from collections.abc import Callable
from pathlib import Path

import click

from subslide.commands import cli
from subslide.keys import words
from subslide.keys.schema import ConfigError

MISSED = 1
"""Exit status of `verify` where a required order is not reached."""

MOST_BYTES = 10_000_000
"""Size from which on a file is no page."""

results_argument = click.argument("results")
pages_option = click.option(
    "-o",
    "--output",
    metavar="FILE.md",
    multiple=True,
    help="page whose tables of the last run are written anew",
)
page_option = click.option(
    "-o", "--output", metavar="FILE.md", help="page whose table of the last run is written anew"
)


def write(name: str, folder: str) -> None:
    """Write a table of the study in a folder, and print it in words, if it has any, and the paths of its files."""
    from subslide import tables
    from subslide.results import Results
    from subslide.tables import _write

    module, results = tables.load(name), Results(folder)
    if lack := _write.lacking(name, results):
        raise ConfigError(f"{folder}: this study gets no table {name}; allowed: a study with {lack}")
    if hasattr(module, "KERNELS"):
        from subslide import jobs

        jobs.set_threads(1)
    paths = _write.write(name, results)
    if hasattr(module, "text"):
        click.echo(f"{module.text(results)}\n")
    for path in paths:
        click.echo(str(path))


def renewer(page: str, folder: str, *paths: str | None) -> Callable[[], None]:
    """Return a function that writes the tables of pages of documentation anew; the pages are checked at once.

    Parameters
    ----------
    page
        Module of `subslide.pages` that makes them.
    folder
        Folder of the study.
    paths
        The pages; None is left out.

    Returns
    -------
    callable
        To be called once the study's tables are written.
    """
    import importlib

    from subslide.files import write_text
    from subslide.pages import renewal
    from subslide.results import Results
    from subslide.study import outputs
    from subslide.study.yaml_files import read_text

    texts = {}
    for path in (path for path in paths if path is not None):
        outputs.check(path, outputs.of_study(Path(folder), but=[Path(path)]), end=".md")
        if not os.path.isfile(path):
            raise ConfigError(
                f"--output: {words.show(path)}: there is no such file; allowed: a page to renew"
            )
        texts[path] = read_text(path, MOST_BYTES)
        renewal.marked(texts[path], importlib.import_module(f"subslide.pages.{page}").MARKS)

    def renew() -> None:
        for path, text in texts.items():
            write_text(path, importlib.import_module(f"subslide.pages.{page}").page(text, Results(folder)))

    return renew


@cli.command()
@click.argument("name")
@results_argument
def table(name: str, results: str) -> None:
    """Write one table, NAME, of a study from its records and tables; RESULTS is its folder, such as results/paper."""
    write(name, results)


@cli.command()
@results_argument
def tables(results: str) -> None:
    """Write runs, timing and series of a study, and its bands if it has any; RESULTS is its folder."""
    from subslide.results import Results
    from subslide.tables import _write

    study = Results(results)
    if study.has_bands:
        write("bands", results)
    else:
        _write.remove("bands", study.folder)
    for name in ("runs", "timing", "series"):
        write(name, results)


@cli.command()
@results_argument
def errors(results: str) -> None:
    """Write the table of errors against exact solutions of a study; RESULTS is the study's folder."""
    write("errors", results)


@cli.command()
@results_argument
@page_option
def verify(results: str, output: str | None) -> int:
    """Print errors and observed orders of a study with exact solutions, such as results/accuracy.

    Exit status: 0 if every required order is reached and grains at rest are still; 1 if not; 2 for bad input.
    """
    from subslide.results import Results
    from subslide.tables import _orders

    renew = renewer("verification", results, output)
    rows = Results(results).errors
    if rows.empty:
        raise ConfigError(
            f"{results}/tables/errors.csv has no rows: no run has a known answer; allowed: a study such as accuracy"
        )
    lines = _orders.lines(rows)
    click.echo(_orders.text(lines))
    renew()
    missed = [line for line in lines if line.missed]
    for line in missed:
        click.echo(f"subslide: required, but {line.verdict}: {', '.join(line.words()[:4])}", err=True)
    return MISSED if missed else 0


@cli.command("work-precision")
@results_argument
@pages_option
def work_precision(results: str, output: tuple[str, ...]) -> None:
    """Chart error against seconds for a study that sweeps numerics; RESULTS is its folder, such as results/accuracy.

    Writes RESULTS/tables/work_precision.csv and cheapest.csv, and prints the cheapest choices.
    """
    renew = renewer("work_precision", results, *output)
    write("work_precision", results)
    write("cheapest", results)
    renew()


@cli.command()
@results_argument
@page_option
def atlas(results: str, output: str | None) -> None:
    """Write the stability atlas of a study and print how each method did; RESULTS is the study's folder."""
    renew = renewer("stability", results, output)
    write("atlas", results)
    renew()


@cli.command()
@results_argument
def cfl(results: str) -> None:
    """Find the largest stable Courant number of each scheme, order and model, for a study's table of them.

    RESULTS is the study's folder, such as results/stability.
    """
    write("cfl", results)


@cli.command()
@results_argument
def claims(results: str) -> None:
    """Hold what the source paper says against a study's tables; RESULTS is its folder, such as results/paper.

    Writes RESULTS/tables/claims.csv and claims.html, and prints the same as text.
    """
    write("claims", results)
