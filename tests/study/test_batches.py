"""The ledger: it only grows, points keep their batch, and jobs never extend it."""

import json
import os

import pytest

from subslide.files import file_hash
from subslide.keys.schema import ConfigError
from subslide.points import Point, to_dict
from subslide.study import batches, choice, config


def study(**axes):
    return config.make_study({"study": "t", "model": "radial", "cells": 40, **axes})


def test_points_keep_their_batch_when_the_study_changes(tmp_path):
    first = batches.plan(study(a_H=[1, 2]), tmp_path, extend=True)
    owner = batches.read(tmp_path)[0]
    wider = batches.plan(study(a_H=[0.5, 2, 1]), tmp_path, extend=True)
    assert set(first.batches) < set(wider.batches)
    assert owner.items() <= batches.read(tmp_path)[0].items()
    narrower = batches.plan(study(a_H=[0.5]), tmp_path, extend=True)
    assert set(narrower.batches) == set(wider.batches) - set(first.batches)
    assert batches.plan(study(a_H=[2, 1]), tmp_path, extend=True) == first


def test_one_more_value_makes_one_more_batch(tmp_path):
    values = [n / 10 for n in range(1, 11)]
    grid = {"a_2": values, "r": [n / 20 for n in range(10)]}
    batches.plan(study(a_H=values, **grid), tmp_path, extend=True)
    before = {path: path.read_bytes() for path in (tmp_path / "batches").iterdir()}
    batches.plan(study(a_H=[*values, 7], **grid), tmp_path, extend=True)
    after = {path: path.read_bytes() for path in (tmp_path / "batches").iterdir()}
    assert before.items() <= after.items()
    assert len(after) == len(before) + 1


def test_points_file_states_runs_in_order_and_is_left_alone_if_equal(tmp_path):
    batches.plan(study(a_H=[2, 1]), tmp_path, extend=True)
    path = tmp_path / "points.json"
    written = path.stat().st_mtime_ns
    assert [row["a_H"] for row in json.loads(path.read_text())["points"]] == [2, 1]
    batches.plan(study(a_H=[2, 1]), tmp_path, extend=True)
    assert path.stat().st_mtime_ns == written


def test_companions_are_planned_and_listed_apart(tmp_path):
    axes = {"a_H": [1, 2], "cells": [80, 40]}
    without = batches.plan(study(**axes), tmp_path, extend=True)
    plain = json.loads((tmp_path / "points.json").read_text())
    with_bands = batches.plan(study(bands=True, **axes), tmp_path, extend=True)
    new = set(with_bands.batches) - set(without.batches)
    added = [p for name in sorted(new) for p in batches.read_batch(tmp_path / "batches" / f"{name}.json")]
    assert sorted((p.a_H, p.cells) for p in added) == [(a_H, cells) for a_H in (1, 2) for cells in (10, 20)]
    index = json.loads((tmp_path / "points.json").read_text())
    assert index["points"] == plain["points"]
    assert set(index) - set(plain) == {"companions"}
    cells = {row["id"]: row["cells"] for row in index["points"]}
    assert [(cells[row["of"]], row["role"], row["cells"]) for row in index["companions"]] == [
        (80, "cells/2", 40),
        (80, "cells/4", 20),
        (40, "cells/2", 20),
        (40, "cells/4", 10),
    ] * 2
    assert batches.plan(study(**axes), tmp_path, extend=True) == without
    assert json.loads((tmp_path / "points.json").read_text()) == plain


def test_the_papers_study_is_balanced(root):
    solved = config.read_study(root / "config/paper.yaml").solved
    parts = batches.split(list(solved))
    costs = [sum(map(batches.cost, batch)) for batch in parts]
    assert max(costs) < 1.1 * max(batches.SECONDS[0], sum(costs) / batches.PARTS)
    for cells in (3200, 200):  # what costs most is spread
        shares = [c for c, b in zip(costs, parts, strict=True) if b[0].cells == cells]
        assert len(shares) > 1
        assert max(shares) < 1.3 * min(shares)


def test_the_round_column_is_cheap_where_the_model_is_left_open():
    costs = {m: batches.cost(Point(model=m, cells=800)) for m in ("auto", "radial", "quarter", "plane")}
    assert costs["auto"] == costs["radial"] < costs["quarter"] / 100 < costs["plane"] / 100


def test_a_job_reads_the_ledger_and_never_extends_it(tmp_path):
    with pytest.raises(batches.LedgerError, match="main process"):
        batches.plan(study(a_H=[1]), tmp_path, extend=False)
    assert list(tmp_path.iterdir()) == []
    planned = batches.plan(study(a_H=[1]), tmp_path, extend=True)
    assert batches.plan(study(a_H=[1]), tmp_path, extend=False) == planned


def test_two_planners_at_once_lose_nothing(tmp_path, monkeypatch):
    """The second one finds its number taken, reads again and goes on with what is left."""
    link, raced = batches.os.link, []

    def slow_link(source, target):
        if not raced:
            raced.append(1)
            batches.plan(study(a_H=[1, 3]), tmp_path, extend=True)
        link(source, target)

    monkeypatch.setattr(batches.os, "link", slow_link)
    batches.plan(study(a_H=[1, 2]), tmp_path, extend=True)
    owner = batches.read(tmp_path)[0]
    assert {p.id for p in study(a_H=[1, 2, 3]).points} == set(owner)
    assert not [path for path in (tmp_path / "batches").iterdir() if path.suffix == ".tmp"]


