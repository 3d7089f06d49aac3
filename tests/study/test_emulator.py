"""The emulator: it learns formulas, its bands hold, its file is whole, small and read by numpy alone."""

import json
import math
import subprocess
import sys

import numpy as np
import pytest
from learned import answer, columns, measured

from subslide import checksums
from subslide.__main__ import main
from subslide.checksums import seal
from subslide.emulator import Emulator, coordinates, fitting, group, growing, judging, model, training
from subslide.emulator import measures as named
from subslide.files import RecordError, write_text
from subslide.keys.schema import ConfigError
from subslide.points import Point
from subslide.results import Results


@pytest.fixture(scope="session")
def trained():
    """What 64 columns taught."""
    return training.learn(measured(columns(64)), {"study": "formulas"})


@pytest.fixture
def saved(trained, tmp_path):
    """Its file."""
    trained.emulator.save(tmp_path / "emulator.json")
    return tmp_path / "emulator.json"


def inner(count):
    """Columns that nothing learned from, within the range of what did."""
    return [
        row
        for row in columns(count, seed=9)
        if 0.6 < row[0] < 9 and 0.05 < row[1] < 0.75 and 0.3 < row[2] < 2.5
    ]


def test_it_gives_the_limit_of_ever_finer_grids(trained):
    rows = inner(256)
    predicted = trained.emulator.predict(*np.array(rows).T)
    for name in ("L_f_1pc", "time_of_arrest_3pc"):
        exact = np.array([answer(*row)[name] for row in rows])
        assert (
            np.quantile(np.abs(predicted[name].value / exact - 1), 0.95) < 2e-3
        )  # grids are off by up to 3e-3
    peak = np.array([max(answer(*row)[name] for name in named.WINDOWS) for row in rows])
    assert np.quantile(np.abs(predicted[named.PEAK].value / peak - 1), 0.95) < 5e-3


def test_bands_hold_what_they_should(trained):
    for name, one in trained.left_out.items():
        assert one.covered > 0.9, name
    rows = inner(256)
    value, band = trained.emulator.predict(*np.array(rows).T)["L_f_1pc"]
    exact = np.array([answer(*row)["L_f_1pc"] for row in rows])
    assert np.mean(np.abs(value - exact) <= band) > 0.9
    assert np.median(band / value) < 5e-3


def test_leave_one_out_is_what_a_fit_without_the_point_predicts(trained):
    """By the formula for all at once; the kernel is the same, so only that point's part may differ."""
    fronts = trained.emulator.groups["fronts"]
    runs = training.limits(measured(columns(64)))["fronts"]
    kept = np.arange(64) != 5
    z = coordinates.of(fronts.kind, runs.inputs)
    basis = coordinates.quadratic(z)
    rest = (runs.values / np.exp(basis @ fronts.law) - basis @ fronts.trend)[:, 0]
    covariance = group.kernel(z / fronts.process.lengths, z / fronts.process.lengths) + 1e-6 * np.eye(64)
    inverse = np.linalg.inv(covariance)
    quick = rest[5] - (inverse @ rest)[5] / inverse[5, 5]
    slow = covariance[5, kept] @ np.linalg.solve(covariance[np.ix_(kept, kept)], rest[kept])
    assert quick == pytest.approx(slow, rel=1e-6, abs=1e-12)


def test_the_file_gives_the_same_and_is_small(trained, saved):
    again = Emulator.load(saved)
    rows = np.array(inner(64)).T
    for name, (value, band) in trained.emulator.predict(*rows).items():
        other = again.predict(*rows)[name]
        assert np.allclose(other.value, value, rtol=5e-5)  # numbers of float32
        assert np.allclose(other.band, band, rtol=1e-4)
    assert saved.stat().st_size < 60_000
    assert again.about["leave_one_out"]["L_f_1pc"]["of_95_percent"] < 0.01


