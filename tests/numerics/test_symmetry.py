"""Mirrors, quarter turns, rotations, and the number of threads: nothing may depend on them."""

import numba
import numpy as np
import pytest
from states import advance, inner, plane

from subslide.kernels import clock as k
from subslide.keys.names import SCHEMES
from subslide.points import Point
from subslide.solver import solve

SERIES = ("time", "x_front", "max_abs_eta", "max_abs_eta_outside", "eta_gauge", "h2", "eta", "h2_diagonal")
DEEP = (9.0, 9.0, 9.0)
"""Thresholds of a front that no state reaches, so that grains may touch an open end."""


def column(**options):
    return Point(cells=60, t_end=0.3, **options)


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
    for name in ("time", "x_front", "max_abs_eta", "max_abs_eta_outside", "eta_gauge"):
        np.testing.assert_array_equal(getattr(whole, name), getattr(quarter, name))
    np.testing.assert_allclose(whole.water_volume, quarter.water_volume, rtol=1e-13)


@pytest.mark.parametrize("order", [1, 2])
def test_two_threads_give_the_bits_of_one(order):
    if numba.config.NUMBA_NUM_THREADS < 2:
        pytest.fail("the tests must run where numba may use two threads")
    one = solve(column(model="quarter", order=order), threads=1)
    two = solve(column(model="quarter", order=order), threads=2)
    for name in SERIES:
        np.testing.assert_array_equal(getattr(one, name), getattr(two, name))


def uneven(n=20):
    """Depths and velocities (h1, u1, v1, h2, u2, v2) without any symmetry, partly without grains."""
    random = np.random.default_rng(7)
    h2 = np.maximum(0.0, random.uniform(-0.4, 1.0, (n, n)))
    u1, v1, u2, v2 = random.uniform(-0.3, 0.3, (4, n, n))
    return random.uniform(0.5, 1.5, (n, n)), u1, v1, h2, u2, v2


def moved(state, order, scheme):
    names = ("h1", "u1", "v1", "h2", "u2", "v2")
    edges = np.linspace(-1, 1, len(state[0]) + 1)
    depths = {"h1": state[0], "h2": state[3]}
    speeds = {name: state[names.index(name)] for name in ("u1", "v1", "u2", "v2")}
    model = plane(edges, **depths, **speeds, level=1.0, order=order, scheme=scheme, m=0.3)
    samples, outcome = advance(model, stop=0.3)
    assert outcome == k.REACHED
    assert len(samples) > 10
    return [inner(model, name).copy() for name in names]


@pytest.mark.parametrize("order", [1, 2])
@pytest.mark.parametrize("scheme", ["hll", "ifcph"])
def test_mirrors_and_quarter_turns_of_an_uneven_state_turn_its_bits(order, scheme):
    h1, u1, v1, h2, u2, v2 = state = uneven()
    e1, a1, b1, e2, a2, b2 = moved(state, order, scheme)
    mirrored = moved(tuple(f[:, ::-1] for f in (h1, -u1, v1, h2, -u2, v2)), order, scheme)
    for found, expected in zip(mirrored, (e1, -a1, b1, e2, -a2, b2), strict=True):
        np.testing.assert_array_equal(found, expected[:, ::-1])
    swapped = moved(tuple(f.T for f in (h1, v1, u1, h2, v2, u2)), order, scheme)
    for found, expected in zip(swapped, (e1, b1, a1, e2, b2, a2), strict=True):
        np.testing.assert_array_equal(found, expected.T)


def ellipse(n, turned):
    """Final front along the long and the short axis of an elliptic column, its axes turned by 45 degrees or not."""
    edges = np.linspace(-3, 3, n + 1)
    fine = np.linspace(-3, 3, 8 * n + 1)
    fine = (fine[1:] + fine[:-1]) / 2
    x, y = np.meshgrid(fine, fine)
    s = np.sqrt(0.5)
    x, y = (s * (x + y), s * (y - x)) if turned else (x, y)
    inside = (x / 1.2) ** 2 + (y / 0.8) ** 2 <= 1
    h2 = inside.reshape(n, 8, n, 8).mean(axis=(1, 3))
    model = plane(edges, 2 - h2, h2, level=2.0, order=2, m=1.0)
    advance(model, stop=1.2)
    h = inner(model, "h2")
    middle = n // 2
    if turned:
        long, short = h.diagonal()[middle:], h[:, ::-1].diagonal()[:middle][::-1]
        step = np.sqrt(2.0)
    else:
        long = (h[middle, middle:] + h[middle - 1, middle:]) / 2
        short = (h[middle:, middle] + h[middle:, middle - 1]) / 2
        step = 1.0
    distance = (np.arange(middle) + 0.5) * step * 6 / n
    return np.array([np.interp(-0.05, -along, distance) for along in (long, short)])


def test_an_ellipse_turned_by_45_degrees_spreads_as_before():
    gaps = [np.abs(ellipse(n, True) / ellipse(n, False) - 1).max() for n in (32, 64)]
    assert gaps[1] < gaps[0]
    assert gaps[1] < 0.03


@pytest.mark.parametrize("order", [1, 2])
def test_a_state_that_does_not_vary_along_y_stays_a_line(order):
    edges = np.linspace(-1, 1, 33)
    x = (edges[1:] + edges[:-1]) / 2
    h2 = np.tile(np.where(x < 0, 1.0, 0.0), (32, 1))
    model = plane(edges, 2 - h2, h2, level=2.0, m=0.5, order=order)
    advance(model, stop=0.3)
    np.testing.assert_array_equal(inner(model, "h2"), inner(model, "h2")[:1].repeat(32, axis=0))
    np.testing.assert_array_equal(inner(model, "v2"), 0)


@pytest.mark.parametrize("order", [1, 2])
def test_tangential_velocity_is_carried_by_the_mass_that_crosses_an_edge(order):
    edges = np.linspace(-1, 1, 25)
    v = np.where(np.arange(24) < 9, 0.3, -0.2)[None, :]
    for u in (0.0, 0.3):
        model = plane(
            edges,
            1.0,
            0.5,
            level=1.5,
            u1=u,
            u2=u,
            v1=v,
            v2=2 * v,
            m=0.0,
            order=order,
            walls=(3,) * 4,
        )
        _, outcome = advance(model, stop=0.5, thresholds=DEEP)
        assert outcome == k.REACHED
        np.testing.assert_allclose(inner(model, "h1"), 1, rtol=1e-13)
        np.testing.assert_allclose(inner(model, "u2"), u, rtol=1e-12, atol=1e-13)
        np.testing.assert_allclose(inner(model, "v2"), 2 * inner(model, "v1"), rtol=1e-12)
        assert inner(model, "v1").min() >= -0.2 - 1e-15
        assert inner(model, "v1").max() <= 0.3 + 1e-15
        if u == 0:
            np.testing.assert_array_equal(inner(model, "v1"), np.broadcast_to(v, (24, 24)))
        else:  # the step has gone u t = 0.15 to the right
            carried = (inner(model, "v1")[0] - v[0]).sum() * (edges[1] - edges[0])
            assert carried == pytest.approx(0.5 * 0.15, rel=1e-3)
