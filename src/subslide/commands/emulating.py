"""Verbs of the emulator: `emulate` makes one of a study, `predict` asks it, `calibrate` lets data choose a column."""

import math
import os
from pathlib import Path
from typing import TYPE_CHECKING

import click

from subslide.commands import cli
from subslide.commands.tabulating import results_argument
from subslide.keys import plain, schema, words
from subslide.keys.schema import ConfigError

if TYPE_CHECKING:
    from subslide.emulator.training import LeftOut

emulator_option = click.option(
    "--emulator", metavar="FILE", help="file of `subslide emulate`  [default: the one of the package]"
)


def number(text: str | None, key: str, flag: str) -> float:
    """Return the value of an option that is a key of a run, checked; its default if it is not given.

    Parameters
    ----------
    text
        What was given, if anything.
    key
        The key.
    flag
        What messages call it.

    Returns
    -------
    float
        The value.
    """
    if text is None:
        return float(schema.properties()[key]["default"])
    try:
        value = plain.value_of(text)
    except ValueError as error:
        raise ConfigError(f"{flag}: {words.cut(text)} {error}") from None
    return float(schema.checked(key, value, flag))


def share(text: str, flag: str) -> float:
    """Return a share such as '0.2%' or 0.002, above 0 and below 1; ConfigError if a text is none.

    Parameters
    ----------
    text
        What was given.
    flag
        What messages call it.

    Returns
    -------
    float
        The share.

    Raises
    ------
    ConfigError
        If it is none.
    """
    try:
        value = float(text.removesuffix("%")) / (100 if text.endswith("%") else 1)
    except ValueError:
        value = math.nan
    if not 0 < value < 1:
        raise ConfigError(
            f"{flag}: {words.show(text)} is not allowed; allowed: a share such as 0.2% or 0.002"
        )
    return value


@cli.command()
@results_argument
@click.option("-o", "--output", metavar="FILE.json", help="file to write  [default: RESULTS/emulator.json]")
@click.option(
    "--to", metavar="SHARE", help="add columns until leave-one-out at 95 % is below it, such as 0.2%"
)
@click.option("--quantity", default="L_f_1pc", show_default=True, help="quantity that --to means")
@click.option(
    "--most", type=click.IntRange(1, 4096), default=512, show_default=True, help="columns that --to may add"
)
@click.option(
    "--held-out", metavar="RESULTS", help="study whose columns the emulator is judged by, and never sees"
)
@click.option(
    "--cores", type=click.IntRange(1, 1024), help="processes that solve added columns  [default: all]"
)
def emulate(
    results: str,
    output: str | None,
    to: str | None,
    quantity: str,
    most: int,
    held_out: str | None,
    cores: int | None,
) -> None:
    """Make an emulator of the converged answer from a study, and print how far leave-one-out errs.

    RESULTS is the folder of a study such as results/emulator, whose columns are solved on two grids or more.
    """
    from subslide import checksums, jobs, source_hash
    from subslide.emulator import growing, measures, training
    from subslide.results import Results
    from subslide.study import outputs

    goal = None if to is None else growing.Goal(quantity, share(to, "--to"), most)
    if goal and quantity not in measures.QUANTITIES:
        allowed = ", ".join(measures.QUANTITIES)
        raise ConfigError(f"--quantity: {words.show(quantity)} is not allowed; allowed: {allowed}")
    folder = Path(results)
    study = Results(folder)
    runs = study.runs_of_study
    path = output or str(folder / "emulator.json")
    within = outputs.of_study(folder, but=[Path(path), checksums.beside(path)])
    (outputs.check_sealed if output is None else outputs.check)(path, within, end=".json")
    jobs.set_threads(1)
    about = {"study": folder.resolve().name, "runs": len(runs), "sources": source_hash()}
    measured = [*training.of_study(study), *growing.kept(folder)]
    others = None if held_out is None else Results(held_out)
    seen = {one.point.similarity_key for one in measured}
    if others and (shared := sum(run.point.similarity_key in seen for run in others.runs_of_study)):
        raise ConfigError(
            f"--held-out: {shared:,} of its {len(others.runs_of_study):,} runs are of columns that are learned;"
            " allowed: a study of other columns"
        )
    if goal is None:
        trained = training.learn(measured, about)
    else:
        processes = cores or os.cpu_count() or 1
        trained, added = growing.grow(measured, about, goal, processes, click.echo)
        growing.keep(folder, [*growing.kept(folder), *added])
    trained.emulator.save(path)
    if output is None:
        checksums.seal(path, sources=source_hash())
    for group, count in trained.known.items():
        lost = (
            f", {trained.dropped[group]} left out since a run lacks a value" if trained.dropped[group] else ""
        )
        click.echo(f"{group}: {count} columns{lost}")
    report("leave-one-out", trained.left_out)
    if others is not None:
        from subslide.emulator import judging

        report(f"held out, {held_out}", judging.held_out(trained.emulator, others))
    click.echo(path)


