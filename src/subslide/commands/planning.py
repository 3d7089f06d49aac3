"""Verbs that tell what a study would do, and clear away what it needs no more."""

from pathlib import Path

import click

from subslide.commands import cli
from subslide.commands.solving import Count
from subslide.study.config import Study


def _study(config: str) -> tuple[Study, Path, Path]:
    """Return the study of a file, its folder of results, and that within `.snakemake`."""
    from subslide.study.config import read_study
    from subslide.study.plan import check_folders

    study = read_study(config)
    results, home = Path("results", study.name), Path(".snakemake/subslide", study.name)
    check_folders(results, home)
    return study, results, home


@cli.command()
@click.argument("config")
@click.option(
    "--cores", type=Count(1, 100_000), help="jobs that work at the same time  [default: this machine's]"
)
def plan(config: str, cores: int | None) -> None:
    """Print what the study CONFIG would solve here: points, batches, seconds, memory and disk; write nothing."""
    from subslide.study import limits, outlook

    study, results, _ = _study(config)
    for line in outlook.lines(study, results, cores or limits.usable_cores()):
        click.echo(line)


@cli.command()
@click.argument("config")
def prune(config: str) -> None:
    """Remove records of the study CONFIG that hold no point which it asks for, and say what that has freed."""
    from subslide.study import locks, pruning

    study, results, home = _study(config)
    with locks.alone(study.name, results, home.parents[1], lambda line: click.echo(line, err=True)):
        pruned = pruning.prune(study, results)
    click.echo(f"study '{study.name}': {pruned.batches} batches removed, {pruned.bytes / 1e6:.3g} MB freed")
