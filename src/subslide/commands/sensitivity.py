"""Verb for studies with Saltelli designs."""

import click

from subslide.commands import cli
from subslide.commands.tabulating import renewer, results_argument, write


@cli.command()
@results_argument
@click.option(
    "-o",
    "--output",
    metavar="FILE.md",
    multiple=True,
    help="page whose tables of the last run are written anew",
)
def sensitivity(results: str, output: tuple[str, ...]) -> None:
    """Write indices, main effects and laws of a study; RESULTS is its folder, such as results/sensitivity.

    Prints first-order and total indices with their 95 % bands.
    """
    renew = renewer("sensitivity", results, *output)
    for name in ("effects", "laws", "indices"):
        write(name, results)
    write("indices_in_time", results)
    renew()
