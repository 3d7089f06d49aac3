"""The surface at the gauge, 2 R from the axis, and its peak."""

import numpy as np
import pytest

from subslide.points import Point
from subslide.records import gauge
from subslide.solver import solve


@pytest.mark.parametrize("model", ["radial", "quarter"])
@pytest.mark.parametrize("cells", [60, 61])
def test_the_gauge_is_where_it_is_on_every_grid(model, cells):
    times = (0.05, 0.1, 0.15)
    run = solve(Point(cells=cells, model=model, snapshot_times=times, t_end=0.15))
    at = np.array([np.interp(2 * 0.0705, run.x, eta) for eta in run.eta[:3]])
    seen = np.interp(times, run.time, run.eta_gauge)
    assert np.abs(at).max() > 1e-4
    np.testing.assert_allclose(seen, at, rtol=1e-9, atol=1e-15)


def test_one_layer_has_no_gauge():
    run = solve(Point(cells=60, model="one-layer", r=0.0, t_end=0.05))
    assert np.isnan(run.eta_gauge).all()
    assert np.isnan(gauge.peak(run.point, run.time, run.eta_gauge)).all()


def test_the_peak_is_the_largest_mean_up_or_down():
    point = Point()
    span = point.radius / point.wave_speed
    time = np.linspace(0, 4 * span, 401)
    trough = np.where((time > 2 * span) & (time < 2.5 * span), -1.0, 0.2)
    value, when = gauge.peak(point, time, trough)
    assert value == pytest.approx(0.5 - 0.1, abs=0.02)
    assert 1.9 * span < when < 2.6 * span
    assert np.isnan(gauge.peak(point, time[:50], trough[:50])).all()


@pytest.mark.parametrize(
    "values",
    [
        {"a_H": 10.0, "a_2": 0.3, "r": 0.1, "delta": 40.0},
        {"a_H": 10.0, "a_2": 1.5, "r": 0.8, "delta": 20.0},
    ],
)
def test_the_peak_at_the_gauge_converges_where_that_of_the_surface_does_not(values):
    one = Point(**values)
    runs = [
        solve(one.with_values(cells=cells, t_end=3.5 * one.radius / one.wave_speed, snapshot_times=()))
        for cells in (1600, 3200)
    ]
    coarse, fine = (gauge.peak(run.point, run.time, run.eta_gauge)[0] for run in runs)
    assert coarse == pytest.approx(fine, rel=0.02)
    assert np.nanmax(runs[0].max_abs_eta) != pytest.approx(np.nanmax(runs[1].max_abs_eta), rel=0.02)
