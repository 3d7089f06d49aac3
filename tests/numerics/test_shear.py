"""Layers that slide over each other: linear theory, and runs that follow it below and above the limit."""

import dataclasses
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from states import advance, axial, plane
from test_waves import matrix

from subslide.exact import shear
from subslide.kernels import samples as columns
from subslide.kernels import waves
from subslide.scenes import shear as layers
from subslide.solver import solve
from subslide.study import config

LAYERS = [(1.0, 0.8), (0.3, 0.4), (4.0, 0.6), (0.1, 0.98), (1.0, 0.05)]


@pytest.mark.parametrize(("h1", "r"), LAYERS)
@pytest.mark.parametrize("part", [0.3, 0.99, 1.01, 1.1])
def test_the_wave_is_an_eigenvector_of_the_sheared_layers(h1, r, part):
    u1, u2 = layers.velocities(h1, 1.0, r, part * layers.critical_shear(h1, 1.0, r), drift=0.3)
    assert r * h1 * u1 + u2 == pytest.approx(0.3 * (r * h1 + 1))
    c, (dh1, du1, dh2, du2) = layers.mode(h1, u1, 1.0, u2, r)
    assert (c.imag > 0) == (part > 1)
    assert max(abs(dh1), abs(dh2)) == pytest.approx(1)
    jump = np.array([dh1, u1 * dh1 + h1 * du1, dh2, u2 * dh2 + du2])
    np.testing.assert_allclose(matrix(h1, u1, 1.0, u2, r) @ jump, c * jump, atol=1e-7)


@pytest.mark.parametrize(("h1", "r"), LAYERS)
def test_both_discriminants_change_sign_at_the_critical_shear(h1, r):
    critical = layers.critical_shear(h1, 1.0, r)
    for part, sign in ((0.5, 1), (1 - 1e-6, 1), (1 + 1e-6, -1), (1.05, -1)):
        du = part * critical
        assert np.sign(layers.discriminant(h1, 1.0, du, r)) == sign
        assert np.sign(waves.discriminant(h1, 1.0, du**2, r)) == sign


def test_the_critical_shear_has_its_known_limits():
    assert layers.critical_shear(0.5, 1.0, 0.9999) == pytest.approx(np.sqrt(1e-4 * 1.5), rel=1e-3)
    assert layers.critical_shear(0.5, 1.0, 1e-6) == pytest.approx(
        layers.critical_shear(0.5, 1.0, 0), rel=3e-3
    )
    assert layers.critical_shear(0.5, 1.0, 0) == np.sqrt(0.5) + 1


@settings(max_examples=300, deadline=None)
@given(
    st.floats(1e-3, 20), st.floats(1e-3, 20), st.floats(0.01, 0.999), st.floats(-1, 1),
    st.sampled_from([0.0, 1e-12, 1e-9, 1e-6, 1e-3, 0.5]),
)  # fmt: skip
def test_the_verdict_is_that_of_exact_arithmetic(h1, h2, r, side, distance):
    """As near to the limit as to the margin of round-off; in fractions nothing is rounded."""
    squared = (layers.critical_shear(h1, h2, r) * (1 + side * distance)) ** 2
    a, b, d2 = (Fraction(value) for value in (h1, h2, squared / 4))
    p, q2 = -2 * d2 - a - b, 4 * d2 * (b - a) ** 2
    s = (d2 - a) * (d2 - b) - Fraction(r) * a * b
    exact = 16 * p**4 * s - 4 * p**3 * q2 - 128 * p**2 * s**2 + 144 * p * q2 * s - 27 * q2**2 + 256 * s**3
    verdict = waves.discriminant(h1, h2, squared, r)
    assert verdict == pytest.approx(float(exact / (a + b + 4 * d2) ** 6), abs=64 * np.finfo(float).eps)


@pytest.mark.parametrize("make", [axial, plane])
def test_the_series_counts_the_cells_whose_matrix_has_complex_eigenvalues(make):
    rng = np.random.default_rng(8)
    shape = (24,) if make is axial else (24, 24)
    h1, h2 = rng.uniform(0.1, 1.5, (2, *shape))
    u = rng.uniform(-0.5, 0.5, (4, *shape))
    if make is axial:
        model = axial(np.arange(25) * 0.1, h1, u[0], h2, u[1], level=2.0, r=0.9)
        shear = u[0] - u[1]
    else:
        velocities = dict(zip(("u1", "u2", "v1", "v2"), u, strict=True))
        model = plane(np.arange(25) * 0.1, h1, h2, level=2.0, r=0.9, **velocities)
        shear = np.hypot(u[0] - u[1], u[2] - u[3])
    cells = zip(h1.ravel(), h2.ravel(), shear.ravel(), strict=True)
    lost = sum(np.abs(np.linalg.eigvals(matrix(a, d, b, 0.0, 0.9)).imag).max() > 1e-6 for a, b, d in cells)
    assert 0.1 * h1.size < lost < 0.9 * h1.size
    assert advance(model, steps=1)[0][0, columns.COMPLEX] == lost


