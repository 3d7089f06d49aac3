"""Batches: balanced, of one kind each, and files that are refused in one line where they are none."""

import json
import os

import pytest

from subslide.keys.schema import ConfigError
from subslide.points import Point, to_dict
from subslide.study import batches, choice, config, cost


def study(**axes):
    return config.make_study({"study": "t", "model": "radial", "cells": 40, **axes})


def test_the_papers_study_is_balanced(root):
    solved = config.read_study(root / "config/paper.yaml").solved
    parts = batches.split(list(solved))
    costs = [sum(map(cost.seconds, batch)) for batch in parts]
    assert max(costs) < 1.1 * max(batches.SECONDS[0], sum(costs) / batches.PARTS)
    for cells in (3200, 200):  # what costs most is spread
        shares = [c for c, b in zip(costs, parts, strict=True) if b[0].cells == cells]
        assert len(shares) > 1
        assert max(shares) < 1.3 * min(shares)


def test_the_round_column_is_cheap_where_the_model_is_left_open():
    costs = {m: cost.seconds(Point(model=m, cells=800)) for m in ("auto", "radial", "quarter", "plane")}
    assert costs["auto"] == costs["radial"] < costs["quarter"] / 100 < costs["plane"] / 100


def test_batches_share_a_cell_size_and_kind_and_are_balanced():
    points = [
        Point(model=m, cells=c, r=n / 20) for m in ("radial", "plane") for c in (100, 200) for n in range(8)
    ]
    parts = batches.split(points)
    assert sorted(p.id for batch in parts for p in batch) == sorted(p.id for p in points)
    for batch in parts:
        assert len({(p.dx, choice.kernels(p)) for p in batch}) == 1
    heavy = [sum(map(cost.seconds, b)) for b in parts if (b[0].model, b[0].cells) == ("plane", 200)]
    assert len(heavy) > 1
    assert max(heavy) <= 2 * min(heavy)


def test_no_batch_is_larger_than_its_limit():
    parts = batches.split([Point(model="radial", cells=20, r=n / 2000) for n in range(1000)])
    assert max(map(len, parts)) <= batches.MOST_POINTS


def test_batch_files_hold_whole_points(tmp_path):
    points = study(a_H=[1, 2], t_end=["rest", 0.5]).points
    (tmp_path / "b.json").write_text(batches.spec_text(points))
    assert batches.read_batch(tmp_path / "b.json") == (list(points), "all")


ROW = {"id": Point(cells=20).id, **to_dict(Point(cells=20))}
EDITED = {
    "nothing": ("", "not a batch file"),
    "no points": ('{"points": []}', "points: [] is not allowed"),
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