def test_an_unreadable_batch_file_counts_as_empty(tmp_path):
    first = batches.plan(study(a_H=[1]), tmp_path, extend=True)
    (tmp_path / "batches" / f"{next(iter(first.batches))}.json").write_text("{")
    assert batches.plan(study(a_H=[1]), tmp_path, extend=True).batches != first.batches


def test_batches_share_a_cell_size_and_kind_and_are_balanced():
    points = [
        Point(model=m, cells=c, r=n / 20) for m in ("radial", "plane") for c in (100, 200) for n in range(8)
    ]
    parts = batches.split(points)
    assert sorted(p.id for batch in parts for p in batch) == sorted(p.id for p in points)
    for batch in parts:
        assert len({(p.dx, choice.kernels(p)) for p in batch}) == 1
    heavy = [sum(map(batches.cost, b)) for b in parts if (b[0].model, b[0].cells) == ("plane", 200)]
    assert len(heavy) > 1
    assert max(heavy) <= 2 * min(heavy)


def test_no_batch_is_larger_than_its_limit():
    parts = batches.split([Point(model="radial", cells=20, r=n / 2000) for n in range(1000)])
    assert max(map(len, parts)) <= batches.MOST_POINTS


def test_batch_files_hold_whole_points(tmp_path):
    points = study(a_H=[1, 2], t_end=["rest", 0.5]).points
    plan = batches.plan(study(a_H=[1, 2], t_end=["rest", 0.5]), tmp_path, extend=True)
    read = [p for name in plan.batches for p in batches.read_batch(tmp_path / "batches" / f"{name}.json")]
    assert sorted(read, key=lambda p: p.id) == sorted(points, key=lambda p: p.id)


ROW = {"id": Point(cells=20).id, **to_dict(Point(cells=20))}
EDITED = {
    "nothing": ("", "not a batch file"),
    "no points": ('{"points": []}', "the key 'kernels' is missing"),
    "an empty list of points": ({"points": []}, "points: [] is not allowed"),
    "a list": ([1], "not a batch file"),
    "points that are none": ({"points": [3]}, "points[0]: 3 is no point"),
    "points that are a mapping": ({"points": {"id": 1}}, "a list of points"),
    "deep nesting": ("[" * 100_000, "nested too deep"),
    "a huge integer": ('{"points": [' + "1" * 5000 + "]}", "not a batch file"),
    "an unknown kernel": ({"kernels": "../../x"}, "kernels: ../../x"),
    "a kernel that is a list": ({"kernels": []}, "kernels: []"),
    "another id": ({"id": "p0"}, "belong to " + ROW["id"]),
    "a value out of range": ({"r": 2.0}, "points[0]: r: 2.0 is not allowed; allowed: a number from 0"),
    "not a number": ({"r": float("nan")}, "r: .nan"),
    "text for a number": ({"a_H": "1"}, "a_H: '1' is text"),
    "an unknown scene": ({"scene": "cylindr"}, "did you mean 'cylinder'?"),
    "an unknown option": ({"scene_options": {"x": 1}}, "no such option"),
    "values that do not go together": ({"model": "one-layer"}, "only with r: 0"),
    "a key too many": ({"zzz": 1}, "zzz: there is no such key"),
    "a key too few": ({"cfl": None}, "cfl: this key is missing"),
}


@pytest.mark.parametrize("what", EDITED)
def test_a_batch_file_that_was_edited_is_refused(tmp_path, what):
    text, part = EDITED[what]
    if isinstance(text, dict):
        row = {key: value for key, value in {**ROW, **text}.items() if value is not None and key != "kernels"}
        batch = {"kernels": "radial:float64", "points": [row]}
        text = {**batch, **{key: text[key] for key in batch if key in text}}
        row.pop("points", None)
        if "r" in row and row["r"] == 2:
            row["id"] = Point(cells=20, r=2.0).id
    path = tmp_path / "b.json"
    path.write_text(text if isinstance(text, str) else json.dumps(text))
    with pytest.raises(ConfigError) as caught:
        batches.read_batch(path)
    assert str(caught.value).startswith(f"{path}: ")
    assert part in str(caught.value)


def test_a_batch_file_is_a_regular_file(tmp_path):
    os.mkfifo(tmp_path / "b.json")
    with pytest.raises(ConfigError, match="a pipe"):
        batches.read_batch(tmp_path / "b.json")


def test_damaged_records_are_found(tmp_path):
    (tmp_path / "records").mkdir()
    record = tmp_path / "records/0001.nc"
    record.write_bytes(b"abc")
    (tmp_path / "records/0001.nc.sha256").write_text(f"{file_hash(record)}  0001.nc\n")
    assert batches.damaged(tmp_path, ("0001", "0002")) == []
    record.write_bytes(b"abd")
    assert batches.damaged(tmp_path, ("0001", "0002")) == [record]