def test_predicting_needs_numpy_alone(saved):
    code = (
        "import sys; from subslide.emulator import Emulator;"
        f"Emulator.load({str(saved)!r}).predict(2, 0.4, 1.1);"
        "print([name for name in ('sklearn', 'scipy', 'numba', 'xarray', 'pandas') if name in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


def test_a_2_and_delta_stand_for_m(trained):
    m = math.tan(math.radians(32)) / 0.56
    by_m = trained.emulator.predict(2, 0.4, m)["L_f_1pc"].value
    assert trained.emulator.predict(2, 0.4, a_2=0.56, delta=32)["L_f_1pc"].value == by_m
    with pytest.raises(ConfigError, match="allowed: one of the two"):
        trained.emulator.predict(2, 0.4, m, a_2=0.56, delta=32)


@pytest.mark.parametrize(
    ("row", "told"), [((20, 0.4, 1), "a_H"), ((2, 0.9, 1), "r"), ((2, 0.4, 5), "m = tan")]
)
def test_it_refuses_what_it_has_not_learned(trained, row, told):
    with pytest.raises(ConfigError, match=f"{told}.*outside what the emulator learned; allowed"):
        trained.emulator.predict(*row)


def test_fronts_at_any_time_go_on_and_end_as_the_deposit(trained):
    times = np.linspace(0, 30, 301)
    predicted = trained.emulator.predict([1.0, 4.0], [0.2, 0.6], [0.5, 1.5], times=times)
    front = predicted["x_front_1pc"].value
    assert front.shape == (2, 301)
    assert np.allclose(front[:, 0], 1)
    assert (np.diff(front, axis=1) > -1e-3).all()
    assert np.allclose(front[:, -1], predicted["L_f_1pc"].value)


def test_points_are_the_same_alone_and_in_bulk(trained):
    rows = np.array(inner(900))
    bulk = trained.emulator.predict(*rows.T)["x_front_3pc"].value
    alone = trained.emulator.predict(*rows[-1])["x_front_3pc"].value
    assert len(rows) > model.CHUNK
    assert np.allclose(bulk[-1], alone[0], rtol=1e-12)


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


@pytest.mark.parametrize(
    "harm", [lambda t: t[:-20], lambda t: t.replace("subslide emulator 1", "x"), lambda t: "[]"]
)
def test_a_damaged_file_is_told(saved, harm):
    saved.write_text(harm(saved.read_text()))
    with pytest.raises(RecordError, match="no file of an emulator"):
        Emulator.load(saved)


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


def test_held_out_columns_change_nothing(trained):
    known = training.limits(measured(inner(64)))
    errors = judging.against(trained.emulator, known)
    assert errors["L_f_1pc"].covered > 0.8
    assert np.quantile(np.abs(errors["L_f_1pc"].error), 0.5) < 1e-3
    assert len(errors["x_front_1pc"].value) == len(known["fronts"].inputs) * len(named.FRONT_NODES)


def test_a_band_holds_its_share_of_errors():
    rng = np.random.default_rng(3)
    rows = np.array(columns(2000))
    size = 0.01 * rows[:, 0]  # errors that grow tenfold over the range
    errors = size * rng.standard_normal(2000)
    coefficients = fitting.band_of(coordinates.GRAINS, rows, errors, np.zeros(2000))
    band = np.exp(coordinates.of_errors(coordinates.of(coordinates.GRAINS, rows)) @ coefficients)
    for half in (rows[:, 0] < 2, rows[:, 0] >= 2):
        assert 0.93 < np.mean(np.abs(errors[half]) <= band[half]) < 0.97


@pytest.mark.parametrize("count", [20, 40])
def test_bands_of_few_columns_hold_columns_that_were_not_seen(count):
    names = ("L_f_1pc", "L_f_5pc")

    def values(rows):
        told = Emulator.load().predict(*rows.T, quantities=names)
        return np.stack([told[name].value for name in names], axis=1)

    others, held = np.array(inner(400)), []
    for seed in range(4):
        rows = np.array(columns(count, seed))
        known = fitting.learn(coordinates.GRAINS, names, rows, values(rows), 1e-4 * values(rows)).group
        guess, band = known(others)
        held.append(np.abs(guess - values(others)) <= band)
    assert np.mean(held) > 0.95
    assert np.mean(held, axis=1).min() > 0.85


def test_predict_prints_scaled_values_and_si_units(saved, capsys):
    assert main(["predict", "--a-H", "2", "--r", "0.4", "--a-2", "0.56", "--emulator", str(saved)]) == 0
    printed = capsys.readouterr().out
    row = next(line for line in printed.splitlines() if line.startswith("L_f_1pc"))
    value, _, metres = (float(word) for word in row.split()[1:4])
    assert metres == pytest.approx(0.0705 * value, rel=1e-3)
    assert main(["predict", "--a-H", "20", "--emulator", str(saved)]) == 2
    assert "allowed: 0.5" in capsys.readouterr().err


def test_predict_prints_nothing_of_what_it_refuses(saved, capsys):
    assert main(["predict", "--emulator", str(saved), "--a-H", "20"]) == 2
    printed = capsys.readouterr()
    assert printed.out == ""
    assert printed.err.startswith("subslide: a_H: 20 is outside what the emulator learned")


def test_columns_broadcast_and_may_be_none(trained):
    emulator = trained.emulator
    depths, ratios = np.array([[1.0], [2.0]]), np.array([[0.2, 0.4, 0.6]])
    every = emulator.predict(depths, ratios, 1.0, quantities="L_f_1pc")["L_f_1pc"].value
    assert every[4] == pytest.approx(emulator.predict(2, 0.4, 1.0)["L_f_1pc"].value[0])
    assert every.shape == (6,)
    assert emulator.predict([], 0.4, 1.0)["x_front_1pc"].value.shape == (0, len(named.TIMES))


def test_the_file_says_what_it_is(saved):
    told = json.loads(saved.read_text())
    assert told["format"] == model.FORMAT
    assert told["about"]["study"] == "formulas"
    assert told["groups"]["fronts"]["points"]["shape"] == [64, 3]


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


def test_the_packages_emulator_answers_as_the_solver_does():
    """Nine columns, on grids that err by less than what is asked: L_f within 0.5 %, the peak within 4 %."""
    emulator, shares = Emulator.load(), {"L_f_1pc": [], "x_front_1pc": [], named.PEAK: []}
    for a_H, r, m in inner(24)[:9]:
        column = Point(a_H=a_H, r=r, a_2=0.56, delta=math.degrees(math.atan(0.56 * m)), snapshot_times=())
        fitted = column.with_values(grid="fitted", quantities="grains", cells=192)
        waves = [column.with_values(cells=cells, t_end=5.0001 * column.time_scale) for cells in (400, 800)]
        solved = [growing._values(point) for point in (fitted, *waves)]
        known = emulator.predict(a_H, r, m, times=named.FRONT_NODES[8] / named.front_clock(r, m))
        peak = [max(one[name] for name in named.WINDOWS) for one in solved[1:]]
        shares["L_f_1pc"].append(solved[0]["L_f_1pc"] / known["L_f_1pc"].value[0] - 1)
        shares["x_front_1pc"].append(solved[0]["x_front_1pc@8"] / known["x_front_1pc"].value[0, 0] - 1)
        shares[named.PEAK].append((2 * peak[1] - peak[0]) / known[named.PEAK].value[0] - 1)
    for name, most in {"L_f_1pc": 0.005, "x_front_1pc": 0.005, named.PEAK: 0.04}.items():
        assert np.abs(shares[name]).max() < most, name


def test_the_packages_emulator_is_small_and_knows_the_whole_range():
    emulator = Emulator.load()
    assert model.SHIPPED.stat().st_size < 300_000
    assert set(emulator.quantities) == set(named.QUANTITIES)
    for key, ends in coordinates.RANGE.items():
        assert emulator.range[key] == pytest.approx(ends, rel=1e-6)
