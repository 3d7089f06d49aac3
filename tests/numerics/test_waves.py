"""Wave speeds against numpy's eigenvalues, and the verdict on hyperbolicity."""

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from subslide.kernels.waves import (
    approximate_speeds,
    discriminant,
    discriminant_without_shear,
    inner_speeds,
    outer_speeds,
)

depths = st.one_of(st.just(0.0), st.floats(1e-5, 20.0))
speeds = st.floats(-3.0, 3.0)
ratios = st.one_of(st.just(0.0), st.floats(0.0, 0.99))
EPS = 64 * np.finfo(float).eps


def matrix(h1, u1, h2, u2, r):
    """The Roe matrix of Eq. (8), scaled, on (h1, q1, h2, q2)."""
    return np.array(
        [
            [0, 1, 0, 0],
            [h1 - u1**2, 2 * u1, h1, 0],
            [0, 0, 0, 1],
            [r * h2, 0, h2 - u2**2, 2 * u2],
        ]
    )


def characteristic(x, h1, u1, h2, u2, r):
    return ((x - u1) ** 2 - h1) * ((x - u2) ** 2 - h2) - r * h1 * h2


@settings(max_examples=400, deadline=None)
@given(depths, speeds, depths, speeds, ratios)
@example(1.0, 0.0, 1.0, 0.0, 0.0)
@example(1.0, 0.5, 1.0, 0.5, 0.4)
@example(2.0, 0.0, 0.0, 1.0, 0.3)
@example(0.0, 0.0, 0.0, 0.0, 0.3)
def test_outer_speeds_bound_the_eigenvalues(h1, u1, h2, u2, r):
    slow, fast = outer_speeds(h1, u1, h2, u2, r)
    values = np.linalg.eigvals(matrix(h1, u1, h2, u2, r))
    scale = max(np.abs(values).max(), 1e-30)
    real = values.real[np.abs(values.imag) <= 1e-6 * scale]
    # numpy's own error at a multiple root is the root of the round-off
    assert fast >= real.max() - 3e-7 * scale
    assert slow <= real.min() + 3e-7 * scale
    # and not far outside: three Newton steps from outside leave little even where layers shear hard
    assert fast <= real.max() + 0.12 * scale
    assert slow >= real.min() - 0.12 * scale


@settings(max_examples=300, deadline=None)
@given(st.floats(0.05, 20), st.floats(0.001, 2), st.floats(-1, 1), st.floats(-0.5, 0.5), ratios)
@example(0.5, 1.0, 0.0, 0.5, 0.0625)  # 9.4e-6 outside
@example(0.718886, 0.503698, 0.0, 0.495688, 0.0881748)  # the worst of two million states: 1.26e-4
@example(1.355357, 1.736613, 0.0, 0.499511, 0.2014465)  # the worst of them from r = 0.2 on: 2.7e-7
def test_speeds_are_nearly_exact_where_layers_shear_moderately(h1, h2, u, shear, r):
    """Three Newton steps err most where layers that hardly feel each other have nearly equal speeds of their own."""
    u1, u2 = u, u + shear * np.sqrt((1 - r) * (h1 + h2)) * 0.5
    slow, fast = outer_speeds(h1, u1, h2, u2, r)
    centre, half = inner_speeds(h1, u1, h2, u2, r, slow, fast)
    values = np.sort(np.linalg.eigvals(matrix(h1, u1, h2, u2, r)).real)
    scale = np.abs(values).max()
    error = 5e-7 if r >= 0.2 else 2e-4
    assert -3e-7 * scale < values[0] - slow < error * scale
    assert -3e-7 * scale < fast - values[3] < error * scale
    if half > 1e-3 * scale**2:
        root = np.sqrt(half)
        inner = [centre - root, centre + root]
        np.testing.assert_allclose(inner, values[1:3], atol=(1e-6 if r >= 0.2 else 3e-4) * scale)


@given(st.floats(0.01, 20), ratios, st.floats(-2, 2))
def test_equal_layers_at_rest_have_the_closed_form(h, r, u):
    slow, fast = outer_speeds(h, u, h, u, r)
    assert np.isclose(fast - u, np.sqrt(h * (1 + np.sqrt(r))), rtol=1e-12)
    assert np.isclose(u - slow, np.sqrt(h * (1 + np.sqrt(r))), rtol=1e-12)


@given(depths, speeds, depths, speeds, ratios)
def test_speeds_of_a_mirrored_state_are_mirrored_to_the_bit(h1, u1, h2, u2, r):
    slow, fast = outer_speeds(h1, u1, h2, u2, r)
    assert (-fast, -slow) == outer_speeds(h1, -u1, h2, -u2, r)


@settings(max_examples=400, deadline=None)
@given(st.floats(0.001, 20), speeds, st.floats(0.001, 20), speeds, st.floats(0.01, 0.99))
def test_discriminant_decides_as_the_eigenvalues_do(h1, u1, h2, u2, r):
    values = np.linalg.eigvals(matrix(h1, u1, h2, u2, r))
    imaginary = np.abs(values.imag).max() / np.abs(values).max()
    verdict = discriminant(h1, h2, (u1 - u2) ** 2, r)
    if imaginary > 1e-3:
        assert verdict < -EPS
    elif imaginary == 0:
        assert verdict > -1e-6


def test_discriminant_sees_the_limit_of_shear_as_densities_meet():
    # Long's limit F^2 = 1 holds as r -> 1
    h1, h2, r = 1.0, 0.5, 0.999
    limit = (1 - r) * (h1 + h2)
    assert discriminant(h1, h2, 0.9 * limit, r) > 0
    assert discriminant(h1, h2, 1.1 * limit, r) < 0


def test_approximate_speeds_err_at_rest_as_published():
    for r, outer, inner in ((0.0, 1.41, 0.71), (0.2, 1.18, 0.85), (0.4, 1.11, 0.90)):
        slow, fast = outer_speeds(1.0, 0.0, 1.0, 0.0, r)
        _, half_width_squared = inner_speeds(1.0, 0.0, 1.0, 0.0, r, slow, fast)
        _, near, _, near_squared = approximate_speeds(1.0, 0.0, 1.0, 0.0, r)
        exact = np.sqrt(half_width_squared) if r > 0 else 1.0
        assert near / fast == pytest.approx(outer, abs=0.006)
        assert np.sqrt(near_squared) / exact == pytest.approx(inner, abs=0.006)


@given(st.floats(1e-6, 10), st.floats(1e-6, 10), st.floats(0, 0.999))
def test_without_shear_the_discriminant_has_a_closed_form(h1, h2, r):
    assert discriminant_without_shear(h1, h2, r) == pytest.approx(discriminant(h1, h2, 0.0, r), abs=1e-13)
