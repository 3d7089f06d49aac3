"""A batch that is stopped or fails keeps the points that it has solved, where the next plan finds them."""

import signal
import subprocess
import sys

import pytest

from subslide import checksums, jobs
from subslide.files import Stopped
from subslide.records import netcdf
from subslide.study import batches, config, plan

pytestmark = pytest.mark.usefixtures("signals_of_a_terminal")

AXES = {"a_H": [n / 4 for n in range(1, 41)], "model": "radial", "cells": 1600, "t_end": 0.5}


@pytest.fixture
def study(tmp_path):
    """A study whose only batch stands in a file, and the folders for its record."""
    asked = config.make_study({"study": "t", **AXES})
    for name in ("records", "batches"):
        (tmp_path / name).mkdir()
    (tmp_path / "spec.json").write_text(batches.spec_text(asked.points))
    return asked


def left(study, folder):
    """Number of points that the next plan solves."""
    return sum(len(batch.points) for batch in plan.plan(study, folder).batches.values() if batch.text)


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT, signal.SIGHUP])
def test_what_a_stopped_job_has_solved_is_kept(study, tmp_path, number):
    words = ["spec.json", "-o", "records/0007.nc", "--ledger", "batches/0007.json"]
    with subprocess.Popen(
        [sys.executable, "-m", "subslide", "batch", *words],
        cwd=tmp_path,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    ) as job:
        for _ in range(3):
            job.stdout.readline()
        job.send_signal(number)
        _, said = job.communicate(timeout=60)
    assert job.returncode == 128 + number
    kept = len(checked_ids(tmp_path / "records/0007p1.nc"))
    assert 3 <= kept < len(study.points)
    assert (
        said.splitlines()[-1]
        == f"subslide: stopped: the {kept} runs that were solved are kept as batch 0007p1"
    )
    assert sorted(path.name for path in tmp_path.rglob("*") if path.is_file()) == [
        *("0007p1.json", "0007p1.nc", "0007p1.nc.sha256", "spec.json"),
    ]
    assert left(study, tmp_path) == len(study.points) - kept


def checked_ids(record):
    """Ids of the runs of a record that is whole."""
    checksums.verify(record)
    return netcdf.read(record)[0]["id"].values.tolist()


def test_what_a_failed_job_has_solved_is_kept(study, tmp_path, monkeypatch, make_run):
    """Twice: parts have numbers, and each is a batch; one whose record's name is taken is left out."""

    failing = set()
    (tmp_path / "records/0001p2.nc").write_bytes(b"mine")

    def solve(point, threads, **rest):
        if point.a_H in failing:
            raise MemoryError
        return make_run(point)

    monkeypatch.setattr(jobs, "solved", solve)
    paths = [str(tmp_path / name) for name in ("spec.json", "records/0001.nc", "batches/0001.json")]
    lines = []
    for a_H in (1.0, 0.75):
        failing.add(a_H)
        with pytest.raises(MemoryError):
            jobs.batch(paths[0], 1, paths[1], paths[2], lines.append)
    assert lines[-1] == "stopped: the 2 runs that were solved are kept as batch 0001p3"
    assert (tmp_path / "records/0001p2.nc").read_bytes() == b"mine"
    assert left(study, tmp_path) == len(study.points) - 3
    failing.clear()
    jobs.batch(paths[0], 1, paths[1], paths[2], lines.append)
    assert left(study, tmp_path) == 0


def test_what_is_left_of_a_part_that_is_solved_again_is_a_part_too(tmp_path):
    """A name such as 0007p2p1 is none of a batch, and what 0007p2 names goes when its job is stopped."""
    (tmp_path / "0007p1.json").touch()
    kept = jobs.unused_part(str(tmp_path / "0007p2.json"), str(tmp_path / "0007p2.nc"))
    assert [path.name for path in kept] == ["0007p3.json", "0007p3.nc"]
    assert all(plan.NAME.fullmatch(path.stem) for path in kept)


def test_a_job_that_has_solved_nothing_leaves_nothing(study, tmp_path, monkeypatch):
    def solve(point, threads, **rest):
        raise Stopped(signal.SIGTERM)

    monkeypatch.setattr(jobs, "solved", solve)
    with pytest.raises(Stopped, match="nothing was written"):
        jobs.batch(
            str(tmp_path / "spec.json"), 1, str(tmp_path / "records/1.nc"), str(tmp_path / "b.json"), print
        )
    assert [path.name for path in tmp_path.rglob("*") if path.is_file()] == ["spec.json"]
