"""What no run may break: volume, positivity, momentum; and how runs end. See also energy, similarity, symmetry."""

import dataclasses

import numba
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from states import advance, axial, inner

from subslide import jobs, naming
from subslide.kernels import clock as k
from subslide.kernels import samples as columns
from subslide.keys.names import SCHEMES
from subslide.naming import STATUSES
from subslide.points import Point
from subslide.scenes.cylinder import disc_corner_area, quadrant_depth, radial_depth
from subslide.solver import loop, solve


def column(r=0.4, **options):
    return Point(r=r, cells=60, t_end=0.3, **options)


@pytest.mark.parametrize("scheme", SCHEMES)
@pytest.mark.parametrize("order", [1, 2])
@pytest.mark.parametrize("model", ["radial", "quarter"])
def test_volumes_hold_and_no_depth_is_negative(scheme, order, model):
    run = solve(column(model=model, scheme=scheme, order=order, boundary="wall"))
    assert run.status == "ok"
    for volume in (run.sediment_volume, run.water_volume):
        assert np.abs(volume / volume[0] - 1).max() < 1e-12
    assert run.h2.min() >= 0
    expected = np.pi * run.point.radius**3 * run.point.a_2
    assert np.isclose(run.sediment_volume[0], expected, rtol=1e-12)


def test_kernels_are_cached_by_their_sources_even_where_numba_came_first():
    # numba itself would not notice an edited imported file
    from subslide import source_hash

    assert numba.config.CACHE_DIR.endswith(source_hash("solver"))


@pytest.mark.parametrize("order", [1, 2])
@pytest.mark.parametrize("scheme", SCHEMES)
@pytest.mark.parametrize("dry", [False, True])
def test_momentum_changes_by_the_pressure_at_the_ends_alone(scheme, order, dry):
    # without friction, before waves reach the ends; where grains are dry, velocities are cut off below 1e-6 H2
    r, dx = 0.6, 0.05
    edges = np.arange(-80, 81) * dx
    x = (edges[1:] + edges[:-1]) / 2
    h2 = np.where((x > -1) & (x < 0.5), 1.0, 0.0 if dry else 0.2) + np.where((x > 0.7) & (x < 1), 0.3, 0.0)
    h1 = np.where(x < 0.2, 1.6, 2.0) - h2
    options = {"scheme": scheme, "order": order, "r": r, "m": 0.0, "walls": (3, 3)}
    model = axial(edges, h1, 0.05, h2, 0.0, level=2.0, **options)

    def pressure(end):
        a, b = h1[end], h2[end]
        return r * a * a / 2 + r * a * b + b * b / 2

    def momentum():
        return (
            r * inner(model, "h1") * inner(model, "u1") + inner(model, "h2") * inner(model, "u2")
        ).sum() * dx

    def inflow(end):
        return r * h1[end] * 0.05**2 + pressure(end)

    before = momentum()
    samples, outcome = advance(model, stop=1.0, thresholds=(9.0, 9.0, 9.0))
    assert outcome == k.REACHED
    np.testing.assert_allclose(inner(model, "u1")[[0, -1]], 0.05, rtol=1e-12)
    change = (inflow(0) - inflow(-1)) * samples[-1, columns.TIME]
    np.testing.assert_allclose(momentum() - before, change, rtol=0, atol=1e-6 if dry else 1e-12)


@pytest.mark.parametrize("values", [{"boundary": "paper"}, {"model": "quarter"}])
def test_the_box_grows_and_no_front_is_cut(values):
    run = solve(Point(a_2=1.5, delta=20.0, r=0.8, cells=40, order=2, **values))
    assert run.status == "ok"
    assert run.box_half_width > 4.26 * run.point.radius
    assert run.L_f[0] < run.box_half_width - 2 * run.dx


def test_grains_without_friction_end_as_left_domain():
    run = solve(Point(delta=0.0, cells=60))
    assert run.status == "left_domain"
    assert np.isnan(run.L_f).all()
    assert "t = " in run.status_detail


def test_a_state_that_is_not_finite_ends_as_diverged_and_says_where():
    edges = np.linspace(0, 1, 21)
    model = axial(edges, 1.0, np.where(np.arange(20) == 7, np.inf, 0.0), 1.0, 0, level=2.0)
    _, outcome = advance(model, stop=1.0)
    assert outcome == k.NOT_FINITE
    assert model.suspect()


def test_snapshots_are_taken_at_their_times_and_at_the_end():
    run = solve(Point(snapshot_times=(0.05, 0.1), t_end=0.2, cells=60))
    np.testing.assert_allclose(run.snapshot_time, [0.05, 0.1, 0.2])
    assert run.h2.shape == (3, len(run.x))
    assert np.diff(run.time).min() > 1e-5
    assert run.time[-1] == pytest.approx(0.2)
    assert len(run.time) == run.steps + 1


