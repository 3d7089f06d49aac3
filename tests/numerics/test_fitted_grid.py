"""The cells of the fitted grid: where they are, what a step takes of their way, and what stays still on them."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from states import inner
from test_range import logarithmic

from subslide.kernels import clock as k
from subslide.kernels.motion import arrive, ends, sweep
from subslide.models import fan as layout
from subslide.models.build import build
from subslide.models.fitted import mesh_of
from subslide.points import Point
from subslide.scenes import level_off
from subslide.solver import DRY_DEPTH, solve
from subslide.solver.loop import Samples, advance_to

POINTS = st.builds(
    Point,
    a_2=logarithmic(1e-3, 100),
    r=st.floats(0, 0.99999),
    delta=st.floats(0, 89),
    cells=st.integers(10, 1000),
    t_end=st.none() | logarithmic(1e-9, 1e3),
    grid=st.just("fitted"),
)


def edges_at(motion, fan, time):
    """Edges of the cells at a scaled time, by their closed form."""
    left, right = ends(fan, time)
    return motion.base + motion.near * left + motion.far * right


def sizes(edges, radial):
    """Volumes of the cells per depth and radian, or on a line per depth and half."""
    return np.diff(edges**2) / 2 if radial else np.diff(edges)


@given(POINTS)
@settings(max_examples=200)
def test_cells_never_change_their_order(point):
    _, motion, fan = mesh_of(point, True)
    end = point.latest_end / point.time_scale
    ahead = fan.stop if math.isfinite(fan.stop) else end
    for time in np.unique(np.minimum(np.linspace(0, 1, 60) * 1.1 * ahead, end)):
        edges = edges_at(motion, fan, time)
        assert edges[0] == 0
        assert (np.diff(edges) > 0).all()
        np.testing.assert_allclose(edges[-1], motion.edges[-1], rtol=1e-14)


@given(POINTS)
@settings(max_examples=100)
def test_the_side_of_the_column_is_an_edge_to_the_bit(point):
    _, motion, _ = mesh_of(point, True)
    assert (motion.edges == 1.0).sum() == 1
    model = build(point, 0, DRY_DEPTH)
    inside = model.x < 1
    assert (inner(model, "h2")[inside] == 1).all()
    assert (inner(model, "h2")[~inside] == 0).all()


@given(POINTS)
@settings(max_examples=100)
def test_the_fan_stops_and_stays(point):
    fan = layout.fan_of(point)
    if fan.stop < 1e100:
        places = [ends(fan, time) for time in fan.stop * np.array([1.0, 1.0 + 1e-12, 2.0, 1e6])]
        assert len(set(places)) == 1
        before = np.array(ends(fan, fan.stop * (1 - 1e-9)))
        np.testing.assert_allclose(before, places[0], atol=1e-7 * places[0][1])


@given(POINTS, st.booleans(), st.floats(0, 1), st.floats(1e-4, 0.3))
@settings(max_examples=100)
def test_what_is_swept_is_what_volumes_change_by(point, radial, when, share):
    mesh, motion, fan = mesh_of(point, radial)
    until = min(fan.stop, point.latest_end / point.time_scale)
    now, dt = when * until, share * 0.05 * until
    motion.edges[:] = edges_at(motion, fan, now)
    sweep(mesh, motion, fan, now, dt)
    before, then = sizes(motion.edges, radial), sizes(motion.ahead, radial)
    swept = mesh.area * motion.drift * dt
    np.testing.assert_allclose(np.diff(swept), then - before, rtol=0, atol=1e-14 * motion.edges[-1] ** 2)
    np.testing.assert_allclose(mesh.inverse_volume, 1 / then, rtol=1e-9)
    np.testing.assert_allclose(1 + motion.growth, before / then, rtol=1e-9)
    arrive(mesh, motion)
    np.testing.assert_array_equal(motion.edges, edges_at(motion, fan, now + dt))
    turn = 2 * math.pi if radial else 2
    np.testing.assert_allclose(mesh.weight[2:-2], turn * then, rtol=1e-9)
    np.testing.assert_allclose(1 / motion.inverse_width[2:-2], np.diff(motion.edges), rtol=1e-14)


def advanced(model, clock, time):
    """Nothing; a model goes on to a scaled time."""
    clock[k.STOP] = time
    outcome, _ = advance_to(model, clock, Samples(), lambda now: None)
    assert outcome == k.REACHED


@pytest.mark.parametrize("scene", ["cylinder", "slab"])
@pytest.mark.parametrize("order", [1, 2])
@pytest.mark.parametrize("scheme", ["rusanov", "hll", "ifcp", "ifcph"])
@pytest.mark.parametrize("grains", [0.0, 0.5])
@pytest.mark.parametrize("dtype", ["float64", "float32"])
def test_what_is_at_rest_stays_so_while_cells_move_and_grains_to_the_bit_once_they_stand(
    scene, order, scheme, grains, dtype
):
    point = Point(grid="fitted", cells=48, scene=scene, order=order, scheme=scheme, dtype=dtype, delta=32.0)
    model = build(point, 0, DRY_DEPTH)
    eps = np.finfo(dtype).eps
    h1, h2 = level_off(np.full(48, grains, dtype), model.level)
    model.cells.h1[2:-2], model.cells.h2[2:-2] = h1, h2
    start, clock = model.motion.edges.copy(), k.started()
    advanced(model, clock, model.fan.stop * 1.01)
    assert np.abs(model.motion.edges - start).max() > 0.3
    np.testing.assert_allclose(inner(model, "h1"), h1, rtol=100 * eps)
    np.testing.assert_allclose(inner(model, "h2"), h2, rtol=100 * eps)
    np.testing.assert_array_equal(model.motion.edges, edges_at(model.motion, model.fan, model.fan.stop))
    there, grains = model.motion.edges.copy(), inner(model, "h2").copy()
    advanced(model, clock, model.fan.stop * 2)
    np.testing.assert_array_equal(model.motion.edges, there)
    np.testing.assert_array_equal(inner(model, "h2"), grains)
    np.testing.assert_allclose(inner(model, "h1"), h1, rtol=100 * eps)


@pytest.mark.parametrize("values", [{"delta": 85.0}, {"delta": 32.0}, {"scene": "slab"}, {"r": 0.0}])
def test_a_deposit_on_cells_that_stand_keeps_its_bits(values):
    point = Point(grid="fitted", cells=48, **values)
    rest = max(
        solve(point.with_values(snapshot_times=())).time[-1], layout.fan_of(point).stop * point.time_scale
    )
    run = solve(point.with_values(snapshot_times=(1.5 * rest, 2 * rest), t_end=3 * rest))
    np.testing.assert_array_equal(run.h2[0], run.h2[2])
    np.testing.assert_array_equal(run.x[0], run.x[2])
    assert np.abs(run.x_front[0][run.time >= 1.5 * rest] / run.L_f[0] - 1).max() < 1e-12
