"""A long run that is killed goes on from what was saved of it, to the bits of one that was never stopped."""

import dataclasses
import os
import signal
import subprocess
import sys
import time

import numpy as np
import pytest

from subslide import jobs, solver
from subslide.points import Point
from subslide.solver import checkpoint, loop
from subslide.solver.checkpoint import Keeper
from subslide.study import batches, plan, staging

WATCHED = {"gauges": ((0.1, 0.05), (0.0, 0.0)), "footprints": True, "runout_directions": 4}
RUNS = {
    "radial, on a sea that grows": Point(cells=40, a_2=1.5, delta=20.0),
    "radial, float32": Point(cells=40, dtype="float32", snapshot_times=(0.0, 0.1, 0.2)),
    "radial, in a box that grows": Point(cells=40, a_2=1.5, delta=12.0, boundary="paper"),
    "a fitted grid": Point(cells=32, grid="fitted", quantities="grains", snapshot_times=(0.1,)),
    "one layer": Point(cells=40, r=0.0, model="one-layer"),
    "a quarter": Point(cells=40, model="quarter", snapshot_times=(0.02, 0.2), fields=True, t_end=0.25),
    "the plane, first order": Point(cells=20, model="plane", order=1, snapshot_times=(0.1,), t_end=0.3),
    "watched on a sea that grows": Point(cells=40, a_2=1.5, delta=20.0, **WATCHED),
    "a watched quarter": Point(cells=40, model="quarter", snapshot_times=(), t_end=0.2, **WATCHED),
    "a line, its ends joined": Point(cells=40, scene="shear", boundary="periodic", t_end=0.3),
}


def same(run, other):
    """Whether two runs are the same to the bit, but for the seconds that they took."""
    for field in dataclasses.fields(run):
        if field.name == "wall_seconds":
            continue
        mine, others = getattr(run, field.name), getattr(other, field.name)
        parts = [(mine, others)] if not isinstance(mine, dict) else [(mine[k], others[k]) for k in mine]
        for one, two in parts:
            if isinstance(one, np.ndarray):
                assert one.dtype == two.dtype
                np.testing.assert_array_equal(one, two, err_msg=field.name, strict=True)
            else:
                assert one == two or (one != one and two != two), field.name
    return True


@pytest.fixture
def saving(monkeypatch):
    """Runs that are saved at every look, and look often."""
    monkeypatch.setattr(checkpoint, "EVERY", 0.0)
    monkeypatch.setattr(loop, "CHUNK", 3)
    monkeypatch.setattr(loop, "FEWEST", 3)


class Killed(BaseException):
    """What stands for the end of a process."""


@pytest.mark.parametrize("name", RUNS)
def test_a_killed_run_goes_on_to_the_same_bits(name, tmp_path, saving):
    point, looks = RUNS[name], []
    whole = solver.solve(point, progress=looks.append)
    places = np.random.default_rng(13).choice(len(looks) - 1, 3, replace=False) + 1
    for place in sorted(looks[place] for place in places):

        def kill(now, place=place):
            if now >= place:
                raise Killed

        with pytest.raises(Killed):
            solver.solve(point, progress=kill, keeper=Keeper(tmp_path, "1", [point]))
    saved = Keeper(tmp_path, "1", [point]).under_way(point)
    assert len(saved.samples) > 1
    again = []
    assert same(solver.solve(point, progress=again.append, keeper=Keeper(tmp_path, "1", [point])), whole)
    assert len(again) < len(looks)
    assert whole.box_half_width > 1.4 * point.half_cells * point.dx or "box that grows" not in name


@pytest.mark.parametrize("keep", ["all", "summary"])
def test_runs_that_ended_are_kept_to_the_bit(tmp_path, saving, keep):
    points = [Point(cells=20, a_H=a_H, **more) for a_H in (1, 2) for more in ({}, WATCHED)]
    runs = [jobs.solved(point, 1, keep=keep) for point in points]
    keeper = Keeper(tmp_path, "0001", points, keep)
    for run in runs:
        keeper.add(run)
    assert Keeper(tmp_path, "0001", points, "series").take(points[0]) is None
    after = Keeper(tmp_path, "0001", points, keep)
    assert all(same(after.take(point), run) for point, run in zip(points, runs, strict=True))
    after.forget()
    assert not tmp_path.exists()


