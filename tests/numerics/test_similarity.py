"""What the scaled equations promise: similarity, and the limits of r = 0 and of deep water."""

import numpy as np
import pytest

from subslide.points import Point
from subslide.solver import solve


@pytest.mark.parametrize("order", [1, 2])
def test_columns_of_7_cm_and_700_m_have_the_same_scaled_answer(order):
    small = solve(Point(radius=0.07, cells=100, order=order))
    large = solve(Point(radius=700.0, cells=100, order=order))
    for name in ("L_f", "x_front", "h2", "max_abs_eta"):
        np.testing.assert_allclose(
            getattr(large, name) / 700.0, getattr(small, name) / 0.07, rtol=1e-9, atol=1e-12
        )
    np.testing.assert_allclose(large.time, small.time * 100.0, rtol=1e-9)


@pytest.mark.parametrize("order", [1, 2])
def test_friction_enters_by_tan_delta_over_a_2_alone(order):
    one = solve(Point(a_2=1.0, delta=30.0, snapshot_times=(), cells=100, order=order))
    flat = np.degrees(np.arctan(0.56 * np.tan(np.radians(30))))
    assert flat == pytest.approx(17.9169, abs=5e-5)
    two = solve(Point(a_2=0.56, delta=flat, snapshot_times=(), cells=100, order=order))
    np.testing.assert_allclose(two.L_f / one.L_f, 1, rtol=1e-6)
    assert len(two.time) == len(one.time)
    np.testing.assert_allclose(two.x_front, one.x_front, rtol=1e-6)


def gap(run, other):
    """Volume between two final piles over the volume of one; the shorter box may be cut."""
    n = min(len(run.x), len(other.x))
    weight = run.x[:n]
    return (np.abs(run.h2[-1][:n] - other.h2[-1][:n]) * weight).sum() / (other.h2[-1][:n] * weight).sum()


def at_rest(**options):
    run = solve(Point(snapshot_times=(), **options))
    assert run.status == "ok"
    return run


CELLS = np.array([100, 200, 400, 800, 1600])


@pytest.mark.parametrize(("order", "rate", "last"), [(1, 0.5, 0.01), (2, 0.7, 0.004)])
def test_at_r_0_the_grains_do_not_feel_the_water(order, rate, last):
    # first order is limited by the thin front, and by nothing else: about 0.6 and 0.8 (water), 0.8 and 1 (one layer)
    water, layers = [], []
    for cells in CELLS:
        shallow = at_rest(r=0.0, a_H=1.0, cells=int(cells), order=order)
        deep = at_rest(r=0.0, a_H=10.0, cells=int(cells), order=order)
        alone = at_rest(r=0.0, model="one-layer", cells=int(cells), order=order)
        water.append(gap(shallow, deep))
        layers.append(gap(alone, shallow))
    for gaps in (water, layers):
        assert -np.polyfit(np.log(CELLS), np.log(gaps), 1)[0] > rate
        assert gaps[-1] < last
    assert np.abs(shallow.L_f[0] / deep.L_f[0] - 1) < 10 * last
    assert np.abs(alone.L_f[0] / shallow.L_f[0] - 1) < 10 * last


@pytest.mark.parametrize("order", [1, 2])
@pytest.mark.parametrize("r", [0.4, 0.8])
def test_in_deep_water_grains_spread_as_dry_ones_slower_by_the_root_of_1_minus_r(order, r):
    gaps = []
    for a_H in (30.0, 100.0, 300.0):
        light = at_rest(r=r, a_H=a_H, cells=200, order=order)
        heavy = at_rest(r=0.0, a_H=a_H, cells=200, order=order)
        gaps.append(gap(light, heavy))
    assert gaps[1] < 0.6 * gaps[0]
    assert gaps[2] < 0.4 * gaps[0]  # 1 / a_H would be 0.1; what the grid adds does not shrink with a_H
    assert gaps[2] < 0.004
    np.testing.assert_allclose(light.L_f[0] / heavy.L_f[0], 1, atol=0.005)
    passed = [np.interp(1.5 * 0.0705, run.x_front[0], run.time) for run in (light, heavy)]
    assert passed[0] * np.sqrt(1 - r) / passed[1] == pytest.approx(1, abs=0.01)


def test_the_plane_approaches_the_radius():
    gaps = []
    for cells in (50, 100, 200):
        radius = solve(Point(model="radial", cells=cells, t_end=0.16))
        plane_ = solve(Point(model="quarter", cells=cells, t_end=0.16))
        there = np.interp(radius.x, plane_.x, plane_.h2[-1])
        gaps.append(np.abs(there - radius.h2[-1]).sum() / radius.h2[-1].sum())
    assert gaps[2] < gaps[1] < gaps[0]
    assert gaps[2] < 0.02
