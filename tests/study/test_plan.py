"""The plan of a study: solved batches never change, others are planned anew, and damage is told from its content."""

import json
import os

import netCDF4
import numpy as np
import pytest

import subslide
from subslide import catalogue, checksums, scenes
from subslide.points import Point
from subslide.results import Results
from subslide.study import batches, config, plan, staging


def study(**axes):
    return config.make_study({"study": "t", "model": "radial", "cells": 40, **axes})


@pytest.fixture
def solved(solve_study, make_run, tmp_path):
    """Function that leaves a study solved in a folder, which it returns."""

    def solve(**axes):
        solve_study(study(**axes), tmp_path, lambda points: [make_run(point) for point in points])
        return tmp_path

    return solve


def to_solve(planned):
    """Values of a_H of each batch that a plan solves, by the batch's name."""
    return {name: [p.a_H for p in batch.points] for name, batch in planned.batches.items() if batch.text}


TABLES = {"runs": ["runs.csv"]}


def contents(folder):
    return {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def test_planning_writes_nothing_and_a_solved_study_has_nothing_to_solve(solved, tmp_path):
    assert to_solve(plan.plan(study(a_H=[1, 2]), tmp_path / "none")) == {"0001": [1, 2]}
    assert not (tmp_path / "none").exists()
    before = contents(solved(a_H=[1, 2]))
    planned = plan.plan(study(a_H=[2, 1]), tmp_path)
    assert to_solve(planned) == {}
    assert planned.faults == []
    assert contents(tmp_path) == before


def test_points_keep_their_batch_and_what_is_new_makes_one_more(solved):
    folder = solved(a_H=[1, 2])
    wider = plan.plan(study(a_H=[0.5, 2, 1]), folder)
    assert to_solve(wider) == {"0002": [0.5]}
    assert list(wider.batches) == ["0001", "0002"]
    assert list(plan.plan(study(a_H=[2]), folder).batches) == ["0001"]


def test_what_was_never_solved_is_planned_anew(solved):
    """A wide plan that nobody ran leaves no trace in the next one."""
    folder = solved(a_H=[1])
    wide = plan.plan(study(a_H=[n / 7 for n in range(1, 600)]), folder)
    assert len(to_solve(wide)) > 1
    assert to_solve(plan.plan(study(a_H=[1, 3]), folder)) == {"0002": [3]}


def test_a_poorer_batch_is_solved_again_only_if_the_configuration_says_so_outright(solved, monkeypatch):
    folder = solved(a_H=[1, 2], keep="series")
    assert json.loads((folder / "batches/0001.json").read_text())["keep"] == "series"
    for word in ("auto", "summary", "series"):
        assert to_solve(plan.plan(study(a_H=[1, 2], keep=word), folder)) == {}
    planned = plan.plan(study(a_H=[1, 2], keep="all"), folder)
    assert to_solve(planned) == {"0001": [1, 2]}
    assert planned.faults == ["1 batches keep less of each run than is asked for: they are solved again"]
    assert json.loads(planned.batches["0001"].text)["keep"] == "all"
    monkeypatch.setattr(config, "MOST_KEPT_WHOLE", 2)
    assert [study(a_H=axis).keep for axis in ([1, 2], [1, 2, 3])] == ["all", "summary"]


def test_a_poorer_batch_is_solved_again_in_batches_that_one_record_may_hold(solved, monkeypatch):
    """A summary may have 20,000 runs, of any cell size: with profiles too much for memory, or one record."""
    folder = solved(a_H=[1, 2, 3], cells=[40, 80], keep="summary")
    assert len(plan.plan(study(a_H=[1, 2, 3], cells=[40, 80]), folder).batches) == 1
    monkeypatch.setitem(batches.MOST_POINTS, "all", 2)
    richer = plan.plan(study(a_H=[1, 2, 3], cells=[40, 80], keep="all"), folder)
    assert sum(len(batch.points) for batch in richer.batches.values() if batch.text) == 6
    for batch in richer.batches.values():
        assert len(batch.points) <= 2
        assert len({point.cells for point in batch.points}) == 1
        assert {row["batch"] for row in json.loads(richer.points_text)["points"]} == set(richer.batches)
    assert richer.batches["0001"].fault == plan.POORER


def test_tables_do_not_depend_on_the_batches(make_run, solve_study, write_tables, tmp_path):
    tables = []
    for seconds, cores in ((1000, 1), (1, 5)):
        asked = study(a_H=[n / 10 for n in range(1, 31)], batch_seconds=seconds)
        folder = tmp_path / str(cores)
        pace = {"radial:float64 all": 10.0} if cores == 5 else {}
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(plan.pace, "known", lambda known=pace: known)
            patch.setattr(batches, "LEAST", 0.1)
            planned = plan.plan(asked, folder, cores)
            patch.setattr(plan, "plan", lambda *_, planned=planned: planned)
            solve_study(asked, folder, lambda points: [make_run(point) for point in points])
        assert len(planned.batches) == cores
        write_tables(folder, "runs", "series")
        tables.append([(folder / f"tables/{name}.csv").read_bytes() for name in ("runs", "series")])
    assert tables[0] == tables[1]


def test_points_file_states_what_was_asked(solved):
    folder = solved(a_H=[1, 2], figures="none")
    asked = {"study": "t", "model": "radial", "cells": 40, "a_H": [1, 2], "figures": "none"}
    assert Results(folder).asked == asked
    assert json.loads((folder / "points.json").read_text())["keep"] == "all"


def test_points_file_states_runs_in_order_and_companions_apart(solved):
    axes = {"a_H": [1, 2], "cells": [80, 40]}
    plain = json.loads(plan.plan(study(**axes), solved(**axes)).points_text)
    assert [(row["a_H"], row["cells"]) for row in plain["points"]] == [(1, 80), (1, 40), (2, 80), (2, 40)]
    planned = plan.plan(study(bands=True, **axes), solved(**axes))
    added = [point for batch in planned.batches.values() if batch.text for point in batch.points]
    assert sorted((p.a_H, p.cells) for p in added) == [(a_H, cells) for a_H in (1, 2) for cells in (10, 20)]
    index = json.loads(planned.points_text)
    assert index["points"] == plain["points"]
    assert set(index) - set(plain) == {"companions"}
    cells = {row["id"]: row["cells"] for row in index["points"]}
    assert [(cells[row["of"]], row["role"], row["cells"]) for row in index["companions"]] == [
        (80, "cells/2", 40),
        (80, "cells/4", 20),
        (40, "cells/2", 20),
        (40, "cells/4", 10),
    ] * 2


DAMAGE = {
    "a bit of the record": ("records/0001.nc", lambda b: b[:500] + bytes([b[500] ^ 1]) + b[501:], True),
    "half of the record": ("records/0001.nc", lambda b: b[: len(b) // 2], True),
    "an empty record": ("records/0001.nc", lambda b: b"", True),
    "no record": ("records/0001.nc", None, False),
    "no checksum": ("records/0001.nc.sha256", None, True),
    "an empty checksum": ("records/0001.nc.sha256", lambda b: b"", True),
    "a checksum of other bytes": ("records/0001.nc.sha256", lambda b: b"\xff\xfe", True),
    "a checksum of another name": ("records/0001.nc.sha256", lambda b: b.replace(b"0001", b"0002"), True),
    "a checksum with odd notes": ("records/0001.nc.sha256", lambda b: b + b"#\n", True),
    "another batch": ("records/0001.nc.sha256", lambda b: b.replace(b"# batch ", b"# batch 1"), False),
    "other sources": ("records/0001.nc.sha256", lambda b: b.replace(b"# sources ", b"# sources 1"), False),
    "an older version's checksum": (
        "records/0001.nc.sha256",
        lambda b: b.splitlines(keepends=True)[0],
        False,
    ),
    "another text of the batch": ("batches/0001.json", lambda b: b.replace(b"\n", b" \n"), False),
}


@pytest.mark.parametrize("name", DAMAGE)
def test_a_batch_whose_record_is_not_whole_is_solved_again_under_its_name(solved, name):
    file, change, damaged = DAMAGE[name]
    folder = solved(a_H=[1, 2])
    path = folder / file
    path.unlink() if change is None else path.write_bytes(change(path.read_bytes()))
    planned = plan.plan(study(a_H=[1, 2, 3]), folder)
    assert to_solve(planned) == {"0001": [1, 2], "0002": [3]}
    assert planned.batches["0001"].damaged == damaged
    assert len(planned.faults) == 1
    assert to_solve(plan.plan(study(a_H=[2]), folder)) == {"0001": [2]}  # only what is still asked for


STRAY = {
    "nothing": b"",
    "no JSON": b"{",
    "no text": b"\xff\xfe\x00",
    "a list": b"[]",
    "null": b"null",
    "points that are none": b'{"points": [1]}',
    "points that are a number": b'{"points": 1}',
    "ids that are none": b'{"points": [{"id": [1]}]}',
    "deep": b"[" * 100_000,
}


@pytest.mark.parametrize("name", STRAY)
def test_an_unreadable_batch_file_counts_as_not_there(solved, name):
    folder = solved(a_H=[1])
    (folder / "batches/0007.json").write_bytes(STRAY[name])
    assert to_solve(plan.plan(study(a_H=[1, 2]), folder)) == {"0008": [2]}
    (folder / "batches/0001.json").write_bytes(STRAY[name])
    assert to_solve(plan.plan(study(a_H=[1]), folder)) == {"0008": [1]}


def test_other_files_among_the_batches_do_not_matter(solved):
    folder = solved(a_H=[1])
    home = folder / "batches"
    for name in (
        "0001-old.json",
        "0001.json.bak",
        f"{'9' * 240}.json",
        f"{'9' * 10}.json",
        "1.json",
        "notes.json",
        ".0002.json.tmp",
    ):
        (home / name).write_text("{")
    (home / "0003.json").mkdir()
    os.mkfifo(home / "0004.json")
    assert to_solve(plan.plan(study(a_H=[1, 2]), folder)) == {"0005": [2]}


@pytest.mark.parametrize("edit", [('"r": 0.4', '"r": 0.5'), ('"r": 0.4', '"r": 2'), ('"r": 0.4,', "")])
def test_a_batch_with_other_values_than_its_ids_counts_as_not_there(solved, edit):
    folder = solved(a_H=[1])
    path = folder / "batches/0001.json"
    path.write_text(path.read_text().replace(*edit))
    assert to_solve(plan.plan(study(a_H=[1]), folder)) == {"0002": [1]}


@pytest.mark.parametrize("kernels", [None, "../../../../outside/x", "radial:float64", 7])
def test_kernels_that_an_older_batch_names_are_not_used(solved, kernels):
    folder = solved(a_H=[1])
    path = folder / "batches/0001.json"
    path.write_text(json.dumps({"kernels": kernels, **json.loads(path.read_text())}))
    assert to_solve(plan.plan(study(a_H=[1]), folder)) == {"0001": [1]}


def test_a_point_in_two_batches_belongs_to_the_one_that_is_whole(solved):
    folder = solved(a_H=[1, 2])
    for name, suffix in (("records", "nc"), ("records", "nc.sha256"), ("batches", "json")):
        path = folder / name / f"0001.{suffix}"
        copy = folder / name / f"0001p1.{suffix}"
        copy.write_bytes(
            path.read_bytes().replace(b"0001.nc", b"0001p1.nc") if "sha" in suffix else path.read_bytes()
        )
    (folder / "records/0001.nc").write_bytes(b"")
    planned = plan.plan(study(a_H=[1, 2]), folder)
    assert list(planned.batches) == ["0001p1"]
    assert to_solve(planned) == {}


def test_texts_for_jobs_are_named_by_their_content(solved, tmp_path):
    """A plan that is made while another one runs changes none of its texts."""
    home = tmp_path / "cache"
    first = staging.stage(plan.plan(study(a_H=[1, 2]), tmp_path / "none"), home, TABLES, [])
    before = contents(home)
    second = staging.stage(plan.plan(study(a_H=[3]), tmp_path / "none"), home, TABLES, [])
    assert before.items() <= contents(home).items()
    assert set(first.specs.values()).isdisjoint(second.specs.values())
    assert staging.staged(first.path) == first
    first.specs["0001"].write_text("{")  # a full disk, say
    staging.stage(plan.plan(study(a_H=[1, 2]), tmp_path / "none"), home, TABLES, [])
    assert contents(home).items() >= before.items()


def test_notes_of_a_record_name_its_batch_and_sources(solved):
    folder = solved(a_H=[1])
    text = (folder / "batches/0001.json").read_text()
    assert checksums.verify(folder / "records/0001.nc") == {
        "batch": checksums.text_hash(text),
        "sources": subslide.source_hash(),
    }
    assert json.loads(text)["points"][0]["id"] == Point(model="radial", cells=40, a_H=1.0).id


def test_the_catalogue_knows_the_options_that_are_paths():
    for name in scenes.NAMES:
        marked = {option for option, about in scenes.load(name).OPTIONS.items() if about.get("reads")}
        assert catalogue.options_that_read(name) == marked
    assert catalogue.options_that_read("raster") == {"file"}


def test_a_raster_is_known_by_its_content(tmp_path, monkeypatch, solve_study, make_run):
    """However its path is spelt, and wherever it was moved; another content is another point."""
    monkeypatch.chdir(tmp_path)

    def rasters(*files):
        cases = [{"scene_options": {"file": file}} for file in files]
        return config.make_study({"study": "t", "scene": "raster", "cells": 40, "cases": cases})

    write_raster("one.nc", 0.01)
    write_raster("two.nc", 0.02)
    assert len(rasters("one.nc", "./one.nc", str(tmp_path / "one.nc")).points) == 1
    solve_study(
        rasters("one.nc", "two.nc"), tmp_path / "t", lambda points: [make_run(point) for point in points]
    )
    os.mkdir("elsewhere")
    os.rename("one.nc", "elsewhere/1.nc")
    moved = rasters("elsewhere/1.nc", "two.nc")
    assert not [batch for batch in plan.plan(moved, tmp_path / "t").batches.values() if batch.text]
    write_raster("two.nc", 0.03)
    (tmp_path / "t/records/0001.nc").unlink()
    planned = plan.plan(rasters("elsewhere/1.nc", "two.nc"), tmp_path / "t")
    files = {name: [dict(p.scene_options)["file"] for p in b.points] for name, b in planned.batches.items()}
    assert files == {"0001": ["elsewhere/1.nc"], "0002": ["two.nc"]}


def write_raster(path, depth):
    """Write a raster of an even depth."""
    with netCDF4.Dataset(path, "w") as data:
        for key in ("y", "x"):
            data.createDimension(key, 8)
            data.createVariable(key, "f8", (key,))[:] = np.linspace(-0.1, 0.1, 8)
        data.createVariable("h2", "f8", ("y", "x"))[:] = depth
