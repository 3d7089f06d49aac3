"""Verbs that the workflow calls while it makes a study, and `unlock` for the time after a killed one."""

import json
import os
from pathlib import Path

import click

from subslide.commands import cli, interrupts
from subslide.keys import words
from subslide.keys.schema import ConfigError

MOST_BYTES = 1_000_000_000
"""Size from which on a file is no list of points."""


@cli.command()
@click.argument("spec")
@click.option(
    "--threads", type=click.IntRange(1, 1024), default=1, show_default=True, help="threads of the kernels"
)
@click.option(
    "--ledger", metavar="FILE.json", help="the study's file of this batch, written once its record is whole"
)
@click.option("--counts", metavar="FILE", help="file that counts the runs that have ended, for whoever waits")
@click.option(
    "--attended", is_flag=True, hidden=True
)  # ends with standard input: with the program that started it
@click.option("-o", "--output", required=True, metavar="FILE.nc", help="record to write (NetCDF-4)")
def batch(
    spec: str, threads: int, ledger: str | None, counts: str | None, attended: bool, output: str
) -> None:
    """Solve the points of a batch file, SPEC, into one record with its SHA-256 beside it."""
    from subslide import jobs

    if attended:
        interrupts.end_with_input()
    jobs.set_threads(threads)
    jobs.batch(spec, threads, output, ledger, click.echo, counts)


@cli.command(hidden=True)
@click.argument("source")
@click.option("-o", "--output", required=True, metavar="FILE.json", help="the copy")
def keep(source: str, output: str) -> None:
    """Copy the list of a study's points, SOURCE, whole or not at all, with its SHA-256 beside it."""
    from subslide import checksums
    from subslide.files import write_text
    from subslide.study import outputs
    from subslide.study.yaml_files import read_text

    text = read_text(source, MOST_BYTES)
    try:
        points = json.loads(text)["points"]
    except (ValueError, TypeError, KeyError, RecursionError):
        points = None
    if not isinstance(points, list):
        raise ConfigError(f"{source}: this is no list of a study's points; allowed: JSON with the key points")
    outputs.check_sealed(output, [source], ".json")
    write_text(output, text)
    checksums.seal(output)


@cli.command()
@click.argument("config")
def unlock(config: str) -> None:
    """Remove the lock that a killed run of the study CONFIG has left in this folder; refuse if a run is at work."""
    from subslide.study import locks
    from subslide.study.config import read_study
    from subslide.study.plan import check_folders

    name = read_study(config).name
    check_folders(Path("results", name), Path(".snakemake/subslide", name))
    locks.unlock(name, Path("results", name), Path(".snakemake"), lambda line: click.echo(line, err=True))


@cli.command()
@click.argument("results")
@click.option(
    "--captions",
    metavar="FOLDER",
    help="folder of texts, NAME.rst, of tables and figures  [default: the package's]",
)
@click.option("-o", "--output", required=True, metavar="FILE.html", help="page to write")
def report(results: str, captions: str | None, output: str) -> None:
    """Write the report of a study: one page with its figures and tables; RESULTS is its folder."""
    from subslide import checksums, source_hash
    from subslide._sources import CAPTIONS
    from subslide.files import write_text
    from subslide.pages import report as page
    from subslide.results import Results
    from subslide.study import outputs

    if captions is not None and not os.path.isdir(captions):
        raise ConfigError(
            f"--captions: {words.show(captions)} is no folder; allowed: a folder of texts, NAME.rst"
        )
    page_of_study = Path(results, "report.html")
    inputs = outputs.of_study(Path(results), but=[page_of_study, checksums.beside(page_of_study)])
    texts = Path(captions or CAPTIONS)
    outputs.check_sealed(output, [*inputs, *texts.glob("*.rst")], ".html")
    write_text(output, page.text(Results(results), texts))
    checksums.seal(output, sources=source_hash("page", "report"))
