"""Sweeps and studies in a program: processes of their own, one data set, nothing left behind, and nothing lost."""

import os
import signal
import subprocess
import sys
import time
import warnings
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
import yaml
from projects import Project

import subslide
from subslide import jobs
from subslide.keys.schema import ConfigError
from subslide.library import processes
from subslide.results import Results
from subslide.study import locks
from subslide.study.config import make_study

SHORT = {"cells": 20, "t_end": 0.05}
LONG = "a_H={'linspace': [1, 4, 60]}, cells=1600, batch_seconds=5, cores=2"


@pytest.fixture(autouse=True)
def _here(tmp_path, monkeypatch):
    """A folder of its own, temporary folders within, and no cautions."""
    (tmp_path / "temporary").mkdir()
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("TMPDIR", str(tmp_path / "temporary"))
    monkeypatch.setattr("tempfile.tempdir", None)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", subslide.Caution)
        yield


@pytest.fixture
def in_processes(monkeypatch):
    """Also what the program would solve itself, being short, is solved in processes."""
    monkeypatch.setattr(processes, "LEAST", 0)


def script(text, *words, **options):
    """A program of some lines, started."""
    quiet = "import warnings; warnings.simplefilter('ignore', subslide.Caution)"
    Path("mine.py").write_text(f"import subslide\n{quiet}\n{text}\n")
    return subprocess.Popen(
        [sys.executable, "mine.py", *words],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        **options,
    )


def left():
    """What is left in the temporary folder."""
    return [path.name for path in Path("temporary").iterdir()]


def workers():
    """Ids of the processes that solve batches for a program in this folder."""
    here, mine = os.getcwd(), []
    for path in Path("/proc").glob("[0-9]*"):
        try:
            if b"--attended" in (path / "cmdline").read_bytes() and os.readlink(path / "cwd") == here:
                mine.append(int(path.name))
        except OSError:
            continue
    return mine


def wait_until(true, seconds=60):
    """Nothing, once something is true."""
    end = time.monotonic() + seconds
    while not true():
        assert time.monotonic() < end
        time.sleep(0.05)


def test_a_sweep_is_the_product_of_its_lists_and_each_run_is_that_of_solve():
    data = subslide.sweep(a_H=np.array([1.0, 2]), r=range(1), progress=False, **SHORT)
    assert data.sizes["run"] == 2
    assert sorted(data["a_H"].values.tolist()) == [1, 2]
    assert isinstance(data["L_f"].data, np.ndarray)  # held, since its files are gone
    assert left() == []
    one = subslide.solve(a_H=2, r=0, **SHORT)
    run = data.isel(run=int(np.flatnonzero(data["a_H"].values == 2)[0]))
    xr.testing.assert_identical(run["x_front"].dropna("step").drop_vars("run").reset_coords(drop=True),
                                one["x_front"].reset_coords(drop=True))  # fmt: skip


def test_a_program_needs_no_guard_and_its_line_tells_the_points():
    apart = "from subslide.library import processes; processes.LEAST = 0"
    program = script(f"{apart}; print(subslide.sweep(a_H=[1, 2], **{SHORT}).sizes['run'])")
    said, told = program.communicate(timeout=100)
    assert (program.returncode, said) == (0, "2\n")
    assert told.splitlines()[-1].startswith("2 of 2 points")
    assert left() == []


def test_a_folder_is_a_study_that_the_workflow_carries_on():
    values = {"a_H": [1, 2], "r": {"linspace": [0, 0.4, 2]}, **SHORT}
    data = subslide.sweep(folder="results/mine", progress=False, **values)
    Path("mine.yaml").write_text(yaml.safe_dump({"study": "mine", **values}))
    study = subslide.Study.from_yaml("mine.yaml")
    assert len(study) == len(study.points) == 4
    assert "0 to solve, 4 kept" in study.plan()
    xr.testing.assert_identical(study.run(progress=False).load(), data.load())
    wider = subslide.sweep(folder="results/mine", progress=False, **{**values, "a_H": [1, 2, 4]})
    assert wider.sizes["run"] == 6
    assert len(list(Path("results/mine/records").glob("*.nc"))) == 2


