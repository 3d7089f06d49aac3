"""The command line: one line for each mistake, exit statuses, and nothing half-written."""

import os
import subprocess
import sys
import time
from pathlib import Path

import netCDF4
import numpy as np
import pytest

import subslide
from subslide.__main__ import main
from subslide.commands import cli
from subslide.keys import schema, words
from subslide.points import RUN_KEYS
from subslide.records.netcdf import read

QUICK = ("--model", "radial", "--cells", "60", "--t-end", "0.02")
BAD = {
    ("--r", "1.5"): ("--r", "1.5", "from 0 to 0.99999"),
    ("--a-H", "-1"): ("--a-H", "-1", "from 0 to 1000"),
    ("--a-H", "nan"): ("--a-H", "nan"),
    ("--a-H", "1,2"): ("2 values",),
    ("--a-H", ""): ("--a-H", "''"),
    ("--cells", "ten"): ("--cells", "ten", "whole number"),
    ("--scheme", "hlll"): ("--scheme", "hlll", "did you mean 'hll'?"),
    ("--order", "7"): ("--order", "7"),
    ("--t-end", "rset"): ("--t-end", "rset", "did you mean 'rest'?"),
    ("--deltta", "30"): ("--deltta", "--delta"),
    ("--threads", "0"): ("--threads", "0"),
    ("--threads", "1_0"): ("--threads", "1_0", "several ways"),
    ("--threads", "1" * 5000): ("--threads", "1111"),
    ("--cells", "0200"): ("--cells: 0200", "several ways"),
    ("--cells", "1e400"): ("--cells: 1e400", "about 1e308"),
    ("--cells", "1" * 5000): ("--cells: 1111", "about 1e308"),
    ("--a-H", "1_0"): ("--a-H: 1_0", "several ways"),
    ("--a-H", "1:30"): ("--a-H: 1:30", "several ways"),
    ("--a-H", "'1'"): ("--a-H: '1'", "a number"),
    ("--snapshot-times", "1,,2"): ("--snapshot-times: 1,,2", "an empty part"),
    ("--snapshot-times", "0,0x1"): ("--snapshot-times: 0x1", "several ways"),
    ("--scene", "a\0b"): ("--scene: a\\x00b", "control character"),
    ("--scene", "x\udcff"): ("--scene: x\\udcff", "control character"),
    ("--scene", "x\x1b[31m"): ("--scene: x\\x1b[31m", "control character"),
    ("--scene-options", "angle=030"): ("--scene-options: 030", "several ways"),
    ("--scene-options", "file=a\0b", "--scene", "raster"): ("--scene-options", "a\\x00b"),
    ("--config", ""): ("(CONFIG, SPEC) is ''",),
    ("--config", "a\0b"): ("a\\x00b", "null"),
    ("--config", "absent.yaml"): ("absent.yaml", "no such file"),
    ("extra",): ("extra",),
}


