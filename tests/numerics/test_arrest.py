"""The time of arrest: since when the front has stood where it ends."""

import numpy as np
import pytest

from subslide.points import Point
from subslide.solver import solve
from subslide.solver.arrest import time_of_arrest

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