def test_numbers_of_runs_whose_batch_was_lost_are_not_given_again():
    values = {"folder": "results/mine", "progress": False, **SHORT}
    subslide.sweep(a_H=[1, 2], **values)
    subslide.sweep(a_H=[1, 2, 3], **values)
    Path("results/mine/batches/0002.json").write_text("{")
    assert subslide.sweep(a_H=[1, 2, 4], **values)["run"].values.tolist() == [1, 2, 4]


@pytest.mark.parametrize(
    ("call", "said"),
    [
        ({"a_h": [1]}, "a_h: there is no such key (its value: [1]); did you mean 'a_H'?"),
        ({"r": [0.4, 2]}, "r: 2 is not allowed"),
        ({"r": []}, "r: [] makes an empty grid"),
        ({"cores": 0}, "cores: 0 is not allowed; allowed: a whole number from 1"),
        ({"cores": True}, "cores: True is not allowed"),
        (
            {"a_H": {"linspace": [0, 1, 101]}, "cells": 100000, "model": "plane"},
            "cells: 100000 is not allowed in",
        ),
    ],
)
def test_bad_input_is_refused_and_nothing_is_written(call, said, monkeypatch):
    for name in ("_solve", "_solve_here"):
        monkeypatch.setattr(processes, name, lambda *_: pytest.fail("started"))
    with pytest.raises(ConfigError) as refused:
        subslide.sweep(folder="results/mine", **call)
    assert str(refused.value).startswith(said)
    assert not Path("results").exists()


def test_a_folder_of_something_else_is_refused_and_left_alone():
    Path("papers").mkdir()
    Path("papers/.mine.tmp").write_text("mine")
    with pytest.raises(ConfigError, match=r"folder: .*papers holds .mine.tmp; allowed: a new folder"):
        subslide.sweep(folder="papers", **SHORT)
    assert [path.name for path in Path("papers").iterdir()] == [".mine.tmp"]
    with pytest.raises(ConfigError, match="folder: / holds .*; allowed: a new folder"):
        subslide.sweep(folder="/", **SHORT)


@pytest.mark.long
def test_the_workflow_makes_tables_and_report_of_a_sweep_and_solves_nothing(root):
    project = Project(root, Path())
    subslide.Study.from_yaml("small.yaml").run(progress=False)
    jobs = project.jobs()
    assert "batch" not in jobs
    assert jobs["report"] == 1
    assert project.jobs() == {}


def test_a_folder_that_another_program_is_at_work_in_is_refused(monkeypatch):
    monkeypatch.setattr(locks, "PATIENCE", 0.1)
    Path("results/mine").mkdir(parents=True)
    with (
        processes._alone(Path("results/mine")),
        pytest.raises(
            ConfigError, match="another program solves a study in .*results/mine; allowed: one at a time"
        ),
    ):
        subslide.sweep(folder="results/mine", **SHORT)
    home = Path(".snakemake/subslide/mine")
    home.mkdir(parents=True)
    program = f"from pathlib import Path; from subslide.study import locks; locks.hold(Path('{home}'));"
    maker = subprocess.Popen(
        [sys.executable, "-c", f"{program} locks.sign(Path('{home}')); print(1, flush=True); input()"],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
    )
    maker.stdout.readline()
    with pytest.raises(ConfigError, match=f"'mine' is being made by another run, process {maker.pid}"):
        subslide.sweep(folder="results/mine", **SHORT)
    maker.communicate(b"\n")


@pytest.mark.usefixtures("in_processes")
def test_a_process_that_fails_is_an_error_that_says_which_and_why(monkeypatch):
    monkeypatch.setenv("NUMBA_THREADING_LAYER", "abacus")
    with pytest.raises(subslide.BatchError) as failed:
        subslide.sweep(**SHORT, progress=False)
    line = "batch 0001 ended with status 2: subslide: NUMBA_THREADING_LAYER: abacus cannot be used"
    assert str(failed.value).startswith(line)
    assert left() == []


