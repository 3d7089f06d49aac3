"""The time of arrest: since when the front has stood where it ends."""

import numpy as np
import pytest

from subslide.points import Point
from subslide.records import reductions
from subslide.solver import compiled, solve
from subslide.solver.arrest import time_of_arrest
from subslide.solver.compiled import sparing

TIME = np.array([0.0, 1.0, 2.0, 3.0, 4.0])


@pytest.mark.parametrize(
    ("front", "expected"),
    [
        ([1.0, 1.5, 1.98, 2.0, 2.0], 2 + (0.01 - 0.005) / 0.01),
        ([1.0, 1.5, 2.02, 2.0, 2.0], 2 + (0.01 - 0.005) / 0.01),  # retreats
        ([1.0, 1.99, 1.96, 2.0, 2.0], 2 + (0.02 - 0.005) / 0.02),  # leaves again
        ([1.0, 1.96, 2.04, 2.0, 2.0], 2 + (0.02 - 0.005) / 0.02),
        ([np.nan, np.nan, 2.0, 2.0, 2.0], 2.0),  # grains that come from elsewhere
        ([2.0, 2.0, 2.0, 2.0, 2.0], 0.0),
        ([2.0, 1.0, 0.0, 0.0, 0.0], np.nan),
        ([2.0, 1.0, 1.0, np.nan, np.nan], np.nan),
    ],
)
def test_it_is_the_last_time_at_which_the_front_was_away_from_its_end(front, expected):
    assert time_of_arrest(TIME, np.array(front)) == pytest.approx(expected, nan_ok=True)


def test_it_is_missing_while_grains_move():
    run = solve(Point(cells=60, t_end=0.05))
    assert np.isnan(run.time_of_arrest).all()
    assert np.isfinite(run.L_f).all()


def test_a_column_that_stands_has_arrived_at_its_side_from_the_start():
    run = solve(Point(a_2=0.02, delta=30.0, cells=100, t_end=0.1))
    assert run.time_at_rest == 0
    assert (run.L_f == run.point.radius).all()
    assert (run.time_of_arrest == 0).all()


@pytest.mark.parametrize(
    "values",
    [
        {"a_H": 10.0, "a_2": 1.5, "r": 0.0, "delta": 40.0},
        {"a_H": 10.0, "a_2": 0.3, "r": 0.8, "delta": 20.0},
        {"a_H": 2.0, "a_2": 0.9, "r": 0.44, "delta": 30.0},
    ],
)
def test_it_converges_where_the_time_of_rest_does_not(values):
    coarse, fine = (solve(Point(cells=cells, snapshot_times=(), **values)) for cells in (800, 3200))
    assert coarse.time_of_arrest[0] == pytest.approx(fine.time_of_arrest[0], rel=0.02)
    assert fine.time_of_arrest[0] < fine.time_at_rest


SERIES = {
    "smooth": np.sin(np.linspace(0.0, 7.0, 300)),
    "rising": np.linspace(0.0, 2.0, 300),
    "rough": np.random.default_rng(1).normal(size=300),
    "zeros": np.zeros(300),
    "nothing": np.full(300, np.nan),
    "gaps": np.where(np.arange(300) % 7, np.linspace(2.0, -1.0, 300), np.nan),
    "infinite": np.where(np.arange(300) == 40, -np.inf, np.linspace(1.0, 3.0, 300)),
}


@pytest.mark.parametrize("name", SERIES)
def test_what_a_run_comes_to_has_the_same_bits_with_and_without_compiled_code(name):
    values, time = SERIES[name], np.cumsum(np.random.default_rng(2).random(300))
    for function, others in (
        (reductions.peak, (time,)),
        (reductions.relative_change, ()),
        (reductions.extreme, (1.0,)),
        (reductions.extreme, (-1.0,)),
        (reductions.share_above, (0.5,)),
        (reductions.rise, (time, 50.0)),
        (reductions.rise, (time, np.nan)),
        (reductions.running_mean_peak, (time, 3.7)),
        (reductions.running_mean_peak, (time, 1e9)),
    ):
        fresh = sparing(function.__wrapped__)
        plain, quick = np.array(fresh(values, *others)), np.array(fresh.compiled()(values, *others))
        assert plain.tobytes() == quick.tobytes(), function.__name__
    fresh = sparing(time_of_arrest.__wrapped__)
    assert np.array(fresh(time, values)).tobytes() == np.array(fresh.compiled()(time, values)).tobytes()


def test_many_samples_are_worth_compiled_code(monkeypatch):
    monkeypatch.setattr(compiled, "compiled", lambda function: lambda samples: "compiled")
    function = sparing(len)
    assert [function(np.ones(compiled.FEW // 2)) for _ in range(3)] == [compiled.FEW / 2] * 2 + ["compiled"]
    assert sparing(len)(np.ones(compiled.FEW + 1)) == "compiled"
