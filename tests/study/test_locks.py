"""Locks of a study: a dead run's lock of Snakemake is removed, a living one's is not, and its jobs are waited for."""

import fcntl
import os
import shutil
import subprocess
import sys
import threading
import time

import pytest

from subslide.__main__ import main
from subslide.study import locks

HOLD = """
import sys, time
from pathlib import Path
from subslide.study import locks
locks.hold(Path(sys.argv[1]))
locks.sign(Path(sys.argv[1]))
print("held", flush=True)
time.sleep(60)
"""


@pytest.fixture
def cache(tmp_path, monkeypatch):
    """A folder `.snakemake` with the locks of two studies, the first of which was made by a run that was killed."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(locks, "PATIENCE", 0.5)
    cache = tmp_path / ".snakemake"
    for name in ("locks", "subslide/one", "subslide/two"):
        (cache / name).mkdir(parents=True)
    (cache / "subslide/one/alive").write_text("1\n")
    (cache / "locks/0.output.lock").write_text("results/one/records/0001.nc\nresults/one/report.html\n")
    (cache / "locks/0.input.lock").write_text("workflow/report/runs.rst\nresults/one/records/0001.nc\n")
    (cache / "locks/1.output.lock").write_text("results/two/report.html\n")
    (tmp_path / "one.yaml").write_text("study: one\nmodel: radial\ncells: 20\n")
    return cache


def left(cache):
    """Names of the locks that are there."""
    return sorted(path.name for path in (cache / "locks").iterdir())


def test_the_lock_of_a_dead_run_goes_and_that_of_another_study_stays(cache, capsys):
    assert main(["unlock", "one.yaml"]) == 0
    assert left(cache) == ["1.output.lock"]
    assert capsys.readouterr() == ("", "")
    assert main(["unlock", "one.yaml"]) == 0


def test_a_lock_goes_though_all_else_is_gone_and_if_it_cannot_be_read(cache):
    """The version before this one held no lock of the system; a full disk leaves any bytes."""
    shutil.rmtree(cache / "subslide")
    (cache / "locks/2.output.lock").write_bytes(b"\xff\xfe")
    assert main(["unlock", "one.yaml"]) == 0
    assert left(cache) == ["1.output.lock"]


def test_a_living_run_keeps_its_lock_until_it_is_killed(cache, capsys):
    command = [sys.executable, "-c", HOLD, str(cache / "subslide/one")]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as holder:
        holder.stdout.readline()
        assert main(["unlock", "one.yaml"]) == 2
        assert capsys.readouterr().err == (
            f"subslide: study: 'one' is being made by another run, process {holder.pid}; allowed: one run at a time\n"
        )
        assert len(left(cache)) == 3
        holder.kill()
    assert main(["unlock", "one.yaml"]) == 0
    assert left(cache) == ["1.output.lock"]


def test_jobs_that_outlive_their_run_are_waited_for(cache, tmp_path, capsys):
    records = tmp_path / "results/one/records"
    records.mkdir(parents=True)
    handle = os.open(records, os.O_RDONLY)
    fcntl.flock(handle, fcntl.LOCK_SH)
    threading.Timer(1.0, os.close, [handle]).start()
    started = time.monotonic()
    assert main(["unlock", "one.yaml"]) == 0
    assert time.monotonic() - started > 0.8
    assert capsys.readouterr().err.startswith("waiting for the jobs of a killed run")
    assert left(cache) == ["1.output.lock"]


def test_a_job_holds_the_folder_of_records(tmp_path):
    with locks.at_work(tmp_path):
        handle = os.open(tmp_path, os.O_RDONLY)
        with pytest.raises(BlockingIOError):
            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    os.close(handle)


def test_a_folder_with_a_backslash_is_refused_before_anything_is_made(tmp_path, monkeypatch, capsys):
    (tmp_path / "a\\b").mkdir()
    monkeypatch.chdir(tmp_path / "a\\b")
    (tmp_path / "a\\b/one.yaml").write_text("study: one\nmodel: radial\ncells: 20\n")
    assert main(["unlock", "one.yaml"]) == 2
    assert "a backslash in the path of a study" in capsys.readouterr().err


def test_what_snakemake_cannot_read_is_forgotten(cache):
    for name, content in (
        ("a", b'{"rule": "batch"}'),
        ("b", b"\xff"),
        ("c", b""),
        ("d", b"[1]"),
        ("e/f", b"{"),
    ):
        path = cache / "metadata" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)
    assert main(["unlock", "one.yaml"]) == 0
    assert sorted(path.name for path in (cache / "metadata").rglob("*") if path.is_file()) == ["a"]


def test_nothing_is_done_where_nothing_was_made(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "one.yaml").write_text("study: one\nmodel: radial\ncells: 20\n")
    assert main(["unlock", "one.yaml"]) == 0
    assert [path.name for path in tmp_path.iterdir()] == ["one.yaml"]
