"""What happens to a study between two calls: damage is found, named and mended, and nothing else is done again."""

import json
import os
import shutil

import pytest
from projects import STUDY, TABLES, Project

from subslide import checksums
from subslide.__main__ import main

pytestmark = pytest.mark.xdist_group("damage")

AGAIN = {"batch": 1, **TABLES, "report": 1}


@pytest.fixture(scope="module")
def finished(root, tmp_path_factory):
    """A finished study; tests get copies of it."""
    project = Project(root, tmp_path_factory.mktemp("whole"))
    project.snakemake()
    return project


@pytest.fixture
def project(finished, tmp_path):
    """A copy of the finished study, with times of files kept."""
    return finished.copy(tmp_path / "copy")


def kept_time(path, content):
    """Give a file other bytes and leave its time as it was."""
    times = path.stat()
    path.write_bytes(content)
    os.utime(path, ns=(times.st_atime_ns, times.st_mtime_ns))


def flipped(path):
    """Flip one bit in the middle of a file, its time kept."""
    content = bytearray(path.read_bytes())
    content[len(content) // 2] ^= 1
    kept_time(path, bytes(content))


def files(project):
    """Bytes and times of every file of the project but those that Snakemake has for itself."""
    return {
        path: (path.read_bytes(), path.stat().st_mtime_ns)
        for path in project.folder.rglob("*")
        if path.is_file() and ".snakemake" not in path.parts
    }


def tables_of(project):
    """Bytes of the tables that do not differ between two identical runs."""
    return [(project.results / "tables" / f"{name}.csv").read_bytes() for name in ("runs", "series")]


@pytest.mark.parametrize(
    "reading",
    [
        ("-pn",),
        ("--dry-run", "--quiet"),
        ("--dag",),
        ("--summary",),
        ("--list-rules",),
        ("--lint",),
        ("-n", "--config", "a_H=7"),
        ("-n", "--config", "study=other"),
    ],
)
def test_reading_writes_and_deletes_nothing(project, reading):
    flipped(project.results / "records/0001.nc")
    (project.results / "tables/bands.csv").write_text("an old table\n")
    before = files(project)
    project.snakemake(*reading, check=False)
    assert files(project) == before


def test_a_damaged_record_is_solved_again_though_its_time_and_size_are_kept(project, finished):
    record = project.results / "records/0001.nc"
    flipped(record)
    damaged = record.read_bytes()
    text = project.snakemake("-n")
    assert "0001.nc does not match its checksum 0001.nc.sha256: batch 0001 is solved again" in text
    assert project.jobs() == AGAIN
    assert (project.results / "damaged/0001.nc").read_bytes() == damaged
    assert tables_of(project) == tables_of(finished)
    assert project.jobs() == {}


@pytest.mark.parametrize("damage", [b"", b"\xff\xfe", b"0" * 64 + b"  0001.nc\n", b"x  0001.nc\n# a\n"])
def test_a_damaged_checksum_counts_as_a_damaged_record(project, damage):
    kept_time(project.results / "records/0001.nc.sha256", damage)
    assert project.jobs() == AGAIN
    assert project.jobs() == {}


def test_an_older_checksum_without_notes_lets_the_batch_be_solved_again(project):
    stated = project.results / "records/0001.nc.sha256"
    kept_time(stated, stated.read_bytes().splitlines(keepends=True)[0])
    assert project.jobs("-n") == AGAIN


@pytest.mark.parametrize("name", ["records", "batches", "tables", "points.json", "records/0001.nc"])
def test_what_was_deleted_is_made_again(project, finished, name):
    path = project.results / name
    shutil.rmtree(path) if path.is_dir() else path.unlink()
    project.snakemake()
    assert tables_of(project) == tables_of(finished)
    assert project.jobs() == {}


@pytest.mark.parametrize("name", ["tables/runs.csv", "tables/series.csv", "points.json"])
@pytest.mark.parametrize("snakemake_remembers", [True, False])
def test_an_edited_or_emptied_file_is_made_again(project, finished, name, snakemake_remembers):
    path = project.results / name
    kept_time(path, path.read_bytes().replace(b"0", b"1"))
    if not snakemake_remembers:
        shutil.rmtree(project.folder / ".snakemake")
    project.snakemake()
    assert path.read_bytes() == (finished.results / name).read_bytes()
    kept_time(path, b"")
    project.snakemake()
    kept_time(path, b"")  # the same damage twice
    project.snakemake()
    assert path.read_bytes() == (finished.results / name).read_bytes()
    assert project.jobs() == {}


def test_two_records_that_were_swapped_with_their_checksums_are_solved_again(project):
    project.configure(STUDY.replace("a_H: [1, 2]", "a_H: [0.5, 2, 1]"))
    project.snakemake()
    right = tables_of(project)
    home = project.results / "records"
    for suffix in ("nc", "nc.sha256"):
        (home / f"0001.{suffix}").rename(home / "aside")
        (home / f"0002.{suffix}").rename(home / f"0001.{suffix}")
        (home / "aside").rename(home / f"0002.{suffix}")
    assert project.jobs("-n")["batch"] == 2
    for name in ("0001", "0002"):  # somebody writes the names anew
        checksums.beside(home / f"{name}.nc").write_text(
            checksums.beside(home / f"{name}.nc").read_text().replace("  000", f"  {name}.nc#")
        )
    assert project.jobs()["batch"] == 2
    assert tables_of(project) == right


def test_records_of_other_sources_are_solved_again_though_snakemake_knows_nothing(project):
    source = shutil.copytree(project.root / "src", project.folder / "src")
    shutil.rmtree(project.folder / ".snakemake")
    assert project.jobs("-n", PYTHONPATH=str(source)) == {}
    with open(source / "subslide/naming.py", "a") as file:
        file.write("# a change\n")
    text = project.snakemake("-n", PYTHONPATH=str(source))
    assert "1 batches were made by other sources: they are solved again" in text
    assert project.jobs("-n", PYTHONPATH=str(source)) == AGAIN


def test_shuffled_times_and_times_in_the_future_solve_nothing_and_settle(project):
    for n, path in enumerate(sorted(project.results.rglob("*"))):
        os.utime(path, (2e9 + n % 7,) * 2)
    assert "batch" not in project.jobs()
    assert project.jobs() == {}


def test_a_moved_study_whose_snakemake_folder_is_gone_is_up_to_date(project):
    shutil.rmtree(project.folder / ".snakemake")
    os.utime(project.results / "records/0001.nc")
    assert set(project.jobs("-n")) <= {*TABLES, "report"}


def test_backups_and_strays_among_batches_do_not_stop_a_study(project):
    home = project.results / "batches"
    shutil.copy(home / "0001.json", home / "0001-old.json")
    (home / "0007.json").write_text("{")
    (home / "0009.json").mkdir()
    (home / "notes.json").write_text("[")
    os.mkfifo(home / "0008.json")
    assert project.jobs() == {}
    project.configure(STUDY.replace("cells: 20", "cells: [20, 30]"))
    assert project.jobs()["batch"] == 1
    assert (home / "0010.json").is_file()


@pytest.mark.parametrize("kernels", [None, "../../../../outside/x", "radial:float64"])
def test_kernels_that_a_batch_names_are_nothing_but_data(project, kernels):
    """The version before this one wrote them."""
    path = project.results / "batches/0001.json"
    path.write_text(json.dumps({"kernels": kernels, **json.loads(path.read_text())}))
    (project.results / "records/0001.nc").unlink()
    assert project.jobs()["batch"] == 1
    assert not list(project.folder.glob("**/outside*"))


def test_a_batch_that_was_edited_is_planned_anew(project, finished):
    path = project.results / "batches/0001.json"
    path.write_text(path.read_text().replace('"r": 0.4', '"r": 0.5'))
    (project.results / "records/0001.nc").unlink()
    assert project.jobs()["batch"] == 1
    assert tables_of(project) == tables_of(finished)


def test_a_batch_is_solved_for_those_points_alone_that_are_still_asked_for(project):
    project.configure(STUDY.replace("a_H: [1, 2]", "a_H: 2"))
    (project.results / "records/0001.nc").unlink()
    assert project.jobs()["batch"] == 1
    assert (
        (project.results / "logs/batch-0001.log")
        .read_text()
        .endswith("1 runs -> results/small/records/0001.nc\n")
    )


def test_a_wide_dry_run_leaves_no_trace_in_the_plan(project):
    project.snakemake("-n", "--config", "a_H=[1,2,3,4,5,6,7,8,9]", "delta=[20,30,40]")
    project.configure(STUDY.replace("a_H: [1, 2]", "a_H: [1, 2, 3]"))
    assert project.jobs()["batch"] == 1
    assert len(json.loads((project.results / "batches/0002.json").read_text())["points"]) == 1


@pytest.mark.parametrize("name", ["tables/runs.csv", "points.json", "records/0001.nc"])
def test_a_reader_names_the_damaged_file_in_one_line(project, capsys, name):
    verb = ["figure", "fig06_fronts", "--results", str(project.results), "-o", str(project.folder / "o")]
    if name.startswith("records"):
        verb = ["tables", str(project.results)]
    path = project.results / name
    whole = path.read_bytes()
    for damage in (b"", whole[: len(whole) // 2], whole.replace(b"0", b"1"), b"[]"):
        kept_time(path, damage)
        assert main(verb) == 1
        lines = capsys.readouterr().err.splitlines()
        assert len(lines) == 1
        assert str(path) in lines[0]
    assert not (project.folder / "o").exists()