@pytest.mark.parametrize("folder", [None, "results/mine"])
def test_an_interrupt_of_a_short_sweep_keeps_what_was_solved_in_its_folder(folder, monkeypatch):
    solved, calls = jobs.solved, []

    def interrupted(*arguments, **keys):
        calls.append(arguments)
        if len(calls) == 2:
            raise KeyboardInterrupt
        return solved(*arguments, **keys)

    monkeypatch.setattr(jobs, "solved", interrupted)
    with pytest.raises(KeyboardInterrupt):
        subslide.sweep(a_H=[1, 2, 4], folder=folder, progress=False, **SHORT)
    assert left() == []
    assert [path.stem for path in Path().rglob("records/*.nc")] == ["0001p1"] * (folder is not None)


def test_a_sweep_too_large_to_be_held_is_lazy_as_long_as_the_program_lasts():
    small = "from subslide.library import studies; studies.MOST_HELD = 0"
    program = script(f"{small}; print(float(subslide.sweep(**{SHORT}, progress=False).L_f.max()) > 0)")
    assert program.communicate(timeout=100) == ("True\n", "")
    assert left() == []


@pytest.mark.long
def test_a_process_that_is_killed_is_one_too():
    code = f"try: subslide.sweep({LONG})\nexcept subslide.BatchError as error: print(error, flush=True)"
    program = script(code)
    wait_until(lambda: len(workers()) == 2)
    os.kill(min(workers()), signal.SIGKILL)
    said = program.communicate(timeout=100)[0]
    assert said.startswith("batch 000")
    assert "was ended by signal 9" in said
    assert workers() == left() == []


@pytest.mark.usefixtures("signals_of_a_terminal")
def test_an_interrupt_ends_all_and_a_folder_keeps_what_was_solved():
    program = script(f"subslide.sweep({LONG}, folder='results/mine')", start_new_session=True)
    ended = Path("results/mine/logs").glob
    wait_until(lambda: any(log.stat().st_size for log in ended("*.log")))  # a run has ended
    program.send_signal(signal.SIGINT)
    told = program.communicate(timeout=100)[1]
    assert program.returncode == -signal.SIGINT
    assert "KeyboardInterrupt" in told
    assert workers() == left() == []
    parts = [path.stem for path in Path("results/mine/batches").glob("*.json")]
    assert parts
    assert all("p" in name and Path(f"results/mine/records/{name}.nc").exists() for name in parts)
    assert not list(Path("results/mine").rglob("*.tmp"))


@pytest.mark.long
def test_processes_end_with_the_program_that_started_them():
    program = script(f"subslide.sweep({LONG}, folder='results/mine')")
    wait_until(lambda: len(workers()) == 2)
    program.kill()
    program.communicate()
    wait_until(lambda: not workers(), 20)


def test_the_line_says_while_kernels_are_compiled(tmp_path):
    from subslide.solver import loop

    log = tmp_path / "batch.log"
    for text, compiles in (
        ("", False),
        (f"{loop.COMPILING}\n", True),
        (f"{loop.COMPILING}\np1: ok\n", False),
    ):
        log.write_text(text)
        assert processes._compiles(log) == compiles


def test_a_study_shows_its_axes():
    study = subslide.Study.from_dict({"study": "mine", "a_H": [1, 2], "delta": 25, "friction": "voellmy"})
    assert repr(study) == "Study 'mine': 2 runs over a_H (1, 2)"
    page = study._repr_html_()
    assert "<code>a_H</code></td><td>2</td>" in page
    assert "25 degree" in page
    assert "core-seconds" in page


def test_results_show_their_axes_and_how_runs_ended(solve_study, make_run, write_tables):
    study = make_study({"study": "mine", "a_H": [1, 2]})
    solve_study(study, Path("mine"), lambda points: [make_run(point) for point in points])
    assert "tables" not in Results("mine")._repr_html_()
    write_tables(Path("mine"))
    page = Results("mine")._repr_html_()
    assert "<td>1, 2 </td>" in page.replace(" style='text-align:left'", "")
    assert "<div>2 ok</div><div>tables: runs.csv, runs_varied.csv, series.csv, timing.csv</div>" in page
    assert repr(Results("nowhere")) == "Results('nowhere')"
    assert Results("nowhere")._repr_html_() is None


def test_a_notebook_gets_one_line_that_is_drawn_again(monkeypatch, capsys):
    cell = processes.Cell()
    cell.write("\rlonger line\033[K")
    cell.write("\rline\033[K\n")
    assert capsys.readouterr().out == "\rlonger line\rline       \n"