@pytest.mark.parametrize("harm", ["cut", "flipped", "empty", "of other sources", "of another point"])
def test_a_state_that_is_not_whole_counts_as_none(tmp_path, saving, monkeypatch, harm):
    point, other = Point(cells=20), Point(cells=20, a_H=2.0)
    whole = solver.solve(point, keeper=Keeper(tmp_path, "1", [point]))
    path = tmp_path / f"{point.id}.npz"
    data = bytearray(path.read_bytes())
    if harm == "cut":
        data = data[: len(data) // 2]
    elif harm == "flipped":
        data[len(data) // 3] ^= 1
    elif harm == "empty":
        data = b""
    elif harm == "of other sources":
        monkeypatch.setattr(checkpoint, "source_hash", lambda: "0123456789ab")
    path.write_bytes(data)
    asked = other if harm == "of another point" else point
    path.rename(tmp_path / f"{asked.id}.npz")
    assert Keeper(tmp_path, "1", [asked]).under_way(asked) is None
    assert harm == "of another point" or same(
        solver.solve(point, keeper=Keeper(tmp_path, "1", [point])), whole
    )


def test_runs_that_ended_are_taken_by_whatever_batch_has_them_next(tmp_path, saving):
    """A plan after a kill has other numbers, and other batches, as soon as one of those begun with has ended."""
    points = [Point(cells=20, a_H=a_H) for a_H in (1, 2, 3)]
    runs = [jobs.solved(point, 1) for point in points]
    killed = Keeper(tmp_path / "records" / staging.UNFINISHED, "0001", points)
    (tmp_path / "records").mkdir()
    killed._unsaved = runs[:2]
    killed.save()
    staging.forget(
        tmp_path, [plan.Batch("0007", tuple(points[1:]), ""), plan.Batch("0008", (points[0],), "")]
    )
    first, second = (Keeper(killed.folder, *what) for what in (("0007", points[1:]), ("0008", points[:1])))
    assert same(first.take(points[1]), runs[1])
    assert first.take(points[2]) is None
    first.add(runs[2])
    first.forget()
    assert same(second.take(points[0]), runs[0])
    assert {path.name for path in killed.folder.iterdir()} == {"batch-0001-0000.npz"}
    second.forget()
    staging.forget(tmp_path, [])
    assert not killed.folder.exists()


def test_what_no_batch_is_to_solve_is_forgotten(tmp_path, saving):
    """But not a run that another batch solves now, as after its batch was stopped and kept what it had."""
    points = [Point(cells=20), Point(cells=20, a_H=2.0), Point(cells=20, a_H=3.0)]
    folder = tmp_path / "records" / staging.UNFINISHED
    folder.parent.mkdir()
    keeper = Keeper(folder, "0001", points)
    keeper.add(jobs.solved(points[0], 1, keeper=keeper))
    for point in points[1:]:
        jobs.solved(point, 1, keeper=keeper)
    states = {f"{point.id}.npz" for point in points[1:]}
    assert {path.name for path in folder.iterdir()} == states | {"batch-0001-0000.npz"}
    staging.forget(tmp_path, [plan.Batch("0002", tuple(points[1:2]), "")])
    assert {path.name for path in folder.iterdir()} == {f"{points[1].id}.npz"}


def test_a_disk_that_refuses_ends_no_run(tmp_path, saving, capsys):
    (tmp_path / "taken").write_text("")
    point = Point(cells=20)
    assert same(solver.solve(point, keeper=Keeper(tmp_path / "taken", "1", [point])), solver.solve(point))
    assert "the state of a long run cannot be kept" in capsys.readouterr().out


SOLVING = """
import sys
from subslide import jobs
from subslide.solver import checkpoint, loop
checkpoint.EVERY, loop.CHUNK = 0.05, 50
jobs.batch("spec.json", 1, "records/0001.nc", "batches/0001.json", lambda line: print(line, flush=True))
"""


def test_a_batch_goes_on_after_sigkill(tmp_path):
    """Killed twice: what ended is not solved again, and the record is that of a batch that was left alone."""
    from subslide.records import netcdf

    points = [Point(cells=1600, a_H=a_H) for a_H in (1, 2, 3, 4)]
    for folder in (tmp_path / "killed", tmp_path / "alone"):
        for name in ("records", "batches"):
            (folder / name).mkdir(parents=True)
        (folder / "spec.json").write_text(batches.spec_text(points))
    words = [sys.executable, "-c", SOLVING]
    for ended in (1, 2):
        with subprocess.Popen(words, cwd=tmp_path / "killed", stdout=subprocess.PIPE, text=True) as job:
            until = time.monotonic() + 60
            while len(list(tmp_path.glob("killed/records/.unfinished/batch-0001-*.npz"))) < ended:
                assert time.monotonic() < until
                time.sleep(0.01)
            os.kill(job.pid, signal.SIGKILL)
        assert not (tmp_path / "killed/records/0001.nc").exists()
    for folder in ("killed", "alone"):
        subprocess.run(words, cwd=tmp_path / folder, check=True, timeout=60, stdout=subprocess.DEVNULL)
    assert not list(tmp_path.glob("killed/records/.unfinished/*.npz"))
    killed, alone = (netcdf.read(tmp_path / folder / "records/0001.nc")[0] for folder in ("killed", "alone"))
    assert {"id", "x_front", "h2"} < set(killed) == set(alone)
    for name in set(killed) - {"wall_seconds"}:
        np.testing.assert_array_equal(killed[name].values, alone[name].values, err_msg=name)
