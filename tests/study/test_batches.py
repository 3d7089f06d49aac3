"""Batches: balanced, of one kind each, and files that are refused in one line where they are none."""

import json
import os

import pytest

from subslide.keys.schema import ConfigError
from subslide.points import Point, to_dict
from subslide.study import batches, choice, config, cost, pace


def study(**axes):
    return config.make_study({"study": "t", "model": "radial", "cells": 40, **axes})


def test_the_papers_study_is_balanced(root):
    solved = config.read_study(root / "config/paper.yaml").solved
    parts = batches.split(list(solved))
    costs = [sum(map(cost.seconds, batch)) for batch in parts]
    assert costs == sorted(costs, reverse=True)
    assert max(costs) < 1.1 * max(batches.LEAST, sum(costs) / 2)
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


@pytest.mark.parametrize(("seconds", "cores"), [(30, 2), (2, 2), (1, 4), (1000, 3)])
def test_cores_end_together(seconds, cores):
    """Jobs in order, each on the core that is free first: all cores end within a share of the last round."""
    points = [Point(model="radial", cells=200, r=n / 4000, t_end=0.1 + (n % 7) / 10) for n in range(1500)]
    sharing = batches.Sharing("summary", seconds, cores)
    costs = [sum(map(sharing.cost, batch)) for batch in batches.split(points, sharing)]
    busy = [0.0] * cores
    for each in costs:
        busy[busy.index(min(busy))] += each
    assert max(costs) < 1.3 * max(seconds, batches.LEAST)
    assert max(busy) - min(busy) <= 0.1 * max(busy) + min(costs)
    assert len(costs) <= cores + sum(costs) / min(seconds, batches.LEAST) * 1.5


def test_a_small_kind_that_comes_last_is_shared_out_too():
    points = [Point(model="radial", cells=200, r=n / 4000) for n in range(1, 2001)]
    points += [Point(model="one-layer", cells=200, r=0, delta=20 + n / 500) for n in range(3000)]
    slow = {pace.kind(points[0], "summary"): 60.0}
    parts = batches.split(points, batches.Sharing("summary", 30, 2, slow))
    assert sorted(p.id for batch in parts for p in batch) == sorted(p.id for p in points)
    assert [batch[0].model for batch in parts[-3:]] == ["radial", "one-layer", "one-layer"]
    assert len(parts[-1]) == len(parts[-2]) == 1500


def test_the_seconds_of_many_runs_are_told_by_some():
    points = [Point(model="radial", cells=200, a_H=0.5 + n / 200) for n in range(2000)]
    assert cost.of_all(points, "summary") == pytest.approx(
        sum(cost.seconds(p, "summary") for p in points), rel=0.02
    )
    assert cost.of_all([], "all") == 0
    assert cost.of_all(points[:3], "all") == pytest.approx(sum(map(cost.seconds, points[:3])))


def test_a_costly_point_has_a_batch_to_itself():
    costly = Point(model="quarter", cells=1000)
    points = [*(Point(model="quarter", cells=40, r=n / 1000) for n in range(200)), costly]
    first, second = batches.split(points, batches.Sharing("summary"))
    assert first == [costly]
    assert len(second) == 200


def test_a_slow_machine_has_smaller_batches():
    points = [Point(model="radial", cells=400, r=n / 1000) for n in range(700)]
    kind = pace.kind(points[0], "summary")
    sizes = [
        max(map(len, batches.split(points, batches.Sharing("summary", 1, 1, {kind: ratio}))))
        for ratio in (2, 8)
    ]
    assert sizes[1] < sizes[0] / 3


def test_the_pace_is_learnt_and_a_damaged_file_counts_as_none(tmp_path, monkeypatch):
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path))
    assert pace.known() == {}
    pace.learn("a", 4.0, 2.0)
    pace.learn("b", 1.0, 0.1)  # too short to tell
    assert pace.known() == {"a": 2.0}
    pace.learn("a", 2.0, 2.0)
    assert 1 < pace.known()["a"] < 2
    file = tmp_path / "pace.json"
    for damage in (b"", b"{", b"[1]", b"\xff", b'{"a": null, "b": 1e99, "c": "x", "d": NaN}', b"[" * 100_000):
        file.write_bytes(damage)
        assert pace.known() == {}
    pace.learn("a", 2.0, 2.0)
    assert json.loads(file.read_text()) == {"a": 1.0}


def test_no_batch_is_larger_than_its_limit():
    parts = batches.split([Point(model="radial", cells=20, r=n / 2000) for n in range(1000)])
    assert max(map(len, parts)) <= batches.MOST_POINTS["all"]


def test_batch_files_hold_whole_points(tmp_path):
    points = study(a_H=[1, 2], t_end=["rest", 0.5]).points
    (tmp_path / "b.json").write_text(batches.spec_text(points))
    assert batches.read_batch(tmp_path / "b.json") == (list(points), "all", 0)


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


def test_nothing_to_solve_makes_no_batch():
    assert batches.split([], batches.Sharing("all", 30.0, 2)) == []
