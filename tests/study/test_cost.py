"""What points cost, told before they are solved: bounds that runs keep, and limits that say what allows more."""

import subprocess
import sys
import time

import pytest

from subslide import solver
from subslide.__main__ import main
from subslide.keys.schema import ConfigError
from subslide.points import Point
from subslide.study import config, cost, limits


def test_boxes_are_the_solvers():
    assert pytest.approx([solver.GROWTH**n for n in range(len(cost.BOXES))]) == cost.BOXES
    assert cost.BOXES[-1] <= solver.LARGEST_BOX < cost.BOXES[-1] * solver.GROWTH


@pytest.mark.parametrize(
    "values",
    [
        *({"delta": delta, "r": r} for delta in (10, 32) for r in (0, 0.8)),
        *({"t_end": 0.2, "a_H": a_H} for a_H in (0.1, 10)),
        {"delta": 20, "g": 0.05, "radius": 3},
        {"delta": 20, "snapshot_times": [2.0]},
        {"scene": "dam_break", "boundary": "wall", "t_end": 0.1},
        {"model": "quarter", "delta": 8, "cells": 40},
        *({"grid": "fitted", "a_H": a_H, "r": r, "cells": 48} for a_H in (0.5, 10) for r in (0, 0.8)),
        {"grid": "fitted", "delta": 8, "scene": "slab"},
    ],
)
def test_runs_take_the_steps_and_boxes_of_their_estimate_or_less(values):
    point = config.make_point({"cells": 100, **values})
    run, size = solver.solve(point), cost._size(point)
    assert run.steps <= 1.2 * size.steps
    assert size.steps <= 3 * run.steps
    assert size.row >= run.x.shape[-1] - 2


def peak(folder):
    """Most bytes that a process which solves the point of a file has had."""
    code = (
        "from subslide.__main__ import main\n"
        "assert main(['run', '--config', 'p.yaml', '-o', 'x.nc']) == 0\n"
        "print(next(line for line in open('/proc/self/status') if line.startswith('VmHWM')))"
    )
    done = subprocess.run(  # what `wait` tells of a child may be its parent's memory
        [sys.executable, "-c", code], cwd=folder, capture_output=True, text=True, check=True
    )
    return 1024 * int(done.stdout.split("VmHWM:")[1].split()[0])


@pytest.mark.parametrize(
    "values", [{}, {"model": "quarter", "cells": 1000}, {"model": "plane", "cells": 500, "fields": True}]
)
def test_a_process_keeps_to_its_memory(values, tmp_path):
    values = {"t_end": 0.004, "snapshot_times": [0.0], **values}
    point = config.make_point(values)
    solver.solve(point.with_values(cells=20, t_end=0.001))  # kernels are compiled here, not there
    (tmp_path / "p.yaml").write_text(
        "\n".join(f"{key}: {str(value).lower()}" for key, value in values.items())
    )
    used = min(peak(tmp_path), peak(tmp_path))  # another process may have made the first one compile
    assert used <= cost.memory(point) <= 1.7 * used


def test_seconds_go_with_cells_steps_order_and_kernels():
    of = {
        name: cost.seconds(config.make_point({"cells": 400, **values}))
        for name, values in {
            "radial": {},
            "finer": {"cells": 800},
            "first": {"order": 1},
            "roe": {"scheme": "roe"},
            "quarter": {"model": "quarter"},
            "plane": {"model": "plane"},
            "longer": {"t_end": 5.4},
        }.items()
    }
    assert 3.5 < (of["finer"] - cost.START["all"]) / (of["radial"] - cost.START["all"]) < 4.5
    assert of["first"] < of["radial"] < of["roe"] < of["longer"] < of["quarter"]
    assert of["plane"] == pytest.approx(4 * of["quarter"], rel=0.01)


def test_an_estimate_is_told_in_words_and_takes_no_time():
    grains = Point(model="plane", cells=400)
    assert limits.estimate([grains]).words() == (
        f"about {cost.seconds(grains):.3g} core-seconds, {cost.memory(grains) / 1e6:.3g} MB a job,"
        " 1 MB of records and tables"
    )
    hours = limits.Estimate(3, 13_912.7, 2.345e9, 4e9).words()
    assert hours == "about 13,900 core-hours, 2,340 MB a job, 4,000 MB of records and tables"
    points = config.make_study({"study": "t", "a_H": [n / 100 for n in range(1000)]}).points
    start = time.process_time()
    limits.estimate(points)
    assert time.process_time() - start < 0.1


TIMES = ", ".join(f"{n}e-6" for n in range(100))
ABSURD = {
    "t_end: 5e8": "max_core_hours: 100",
    "model: plane\ncells: 9000\nt_end: 1e-4": "max_memory: 8",
    f"model: plane\ncells: 4000\nt_end: 1e-4\nfields: true\nsnapshot_times: [{TIMES}]": "max_memory: 8",
    "a_2: 0.01\ndelta: 0\nr: 0.9999\ncells: 100000\nboundary: wall\na_H: 1000": "max_core_hours: 100",
}


@pytest.mark.parametrize("text", ABSURD, ids=lambda text: repr(text[:20]))
def test_what_costs_too_much_is_refused_and_a_key_allows_it(text, write_yaml, tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    write_yaml(f"study: t\n{text}\n")
    start = time.monotonic()
    for arguments in (("check", "study.yaml"), ("run", "--config", "study.yaml", "-o", "x.nc")):
        assert main([*arguments]) == 2
        out, err = capsys.readouterr()
        assert (out, err.count("\n")) == ("", 1)
        assert ABSURD[text] in err
        assert len(err) <= 301
    assert time.monotonic() - start < 5
    write_yaml(f"study: t\nmax_core_hours: 1e7\nmax_memory: 1e5\nmax_disk: 1e6\n{text}\n")
    assert main(["check", "study.yaml"]) == 0
    assert "core-" in capsys.readouterr().out
    assert not (tmp_path / "x.nc").exists()


def test_a_run_takes_limits_as_options_too(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    quick = ("run", "--cells", "20", "--t-end", "0.02", "-o", "x.nc")
    assert main([*quick, "--max-memory", "0.1"]) == 2
    assert "allowed: up to max_memory: 0.1 (the key, or --max-memory of run, allows more)" in (
        capsys.readouterr().err
    )
    assert main([*quick, "--max-memory", "1"]) == 0
    assert main([*quick, "--max-disk", "0"]) == 2
    assert "--max-disk: 0 is not allowed; allowed: a number from 0.001" in capsys.readouterr().err


def test_many_small_runs_count_together():
    values = {"study": "t", "model": "quarter", "cells": 1000, "a_H": [n / 1000 for n in range(1, 400)]}
    with pytest.raises(ConfigError, match=r"the study needs about [\d,.]+ core-hours; allowed: up to"):
        config.make_study({**values, "max_core_hours": 1})
    assert len(config.make_study(values).points) == 399
