"""What the solving verbs of the command line do: one run, a batch, compiled kernels.

Only numpy, numba and netCDF4 are imported here, and late: start-up is most of a radial run's time.
"""

import itertools
import os
import signal
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from subslide import checksums, scenes, source_hash
from subslide.files import Stopped, write_text
from subslide.keys import schema, words
from subslide.keys.schema import ConfigError
from subslide.naming import FINISHED
from subslide.points import Point
from subslide.study import config, cost, notes, option_texts, outputs, pace, progress, staging
from subslide.study.batches import read_batch, spec_text
from subslide.study.yaml_files import read_yaml

if TYPE_CHECKING:
    from subslide.solver.checkpoint import Keeper
    from subslide.solver.run import Run


def point_of(path: str | None, options: dict[str, str]) -> Point:
    """Return the point that a configuration file and options ask for.

    Parameters
    ----------
    path
        YAML file of one point, if any.
    options
        Texts by key, which win over the file.

    Returns
    -------
    Point
        The point, checked.

    Raises
    ------
    ConfigError
        If the file or an option is wrong: one line that names it.
    """
    values = {} if path is None else read_yaml(path)
    names = {key: f"{path}: {key}" for key in values}
    for key, text in options.items():
        names[key] = "--" + key.replace("_", "-")
        values[key] = option_texts.value_of(key, text, names[key])
    if isinstance(values.get("snapshot_times"), int | float):
        values["snapshot_times"] = [values["snapshot_times"]]
    point = config.make_point(values, names)
    for note in notes.left_out(values):
        print(words.printable(f"subslide: {path}: {note}"), file=sys.stderr)
    return point


def set_threads(threads: int) -> None:
    """Make numba use this many threads, unless it is loaded: then the number is settled, and `solve` stays within."""
    if "numba" not in sys.modules:
        os.environ["NUMBA_NUM_THREADS"] = str(threads)


def run(point: Point, threads: int, output: str) -> str:
    """Solve a point and write its record.

    Parameters
    ----------
    point
        The run.
    threads
        Cores for it.
    output
        Path of the record.

    Returns
    -------
    str
        The line that tells the outcome.
    """
    from subslide.records import netcdf as records

    result = solved(point, threads, progress.of_run(point) if sys.stderr.isatty() else None)
    records.write(output, [result])
    return f"{summary(result)} -> {output}"


def solved(
    point: Point,
    threads: int,
    progress: Callable[[float], object] | None = None,
    keep: str = "all",
    keeper: "Keeper | None" = None,
) -> "Run":
    """Return the run of a point as a record keeps it, so that a batch fits into memory.

    Parameters
    ----------
    point
        The run.
    threads
        Cores for it.
    progress
        Function that is called with the time (s) that the run has reached.
    keep
        What the record keeps of it, one of `subslide.keys.kept.WORDS`.
    keeper
        What keeps the state of a long run, and gives it back.

    Returns
    -------
    Run
        The run.
    """
    from subslide import solver
    from subslide.records import thinning

    run = solver.solve(point, threads=threads, progress=progress, keeper=keeper, profiles=keep == "all")
    return thinning.kept(run, keep)


def batch(
    spec: str,
    threads: int,
    output: str,
    ledger: str | None,
    say: Callable[[str], object],
    counted: str | None = None,
) -> None:
    """Solve the points of a batch file into one record, with its checksum beside it.

    Parameters
    ----------
    spec
        Path of the batch file.
    threads
        Cores for each run.
    output
        Path of the record.
    ledger
        Path of the file of the study's ledger that states the batch, written once its record is whole. With it, points
        that are solved when the job is stopped, or fails, are kept as a batch of their own.
    say
        Function that is called with a line as each run ends, and with one on the record.
    counted
        Path of the file that counts the runs that have ended, for whoever waits.

    Raises
    ------
    ConfigError
        If the file is no batch file, see `study.batches.read_batch`, or an output is none, see `study.outputs.check`.
    """
    from subslide.solver.checkpoint import Keeper
    from subslide.study.locks import at_work

    points, keep, first = read_batch(spec)
    inputs = {spec, *(file for point in points for file in scenes.files(point))}
    outputs.check_sealed(output, inputs)
    if ledger is not None:
        outputs.check(ledger, [*inputs, output, checksums.beside(output)], "--ledger", ".json")
    results: list[Run] = []
    timed: list[Point] = []
    begun = 0.0
    counter = progress.Counter(counted)
    with at_work(Path(os.path.realpath(output)).parent):
        keeper = Keeper(Path(output).parent / staging.UNFINISHED, Path(output).stem, points, keep)
        try:
            for point in points:
                before = keeper.take(point)
                results.append(before or solved(point, threads, keep=keep, keeper=keeper))
                say(summary(results[-1]))
                counter.add(results[-1].status not in FINISHED)
                if not before:
                    keeper.add(results[-1])
                    if begun:
                        timed.append(point)
                    begun = begun or time.process_time()  # the first run waits for kernels
            keep_batch(results, output, ledger, keep, first)
            counter.write()
            keeper.forget()
            if threads == 1:
                pace.learn(pace.kind(points[0], keep), time.process_time() - begun, cost.of_all(timed, keep))
        except BaseException as error:
            if not (ledger and results):
                raise
            part, record = unused_part(ledger, output)
            keep_batch(results, str(record), str(part), keep, first)
            said = f"stopped: the {len(results)} runs that were solved are kept as batch {part.stem}"
            if isinstance(error, KeyboardInterrupt | Stopped):
                raise Stopped(getattr(error, "signal", signal.SIGINT), said) from None
            say(said)
            raise
    say(f"{len(results)} runs -> {output}")


