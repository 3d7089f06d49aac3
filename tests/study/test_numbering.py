"""Numbers of runs: each is given once within a study, whatever becomes of the batch that it was given to."""

import json

import netCDF4
import pytest

from subslide.keys.schema import ConfigError
from subslide.study import batches, config, numbering, plan
from subslide.study.pruning import prune


def study(**axes):
    return config.make_study({"study": "t", "model": "radial", "cells": 40, **axes})


@pytest.fixture
def solve(solve_study, make_run, tmp_path):
    """Function that solves a study as the workflow does, and returns the numbers of the runs of each record."""

    def solve(**axes):
        planned = plan.plan(study(**axes), tmp_path)
        solve_study(study(**axes), tmp_path, lambda points: [make_run(point) for point in points])
        numbering.keep(tmp_path, planned.next_run)
        return numbers(tmp_path)

    return solve


def numbers(folder):
    """Numbers and ids of the runs of each record, by its name."""
    read = {}
    for path in sorted((folder / "records").glob("*.nc")):
        with netCDF4.Dataset(path) as data:
            read[path.stem] = dict(zip(data["run"][:].tolist(), data["id"][:].tolist(), strict=True))
    return read


def test_numbers_grow_with_the_batches(solve, tmp_path):
    solve(a_H=[1, 2])
    solve(a_H=[0.5, 1, 2, 3])
    assert {name: list(of) for name, of in solve(a_H=[0.5, 1, 2, 3, 4]).items()} == {
        "0001": [1, 2],
        "0002": [3, 4],
        "0003": [5],
    }
    assert numbering.kept(tmp_path) == 6
    assert plan.plan(study(a_H=[1, 2]), tmp_path).next_run == 6


def test_the_same_batch_solved_again_keeps_its_numbers_and_another_gets_new_ones(solve, tmp_path):
    before = solve(a_H=[1, 2, 3])
    (tmp_path / "records/0001.nc").unlink()
    assert solve(a_H=[3, 2, 1]) == before
    (tmp_path / "records/0001.nc").unlink()
    after = solve(a_H=[3, 2])
    assert list(after["0001"]) == [4, 5]
    assert set(after["0001"].values()) < set(before["0001"].values())


@pytest.mark.parametrize(
    "what", ["pruned", "pruned, unnumbered", "damaged", "never solved", "of an older version"]
)
def test_no_number_is_given_twice(solve, tmp_path, what):
    """Batches that are gone, unreadable or were stopped leave their numbers behind."""
    solve(a_H=[1, 2])
    before = solve(a_H=[1, 2, 3, 4])
    ledger = tmp_path / "batches/0002.json"
    if "pruned" in what:
        if "unnumbered" in what:
            (tmp_path / "batches" / numbering.FILE).unlink()
        assert prune(study(a_H=[1, 2]), tmp_path).batches == 1
    elif what == "damaged":
        ledger.write_text("{")
    elif what == "never solved":
        numbering.keep(tmp_path, plan.plan(study(a_H=[1, 2, 3, 4, 5]), tmp_path).next_run)
    else:
        ledger.write_text(json.dumps({**json.loads(ledger.read_text()), numbering.KEY: None}))
        (tmp_path / "records/0002.nc").unlink()
    after = solve(a_H=[1, 2, 3, 4, 5])
    given = [*before.items(), *((name, of) for name, of in after.items() if before.get(name) != of)]
    used = [(number, id_) for _, of in given for number, id_ in of.items()]
    assert len({number for number, _ in used}) == len(set(used)) == len(used)
    assert {id_ for of in after.values() for id_ in of.values()} >= {
        p.id for p in study(a_H=[1, 2, 3, 4, 5]).points
    }


@pytest.mark.parametrize("text", [None, "", "-3", "99999999999999"])
def test_without_a_sound_file_the_ledger_tells(solve, tmp_path, text):
    solve(a_H=[1, 2])
    path = tmp_path / "batches" / numbering.FILE
    path.unlink() if text is None else path.write_text(text)
    assert list(solve(a_H=[1, 2, 3])["0002"]) == [3]
    assert path.read_text() == "4\n"


@pytest.mark.parametrize("value", [-1, 2**31, "1", True, None, 1.0, [1]])
def test_a_batch_file_with_a_number_that_is_none_is_refused(tmp_path, value):
    text = json.loads(batches.spec_text(study(a_H=[1]).points))
    (tmp_path / "b.json").write_text(json.dumps({**text, numbering.KEY: value}))
    with pytest.raises(
        ConfigError, match=r"b\.json: first_run: .* is not allowed; allowed: a whole number from 0"
    ):
        batches.read_batch(tmp_path / "b.json")
