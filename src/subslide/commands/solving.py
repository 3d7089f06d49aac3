"""Verbs that check and solve: `run` for one collapse, `check` for studies."""

import gc
from collections.abc import Callable, Iterable
from typing import Any

import click

from subslide.commands import cli
from subslide.keys import plain, schema, words
from subslide.points import RUN_KEYS, Point

LIMITS = ("max_core_hours", "max_memory", "max_disk")
"""Keys of a study that say something of one run too."""


class Count(click.IntRange):
    """Whole number within a range, written as in a file."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Return the number that a text stands for; a complaint of click if it is none, or out of range."""
        try:
            number = plain.value_of(value) if isinstance(value, str) else value
        except ValueError as error:
            self.fail(f"{words.cut(value)} {error}", param, ctx)
        if not isinstance(number, int):
            self.fail(f"{words.show(value)} is not a whole number", param, ctx)
        return super().convert(number, param, ctx)


threads_option = click.option(
    "--threads", type=Count(1, 1024), default=1, show_default=True, help="threads of the kernels"
)


def run_options(command: Callable) -> Callable:
    """Return the command with one option for each key of a run; help texts come from the schema."""
    for key in reversed((*LIMITS, "numerics", *RUN_KEYS)):
        about = schema.properties()[key]
        flag = "--" + key.replace("_", "-")
        default = about["default"]
        if about.get("type") == "boolean":
            option = click.option(f"{flag}/--no-{flag[2:]}", key, default=None, help=_help(key))
        else:
            metavar = words.metavar(key)
            option = click.option(flag, key, metavar=metavar, help=f"{_help(key)}  [default: {default}]")
        command = option(command)
    return command


def _help(key: str) -> str:
    """Return what help says of a key: its meaning, unit and range."""
    about = schema.properties()[key]
    unit = f" [{words.unit(key)}]" if words.unit(key) else ""
    choice = "" if "enum" in about or about.get("type") == "boolean" else f"; {words.allowed(key)}"
    return f"{about['description']}{unit}{choice}"


@cli.command()
@click.option(
    "--config", metavar="FILE", help="YAML file of one point, with the keys of a study; options override it"
)
@run_options
@threads_option
@click.option("-o", "--output", required=True, metavar="FILE.nc", help="record to write (NetCDF-4)")
def run(config: str | None, threads: int, output: str, **options: Any) -> None:
    """Solve one collapse, print one line and write its record.

    Exit status: 0 when a record was written, whatever its status; 2 for bad input; 1 for a fault.
    """
    from subslide import jobs, scenes
    from subslide.study import outputs

    gc.disable()  # a seventh of the start-up time went into looking for cycles among imported modules
    options = {key: value for key, value in options.items() if value is not None}
    point = jobs.point_of(config, options)
    outputs.check(output, [*([config] if config else []), *scenes.files(point)])
    caution([point])
    jobs.set_threads(threads)
    click.echo(jobs.run(point, threads, output))


def caution(points: Iterable[Point], more: Iterable[str] = ()) -> None:
    """Say on stderr, once of each unsafe region and note, that it fits some of the points; and what more there is."""
    from subslide.study import cautions, notes

    points = list(points)
    for line in (*cautions.cautions(points), *notes.notes(points), *more):
        click.echo(f"subslide: {line}", err=True)


@cli.command()
@click.argument("config", nargs=-1, required=True)
def check(config: tuple[str, ...]) -> None:
    """Check study files, CONFIG..., and print one line for each, with cautions where runs lie in unsafe regions."""
    from subslide.study import limits, notes
    from subslide.study.config import read_study

    for path in config:
        study = read_study(path)
        companions = len(study.solved) - len(study.runs)
        more = f" and {companions} companions for bands" if companions else ""
        click.echo(
            f"{path}: study '{study.name}', {len(study.runs)} runs{more}, {len(study.figures)} figures,"
            f" {limits.estimate(study.solved, study.keep).words()}"
        )
        caution(study.points, notes.unkept(study.points, study.keep))


@cli.command()
@click.argument("kernel", nargs=-1, required=True, metavar="MODEL:DTYPE[:fitted][:general]...")
def warm(kernel: tuple[str, ...]) -> None:
    """Compile the kernels of some models into the cache, so that jobs started together do not each compile."""
    from subslide import jobs

    jobs.set_threads(1)
    for line in jobs.warm(kernel):
        click.echo(line)
