"""The open edge of the box: until when no wave has been there, and that the surface is the wide box's till then."""

import math

import numpy as np
import pytest

from subslide.points import Point
from subslide.solver import attempt, solve


def compared(cells, **values):
    """Run in the smallest box, and how far its surface is off that of a box six times as wide, by snapshot."""
    times = tuple(np.arange(1, 28) * 0.02)
    point = Point(cells=cells, model="radial", t_end=0.54, snapshot_times=times, **values)
    box, wide = (attempt(point, k * point.half_cells, None) for k in (1, 6))
    right = wide.eta[:, : len(box.x)]
    return box, np.abs(box.eta - right).max(axis=1) / np.abs(right).max(axis=1)


@pytest.mark.parametrize("order", [1, 2])
@pytest.mark.parametrize(("a_H", "r"), [(0.2, 0.2), (1.0, 0.8), (2.0, 0.4), (10.0, 0.4)])
@pytest.mark.parametrize("cells", [100, 200])
def test_the_surface_is_right_until_the_first_wave_may_be_at_the_edge(a_H, r, order, cells):
    box, off = compared(cells, a_H=a_H, r=r, order=order)
    free = box.snapshot_time <= box.wave_free_until
    assert free.sum() >= 3
    assert off[free].max() < 0.003


def test_later_the_edge_may_rule_the_surface():
    box, off = compared(100, a_H=10.0)
    assert box.wave_free_until < 0.112
    assert off[-1] > 1


def test_it_is_near_the_time_of_a_wave_of_no_height():
    point = Point(a_H=10.0, cells=400, t_end=0.12)
    still = (point.half_box - 1) * point.radius / point.wave_speed
    assert 0.96 * still < solve(point).wave_free_until < still


def test_a_run_that_ends_before_says_when_it_would_be():
    long, short = (solve(Point(a_H=10.0, cells=200, t_end=end)).wave_free_until for end in (0.12, 0.02))
    assert short == pytest.approx(long, rel=0.01)


def test_a_box_that_grew_is_free_for_longer_and_a_column_aside_for_less():
    middle = solve(Point(cells=60, t_end=0.05)).wave_free_until
    grown = attempt(Point(cells=60, t_end=0.05), 45, None).wave_free_until
    aside = solve(Point(cells=60, t_end=0.05, scene="columns", scene_options=(("y", 1.5),))).wave_free_until
    assert aside < middle < grown


@pytest.mark.parametrize(
    "values",
    [
        {"boundary": "wall"},
        {"r": 0.0, "model": "one-layer"},
        {"scene": "shear", "model": "line", "boundary": "periodic", "delta": 0.0},
    ],
)
def test_without_an_open_edge_or_water_there_is_no_such_time(values):
    assert math.isnan(solve(Point(cells=20, t_end=0.02, **values)).wave_free_until)
