"""What happens to a study between two calls: damage is found, named and mended, and nothing else is done again."""

import os
import shutil

import pytest
from projects import STUDY, TABLES, Project

from subslide.__main__ import main

pytestmark = pytest.mark.slow

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


@pytest.mark.parametrize("reading", ["-pn", "--summary", "--list-rules", "-n --config a_H=[3,4] study=other"])
def test_reading_writes_and_deletes_nothing(project, reading):
    flipped(project.results / "records/0001.nc")
    (project.results / "tables/bands.csv").write_text("an old table\n")
    before = files(project)
    project.snakemake(*reading.split())
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


@pytest.mark.parametrize("name", ["batches", "tables", "points.json"])
def test_what_was_deleted_is_made_again(project, finished, name):
    path = project.results / name
    shutil.rmtree(path) if path.is_dir() else path.unlink()
    project.snakemake()
    assert tables_of(project) == tables_of(finished)
    assert project.jobs() == {}


@pytest.mark.parametrize("snakemake_remembers", [True, False])
def test_edited_and_emptied_files_are_made_again(project, finished, snakemake_remembers):
    names = ("tables/runs.csv", "tables/series.csv", "points.json", "report.html")
    right = [(finished.results / name).read_bytes() for name in names]
    for name in names:
        path = project.results / name
        kept_time(path, path.read_bytes().replace(b"0", b"1"))
    if not snakemake_remembers:
        shutil.rmtree(project.folder / ".snakemake")
    for _ in range(2):  # the same damage twice
        project.snakemake()
        assert [(project.results / name).read_bytes() for name in names] == right
        for name in names:
            kept_time(project.results / name, b"")


def test_what_stands_where_a_file_belongs_is_set_aside(project, finished):
    """A folder in place of a table, pipes in place of checksums: nothing waits for them."""
    (project.results / "tables/runs.csv").unlink()
    (project.results / "tables/runs.csv").mkdir()
    (project.results / "tables/runs.csv/notes").write_text("mine\n")
    for name in ("tables/series.csv", "records/0001.nc", "points.json"):
        (project.results / f"{name}.sha256").unlink()
        os.mkfifo(project.results / f"{name}.sha256")
    project.snakemake()
    assert tables_of(project) == tables_of(finished)
    assert [path.read_text() for path in (project.results / "damaged").rglob("notes")] == ["mine\n"]
    assert project.jobs() == {}


@pytest.mark.parametrize("name", ["results", "results/small", "results/small/records", ".snakemake/subslide"])
def test_a_file_where_a_folder_belongs_is_named_in_one_line(project, capsys, monkeypatch, name):
    path = project.folder / name
    shutil.rmtree(path)
    path.write_text("mine\n")
    text = project.snakemake(check=False)
    said = f"{name} is a file where a folder of the study belongs: move it away"
    assert [said in line for line in text.splitlines()].count(True) == 1
    assert "Traceback" not in text
    monkeypatch.chdir(project.folder)
    assert main(["unlock", "small.yaml"]) == 2
    assert capsys.readouterr().err == f"subslide: {said}\n"
    assert path.read_text() == "mine\n"


def test_two_records_that_were_swapped_with_their_checksums_are_solved_again(project):
    project.configure(STUDY.replace("a_H: [1, 2]", "a_H: [0.5, 2, 1]"))
    project.snakemake()
    right = tables_of(project)
    home = project.results / "records"
    for suffix in ("nc", "nc.sha256"):
        (home / f"0001.{suffix}").rename(home / "aside")
        (home / f"0002.{suffix}").rename(home / f"0001.{suffix}")
        (home / "aside").rename(home / f"0002.{suffix}")
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


def test_a_record_of_another_version_is_named_in_one_line(project, capsys, monkeypatch):
    """Its checksums are right, and it lacks a variable that a table needs."""
    from subslide.records import by_run

    whole = by_run.netcdf.read
    lacking = {"wave_free_until"}
    monkeypatch.setattr(
        by_run.netcdf,
        "read",
        lambda path, names, **how: whole(path, set(names) - lacking, **how),
    )
    assert main(["table", "runs", str(project.results)]) == 1
    (line,) = capsys.readouterr().err.splitlines()
    assert (
        "0001.nc: the record has no wave_free_until: it is of another version; make the study again" in line
    )
