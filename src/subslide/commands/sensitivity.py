"""Verb for studies with Saltelli designs."""

from subslide.commands import cli
from subslide.commands.tabulating import pages_option, renewer, results_argument, write


@cli.command()
@results_argument
@pages_option
def sensitivity(results: str, output: tuple[str, ...]) -> None:
    """Write indices, main effects and laws of a study; RESULTS is its folder, such as results/sensitivity.

    Prints first-order and total indices with their 95 % bands.
    """
    renew = renewer("sensitivity", results, *output)
    for name in ("effects", "laws", "indices", "indices_in_time"):
        write(name, results)
    renew()
