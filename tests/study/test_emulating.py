"""From a study to an emulator: what is learned from, what is refused, columns that it asks for."""

import numpy as np
import pytest
from learned import columns, measured

from subslide import checksums
from subslide.__main__ import main
from subslide.checksums import seal
from subslide.emulator import Emulator, growing, training
from subslide.files import write_text
from subslide.keys.schema import ConfigError
from subslide.points import Point
from subslide.results import Results


def test_one_grid_teaches_nothing(trained):
    one = [run for run in measured(columns(32)) if run.point.cells in (192, 1600)]
    with pytest.raises(ConfigError, match="at least two numbers of cells"):
        training.learn(one, {})


def test_few_columns_are_refused():
    with pytest.raises(ConfigError, match="8 columns are known; allowed: at least 20"):
        training.learn(measured(columns(8)), {})


@pytest.mark.parametrize(
    ("values", "told"),
    [({"friction": "voellmy"}, "coulomb"), ({"a_H": 0.1}, "a_H is 0.1"), ({"delta": 3}, "m is")],
)
def test_other_runs_are_refused(values, told):
    with pytest.raises(ConfigError, match=told):
        training.refuse(Point(**values))


def test_columns_are_added_where_it_is_least_sure(trained):
    chosen = growing.least_sure(trained, "L_f_1pc", 16)
    known = np.array(columns(64))
    logs = [np.log(rows * [1, 0, 1] + [0, 1, 0]) + rows * [0, 1, 0] for rows in (chosen, known)]
    apart = np.linalg.norm(logs[0][:, None] - logs[1][None], axis=2).min(axis=1)
    among = [np.linalg.norm(logs[0] - row, axis=1) for row in logs[0]]
    assert apart.min() > 0.05  # none where a point is known
    assert np.sort(among, axis=1)[:, 1].min() > 0.05  # nor twice


def test_growing_ends_when_leave_one_out_holds(monkeypatch):
    asked = []

    def solve(points, processes):
        rows = {point.similarity_key for point in points}
        asked.append(len(rows))
        return measured(sorted(rows))

    monkeypatch.setattr(growing, "solved", solve)
    first = training.learn(measured(columns(32)), {})
    before = growing.reached(first, "L_f_1pc")
    goal = growing.Goal("L_f_1pc", before / 2, 256)
    lines = []
    trained, added = growing.grow(measured(columns(32)), {}, goal, 1, lines.append)
    assert growing.reached(trained, "L_f_1pc") <= goal.error
    assert len(added) == 4 * sum(asked)
    assert lines[-1].endswith(f"{sum(asked)} columns added")


@pytest.fixture(scope="module")
def study_of(tmp_path_factory):
    """Function that solves a study of a few columns on two coarse fitted grids, and returns its folder."""
    from subslide.jobs import keep_batch
    from subslide.solver import solve
    from subslide.study import config, plan

    def make(name, count, seed):
        over = {"a_H": [0.6, 9], "r": [0.05, 0.75], "m": [0.3, 2.5]}
        values = {
            "study": name,
            "grid": "fitted",
            "quantities": "grains",
            "cells": [24, 34],
            "figures": "none",
        }
        design = {"latin_hypercube": {"points": count, "seed": seed, "over": over}}
        study, folder = (
            config.make_study({**values, "design": design}),
            tmp_path_factory.mktemp("made") / name,
        )
        planned = plan.plan(study, folder)
        for part in ("records", "batches"):
            (folder / part).mkdir(parents=True)
        for batch, of in planned.batches.items():
            path = str(plan.record_path(folder, batch))
            keep_batch(
                [solve(p) for p in of.points], path, str(folder / "batches" / f"{batch}.json"), study.keep
            )
        write_text(folder / "points.json", planned.points_text)
        seal(folder / "points.json")
        return folder

    return make


def test_emulate_makes_a_sealed_file_that_no_held_out_column_changes(study_of, capsys):
    folder, other = study_of("learnt", 24, 1), study_of("held", 8, 2)
    assert main(["emulate", str(folder)]) == 0
    alone = (folder / "emulator.json").read_bytes()
    assert "L_f_1pc" in capsys.readouterr().out
    checksums.verify(folder / "emulator.json")
    assert main(["emulate", str(folder), "--held-out", str(other)]) == 0
    assert (folder / "emulator.json").read_bytes() == alone
    assert f"held out, {other}" in capsys.readouterr().out
    inside = Emulator.load(folder / "emulator.json").predict(2, 0.4, 1.0, quantities=["L_f_1pc"])["L_f_1pc"]
    assert 1.5 < inside.value[0] < 2.5

    assert main(["emulate", str(folder), "--held-out", str(folder)]) == 2
    assert "48 of its 48 runs are of columns that are learned" in capsys.readouterr().err

    words = ["emulate", str(folder), "--to", "0.01%", "--most", "3", "--cores", "1"]
    assert main(words) == 0
    assert "3 columns added" in capsys.readouterr().out
    assert main(["emulate", str(folder)]) == 0  # what was added is there again
    assert "fronts: 27 columns" in capsys.readouterr().out
    added = {run.point.similarity_key for run in growing.kept(folder)}
    assert not added & {run.point.similarity_key for run in training.of_study(Results(other))}


def test_emulate_refuses_what_is_no_goal(tmp_path, capsys):
    assert main(["emulate", str(tmp_path), "--to", "2"]) == 2
    assert "--to: '2' is not allowed; allowed: a share" in capsys.readouterr().err
    assert main(["emulate", str(tmp_path), "--to", "2%", "--quantity", "L"]) == 2
    assert "--quantity: L is not allowed; allowed: L_f_1pc" in capsys.readouterr().err
