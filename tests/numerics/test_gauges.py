"""Gauges where they are asked for: they see what profiles and fields show, and change nothing else."""

import numpy as np
import pytest

from subslide import naming, solver
from subslide.points import Point
from subslide.solver import solve

TIMES = (0.03, 0.06)
PLACES = ((0.1, 0.0), (0.0, 0.0), (0.0032, 0.0), (0.05, 0.04), (-0.05, -0.04), (0.29, 0.0))
MODELS = {
    "radial": {},
    "quarter": {"model": "quarter", "fields": True},
    "plane": {"model": "plane", "fields": True},
    "line": {"scene": "slab"},
}


def run_of(kind, places=PLACES, **values):
    """Return a short run of a column of some kind, with gauges."""
    values = {"cells": 60, "t_end": TIMES[-1], "snapshot_times": TIMES, **MODELS[kind], **values}
    return solve(Point(gauges=tuple(places), **values))


def at_snapshots(run, name):
    """Return a series (gauges, snapshots) at the times of the snapshots."""
    places = np.searchsorted(run.time, run.snapshot_time * (1 - 1e-12))
    return run.measured[name][:, places]


@pytest.mark.parametrize("cells", [60, 61])
@pytest.mark.parametrize("kind", MODELS)
def test_gauges_along_x_see_the_profiles(kind, cells):
    run = run_of(kind, cells=cells)
    for name in ("h2", "eta"):
        for n, (x, y) in enumerate(PLACES):
            if y == 0:
                place = max(x, run.x[0])
                shown = [np.interp(place, run.x, profile) for profile in getattr(run, name)]
                np.testing.assert_allclose(
                    at_snapshots(run, f"gauge_{name}")[n], shown, rtol=1e-9, atol=1e-15
                )
    assert np.ptp(run.measured["gauge_eta"][0]) > 1e-4


def test_gauges_off_the_axes_see_the_fields():
    """Bilinear between the four centres around the place, by scipy."""
    from scipy.interpolate import RegularGridInterpolator

    run = run_of("plane", scene="ellipse", scene_options=(("angle", 30.0), ("elongation", 2.0)))
    shown = [
        RegularGridInterpolator((run.x, run.x), field)([(y, x) for x, y in PLACES]) for field in run.eta_field
    ]
    np.testing.assert_allclose(at_snapshots(run, "gauge_eta"), np.transpose(shown), rtol=2e-6, atol=1e-9)
    assert (at_snapshots(run, "gauge_h2")[3] > 0).all()


def test_a_quarter_mirrors_what_the_plane_holds():
    places = [(sx * 0.06, sy * 0.035) for sx in (1, -1) for sy in (1, -1)]
    places += [(0.001, -0.002), (-0.05, 0.002), (0.0, 0.06)]  # within half a cell of an axis, or on it
    quarter, plane = run_of("quarter", places), run_of("plane", places)
    for name in naming.GAUGES:
        np.testing.assert_allclose(quarter.measured[name], plane.measured[name], atol=1e-12)
    u, v = (quarter.measured[name][:4, -1] for name in ("gauge_u2", "gauge_v2"))
    assert (u[:2] > 0.01).all()
    assert (v[::2] > 0.01).all()
    np.testing.assert_array_equal(u[2:], -u[:2])
    np.testing.assert_array_equal(v[1::2], -v[::2])


def test_a_radius_tells_velocities_along_x_and_y():
    places = [(0.07, 0.0), (0.07 * np.cos(2.0), 0.07 * np.sin(2.0)), (0.0, 0.0)]
    run = run_of("radial", places)
    for layer in ("1", "2"):
        u, v = run.measured[f"gauge_u{layer}"], run.measured[f"gauge_v{layer}"]
        np.testing.assert_allclose(u[1], np.cos(2.0) * u[0], rtol=1e-9)
        np.testing.assert_allclose(v[1], np.sin(2.0) * u[0], rtol=1e-9)
        assert (v[0] == 0).all()
        assert (u[2] == 0).all()
        assert (v[2] == 0).all()
    assert run.measured["gauge_u2"][0, -1] > 0.05 > 0 > run.measured["gauge_u1"][0, -1]


def test_one_layer_has_no_water_at_its_gauges():
    run = run_of("radial", model="one-layer", r=0.0)
    for name in ("gauge_eta", "gauge_u1", "gauge_v1"):
        assert np.isnan(run.measured[name]).all()
    assert (run.measured["gauge_h2"][0] >= 0).all()


@pytest.mark.parametrize("kind", ["radial", "line"])
def test_gauges_stay_where_they_are_as_the_sea_grows(kind, monkeypatch):
    long = run_of(kind, t_end=0.3)
    monkeypatch.setattr(solver, "first_box", lambda point: point.half_cells)
    grown = run_of(kind, t_end=0.3)
    for name in naming.GAUGES:
        np.testing.assert_allclose(grown.measured[name], long.measured[name], rtol=1e-9, atol=1e-15)


@pytest.mark.parametrize("kind", ["radial", "quarter"])
def test_being_watched_changes_no_bit(kind):
    watched, alone = run_of(kind, footprints=True, runout_directions=4), run_of(kind, places=())
    assert not alone.measured
    assert watched.steps == alone.steps
    np.testing.assert_array_equal(watched.time, alone.time)
    for name in (*naming.SERIES, "h2", "eta"):
        np.testing.assert_array_equal(getattr(watched, name), getattr(alone, name))


@pytest.mark.parametrize("kind", ["radial", "quarter"])
def test_gauges_are_the_same_where_no_profiles_are_kept(kind):
    """There a loop goes on from stop to stop by itself."""
    point = Point(
        cells=60, t_end=TIMES[-1], snapshot_times=TIMES, gauges=PLACES, footprints=True, **MODELS[kind]
    )
    whole, short = solve(point), solve(point, profiles=False)
    np.testing.assert_array_equal(short.time, whole.time)
    assert set(short.measured) == {*naming.GAUGES}
    for name in naming.GAUGES:
        np.testing.assert_array_equal(short.measured[name], whole.measured[name])