def run(part, folds, samples=5, **keys):
    """Run over the time in which the wave grows by e^folds, or turns by as many radians where it does not grow."""
    options = {"shear": part, "amplitude": 1e-5, **keys.pop("scene_options", {})}
    values = {
        "scene": "shear",
        "scene_options": options,
        "boundary": "periodic",
        "delta": 0,
        "r": 0.8,
        **keys,
    }
    point = config.make_point(values)
    c = complex(layers.mode(*layers.base(point), point.r)[0])
    rate = layers.wave_number(point) * (c.imag or abs(c.real)) / np.sqrt(point.radius / (point.g * point.a_2))
    times = np.linspace(0, folds / rate, samples)
    point = dataclasses.replace(point, t_end=times[-1], snapshot_times=tuple(times[:-1]))
    result = solve(point)
    assert result.status == "ok"
    return result, shear.measured_growth(point, result.x, result.snapshot_time, result.h2) / rate


@pytest.mark.parametrize(("order", "folds"), [(1, 1.0), (2, 0.25)])
@pytest.mark.parametrize(
    ("part", "keys"), [(1.1, {}), (1.5, {}), (2.0, {"r": 0.95}), (1.2, {"a_H": 0.3, "r": 0.6})]
)
def test_above_the_limit_the_wave_grows_as_linear_theory_says(part, keys, order, folds):
    found = [run(part, folds, order=order, cells=cells, **keys) for cells in (50, 100)]
    errors = np.array([abs(growth - 1) for _, growth in found])
    assert errors[1] < (0.07 if order == 1 else 0.002)
    assert errors[1] < errors[0] * (0.55 if order == 1 else 0.35)
    for result, _ in found:
        assert np.all(result.nonhyperbolic_cells == len(result.x))


@pytest.mark.parametrize("order", [1, 2])
@pytest.mark.parametrize(("part", "keys"), [(0.5, {}), (0.9, {}), (0.99, {"r": 0.95}), (0.99, {"r": 0.4})])
def test_below_the_limit_nothing_grows(part, keys, order):
    damping = []
    for cells in (50, 100):
        result, growth = run(part, 2 * np.pi, order=order, cells=cells, **keys)
        assert growth < 1e-4
        assert not result.nonhyperbolic_cells.any()
        damping.append(-growth)
    assert damping[1] < damping[0] * (0.6 if order == 1 else 0.3)


@pytest.mark.parametrize("drift", [-1.0, 1.0])
def test_growth_is_the_same_in_a_frame_that_moves(drift):
    _, growth = run(1.5, 1.0, order=1, cells=100, scene_options={"drift": drift})
    assert growth == pytest.approx(1, abs=0.1)


def test_the_solution_moves_and_grows_with_the_wave():
    result, _ = run(1.3, 0.25, cells=100, a_H=0.5)
    point = result.point
    exact = shear.solution(point, result.x, result.snapshot_time[-1])
    for name in ("h2", "eta"):
        height = shear.amplitude(point, result.snapshot_time[-1]) * point.a_2 * point.radius
        assert np.abs(getattr(result, name)[-1] - exact[name]).max() < 0.02 * height
    assert shear.amplitude(point, point.t_end) == pytest.approx(1e-5 * np.exp(0.25))
    assert np.isnan(shear.solution(dataclasses.replace(point, delta=5.0), result.x, 0.1)["h2"]).all()


def test_the_margin_is_one_at_rest_and_negative_where_speeds_are_complex():
    critical = layers.critical_shear(1.0, 1.0, 0.8)
    for factor, cells in ((0.0, 0), (0.5, 0), (0.999, 0), (1.01, 20), (1.3, 20)):
        model = axial(
            np.arange(21) * 0.05,
            1.0,
            factor * critical,
            1.0,
            0.0,
            level=2.0,
            r=0.8,
            m=0.0,
            walls=(2, 2),
        )
        samples, _ = advance(model, steps=0)
        assert samples[0, columns.COMPLEX] == cells
        margin = samples[0, columns.MARGIN]
        assert margin == 1 if factor == 0 else 0 < margin < 1 if factor < 1 else margin < 0