@pytest.mark.parametrize("t_end", [0.1, None])
def test_a_run_that_ends_at_a_snapshot_keeps_it_once(t_end):
    run = solve(Point(snapshot_times=(0.0, 0.05, 0.1 if t_end else 1.5), t_end=t_end, cells=60))
    assert run.snapshot_time.tolist() == [0.0, 0.05, 0.1 if t_end else 1.5]
    assert run.time[-1] == pytest.approx(run.snapshot_time[-1], rel=1e-14)
    assert len(run.h2) == len(run.eta) == 3
    assert np.isfinite(np.interp(0.07, run.snapshot_time, run.h2[:, 0]))


def test_a_failed_run_has_its_end_beside_the_snapshots_before_it():
    run = solve(
        Point(cfl=4.0, delta=0.0, cells=60, boundary="wall", order=1, snapshot_times=(0.0, 9.0), t_end=9.0)
    )
    assert run.status != "ok"
    assert run.snapshot_time.tolist() == [0.0, run.time[-1]]


@pytest.mark.parametrize("chunk", [loop.CHUNK, 12])
@pytest.mark.parametrize(
    "values",
    [
        {"snapshot_times": (0.0, 0.05, 1.5)},
        {"snapshot_times": (0.05, 0.1), "t_end": 0.2},
        {"snapshot_times": (), "r": 0.0, "quantities": "grains"},
        {
            "cfl": 4.0,
            "delta": 0.0,
            "boundary": "wall",
            "order": 1,
            "snapshot_times": (0.0, 9.0),
            "t_end": 9.0,
        },
        {"model": "quarter", "snapshot_times": (0.05, 0.1), "t_end": 0.2},
    ],
)
def test_a_run_without_profiles_goes_on_from_stop_to_stop_to_the_same_bits(values, chunk, monkeypatch):
    point = Point(**{"cells": 20 if "model" in values else 60, **values})
    whole = solve(point)
    monkeypatch.setattr(loop, "CHUNK", chunk)
    launches = []
    track = loop.Samples.track
    monkeypatch.setattr(loop.Samples, "track", lambda *where: launches.append(1) or track(*where))
    run = solve(point, profiles=False)
    assert (run.status, run.status_detail) == (whole.status, whole.status_detail)
    for name in ("time", "snapshot_time", "L_f", "time_of_arrest", *naming.SERIES):
        np.testing.assert_array_equal(getattr(run, name), getattr(whole, name))
    if run.steps < chunk and "model" not in values:
        assert len(launches) == 1


@pytest.mark.parametrize("place", [{"x": -2.0}, {"y": 2.0}])
def test_a_column_off_the_positive_x_axis_has_no_front_and_no_length_there(place):
    run = solve(Point(scene="columns", scene_options=tuple(place.items()), cells=40, t_end=0.02))
    assert run.status == "ok"
    assert np.isnan(run.x_front).all()
    assert np.isnan(run.L_f).all()
    assert np.isfinite(run.energy).all()
    assert "L_f" not in jobs.summary(run)


def test_a_front_begins_where_grains_come_onto_the_axis():
    run = solve(Point(scene="columns", scene_options=(("x", -1.2),), cells=40, t_end=0.2))
    there = np.isfinite(run.x_front[0])
    assert not there[0]
    assert there[-1]
    assert run.x_front[0][there].min() > 0


def test_the_disc_is_exact_in_every_cell():
    edges = np.linspace(0, 1.5, 38)
    area = (quadrant_depth(edges) * np.diff(edges)[0] ** 2).sum()
    assert np.isclose(area, np.pi / 4, rtol=1e-14)
    rings = np.pi * (edges[1:] ** 2 - edges[:-1] ** 2)
    assert np.isclose((radial_depth(edges) * rings).sum(), np.pi, rtol=1e-14)
    assert np.isclose(disc_corner_area(0.6, 0.7), 0.42)
    fine = (np.arange(2000) + 0.5) / 2000 * 0.9
    inside = np.hypot(fine[:, None], fine[None, :]) <= 1
    assert np.isclose(disc_corner_area(0.9, 0.9), inside.mean() * 0.81, rtol=1e-3)


@settings(max_examples=40, deadline=None)
@given(
    st.floats(0.05, 20), st.floats(0.1, 5), st.floats(0, 0.95), st.floats(5, 55), st.sampled_from(list(SCHEMES)),
    st.sampled_from([1, 2]), st.integers(20, 80), st.sampled_from(["radial", "quarter"]),
)  # fmt: skip
def test_any_column_ends_in_a_status_with_its_volume(a_H, a_2, r, delta, scheme, order, cells, model):
    cells = min(cells, 40) if model == "quarter" else cells
    point = Point(a_H=a_H, a_2=a_2, r=r, delta=delta, scheme=scheme, order=order, cells=cells, model=model)
    run = solve(dataclasses.replace(point, boundary="wall", t_end=3 * np.sqrt(point.radius / (9.81 * a_2))))
    assert run.status in STATUSES
    assert run.status == "ok"
    assert np.abs(run.sediment_volume / run.sediment_volume[0] - 1).max() < 1e-12
    assert np.abs(run.water_volume / run.water_volume[0] - 1).max() < 1e-12
    assert run.h2.min() >= 0
