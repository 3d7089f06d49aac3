"""What a study would cost, told before it runs; and what it needs no more, which goes only when that is asked for."""

import pytest

from subslide.__main__ import main
from subslide.study import config, outlook, plan

TEXT = "study: t\nmodel: radial\ncells: 40\na_H: {}\n"


@pytest.fixture
def solved(solve_study, make_run, tmp_path, monkeypatch, write_yaml):
    """A study of two batches, [1, 2] and [3], of which the file asks for 3 alone now."""
    monkeypatch.chdir(tmp_path)
    for axis in ([1, 2], [1, 2, 3]):
        study = config.read_study(write_yaml(TEXT.format(axis)))
        solve_study(study, tmp_path / "results/t", lambda points: [make_run(point) for point in points])
    write_yaml(TEXT.format([3]))
    return tmp_path / "results/t"


def files(folder):
    return {path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file()}


def test_removing_points_removes_no_file_unless_that_is_asked_for(solved, capsys):
    before = files(solved)
    assert list(plan.plan(config.read_study("study.yaml"), solved).batches) == ["0002"]
    assert files(solved) == before
    (solved / "records/notes.nc").write_text("mine")
    (solved / "records/0007.nc").write_bytes(b"of no batch")
    freed = sum((solved / name).stat().st_size for name in before if "0001" in name) + 11
    assert main(["prune", "study.yaml"]) == 0
    assert capsys.readouterr().out == f"study 't': 2 batches removed, {freed / 1e6:.3g} MB freed\n"
    assert files(solved) == {name for name in before if "0001" not in name} | {
        "records/notes.nc",
        "batches/next_run",
    }
    assert main(["prune", "study.yaml"]) == 0
    assert capsys.readouterr().out == "study 't': 0 batches removed, 0 MB freed\n"


def test_a_batch_of_which_one_point_is_asked_for_stays(solved, write_yaml):
    write_yaml(TEXT.format([2, 3]))
    before = files(solved)
    assert main(["prune", "study.yaml"]) == 0
    assert files(solved) == before


def test_the_outlook_counts_what_is_new_and_writes_nothing(solved, write_yaml, tmp_path, capsys):
    write_yaml(TEXT.format("{linspace: [1, 10, 10]}") + "bands: true\nr: [0, 0.4]\n")
    before = files(tmp_path)
    assert main(["plan", "study.yaml", "--cores", "3"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == "study 't': 20 runs and 40 companions for bands: 57 to solve, 3 kept"
    assert lines[1] == "  57 with kernels radial:float64"
    assert "3 batches (keep: all), about 0." in lines[2]
    assert " s on 3 cores beside tables and figures; jobs ask for up to 1,000 MB" in lines[2]
    assert files(tmp_path) == before


def test_jobs_in_order_take_as_long_as_the_busiest_core():
    assert outlook.wall([10, 6, 5, 3], 2) == pytest.approx(13 + 2 * outlook.PROCESS)