@pytest.fixture(autouse=True)
def in_a_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def complaint(capsys, *arguments):
    """One line on stderr of a command that must end with status 2 and write nothing."""
    before = sorted(os.listdir())
    assert main([*arguments]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.startswith("subslide: ")
    assert err.count("\n") == 1
    assert sorted(os.listdir()) == before
    return err


@pytest.mark.parametrize("arguments", BAD, ids=" ".join)
def test_bad_options_of_run(arguments, capsys):
    quick = [
        word
        for pair in zip(QUICK[::2], QUICK[1::2], strict=True)
        if pair[0] not in arguments
        for word in pair
    ]
    line = complaint(capsys, "run", *quick, *arguments, "-o", "x.nc")
    for part in BAD[arguments]:
        assert part in line


@pytest.mark.parametrize(
    ("text", "part"),
    [
        ("r: 1.5", "point.yaml: r: 1.5"),
        ("cel: 1", "cells"),
        ("a_H: [1, 2]", "2 values"),
        ("a: [", "not valid YAML"),
    ],
)
def test_bad_configuration_of_run(text, part, capsys, write_yaml):
    write_yaml(text, "point.yaml")
    assert part in complaint(capsys, "run", "--config", "point.yaml", "-o", "x.nc")


@pytest.mark.parametrize(
    ("text", "parts"),
    [
        ("study: A/B", ("study: A/B", "lower-case letters")),
        ("study: 2024", ("study: 2024 is a number", "in quotes")),
        ("study: " + "a" * 300, ("study: aaa", "at most 64")),
        ("bands: maybe", ("bands: maybe", "true or false")),
        ("figures: 7", ("figures: 7", "auto, none or a list")),
        ("figures: [fig06_frnts]", ("figures: fig06_frnts", "did you mean 'fig06_fronts'?")),
    ],
)
def test_keys_of_a_study_are_checked_for_one_run_too(text, parts, capsys, write_yaml):
    write_yaml(text, "point.yaml")
    line = complaint(capsys, "run", *QUICK, "--config", "point.yaml", "-o", "x.nc")
    assert line.startswith("subslide: point.yaml: ")
    for part in parts:
        assert part in line


def test_what_says_nothing_of_one_run_is_told(capsys, write_yaml):
    write_yaml("study: t\nfigures: none\nbands: true\nkeep: summary\na_H: [2]", "point.yaml")
    assert main(["run", *QUICK, "--config", "point.yaml", "-o", "x.nc"]) == 0
    assert capsys.readouterr().err == (
        "subslide: point.yaml: bands: true has no meaning for one run and is left out\n"
        "subslide: point.yaml: keep: summary has no meaning for one run and is left out\n"
    )
    assert read("x.nc")[0]["a_H"].values == 2


def test_bad_outputs(capsys, tmp_path, write_yaml):
    assert "does not exist" in complaint(capsys, "run", *QUICK, "-o", "absent/x.nc")
    assert "is a folder" in complaint(capsys, "run", *QUICK, "-o", str(tmp_path))
    write_yaml("r: 0", "point.yaml")
    assert "is the input" in complaint(capsys, "run", "--config", "point.yaml", "-o", "point.yaml")
    assert "--output" in complaint(capsys, "run", *QUICK)
    assert "--output: a\\x00b.nc has a control character" in complaint(capsys, "run", *QUICK, "-o", "a\0b.nc")
    assert "cannot be written" in complaint(capsys, "run", *QUICK, "-o", "/proc/x.nc")


def test_an_output_is_no_raster_that_the_run_reads(capsys):
    with netCDF4.Dataset("grains.nc", "w") as data:
        for name in ("x", "y"):
            data.createDimension(name, 4)
            data.createVariable(name, "f8", (name,))[:] = 0.01 * np.arange(4)
        data.createVariable("h2", "f8", ("y", "x"))[:] = 0.01
    before = Path("grains.nc").read_bytes()
    os.link("grains.nc", "same.nc")
    os.symlink("grains.nc", "link.nc")
    for output in ("grains.nc", "same.nc", "link.nc", "./grains.nc"):
        scene = ("--scene", "raster", "--scene-options", "file=grains.nc")
        assert "is the input" in complaint(capsys, "run", "--cells", "20", *scene, "-o", output)
    assert Path("grains.nc").read_bytes() == before


def test_an_output_is_a_regular_file_or_a_link_to_one(capsys):
    os.mkfifo("pipe.nc")
    os.symlink("pipe.nc", "to_pipe.nc")
    for output in ("pipe.nc", "to_pipe.nc"):
        assert "not a regular file" in complaint(capsys, "run", *QUICK, "-o", output)
    assert "NetCDF" in complaint(capsys, "run", *QUICK, "-o", "table.csv")
    Path("kept.nc").touch()
    os.symlink("kept.nc", "link.nc")
    assert main(["run", *QUICK, "-o", "link.nc"]) == 0
    assert os.path.islink("link.nc")
    assert read("kept.nc")[1]["model"] == "radial"


def test_bad_verbs_and_their_inputs(capsys):
    assert "did you mean 'run'?" in complaint(capsys, "rnu")
    assert "no such file" in complaint(capsys, "check", "absent.yaml")
    assert "no such file" in complaint(capsys, "batch", "absent.json", "-o", "x.nc")
    assert "model: radal" in complaint(capsys, "warm", "radal:float64")
    assert "nowhere" in complaint(capsys, "tables", "nowhere")
    assert "did you mean 'runs'?" in complaint(capsys, "table", "rnus", "nowhere")
    assert "figure: absent" in complaint(capsys, "figure", "absent", "--results", ".", "-o", ".")


def test_help_states_unit_default_and_range_of_every_key(capsys):
    assert main(["run", "--help"]) == 0
    text = " ".join(capsys.readouterr().out.split())
    for key in RUN_KEYS:
        assert "--" + key.replace("_", "-") in text
        about = schema.properties()[key]
        if about.get("type") in ("number", "integer"):
            assert words.allowed(key) in text
            assert f"[default: {about['default']}]" in text
    for part in ("[degree]", "[m]", "Exit status"):
        assert part in text


def test_check_tells_what_a_study_holds(capsys, root):
    assert main(["check", str(root / "config/paper.yaml")]) == 0
    assert "study 'paper', 30 runs and 60 companions for bands" in capsys.readouterr().out


def test_run_prints_one_line_and_options_win_over_the_file(capsys, write_yaml):
    write_yaml("r: 0.1\na_H: 3\nmodel: radial\ncells: 20\nt_end: 0.02\n", "point.yaml")
    assert (
        main(["run", "--config", "point.yaml", "--a-H", "2", "--snapshot-times", "0,0.01", "-o", "x.nc"]) == 0
    )
    out, _ = capsys.readouterr()
    assert out.count("\n") == 1
    found, attrs = read("x.nc")
    assert (found["a_H"].values[0], found["r"].values[0]) == (2, 0.1)
    assert attrs["status"] in ("ok", "not_at_rest")
    assert os.listdir() in (["x.nc", "point.yaml"], ["point.yaml", "x.nc"])


def test_a_warm_run_starts_light():
    """No xarray, pandas, dask or plotting on the way to a record: they would double its time."""
    code = (
        "import sys; from subslide.__main__ import main;"
        f"assert main(['run', {', '.join(map(repr, QUICK))}, '-o', 'x.nc']) == 0;"
        "heavy = {'xarray', 'pandas', 'dask', 'matplotlib', 'seaborn', 'jsonschema', 'snakemake'} & set(sys.modules);"
        "assert not heavy, heavy"
    )
    subprocess.run([sys.executable, "-c", code], check=True)
    start = time.monotonic()
    subprocess.run([sys.executable, "-m", "subslide", "run", *QUICK, "-o", "y.nc"], check=True)
    assert time.monotonic() - start < 6  # about 1 s on a quiet core


def test_a_batch_leaves_a_checksum_beside_its_record(capsys):
    from pathlib import Path

    from subslide import checksums
    from subslide.study import batches, config

    study = config.make_study({"study": "t", "a_H": [1, 2], "model": "radial", "cells": 20, "t_end": 0.02})
    text = batches.spec_text(study.points)
    Path("b.json").write_text(text)
    assert main(["batch", "b.json", "--ledger", "kept.json", "-o", "b.nc"]) == 0
    assert capsys.readouterr().out.count("\n") == 3
    assert read("b.nc")[0]["id"].values.tolist() == [p.id for p in study.points]
    assert subprocess.run(["sha256sum", "-c", "--strict", "b.nc.sha256"], check=False).returncode == 0
    assert checksums.verify("b.nc") == {"batch": checksums.text_hash(text), "sources": subslide.source_hash()}
    assert Path("kept.json").read_text() == text


@pytest.mark.parametrize("damage", ["a byte", "half", "nothing left"])
def test_a_damaged_record_gets_one_line(damage, capsys, make_run, write_tables, solve_study):
    from pathlib import Path

    from subslide.study import config

    folder = Path("study")
    study = config.make_study({"study": "t", "a_H": [1, 2], "model": "radial", "cells": 20})
    solve_study(study, folder, lambda points: [make_run(point) for point in points])
    record = folder / "records/0001.nc"
    write_tables(folder)
    before = {path: path.read_bytes() for path in (folder / "tables").iterdir()}
    content = bytearray(record.read_bytes())
    content[content.index(make_run(study.points[0]).L_f.tobytes())] ^= (
        1  # a value: files have room that nobody reads
    )
    record.write_bytes({"a byte": content, "half": content[: len(content) // 2], "nothing left": b""}[damage])
    verbs = [["table", name, "study"] for name in ("runs", "timing", "series")]
    for call in (*verbs, ["tables", "study"], ["figure", "fig05_h2_by_r", "--results", "study", "-o", "."]):
        assert main(call) == 1
        out, err = capsys.readouterr()
        assert out == ""
        assert err.startswith(f"subslide: {record} does not match its checksum")
        assert err.count("\n") == 1
    assert {path: path.read_bytes() for path in (folder / "tables").iterdir()} == before


def test_kernels_are_cached_in_a_folder_of_their_sources(tmp_path):
    code = "import subslide, os; print(os.environ['NUMBA_CACHE_DIR'])"
    environment = {**os.environ, "NUMBA_CACHE_DIR": str(tmp_path / "cache")}

    def folder(environment):
        done = subprocess.run(
            [sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=True
        )
        return done.stdout.strip()

    first = folder(environment)
    assert first.startswith(str(tmp_path / "cache"))
    assert folder({**environment, "NUMBA_CACHE_DIR": first}) == first  # as a child process sees it
    unwritable = {**environment, "NUMBA_CACHE_DIR": "/proc/none"}
    assert os.path.isdir(folder(unwritable))


def test_a_locale_without_greek_letters_stops_nothing():
    """The line of a result holds an eta, which Latin-1 has not."""
    environment = {**os.environ, "PYTHONIOENCODING": "iso-8859-1"}
    command = [sys.executable, "-m", "subslide", "run", *QUICK, "-o", "x.nc"]
    done = subprocess.run(command, env=environment, capture_output=True, check=False)
    assert done.returncode == 0, done.stderr
    assert b"max|?|" in done.stdout
    assert read("x.nc")[1]["status"] == "ok"


@pytest.mark.parametrize(
    "name",
    [name for name, verb in cli.commands.items() if any(p.param_type_name == "option" for p in verb.params)],
)
def test_an_option_is_given_once(capsys, name):
    verb = cli.commands[name]
    option = next(p for p in verb.params if p.param_type_name == "option" and not p.is_flag)
    line = (name, *["x" for p in verb.params if p.param_type_name == "argument"])
    words = [*line, option.opts[0], "1", option.opts[-1], "2"]
    if option.multiple:
        assert "given twice" not in complaint(capsys, *words)
    else:
        flag = max(option.opts, key=len)
        assert complaint(capsys, *words) == f"subslide: {flag}: given twice; allowed: each option once\n"


def test_a_switch_and_its_opposite_are_one_option(capsys):
    assert "--fields: given twice" in complaint(
        capsys, "run", *QUICK, "--fields", "--no-fields", "-o", "x.nc"
    )


def test_an_error_is_of_standard_output_only_if_that_is_written(tmp_path, monkeypatch, capsys):
    def fail(*_):
        raise OSError("Could not load a library")

    monkeypatch.setattr("subslide.jobs.run", fail)
    assert main(["run", *QUICK, "-o", "x.nc"]) == 1
    assert capsys.readouterr().err == "subslide: Could not load a library\n"
    gone = tmp_path / "gone"
    gone.mkdir()
    monkeypatch.chdir(gone)
    gone.rmdir()
    assert main(["run", *QUICK, "-o", "x.nc"]) == 2
    assert (
        capsys.readouterr().err == "subslide: --output: x.nc cannot be written: No such file or directory\n"
    )
    monkeypatch.setattr("subslide.study.outputs.check", lambda *_: os.getcwd())
    assert main(["run", *QUICK, "-o", "x.nc"]) == 1
    assert capsys.readouterr().err == "subslide: the current folder: No such file or directory\n"
