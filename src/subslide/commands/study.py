"""Verbs that run a whole study wherever the package is installed, and tell other workflows where this one lies."""

import os
import sys
from pathlib import Path
from typing import Any

import click

from subslide._sources import ROOT, SNAKEFILE
from subslide.commands import cli
from subslide.commands.making import unlock
from subslide.commands.solving import Count, check
from subslide.keys import words
from subslide.keys.schema import ConfigError

STARTED = Path(".snakemake/subslide/Snakefile")
"""What Snakemake starts with: it lies below the current folder, so that jobs which share none are sent it."""

INCLUDED = """# Written by `subslide study`: the workflow of the package, wherever that is installed.
import subslide


include: subslide.SNAKEFILE


workflow.default_target = "all"
"""


class Cores(Count):
    """Whole number, or `all`."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Return the number that a text stands for, or `all`; a complaint of click if it is neither."""
        return value if value == "all" else super().convert(value, param, ctx)


@cli.command()
@click.argument("config")
@click.argument("options", nargs=-1, metavar="[-- OPTIONS]")
@click.option(
    "--cores",
    type=Cores(1, 100_000),
    metavar="N|all",
    help="jobs that work at the same time  [default: all, or as the profile says]",
)
@click.option(
    "--profile",
    metavar="NAME",
    help="where jobs run: a folder of profiles/ here or of the package, such as slurm  [default: this machine]",
)
@click.pass_context
def study(
    ctx: click.Context, config: str, options: tuple[str, ...], cores: int | str | None, profile: str | None
) -> None:
    """Check the study CONFIG and run it to its report, into results/ of the current folder.

    What follows `--`, OPTIONS, goes to Snakemake, whose exit status this has: `subslide study mine.yaml -- --dry-run`.
    """
    from subslide.files import write_text

    chosen = _profile("default" if profile is None else profile)
    ctx.invoke(check, config=(config,))
    ctx.invoke(unlock, config=config)
    STARTED.parent.mkdir(parents=True, exist_ok=True)
    write_text(STARTED, INCLUDED)
    command = [sys.executable, "-P", "-m", "snakemake", f"--snakefile={STARTED}", f"--configfile={config}"]
    command.append(f"--workflow-profile={chosen}")
    if cores or profile is None:
        command.append(f"--cores={cores or 'all'}")
    sys.stdout.flush()
    os.execv(sys.executable, [*command, *options])  # signals and exit status are Snakemake's


def _profile(name: str) -> Path:
    """Return the folder of a profile; ConfigError if there is none of this name."""
    homes = (Path("profiles"), ROOT / "profiles")
    for path in (home / name for home in homes):
        if name and (path / "config.yaml").is_file():
            return path
    known = sorted({path.parent.name for home in homes for path in home.glob("*/config.yaml")})
    raise ConfigError(
        f"--profile: {words.show(name)} is not allowed; allowed: {', '.join(known)}{words.closest(name, known)}"
    )


@cli.command()
def workflow() -> None:
    """Print the path of the package's Snakefile, which other workflows can import as a module."""
    click.echo(SNAKEFILE)
