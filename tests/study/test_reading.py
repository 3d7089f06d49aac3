"""Tables and records that are not those of their study are named in one line, also under a checksum that fits."""

import json
import os
import shutil
import subprocess
import sys

import pytest

from subslide.__main__ import main
from subslide.checksums import seal
from subslide.files import RecordError
from subslide.results import Results
from subslide.study import config


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """Folder of a study of two runs that the first test solves."""
    return tmp_path_factory.mktemp("whole") / "t"


@pytest.fixture
def folder(whole, tmp_path, solve_study, write_tables, make_run):
    """Folder of a study of two runs, made up."""
    if not whole.exists():
        whole.mkdir()
        study = config.make_study(
            {"study": "t", "model": "radial", "cells": 40, "a_H": [1, 2], "r": 0.4, "t_end": 1}
        )
        solve_study(study, whole, lambda points: [make_run(point) for point in points])
        write_tables(whole)
    return shutil.copytree(whole, tmp_path / "t")


def each_row(change):
    """Return a function of a text that changes each line but the first."""

    def of(text):
        first, *rows = text.splitlines()
        return "\n".join([first, *map(change, rows)]) + "\n"

    return of


HARM = {
    "empty": lambda text: "",
    "names alone": lambda text: text.splitlines()[0] + "\n",
    "half the rows": lambda text: "\n".join(text.splitlines()[: text.count("\n") // 2]) + "\n",
    "cut": lambda text: text[: len(text) * 2 // 3],
    "rows twice": lambda text: text + text.partition("\n")[2],
    "names as a row": lambda text: text + text,
    "a column twice": lambda text: "".join(f"{row},{row.rpartition(',')[2]}\n" for row in text.splitlines()),
    "columns in another order": lambda text: "".join(
        ",".join(reversed(row.split(","))) + "\n" for row in text.splitlines()
    ),
    "words for numbers": lambda text: text.replace("0.", "zero"),
    "nan": each_row(lambda row: row.partition(",")[0] + ",nan" * row.count(",")),
    "semicolons": lambda text: text.replace(",", ";"),
    "no such run": lambda text: text.replace("\np", "\nq"),
    "an open quote": lambda text: text.replace("\n", '\n"', 1),
    "NUL": lambda text: text[:200] + "\0" * 50 + text[250:],
    "one row": lambda text: "\n".join(text.splitlines()[:2]) + "\n",
    "wide rows": each_row(lambda row: row + ",5"),
    "Latin 1": lambda text: text.replace("ok", "\udce9k").replace("x_front", "\udce9"),
}
OF_SERIES = {
    "infinite times": each_row(lambda row: row.replace("0.", "1e400")),
    "times below 0": each_row(lambda row: row.replace(",0.", ",-0.")),
    "a run's rows in another order": lambda text: "\n".join(
        [text.splitlines()[0], *sorted(text.splitlines()[1:], reverse=True), ""]
    ),
}
OF_RUNS = {
    "infinite": each_row(lambda row: row.replace("0.", "1e400")),
    "huge": each_row(lambda row: row.replace(",0.", ",9e300")),
    "other values": each_row(lambda row: row.replace(",0.56,", ",0.57,")),
    "other numerics": each_row(lambda row: row.replace(",default,", ",paper,")),
}


@pytest.mark.parametrize(
    ("name", "harm"),
    [
        *((name, harm) for name in ("runs", "series") for harm in HARM.values()),
        *(("runs", harm) for harm in OF_RUNS.values()),
        *(("series", harm) for harm in OF_SERIES.values()),
    ],
    ids=[*(f"{name}: {harm}" for name in ("runs", "series") for harm in HARM), *OF_RUNS, *OF_SERIES],
)
def test_a_table_that_is_none_of_the_study_is_named_in_one_line(folder, name, harm, capsys):
    path = folder / f"tables/{name}.csv"
    path.write_bytes(harm(path.read_text()).encode(errors="surrogateescape"))
    seal(path)
    figure = ["figure", "fig06_fronts", "--results", str(folder)]
    for verb, output in (
        (figure, folder.parent / "out"),
        (["report", str(folder)], folder.parent / "r.html"),
    ):
        assert main([*verb, "-o", str(output)]) == 1
        (line,) = capsys.readouterr().err.splitlines()
        assert f"tables/{name}.csv is not the table {name} of this study" in line
        assert len(line) <= 300
        assert not output.exists()


def test_all_tables_that_are_whole_are_read(folder):
    results = Results(folder)
    assert len(results.runs) == 2
    assert len(results.lines("series")) == len(results.series) > 0
    assert len(results.table("timing")) == 2


def test_a_record_of_other_runs_is_named(folder, tmp_path):
    (folder / "records/0001.nc").unlink()
    other = ["run", "--model", "radial", "--cells", "20", "--t-end", "0.01", "-o"]
    assert main([*other, str(folder / "records/0001.nc")]) == 0
    seal(folder / "records/0001.nc")
    results = Results(folder)
    run = results.runs_of_study[0].id
    with pytest.raises(RecordError, match=f"0001.nc: the record lacks the run {run}"):
        results.record(run)
    with pytest.raises(RecordError, match="0001.nc: the record lacks the run"):
        list(results.each("time"))


def test_a_run_that_points_json_has_twice_is_refused(folder):
    path = folder / "points.json"
    index = json.loads(path.read_text())
    index["points"].append(index["points"][0])
    path.write_text(json.dumps(index))
    seal(path)
    with pytest.raises(RecordError, match=f"points.json .*{index['points'][0]['id']} is there twice"):
        Results(folder).runs_of_study  # noqa: B018 - asking is what fails


@pytest.mark.parametrize("name", ["atlas", "errors", "cfl", "claims", "bands", "work_precision", "cheapest"])
def test_a_table_that_a_study_does_not_get_is_refused_and_left_out(folder, name, capsys):
    before = sorted((folder / "tables").iterdir())
    verbs = [["table", name], *([[name]] if name in ("atlas", "errors", "cfl", "claims") else [])]
    for verb in verbs:
        assert main([*verb, str(folder)]) == 2
        said = capsys.readouterr()
        assert said.out == ""
        (line,) = said.err.splitlines()
        assert f"this study gets no table {name}; allowed: a study with " in line
    assert sorted((folder / "tables").iterdir()) == before


@pytest.mark.parametrize("name", ["work_precision", "fig04_profiles_r0", "verify_orders", "stability_cfl"])
def test_a_figure_whose_runs_a_study_lacks_is_refused_and_not_drawn(folder, name, capsys):
    assert main(["figure", name, "--results", str(folder), "-o", str(folder / "out")]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert f"{name} needs runs with " in line
    assert not (folder / "out").exists()


def test_matplotlib_without_a_folder_of_settings_draws_in_silence(folder, monkeypatch):
    monkeypatch.setenv("MPLCONFIGDIR", os.devnull)
    verb = ["figure", "fig06_fronts", "--results", str(folder), "-o", str(folder / "out")]
    done = subprocess.run([sys.executable, "-m", "subslide", *verb], capture_output=True, text=True)
    assert (done.returncode, done.stderr) == (0, "")


@pytest.mark.parametrize("content", [b"", b"PAR1", b"PAR1" + bytes(60) + b"PAR1", b"id,time\n"])
def test_a_parquet_table_that_is_none_is_named_in_one_line(folder, content, capsys):
    (folder / "tables/series.csv").unlink()
    path = folder / "tables/series.parquet"
    path.write_bytes(content)
    seal(path)
    verb = ["figure", "fig06_fronts", "--results", str(folder), "-o", str(folder / "out")]
    assert main(verb) == 1
    (line,) = capsys.readouterr().err.splitlines()
    assert "series.parquet is not the table series of this study" in line
