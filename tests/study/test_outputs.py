"""What verbs write replaces nothing that they read, and nothing that is no file of theirs."""

import json
import os
import re
from pathlib import Path

import netCDF4
import numpy as np
import pytest

from subslide import pages
from subslide.__main__ import main
from subslide.files import RecordError, write_text
from subslide.keys.schema import ConfigError
from subslide.pages import renewal
from subslide.records import netcdf
from subslide.results import Results
from subslide.study import batches, config, outputs, plan

QUICK = ("--model", "radial", "--cells", "60", "--t-end", "0.02")
BYTES = b"mine"


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    """The current folder, empty."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def refused(folder, capsys):
    """Function that runs a command which must end with a line, and must change, make and remove nothing."""

    def state():
        paths = sorted(folder.rglob("*"))
        return [(path, os.lstat(path).st_ino, path.read_bytes() if path.is_file() else b"") for path in paths]

    def run(*words, status=2):
        before = state()
        capsys.readouterr()
        assert main([str(word) for word in words]) == status
        out, err = capsys.readouterr()
        assert (out, err.count("\n")) == ("", 1), err
        assert len(err) <= 301
        assert state() == before
        return err

    return run


@pytest.fixture
def spec(folder):
    """A batch file of two points that read a raster, g.nc, and folders for what is made of it."""
    with netCDF4.Dataset("g.nc", "w") as data:
        for name in ("x", "y"):
            data.createDimension(name, 4)
            data.createVariable(name, "f8", (name,))[:] = 0.01 * np.arange(4)
        data.createVariable("h2", "f8", ("y", "x"))[:] = 0.01
    raster = {"scene": "raster", "scene_options": {"file": "g.nc"}, "cells": 20, "t_end": 0.001}
    study = config.make_study({"study": "t", "a_H": [1, 2], **raster})
    write_text("s.json", batches.spec_text(study.points))
    os.symlink("g.nc", "link.nc")
    os.link("g.nc", "same.nc")
    return "s.json"


@pytest.fixture
def study(folder, solve_study, write_tables, make_run):
    """Folder of a made-up study, `t`, with tables."""
    asked = config.make_study({"study": "t", "cells": 40, "a_H": [1, 2]})
    solve_study(asked, folder / "t", lambda points: [make_run(point) for point in points])
    write_tables(folder / "t")
    return Path("t")


@pytest.mark.parametrize("output", ["g.nc", "link.nc", "same.nc", "./g.nc"])
def test_a_batch_replaces_no_raster_of_its_points(spec, refused, output):
    assert "is the input" in refused("batch", spec, "-o", output)


@pytest.mark.parametrize(
    ("ledger", "said"),
    [
        ("s.json", "is the input"),
        ("of_spec.json", "is the input"),
        ("of_raster.json", "is the input"),
        ("b.nc", "another output"),
        ("b.nc.sha256", "another output"),
        ("b.txt", "ends in .json"),
        ("pipe.json", "not a regular file"),
        ("", "is a folder"),
        ("absent/b.json", "does not exist"),
        ("a\0b.json", "control character"),
    ],
)
def test_a_ledger_is_checked_as_the_record_is(spec, refused, ledger, said):
    os.symlink(spec, "of_spec.json")
    os.symlink("g.nc", "of_raster.json")
    os.mkfifo("pipe.json")
    line = refused("batch", spec, "-o", "b.nc", "--ledger", ledger)
    assert line.startswith("subslide: --ledger: ")
    assert said in line


def test_the_checksum_of_a_batch_is_an_output_too(spec, refused):
    os.mkfifo("b.nc.sha256")
    assert "b.nc.sha256 is not a regular file" in refused("batch", spec, "-o", "b.nc")
    os.symlink(spec, "c.nc.sha256")
    assert "c.nc.sha256 is the input" in refused("batch", spec, "-o", "c.nc")


@pytest.mark.parametrize("name", ["notes", "notes.nc", "notes.dat", "link.nc"])
@pytest.mark.parametrize("verb", ["run", "batch"])
def test_what_is_no_record_stays(spec, refused, verb, name):
    Path("link.nc").unlink()
    os.symlink("notes", "link.nc")
    for path in {name, "notes"}:
        if path != "link.nc":
            Path(path).write_bytes(BYTES)
    words = QUICK if verb == "run" else [spec]
    assert "is there and is no record" in refused(verb, *words, "-o", name)


@pytest.mark.parametrize("start", [b"", b"CDF\x01", b"\x89HDF\r\n"])
def test_a_record_or_an_empty_file_is_replaced(start):
    Path("x.nc").write_bytes(start)
    assert main(["run", *QUICK, "-o", "x.nc"]) == 0
    assert netcdf.read("x.nc")[1]["model"] == "radial"


def test_a_backslash_is_named_where_the_library_would_misread_it(folder, refused, monkeypatch, make_run):
    odd = folder / "bs\\x"
    odd.mkdir()
    for output in (odd / "y.nc", "y\\z.nc"):
        assert "NetCDF takes '\\' for '/'" in refused("run", *QUICK, "-o", output)
    netcdf.write("y.nc", [make_run(config.make_point({"cells": 40}))])
    os.rename("y.nc", odd / "y.nc")
    assert netcdf.read(odd / "y.nc")[1]["cells"] == 40
    monkeypatch.chdir(odd)
    assert "NetCDF takes" in refused("run", *QUICK, "-o", "z.nc")


def test_a_study_in_a_folder_with_a_backslash_gives_tables_and_names_it_where_it_cannot(study, capsys):
    study.rename("b\\t")
    assert main(["table", "runs", "b\\t"]) == 0
    capsys.readouterr()
    with pytest.raises(ConfigError, match="folders, without backslashes"):
        Results("b\\t").record(Results("b\\t").runs_of_study[0].id)


@pytest.mark.parametrize(
    "output",
    [
        "t/points.json",
        "t/tables/runs.csv",
        "t/records/0001.nc",
        "points.html",
        "runs.html",
        "caption.html",
        "pipe.html",
        "sealed.html",
        "page.txt",
        "t",
        "absent/page.html",
    ],
)
def test_a_report_replaces_no_file_of_the_study(study, refused, output):
    os.symlink("t/points.json", "points.html")
    os.link("t/tables/runs.csv", "runs.html")
    Path("captions").mkdir()
    Path("captions/runs.rst").write_text("Runs.")
    os.symlink("captions/runs.rst", "caption.html")
    os.mkfifo("pipe.html")
    os.mkfifo("sealed.html.sha256")
    assert "--output: " in refused("report", study, "--captions", "captions", "-o", output)


def test_a_report_is_renewed_and_its_captions_are_a_folder_of_texts(study, refused):
    for _ in range(2):
        assert main(["report", "t", "-o", "t/report.html"]) == 0
    line = refused("report", study, "--captions", "t/points.json", "-o", "page.html")
    assert "--captions: t/points.json is no folder" in line
    Path("runs.rst").write_bytes(b"\xff")
    assert "runs.rst: this is not a text file" in refused("report", study, "--captions", ".", "-o", "p.html")


@pytest.mark.parametrize(
    ("source", "text", "said"),
    [
        ("absent.json", None, "no such file"),
        ("pipe", None, "a pipe"),
        ("s.json", b"\xff", "not a text file"),
        ("s.json", b"points", "no list of a study's points"),
        ("s.json", b"[1]", "no list of a study's points"),
        ("s.json", b'{"points": 1}', "no list of a study's points"),
        ("s.json", b"[" * 100_000, "no list of a study's points"),
    ],
)
def test_only_a_list_of_points_is_kept(refused, source, text, said):
    os.mkfifo("pipe")
    if text is not None:
        Path(source).write_bytes(text)
    line = refused("keep", source, "-o", "points.json")
    assert source in line
    assert said in line


def test_what_is_kept_replaces_nothing_else_and_help_does_not_tell_of_it(refused, capsys):
    Path("s.json").write_text(json.dumps({"points": []}))
    os.mkfifo("pipe.json")
    for output, said in (
        ("s.json", "is the input"),
        ("pipe.json", "regular file"),
        ("x.nc", "ends in .json"),
    ):
        assert said in refused("keep", "s.json", "-o", output)
    assert main(["keep", "s.json", "-o", "points.json"]) == 0
    assert main(["--help"]) == 0
    assert not re.search(r"\bkeep\b", capsys.readouterr().out)
    assert "keep" not in refused("kep")


def test_pipes_in_place_of_what_a_study_makes_stay(study, refused):
    for name in ("runs.csv", "runs.csv.sha256"):
        path = study / "tables" / name
        path.rename("aside")
        os.mkfifo(path)
        assert f"tables/{name}: this is no regular file" in refused("table", "runs", study, status=1)
        path.unlink()
        Path("aside").rename(path)
    Path("out").mkdir()
    words = ("figure", "fig06_fronts", "--results", study, "-o", "out")
    for name in ("fig06_fronts.png.sha256", "fig06_fronts.svg"):
        os.mkfifo(f"out/{name}")
        assert f"{name}: this is no regular file" in refused(*words, status=1)
        Path("aside").unlink(missing_ok=True)
        Path("out", name).rename("aside")
    Path("aside").rename("out/fig06_fronts.svg")
    with pytest.raises(RecordError, match="no regular file"):
        write_text("out/fig06_fronts.svg", "text")


def test_links_to_other_files_of_a_study_are_not_written_through(study, refused):
    Path("out").mkdir()
    os.symlink("../t/records/0001.nc", "out/fig06_fronts.png")
    words = ("figure", "fig06_fronts", "--results", study, "-o", "out")
    assert "a link to another file of the study" in refused(*words, status=1)
    table = study / "tables/timing.csv"
    table.unlink()
    os.symlink("../points.json", table)
    assert "a link to another file of the study" in refused("table", "timing", study, status=1)
    table.unlink()
    Path("elsewhere.csv").touch()
    os.symlink("../../elsewhere.csv", table)
    assert main(["table", "timing", "t"]) == 0
    assert table.is_symlink()
    assert Path("elsewhere.csv").stat().st_size


@pytest.mark.parametrize("verb", ["atlas", "verify", "work-precision"])
def test_pages_are_checked_before_tables_are_written(study, refused, verb):
    os.mkfifo("pipe.md")
    os.symlink("t/points.json", "points.md")
    Path("plain.md").write_text("no marks")
    Path("turned.md").write_text("\n".join(reversed(renewal.LAST_RUN)))
    Path("bytes.md").write_bytes(b"\xff")
    for page, said in (
        ("pipe.md", "regular file"),
        ("points.md", "is the input"),
        ("plain.md", "lacks the lines"),
        ("turned.md", "lacks the lines"),
        ("bytes.md", "not a text file"),
        ("absent.md", "no such file"),
        ("t/points.json", "ends in .md"),
        ("", "is a folder"),
    ):
        assert said in refused(verb, study, "-o", page)


def test_no_page_of_the_documentation_is_written_unless_all_can_be(refused):
    first, *rest = map(Path, pages.generated())
    first.parent.mkdir(parents=True, exist_ok=True)
    assert "no such folder" in refused("docs")
    for path in rest:
        path.parent.mkdir(parents=True, exist_ok=True)
    os.mkfifo(rest[-1])
    assert "not a regular file" in refused("docs")


def test_the_library_refuses_as_verbs_do(study):
    with pytest.raises(ConfigError, match="is a folder"):
        outputs.check("t", ())
    files = {path.as_posix() for path in outputs.of_study(study, but=[study / "points.json"])}
    assert "t/points.json" not in files
    assert {"t/tables/runs.csv", plan.record_path(study, "0001").as_posix()} <= files
