"""What no run may break: volume, positivity, mirrors, similarity, energy, momentum, the number of threads."""

import dataclasses

import numba
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from states import advance, axial, inner, plane

from subslide.fields import STATUSES
from subslide.kernels import clock as k
from subslide.kernels.viscosity import SCHEMES
from subslide.points import Point
from subslide.scenes.cylinder import disc_corner_area, quadrant_depth, radial_depth
from subslide.solver import solve

SERIES = ("time", "x_front", "max_abs_eta", "max_abs_eta_outside", "h2", "eta", "h2_diagonal")


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


@pytest.mark.parametrize("order", [1, 2])
@pytest.mark.parametrize("scheme", SCHEMES)
def test_the_quarter_is_the_plane_and_the_plane_is_symmetric_to_the_bit(order, scheme):
    whole = solve(column(model="plane", order=order, scheme=scheme, fields=True))
    quarter = solve(column(model="quarter", order=order, scheme=scheme, fields=True))
    for field in (whole.h2_field[-1], whole.eta_field[-1]):
        np.testing.assert_array_equal(field, field[::-1])
        np.testing.assert_array_equal(field, field[:, ::-1])
        np.testing.assert_array_equal(field, field.T)
    n = len(quarter.x)
    np.testing.assert_array_equal(whole.h2_field[:, n:, n:], quarter.h2_field)
    np.testing.assert_array_equal(whole.h2[:, n:], quarter.h2)
    np.testing.assert_array_equal(whole.eta[:, n:], quarter.eta)
    for name in ("time", "x_front", "max_abs_eta", "max_abs_eta_outside"):
        np.testing.assert_array_equal(getattr(whole, name), getattr(quarter, name))
    np.testing.assert_allclose(whole.water_volume, quarter.water_volume, rtol=1e-13)


def test_kernels_are_cached_by_their_sources_even_where_numba_came_first():
    # numba itself would not notice an edited imported file
    from subslide import source_hash

    assert numba.config.CACHE_DIR.endswith(source_hash("solver"))


def test_two_threads_give_the_bits_of_one():
    if numba.config.NUMBA_NUM_THREADS < 2:
        pytest.fail("the tests must run where numba may use two threads")
    one = solve(column(model="quarter"), threads=1)
    two = solve(column(model="quarter"), threads=2)
    for name in SERIES:
        np.testing.assert_array_equal(getattr(one, name), getattr(two, name))


@pytest.mark.parametrize("order", [1, 2])
def test_columns_of_7_cm_and_700_m_have_the_same_scaled_answer(order):
    small = solve(Point(radius=0.07, cells=100, order=order))
    large = solve(Point(radius=700.0, cells=100, order=order))
    for name in ("L_f", "x_front", "h2", "max_abs_eta"):
        np.testing.assert_allclose(
            getattr(large, name) / 700.0, getattr(small, name) / 0.07, rtol=1e-9, atol=1e-12
        )
    np.testing.assert_allclose(large.time, small.time * 100.0, rtol=1e-9)


def test_friction_enters_by_tan_delta_over_a_2_alone():
    one = solve(Point(a_2=1.0, delta=30.0, snapshot_times=(), cells=100))
    two = solve(
        Point(
            a_2=0.56, delta=np.degrees(np.arctan(0.56 * np.tan(np.radians(30)))), snapshot_times=(), cells=100
        )
    )
    np.testing.assert_allclose(two.L_f, one.L_f, rtol=1e-6)


def test_one_layer_and_two_layers_at_r_0_approach_each_other():
    gaps = []
    for cells in (100, 400, 1600):
        alone = solve(Point(r=0.0, model="one-layer", cells=cells))
        under = solve(Point(r=0.0, model="radial", cells=cells))
        gaps.append(abs(alone.L_f[0] / under.L_f[0] - 1))
    assert gaps[2] < gaps[1] < gaps[0]
    assert gaps[2] < 0.015


def test_the_plane_approaches_the_radius():
    gaps = []
    for cells in (50, 100, 200):
        radius = solve(Point(model="radial", cells=cells, t_end=0.16))
        plane_ = solve(Point(model="quarter", cells=cells, t_end=0.16))
        there = np.interp(radius.x, plane_.x, plane_.h2[-1])
        gaps.append(np.abs(there - radius.h2[-1]).sum() / radius.h2[-1].sum())
    assert gaps[2] < gaps[1] < gaps[0]
    assert gaps[2] < 0.02


@pytest.mark.parametrize("order", [1, 2])
def test_energy_never_grows_inside_walls(order):
    run = solve(column(model="radial", order=order, boundary="wall", scheme="hll"))
    assert np.diff(run.energy).max() <= 1e-9 * run.energy[0]
    assert run.energy[-1] < run.energy[0]


def test_momentum_holds_without_friction():
    edges = np.linspace(-4, 4, 201)
    x = (edges[1:] + edges[:-1]) / 2
    bump = np.exp(-4 * x**2)
    h2 = 0.5 + 0.3 * bump
    model = axial(edges, 2 - h2, 0.1, h2, 0.2 * bump, level=2.0, friction=0.0, walls=(False, False))

    def momentum():
        return (0.4 * inner(model, "h1") * inner(model, "u1") + inner(model, "h2") * inner(model, "u2")).sum()

    def flow_in():  # what uniform ends let in is let out
        return momentum()

    before = flow_in()
    advance(model, stop=0.5)
    assert np.isclose(flow_in(), before, rtol=1e-12)


@pytest.mark.parametrize("order", [1, 2])
def test_a_state_that_does_not_vary_along_y_stays_a_line(order):
    edges = np.linspace(-1, 1, 33)
    x = (edges[1:] + edges[:-1]) / 2
    h2 = np.tile(np.where(x < 0, 1.0, 0.0), (32, 1))
    model = plane(edges, 2 - h2, h2, level=2.0, friction=0.5, order=order)
    advance(model, stop=0.3)
    np.testing.assert_array_equal(inner(model, "h2"), inner(model, "h2")[:1].repeat(32, axis=0))
    np.testing.assert_array_equal(inner(model, "v2"), 0)


def test_the_box_grows_and_no_front_is_cut():
    run = solve(Point(a_2=1.5, delta=20.0, r=0.8, cells=60, order=2))
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