def keep_batch(
    results: list["Run"], output: str, ledger: str | None, keep: str = "all", first: int = 0
) -> None:
    """Write the record of runs, its checksum and, if it is given, the ledger's file, each whole or not at all.

    Parameters
    ----------
    results
        Runs, as `solved` gives them.
    output, ledger
        Paths of the record and of the ledger's file.
    keep
        What is kept of each run, one of `subslide.keys.kept.WORDS`.
    first
        Number of the first run within its study.
    """
    from subslide.records import netcdf as records

    text = spec_text([result.point for result in results], keep, first)
    checksums.beside(output).unlink(missing_ok=True)
    records.write(output, results, keep, first)
    checksums.seal(output, batch=checksums.text_hash(text), sources=source_hash())
    if ledger:
        write_text(ledger, text)


def unused_part(ledger: str, output: str) -> tuple[Path, Path]:
    """Return the paths, beside those of a batch, of the ledger's file and record of the first part not yet there."""
    stem = Path(ledger).stem.partition("p")[0]  # what is solved again may be a part itself
    for number in itertools.count(1):
        part = Path(ledger).with_name(f"{stem}p{number}.json")
        record = Path(output).with_name(f"{part.stem}.nc")
        there = any(os.path.lexists(path) for path in (part, record, checksums.beside(record)))
        if part != Path(ledger) and not there:  # Snakemake removes what a job that was stopped was to make
            break
    return part, record


def warm(kernels: tuple[str, ...]) -> Iterator[str]:
    """Compile kernels, named 'model:dtype[:fitted][:general]', into the cache by tiny runs; yield a line for each.

    Raises
    ------
    ConfigError
        If a name is none of compiled code.
    """
    from subslide import solver

    for kernel in kernels:
        model, *marks = kernel.split(":")
        dtype = marks.pop(0) if marks else "float64"
        if marks not in ([], ["fitted"], ["general"], ["fitted", "general"]):
            raise ConfigError(f"kernel: {kernel} is not allowed; allowed: MODEL:DTYPE[:fitted][:general]")
        values = {
            "model": schema.checked("model", model),
            "dtype": schema.checked("dtype", dtype),
            "grid": "fitted" if "fitted" in marks else "uniform",
        }
        scene = {"scene": "slab"} if model == "line" else {}
        scheme = "roe" if "general" in marks else "ifcph"
        solver.solve(
            config.make_point({"r": 0, "cells": 20, "t_end": 0.01, "scheme": scheme, **scene, **values})
        )
        yield f"compiled {kernel}"


def summary(result: "Run") -> str:
    """Return one line on a solved run: id, status, deposit, surface, model, steps and time."""
    import numpy as np

    radius = result.point.radius
    parts = [f"{result.point.id}: {result.status}"]
    if result.status != "ok":
        parts[0] += f" ({result.status_detail})"
    if np.isfinite(result.L_f[0]):
        parts.append(f"L_f = {result.L_f[0]:.4g} m = {result.L_f[0] / radius:.4g} R")
    farthest, at = (result.measured.get(f"runout_max{end}", [np.nan])[0] for end in ("", "_direction"))
    if np.isfinite(farthest):
        parts.append(f"runout up to {farthest:.4g} m, at {at:g} degrees")
    if np.isfinite(result.max_abs_eta).any():
        parts.append(f"peak max|η| = {np.nanmax(result.max_abs_eta):.4g} m")
    if np.isfinite(result.time_at_rest):
        parts.append(f"at rest at {result.time_at_rest:.4g} s")
    parts.append(f"{result.model} ({result.model_reason})")
    if result.grid != "uniform" or result.point.grid == "auto":
        parts.append(f"{result.grid} grid ({result.grid_reason})")
    parts.append(f"{result.steps} steps in {result.wall_seconds:.3g} s")
    return ", ".join(parts)