def report(title: str, errors: "dict[str, LeftOut]") -> None:
    """Print errors by quantity: in the median, at 95 % and at worst, and how many bands hold.

    Parameters
    ----------
    title
        Heading.
    errors
        Predictions beside values, by quantity.
    """
    import numpy as np

    click.echo(f"{title + ':':<34}{'median %':>9}{'95 % of':>9}{'worst':>9}{'covered':>9}{'band %':>9}")
    for name, one in errors.items():
        numbers = 100 * np.quantile(np.abs(one.error), [0.5, 0.95, 1])
        band = 100 * np.median(one.band / np.abs(one.value))
        click.echo(
            f"  {name:<32}"
            + "".join(f"{value:9.3f}" for value in numbers)
            + f"{100 * one.covered:9.1f}{band:9.3f}"
        )


@cli.command()
@click.option(
    "--a-H", "a_H", metavar="NUMBER", help=f"{schema.properties()['a_H']['description']}  [default: 1]"
)
@click.option(
    "--a-2", "a_2", metavar="NUMBER", help=f"{schema.properties()['a_2']['description']}  [default: 0.56]"
)
@click.option("--r", metavar="NUMBER", help=f"{schema.properties()['r']['description']}  [default: 0.4]")
@click.option(
    "--delta", metavar="DEGREE", help=f"{schema.properties()['delta']['description']}  [default: 32]"
)
@click.option(
    "--radius", metavar="M", help=f"{schema.properties()['radius']['description']}  [default: 0.0705]"
)
@click.option("--g", metavar="NUMBER", help="acceleration of gravity (m s-2)  [default: 9.81]")
@emulator_option
def predict(emulator: str | None, **options: str | None) -> None:
    """Print the converged answer of one column, by an emulator, with 95 % bands.

    The bands hold the emulator's error and that of the grids it learned from; nothing of the model's own. Outside the
    range that was learned it refuses: there `subslide run` answers.
    """
    from subslide.emulator import Emulator, telling
    from subslide.points import Point

    values = {key: number(text, key, f"--{key.replace('_', '-')}") for key, text in options.items()}
    for line in telling.lines(Emulator.load(emulator), Point(**values)):
        click.echo(line)


@cli.command()
@click.argument("data", metavar="DATA.csv")
@click.option(
    "--threshold", required=True, metavar="SHARE", help="depth that defines the fronts over H2: 1% to 5%"
)
@click.option(
    "--a-2", "a_2", required=True, metavar="NUMBER", help="aspect ratio H2/R of the column, which is known"
)
@click.option("--radius", metavar="M", help="initial radius R (m)  [default: 0.0705]")
@click.option("--g", metavar="NUMBER", help="acceleration of gravity (m s-2)  [default: 9.81]")
@click.option("--a-H", "a_H", metavar="NUMBER", help="water depth over the column, if it is known")
@click.option("--r", metavar="NUMBER", help="ratio of densities, if it is known")
@click.option("--delta", metavar="DEGREE", help="friction angle, if it is known")
@click.option(
    "--model-error", default="0%", show_default=True, metavar="SHARE", help="model's own error of a front"
)
@click.option("--check/--no-check", default=True, help="ask the solver at the best fit")
@emulator_option
@click.option("-o", "--output", metavar="FILE.json", help="file for the numbers, with the profiles")
@click.option("--figure", metavar="FILE.png", help="file for a figure of the best fit and the profiles")
def calibrate(
    data: str,
    threshold: str,
    model_error: str,
    check: bool,
    emulator: str | None,
    output: str | None,
    figure: str | None,
    **options: str | None,
) -> None:
    """Find the column, (a_H, r, delta), whose fronts are those of DATA.csv, and how far the data tell it.

    DATA.csv has the columns time (s; empty for the deposit), x_front (m from the axis) and error (m, one standard
    deviation). Errors of the data are thought independent; the prior is even in ln a_H, r and delta.
    """
    import json

    from subslide import jobs
    from subslide.emulator import Emulator, calibration, observed
    from subslide.files import write_text
    from subslide.points import Point
    from subslide.study import outputs

    values = {
        key: number(text, key, f"--{key.replace('_', '-')}")
        for key, text in options.items()
        if text is not None
    }
    fixed = {key: values.pop(key) for key in observed.FREE if key in values}
    own_error = 0.0 if model_error.rstrip("%") in ("0", "0.0") else share(model_error, "--model-error")
    inputs = [data, *([emulator] if emulator else [])]
    if output is not None:
        outputs.check(output, inputs, end=".json")
    if figure is not None:
        outputs.check(figure, inputs, "--figure", ".png")
    fronts = observed.read(data, share(threshold, "--threshold"))
    model = observed.Model(Emulator.load(emulator), fronts, Point(**values), fixed, own_error)
    observed.check_known(model)
    jobs.set_threads(1)
    answer = calibration.calibrate(model, check)
    if output is not None:
        write_text(output, json.dumps(calibration.told(answer, data), indent=1) + "\n")
    if figure is not None:
        from subslide.figures import _calibration

        _calibration.save(answer, figure)
    for line in calibration.lines(answer):
        click.echo(line)
