"""The command line: `subslide run` for one collapse, and the verbs that the workflow's rules call."""

import gc
import os
import sys
from pathlib import Path

import click

import subslide
from subslide.keys import schema, words
from subslide.keys.schema import ConfigError
from subslide.points import RUN_KEYS

BAD_INPUT, FAULT, INTERRUPTED = 2, 1, 130


class Verbs(click.Group):
    """Group of commands that lists them in the order they were written, and names the nearest to a mistyped one."""

    def list_commands(self, ctx):
        return list(self.commands)

    def resolve_command(self, ctx, args):
        if args and args[0] not in self.commands:
            hint = words.closest(args[0], self.commands)
            raise click.UsageError(
                f"{args[0]}: there is no such command; allowed: {', '.join(self.commands)}{hint}"
            )
        return super().resolve_command(ctx, args)


@click.group(cls=Verbs, context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 110})
@click.version_option(subslide.__version__, prog_name="subslide")
def cli():
    """Collapse of submerged granular columns: two-layer Coulomb runs, records, tables and figures."""


def run_options(command):
    """The command with one option for each key of a run; help texts come from the schema."""
    for key in reversed(("numerics", *RUN_KEYS)):
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
    about = schema.properties()[key]
    unit = f" [{words.unit(key)}]" if words.unit(key) else ""
    choice = "" if "enum" in about or about.get("type") == "boolean" else f"; {words.allowed(key)}"
    return f"{about['description']}{unit}{choice}"


@cli.command()
@click.option(
    "--config", metavar="FILE", help="YAML file of one point, with the keys of a study; options override it"
)
@run_options
@click.option(
    "--threads", type=click.IntRange(1, 1024), default=1, show_default=True, help="threads of the kernels"
)
@click.option("-o", "--output", required=True, metavar="FILE.nc", help="record to write (NetCDF-4)")
def run(config, threads, output, **options):
    """Solve one collapse, print one line and write its record.

    Exit status: 0 when a record was written, whatever its status; 2 for bad input; 1 for a fault.
    """
    from subslide import jobs

    gc.disable()  # a seventh of the start-up time went into looking for cycles among imported modules
    options = {key: value for key, value in options.items() if value is not None}
    point = jobs.point_of(config, options)
    jobs.check_output(output, inputs=[config] if config else [])
    caution([point])
    jobs.set_threads(threads)
    click.echo(jobs.run(point, threads, output))


def caution(points) -> None:
    """Nothing; stderr says once of each unsafe region that any of the points lies in it."""
    from subslide.study import cautions as guard

    for line in guard.cautions(points):
        click.echo(f"subslide: {line}", err=True)


@cli.command()
@click.argument("config", nargs=-1, required=True)
def check(config):
    """Check study files, CONFIG..., and print one line for each, with cautions where runs lie in unsafe regions."""
    from subslide.study.config import read_study

    for path in config:
        study = read_study(path)
        more = f" and {len(study.solved) - len(study.runs)} companions for bands" if study.bands else ""
        click.echo(
            f"{path}: study '{study.name}', {len(study.runs)} runs{more}, {len(study.figures)} figures"
        )
        caution(study.points)


@cli.command()
@click.argument("spec")
@click.option(
    "--threads", type=click.IntRange(1, 1024), default=1, show_default=True, help="threads of the kernels"
)
@click.option("-o", "--output", required=True, metavar="FILE.nc", help="record to write (NetCDF-4)")
def batch(spec, threads, output):
    """Solve the points of a batch file, SPEC, into one record with its SHA-256 beside it."""
    from subslide import jobs

    jobs.check_output(output, inputs=[spec])
    jobs.set_threads(threads)
    for line in jobs.batch(spec, threads, output):
        click.echo(line)


@cli.command()
@click.argument("kernel", nargs=-1, required=True, metavar="MODEL:DTYPE[:general]...")
def warm(kernel):
    """Compile the kernels of some models into the cache, so that jobs started together do not each compile."""
    from subslide import jobs

    jobs.set_threads(1)
    for line in jobs.warm(kernel):
        click.echo(line)


@cli.command()
@click.argument("results")
def tables(results):
    """Write the tables of a study from its records; RESULTS is the study's folder, such as results/paper."""
    from subslide.tables import runs as tables_of

    for path in tables_of.write(Path(results)):
        click.echo(str(path))


@cli.command()
@click.argument("results")
def errors(results):
    """Write the table of errors against exact solutions of a study; RESULTS is the study's folder."""
    from subslide.tables import errors as errors_of

    click.echo(str(errors_of.write(Path(results))))


