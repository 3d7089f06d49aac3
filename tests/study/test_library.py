"""The library: keys in, the data sets of records out, with the checks and messages of a study's file."""

import re
import subprocess
import sys
import warnings

import numpy as np
import pytest
import xarray as xr

import subslide
from subslide import jobs
from subslide.keys.schema import ConfigError
from subslide.library import one_run
from subslide.records import netcdf
from subslide.study.config import make_point

PROGRAM = """import subslide

reveal_type(subslide.solve(a_H=2, r=0.6))
reveal_type(subslide.sweep(a_H=[1, 2], cores=2, folder="results/mine"))
study = subslide.Study.from_yaml("mine.yaml")
reveal_type(len(study))
reveal_type(study.points)
reveal_type(study.run(cores=2))
try:
    subslide.open_study("results/mine")
except (subslide.ConfigError, subslide.BatchError) as error:
    print(error)
"""
"""A user's program."""

SHORT = {"cells": 20, "t_end": 0.05, "a_2": 0.56}


@pytest.fixture(autouse=True)
def _no_caution_of_coarse_grids():
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", "caution, coarse grid", subslide.Caution)
        yield


@pytest.mark.parametrize(
    "keys",
    [
        SHORT,
        {**SHORT, "r": 0},
        {**SHORT, "grid": "fitted"},
        {**SHORT, "delta": 0, "t_end": "rest"},
        {**SHORT, "gauges": [[0.1, 0.0], [0.2, 0.1]], "footprints": True},
    ],
)
def test_the_data_set_of_a_run_is_that_of_its_record(keys, tmp_path):
    """To the bit, attributes and checksum included; also of one that fails."""
    run = jobs.solved(make_point(keys), 1)
    netcdf.write(tmp_path / "one.nc", [run])
    with xr.open_dataset(tmp_path / "one.nc") as data:
        xr.testing.assert_identical(one_run.dataset(run), data.squeeze("run").load())


def test_a_data_set_shows_how_the_run_ended_first_and_its_main_parameters_last():
    data = subslide.solve(**SHORT)
    assert list(data.data_vars)[:3] == ["status", "status_detail", "L_f"]
    assert list(data.coords)[-4:] == ["a_H", "a_2", "r", "delta"]


def test_solve_gives_what_the_command_line_writes(tmp_path):
    words = [f"--{key.replace('_', '-')}={value}" for key, value in SHORT.items()]
    command = [sys.executable, "-m", "subslide", "run", *words, "-o", "one.nc"]
    subprocess.run(command, cwd=tmp_path, check=True, capture_output=True)
    given = {**SHORT, "a_2": np.float64(0.56), "cells": np.array(20)}
    data = subslide.solve(**given)
    with xr.open_dataset(tmp_path / "one.nc") as written:
        same = written.squeeze("run").load()
    for one in (data, same):
        for name in ("wall_seconds", "checksum"):  # the only ones that differ between two equal runs
            del one.attrs[name]
    xr.testing.assert_identical(data.drop_vars("wall_seconds"), same.drop_vars("wall_seconds"))


def test_a_failed_run_is_data():
    with pytest.warns(subslide.Caution, match="little friction"):
        data = subslide.solve(delta=0, cells=20)
    assert str(data.status.values) == data.attrs["status"] == "left_domain"


@pytest.mark.parametrize(
    ("keys", "said"),
    [
        ({"a_h": 1}, "a_h: there is no such key (its value: 1); did you mean 'a_H'?"),
        ({"order": 3}, "order: 3 is not allowed; allowed: one of 1, 2"),
        ({"t_end": -1.0, "cells": 5}, "t_end: -1.0 is not allowed; allowed: rest or a number from 1e-09"),
        ({"a_H": np.array([1, 2])}, "a_H: [1, 2] has 2 values; allowed: one for one run"),
        ({"a_H": np.nan}, "a_H: .nan is not allowed"),
        ({"a_H": None}, "a_H: nothing is not allowed"),
        ({"model": "one-layer"}, "model: one-layer is not allowed with r: 0.4; allowed: only with r: 0"),
        ({"cases": []}, "cases: [] is not allowed for one run"),
    ],
)
def test_bad_keys_are_refused_as_in_a_file_and_nothing_is_solved(keys, said, monkeypatch):
    monkeypatch.setattr(jobs, "solved", lambda *_: pytest.fail("solved"))
    with pytest.raises(ConfigError) as refused:
        subslide.solve(**keys)
    assert str(refused.value).startswith(said)
    assert isinstance(refused.value, ValueError)


def test_a_list_within_itself_is_refused_in_one_line():
    endless = []
    endless.append(endless)
    with pytest.raises(ConfigError, match="solve: a value is within itself"):
        subslide.solve(a_H=endless)


def test_cautions_are_warnings_at_the_line_that_calls():
    with pytest.warns(subslide.Caution, match="caution, range") as said:
        subslide.solve(a_H=20, **SHORT)
    assert {warning.filename for warning in said} == {__file__}


def test_progress_is_told_to_a_function():
    reached = []
    subslide.solve(**SHORT, progress=reached.append)
    assert reached[-1] == pytest.approx(0.05)


def test_the_number_of_threads_of_a_program_stays():
    import numba

    before = numba.get_num_threads()
    subslide.solve(**SHORT)
    assert numba.get_num_threads() == before


def test_help_tells_the_keys_with_their_defaults():
    import inspect

    keys = inspect.signature(subslide.solve).parameters
    assert keys["delta"].default == 32
    assert keys["threads"].default == 1


def test_importing_the_package_loads_nothing_else():
    script = (
        "import sys, subslide; print(*sorted(name for name in sys.modules if name.startswith('subslide')))"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert done.stdout.split() == ["subslide", "subslide._cache", "subslide._early", "subslide._sources"]


def test_the_page_on_the_library_runs(root, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    blocks = re.findall(r"```python\n(.*?)```", (root / "docs/library.md").read_text(), re.DOTALL)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", subslide.Caution)
        exec("".join(blocks), {})


@pytest.mark.long
def test_a_program_that_calls_the_library_is_typed(tmp_path):
    (tmp_path / "mine.py").write_text(PROGRAM)
    words = ["--strict", "--follow-imports=silent", "--no-incremental", "mine.py"]
    done = subprocess.run(
        [sys.executable, "-m", "mypy", *words], cwd=tmp_path, capture_output=True, text=True
    )
    revealed = [
        line.partition("note: ")[2].replace("builtins.", "")
        for line in done.stdout.splitlines()
        if "note: " in line
    ]
    assert done.returncode == 0, done.stdout
    assert revealed == [
        'Revealed type is "xarray.core.dataset.Dataset"',
        'Revealed type is "xarray.core.dataset.Dataset"',
        'Revealed type is "int"',
        'Revealed type is "tuple[subslide.points.Point, ...]"',
        'Revealed type is "xarray.core.dataset.Dataset"',
    ]


def test_type_checkers_see_all_that_the_package_offers():
    """Their file names what `__init__` does, and no more."""
    import ast
    from pathlib import Path

    stub = ast.parse(Path(subslide.__file__).with_suffix(".pyi").read_text(encoding="utf-8"))
    offered = {alias.name for node in stub.body if isinstance(node, ast.ImportFrom) for alias in node.names}
    assert {*offered, "__version__"} == set(subslide.__all__)
    assert set(subslide.__all__) - set(subslide.LAZY) == {"SNAKEFILE", "__version__", "source_hash"}
