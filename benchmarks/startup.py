"""What a run costs before its time loop: new processes, with compiled kernels at hand or without."""

import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from table import rows_of
from timing import spread

IMPORTS = "import subslide.__main__, subslide.jobs, subslide.solver, subslide.records, os; os._exit(0)"


def seconds_of(command, **environment):
    """Return the wall time of a command; ValueError with its message where it fails."""
    started = time.perf_counter()
    done = subprocess.run(command, env=os.environ | environment, capture_output=True, text=True, check=False)
    wall = time.perf_counter() - started
    if done.returncode:
        raise ValueError(f"{' '.join(command)} failed: {done.stderr.strip().splitlines()[-1:]}")
    return wall


def start_up(rounds):
    """Return rows: wall time of `subslide run` of the default radial point, and of its parts, in new processes."""
    rows = []
    with tempfile.TemporaryDirectory(prefix="subslide-bench-") as folder:
        record = str(Path(folder) / "run.nc")
        commands = {
            "start_up_python": [sys.executable, "-c", "pass"],
            "start_up_imports": [sys.executable, "-c", IMPORTS],
            "start_up_run": [sys.executable, "-m", "subslide", "run", "--model", "radial", "-o", record],
        }
        seconds_of(commands["start_up_run"])
        measured = {name: [] for name in commands}
        for _ in range(rounds):
            for name, command in commands.items():
                measured[name].append(seconds_of(command))
    for name, values in measured.items():
        rows += rows_of("start_up", name, spread(values), "s", model="radial")
    pairs = zip(measured["start_up_imports"], measured["start_up_run"], strict=True)
    rows += rows_of("start_up", "import_share", spread([a / b for a, b in pairs]), model="radial")
    return rows


def compile_times(dtypes, models=("radial", "plane")):
    """Return rows: wall time of a new process that compiles a model's kernels into the present cache folder.

    One model stands for its like: radial for one-layer, plane for quarter. Both orders and all schemes are compiled
    together.
    """
    rows = []
    for model in models:
        for dtype in dtypes:
            command = [sys.executable, "-m", "subslide", "warm", f"{model}:{dtype}"]
            cold, warm = seconds_of(command), seconds_of(command)
            about = {"model": model, "dtype": dtype}
            rows += rows_of("compile", "cold", cold, "s", **about)
            rows += rows_of("compile", "warm", warm, "s", **about)
    return rows