@cli.command()
@click.argument("results")
@click.option("-o", "--output", metavar="FILE.md", help="page whose table of the last run is written anew")
def verify(results, output):
    """Print errors and observed orders of a study with exact solutions, such as results/accuracy.

    Exit status: 0 if every required order is reached and grains at rest are still; 1 if not; 2 for bad input.
    """
    from subslide.pages import verification

    text, missed = verification.report(Path(results))
    click.echo(text)
    if output:
        _renew(output, lambda page: verification.page(page, Path(results)))
    for line in missed:
        click.echo(f"subslide: required, but {line.verdict}: {', '.join(line.words()[:4])}", err=True)
    return FAULT if missed else 0


@cli.command("work-precision")
@click.argument("results")
@click.option(
    "-o",
    "--output",
    metavar="FILE.md",
    multiple=True,
    help="page whose tables of the last run are written anew",
)
def work_precision(results, output):
    """Chart error against seconds for a study that sweeps numerics; RESULTS is its folder, such as results/accuracy.

    Writes RESULTS/tables/work_precision.csv and cheapest.csv, and prints the cheapest choices.
    """
    from subslide.pages import _work_precision_old as chart

    paths, text = chart.write(Path(results))
    click.echo("\n".join([text, "", *map(str, paths)]))
    for page in output:
        _renew(page, lambda words: chart.page(words, Path(results)))


@cli.command()
@click.argument("results")
@click.option("-o", "--output", metavar="FILE.md", help="page whose table of the last run is written anew")
def atlas(results, output):
    """Write the stability atlas of a study and print how each method did; RESULTS is the study's folder."""
    from subslide.pages import stability as methods
    from subslide.tables import atlas as atlas_of

    click.echo(str(atlas_of.write(Path(results))))
    click.echo(methods.report(Path(results)))
    if output:
        _renew(output, lambda page: methods.page(page, Path(results)))


@cli.command()
@click.argument("results")
def cfl(results):
    """Find the largest stable Courant number of each scheme, order and model, for a study's table of them.

    RESULTS is the study's folder, such as results/stability.
    """
    from subslide import jobs
    from subslide.tables import cfl as courant

    jobs.set_threads(1)
    click.echo(str(courant.write(Path(results))))


@cli.command()
@click.argument("name")
@click.option(
    "--results", required=True, metavar="FOLDER", help="folder of a study with its tables and records"
)
@click.option("-o", "--output", required=True, metavar="FOLDER", help="folder for NAME.png and NAME.svg")
def figure(name, results, output):
    """Draw one figure, NAME, of a study as PNG and SVG."""
    from subslide.figures import _save as drawing

    for path in drawing.save(name, Path(results), Path(output)):
        click.echo(str(path))


@cli.command()
@click.argument("results")
def claims(results):
    """Hold what the source paper says against a study's tables; RESULTS is its folder, such as results/paper.

    Writes RESULTS/tables/claims.csv and claims.html, and prints the same as text.
    """
    from subslide.tables import claims as claims_of

    paths, text = claims_of.write(Path(results))
    click.echo("\n".join([text, "", *map(str, paths)]))


@cli.command()
def docs():
    """Write the pages of documentation that follow from the code, in the repository that is the current folder."""
    from subslide.files import write_text
    from subslide.pages import documentation as pages_of

    for path, text in pages_of.pages().items():
        if not Path(path).parent.is_dir():
            raise ConfigError(f"{path}: there is no such folder here; allowed: the root of the repository")
        write_text(path, text)
        click.echo(path)


def _renew(path: str, renewed) -> None:
    """Nothing; the page at `path` is what `renewed` makes of its text."""
    from subslide.files import write_text

    try:
        page = Path(path).read_text(encoding="utf-8")
    except FileNotFoundError:
        raise ConfigError(f"--output: {path}: there is no such file; allowed: a page to renew") from None
    write_text(path, renewed(page))


def main(arguments: list[str] | None = None) -> int:
    """Exit status of the command line: 0 done, 2 bad input (one line on stderr), 1 a fault."""
    try:
        code = cli.main(arguments, prog_name="subslide", standalone_mode=False)
        return code if isinstance(code, int) else 0
    except click.ClickException as error:
        return _complain(error.format_message(), BAD_INPUT)
    except ConfigError as error:
        return _complain(str(error), BAD_INPUT)
    except (click.Abort, KeyboardInterrupt):
        return _complain("interrupted; nothing was written", INTERRUPTED)
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0
    except OSError as error:
        if type(error).__name__ == "RecordError":
            return _complain(str(error), FAULT)
        return _complain(f"{error.filename or 'output'}: {error.strerror or error}", FAULT)


def _complain(message: str, code: int) -> int:
    print("subslide: " + " ".join(message.split()), file=sys.stderr)
    return code


def entry() -> None:
    """Nothing; ends the process at once: tearing down compiled code takes longer than a radial run."""
    status = main()
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(status)


if __name__ == "__main__":
    entry()
