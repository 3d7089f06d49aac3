"""Estimates from three grids: on made-up sequences the order, the limit and the error are known."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from subslide.tables._convergence import CONVERGING, NOT_CONVERGED, SAFETY, estimate

limits = st.floats(0.1, 10)
orders = st.floats(0.4, 4)
errors = st.floats(1e-4, 0.05) | st.floats(-0.05, -1e-4)


@given(limits, orders, errors, st.sampled_from([1.0, 2.0]))
def test_order_and_limit_of_a_power_law_are_found_and_lie_in_the_band(limit, order, error, formal):
    found = estimate(*(limit + error * h**order for h in (1, 2, 4)), formal)
    assert found.convergence == CONVERGING
    assert found.order == pytest.approx(order, rel=1e-6)
    assert found.limit == pytest.approx(limit, rel=1e-7)
    assert abs(error) < found.band


@given(limits, orders, errors)
def test_below_the_formal_order_the_band_is_roaches_index(limit, order, error):
    f1, f2, f3 = (limit + error * h**order for h in (1, 2, 4))
    assert estimate(f1, f2, f3, 5.0).band == pytest.approx(SAFETY * abs(f1 - f2) / (2**order - 1), rel=1e-6)
    assert SAFETY == 1.25


@given(limits, errors, st.floats(1.01, 40))
def test_faster_than_the_formal_order_never_narrows_the_band(limit, error, order):
    """However well the two finest values agree, the band is what the coarser pair leaves at the formal order."""
    fast = estimate(limit, limit + error / 2**order, limit + error / 2**order + error, 1.0)
    assert fast.band == pytest.approx(SAFETY * abs(error) / 2, rel=1e-6)
    chance = estimate(limit, limit, limit + error, 1.0)
    assert (chance.limit, chance.convergence) == (limit, CONVERGING)
    assert chance.band == pytest.approx(SAFETY * abs(error) / 2, rel=1e-6)


@given(limits, errors, st.floats(0.01, 100))
def test_oscillation_is_not_converged(limit, error, ratio):
    found = estimate(limit, limit + error, limit + error - ratio * error, 1.0)
    assert found.convergence == NOT_CONVERGED
    assert all(map(math.isnan, found[:2]))
    assert found.band == pytest.approx(3 * abs(error) * max(1, ratio), rel=1e-6)


@given(limits, errors, st.floats(-3, 0.29))
def test_growing_or_hardly_shrinking_differences_are_not_converged(limit, error, order):
    found = estimate(limit, limit + error, limit + error + 2**order * error, 1.0)
    assert found.convergence == NOT_CONVERGED
    assert found.order == pytest.approx(order, abs=1e-6)
    assert math.isnan(found.limit)
    assert found.band == pytest.approx(3 * abs(error) * (1 + 2**order), rel=1e-6)


@given(limits, st.lists(st.integers(-2, 2), min_size=3, max_size=3))
def test_round_off_is_converging_with_no_band_to_speak_of(value, units):
    found = estimate(*(value + n * math.ulp(value) for n in units), 1.0)
    assert found.convergence == CONVERGING
    assert found.limit == value + units[0] * math.ulp(value)
    assert 0 <= found.band <= 1e-14 * abs(value) + 1e-300


def test_round_off_is_that_of_the_numbers_a_difference_was_taken_of():
    """A lake at rest: displacements of 1e-17 m in a metre of water, in any order, are zero."""
    assert estimate(1e-17, 3e-17, 2e-17, 1.0).convergence == NOT_CONVERGED
    assert estimate(1e-17, 3e-17, 2e-17, 1.0, scale=1.0).convergence == CONVERGING
    single = (0.1, 0.1 + 2e-8, 0.1 + 1e-8)
    assert estimate(*single, 1.0).convergence == NOT_CONVERGED
    assert estimate(*single, 1.0, dtype="float32").convergence == CONVERGING


@pytest.mark.parametrize("place", [0, 1, 2])
@pytest.mark.parametrize("bad", [math.nan, math.inf])
def test_a_value_that_is_missing_is_not_converged(place, bad):
    values = [1.0, 1.1, 1.3]
    values[place] = bad
    found = estimate(*values, 1.0)
    assert found.convergence == NOT_CONVERGED
    assert all(map(math.isnan, found[:3]))


@given(
    st.lists(st.floats(allow_nan=False, allow_infinity=False), min_size=3, max_size=3),
    st.sampled_from([1.0, 2.0]),
)
def test_any_three_numbers_have_an_answer(values, formal):
    found = estimate(*values, formal)
    converging = found.convergence == CONVERGING
    assert converging == (not math.isnan(found.limit))
    assert not math.isnan(found.band)
    assert not found.band < 0
