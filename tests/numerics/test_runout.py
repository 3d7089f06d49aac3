"""Runout by direction, area and centroid of deposits: of fields that are known, and of runs."""

import numpy as np
import pytest

from subslide.naming import FRONT_THRESHOLDS
from subslide.points import Point
from subslide.solver import runout, solve

X = (np.arange(-200, 200) + 0.5) * 0.01
"""Centres of cells."""


def cone(a, b, angle, shift=(0.0, 0.0)):
    """Return a cone of height 1 on an ellipse of semi-axes a and b, the first at an angle (degree) to the x axis."""
    x, y = np.meshgrid(X - shift[0], X - shift[1])
    c, s = np.cos(np.deg2rad(angle)), np.sin(np.deg2rad(angle))
    return np.maximum(0, 1 - np.hypot((c * x + s * y) / a, (c * y - s * x) / b))


@pytest.mark.parametrize("depth", [0.01, 0.05, 0.3])
def test_a_cone_has_its_ellipse(depth):
    h2 = cone(1.5, 0.75, 30)
    for angle in np.arange(0, 360, 7.5):
        c, s = np.cos(np.deg2rad(angle - 30)), np.sin(np.deg2rad(angle - 30))
        exact = (1 - depth) / np.hypot(c / 1.5, s / 0.75)
        assert runout.along_ray(h2, X, angle, [depth])[0] == pytest.approx(
            exact, abs=1e-3
        )  # a tenth of a cell
    area = np.pi * 1.5 * 0.75 * (1 - depth) ** 2
    assert runout.area_above(h2, X, depth) == pytest.approx(area, rel=1e-3)


def test_a_quarter_has_the_whole_of_it():
    h2 = cone(1.5, 0.75, 0)
    part = h2[200:, 200:]
    for angle in (0, 40, 90, 140, 180, 220, 270, 310):
        whole = runout.along_ray(h2, X, angle, [0.02])
        np.testing.assert_allclose(runout.along_ray(part, X[200:], angle, [0.02], quarter=True), whole)
    quarter = runout.area_above(part, X[200:], 0.02, quarter=True)
    assert quarter == pytest.approx(runout.area_above(h2, X, 0.02), rel=1e-12)


def test_rings_have_their_area():
    r = (np.arange(100) + 0.5) * 0.02
    assert runout.area_of_rings(1 - r / 1.5, r, 0.1) == pytest.approx(np.pi * 1.35**2, rel=1e-3)
    ring = np.maximum(0, 1 - np.abs(r - 1) / 0.5)
    assert runout.area_of_rings(ring, r, 0.1) == pytest.approx(np.pi * (1.45**2 - 0.55**2), rel=1e-12)
    assert runout.area_of_rings(0 * r, r, 0.1) == 0


def test_a_ray_without_grains_has_no_runout():
    h2 = cone(0.3, 0.3, 0, shift=(0.0, 1.0))
    assert np.isnan(runout.along_ray(h2, X, 0, [0.01])[0])
    assert runout.along_ray(h2, X, 90, [0.1])[0] == pytest.approx(1.27, abs=1e-3)


@pytest.fixture(scope="module")
def ellipse():
    """Run to rest of an ellipse of 2:1 at 30 degrees."""
    options = (("angle", 30.0), ("elongation", 2.0))
    values = {"cells": 200, "snapshot_times": (0.0,), "fields": True}
    return solve(Point(scene="ellipse", scene_options=options, runout_directions=72, **values))


def test_an_ellipses_runout_is_that_of_its_fields(ellipse):
    """By scipy: the last of many points on the ray where the field is as deep as the threshold, within half a cell."""
    from scipy.interpolate import RegularGridInterpolator

    field = RegularGridInterpolator((ellipse.x, ellipse.x), ellipse.h2_field[-1].astype(float))
    along = np.arange(0, 0.25, ellipse.dx / 20)
    for angle, lengths in zip(ellipse.directions, ellipse.measured["runout"].T, strict=True):
        c, s = np.cos(np.deg2rad(angle)), np.sin(np.deg2rad(angle))
        h2 = field(np.transpose([s * along, c * along]))
        last = [along[h2 >= share * ellipse.point.column_height][-1] for share in FRONT_THRESHOLDS]
        np.testing.assert_allclose(lengths, last, atol=0.5 * ellipse.dx)
    for area, share in zip(ellipse.measured["deposit_area"], FRONT_THRESHOLDS, strict=True):
        cells = (ellipse.h2_field[-1] >= share * ellipse.point.column_height).sum()
        assert area == pytest.approx(cells * ellipse.dx**2, rel=0.02)


def test_an_ellipses_runout_is_largest_along_its_longer_axis(ellipse):
    measured = ellipse.measured
    np.testing.assert_allclose(measured["runout"][:, 0], ellipse.L_f, rtol=1e-12)
    np.testing.assert_allclose(measured["runout"][:, :36], measured["runout"][:, 36:], rtol=1e-9)
    assert (np.abs(measured["runout_max_direction"] - 30) <= 5).all()  # and not 180 more, its mirror image
    turning = measured["runout"] @ np.exp(
        2j * np.deg2rad(ellipse.directions)
    )  # of an ellipse, twice its angle
    np.testing.assert_allclose(np.rad2deg(np.angle(turning)) / 2, 30, atol=1)
    np.testing.assert_array_equal(measured["runout_max"], measured["runout"].max(axis=1))
    assert measured["runout_max"][0] > 1.05 * measured["runout"][0].min()
    assert abs(measured["deposit_x"]) < 1e-12 > abs(measured["deposit_y"])


@pytest.mark.parametrize(
    "values", [{"model": "radial"}, {"grid": "fitted", "cells": 48}, {"model": "quarter"}]
)
def test_a_round_column_has_one_runout(values):
    run = solve(Point(**{"cells": 100, "t_end": 0.2, "runout_directions": 8, **values}))
    runouts = run.measured["runout"]
    np.testing.assert_allclose(runouts[:, ::2], np.repeat(run.L_f[:, None], 4, axis=1), rtol=1e-12)
    np.testing.assert_allclose(runouts[0], run.L_f[0], rtol=0.05)
    assert run.measured["deposit_area"][0] == pytest.approx(np.pi * run.L_f[0] ** 2, rel=0.05)


def test_a_column_beside_the_x_axis_has_no_length_along_it():
    options = (("x", 0.0), ("y", 2.0))
    run = solve(Point(scene="columns", scene_options=options, cells=60, t_end=0.02, runout_directions=4))
    assert run.status == "ok"
    assert np.isnan(run.L_f).all()
    assert np.isnan(run.measured["runout"][:, 0]).all()
    assert run.measured["runout_max_direction"][0] == 90
    assert run.measured["runout_max"][0] > 2.9 * 0.0705
    assert run.measured["deposit_y"] == pytest.approx(2 * 0.0705, rel=1e-3)
    assert abs(run.measured["deposit_x"]) < 1e-12


def test_a_failed_run_has_no_runout():
    run = solve(Point(cells=100, cfl=3, delta=0, order=1, boundary="wall", runout_directions=4))
    assert run.status == "step_collapse"
    assert all(np.isnan(values).all() for values in run.measured.values())
