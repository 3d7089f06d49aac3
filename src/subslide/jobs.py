"""What the solving verbs of the command line do: one run, a batch, compiled kernels.

Only numpy, numba and netCDF4 are imported here, and late: start-up is most of a radial run's time.
"""

import hashlib
import json
import os
import sys
from collections.abc import Iterator
from pathlib import Path

from subslide import scenes
from subslide.files import write_text
from subslide.keys import schema
from subslide.keys.schema import ConfigError
from subslide.points import Point, from_dict
from subslide.study import config, scene_options
from subslide.study.choice import model_reason
from subslide.study.yaml_files import read_yaml


def point_of(path: str | None, options: dict[str, str]) -> Point:
    """Return the point of a configuration file and of options.

    Parameters
    ----------
    path
        YAML file of one point, or None.
    options
        Texts by key; they win over the file.

    Raises
    ------
    ConfigError
        If a key or value is not allowed, or the point is no run.
    """
    values = read_yaml(path) if path else {}
    names = {key: f"{path}: {key}" for key in values}
    for key, text in options.items():
        mapping = key == "scene_options"
        values[key] = scene_options.of_text(text, _value_of_text) if mapping else _value_of_text(text)
        names[key] = "--" + key.replace("_", "-")
    if isinstance(values.get("snapshot_times"), int | float):
        values["snapshot_times"] = [values["snapshot_times"]]
    return config.make_point(values, names)


def check_output(path: str, inputs: list[str]) -> None:
    """Raise ConfigError unless a file can be written at `path`, which is none of the inputs."""
    target = Path(path)
    folder = target.parent
    if target.is_dir():
        raise ConfigError(f"--output: {path} is a folder; allowed: the path of a file")
    if not folder.is_dir():
        raise ConfigError(f"--output: {path}: the folder {folder} does not exist")
    if any(target.exists() and target.samefile(other) for other in inputs if os.path.exists(other)):
        raise ConfigError(f"--output: {path} is the input; allowed: the path of another file")
    probe = folder / f".{target.name}.{os.getpid()}.probe"
    try:
        probe.touch(exist_ok=False)
        probe.unlink()
    except OSError as error:
        raise ConfigError(f"--output: {path} cannot be written: {error.strerror}") from None


def set_threads(threads: int) -> None:
    """Make numba use this many threads, unless it is loaded: then the number is settled, and `solve` stays within."""
    if "numba" not in sys.modules:
        os.environ["NUMBA_NUM_THREADS"] = str(threads)


def run(point: Point, threads: int, output: str) -> str:
    """Solve a run, write its record to `output`, and return the line that tells its outcome."""
    from subslide import solver
    from subslide.records import netcdf as records

    result = solver.solve(point, threads=threads, progress=_progress() if sys.stderr.isatty() else None)
    records.write(output, [result])
    return f"{summary(result)} -> {output}"


def batch(spec: str, threads: int, output: str) -> Iterator[str]:
    """Solve a batch file into a record at `output`, its SHA-256 in `output`.sha256; give a line as each run ends."""
    from subslide import solver
    from subslide.records import netcdf as records
    from subslide.records import thinning

    points = read_batch(spec)
    results = []
    for point in points:
        results.append(thinning.thinned(solver.solve(point, threads=threads)))
        yield summary(results[-1])
    Path(output + ".sha256").unlink(missing_ok=True)
    records.write(output, results)
    write_text(output + ".sha256", f"{file_hash(output)}  {Path(output).name}\n")
    yield f"{len(results)} runs -> {output}"


def read_batch(spec: str) -> list[Point]:
    """Return the points of a batch file, each checked against its id; ConfigError if it is none."""
    try:
        rows = json.loads(Path(spec).read_text(encoding="utf-8"))["points"]
        points = {row.pop("id"): from_dict(row) for row in rows}
    except FileNotFoundError:
        raise ConfigError(f"{spec}: there is no such file") from None
    except (OSError, ValueError, KeyError, TypeError, AttributeError) as error:
        raise ConfigError(f"{spec}: not a batch file ({type(error).__name__}: {error})") from None
    for name, point in points.items():
        if point.id != name:
            raise ConfigError(f"{spec}: the values of {name} belong to {point.id}; was the file edited?")
        try:
            scenes.check(point)
        except scenes.SceneError as error:
            raise ConfigError(f"{spec}: {name}: {error}") from None
    return list(points.values())


def warm(kernels: tuple[str, ...]) -> Iterator[str]:
    """Compile kernels, 'model:dtype[:general]', into the cache by solving a tiny run each; give a line for each."""
    from subslide import solver

    for kernel in kernels:
        model, *others = kernel.split(":")
        dtype, general = (*others, "", "")[:2]
        if general not in ("", "general"):
            raise ConfigError(f"kernel: {kernel} is not allowed; allowed: MODEL:DTYPE or MODEL:DTYPE:general")
        values = {
            "model": schema.checked("model", model),
            "dtype": schema.checked("dtype", dtype or "float64"),
        }
        scene = {"scene": "dam_break", "boundary": "wall"} if model == "line" else {}
        scheme = "roe" if general else "ifcph"
        solver.solve(
            config.make_point({"r": 0, "cells": 20, "t_end": 0.01, "scheme": scheme, **scene, **values})
        )
        yield f"compiled {kernel}"


def file_hash(path: Path | str) -> str:
    """Return the SHA-256 (hex) of a file's bytes, as `sha256sum` prints it."""
    with open(path, "rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def summary(result) -> str:
    """Return one line on a solved run: id, status, deposit, surface, model, steps and time."""
    import numpy as np

    radius = result.point.radius
    parts = [f"{result.point.id}: {result.status}"]
    if result.status != "ok":
        parts[0] += f" ({result.status_detail})"
    if np.isfinite(result.L_f[0]):
        parts.append(f"L_f = {result.L_f[0]:.4g} m = {result.L_f[0] / radius:.4g} R")
    if np.isfinite(result.max_abs_eta).any():
        parts.append(f"peak max|η| = {np.nanmax(result.max_abs_eta):.4g} m")
    if np.isfinite(result.time_at_rest):
        parts.append(f"at rest at {result.time_at_rest:.4g} s")
    parts.append(
        f"{result.model} ({model_reason(result.point)}), {result.steps} steps in {result.wall_seconds:.3g} s"
    )
    return ", ".join(parts)


def _value_of_text(text):
    """Return the number, list of numbers or text that the text of an option stands for."""
    if not isinstance(text, str):
        return text
    if "," in text:
        return [_value_of_text(part.strip()) for part in text.split(",")]
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            continue
    return text


def _progress():
    """Return a function that shows the fraction done on the terminal, once a run has taken a while."""
    import time

    start = last = time.monotonic()

    def show(fraction: float) -> None:
        nonlocal last
        now = time.monotonic()
        if now - start > 2 and now - last > 0.5:
            last = now
            print(f"\r{fraction:4.0%} ", end="\r", file=sys.stderr, flush=True)

    return show
