"""Sobol' indices: functions whose indices are known, bands that hold them, failed runs and grid error."""

import itertools

import numpy as np
import pytest

from subslide.sensitivity.effects import effect
from subslide.sensitivity.indices import indices, labels
from subslide.sensitivity.laws import fit

SCRAMBLINGS, POINTS = 16, 64
WEIGHTS = np.array([0.0, 0.5, 3.0, 9.0, 99.0])


def blocks(inputs, random, points=POINTS):
    """Return the inputs of scrambled Saltelli blocks: (scramblings, 2 + 2 inputs, points, inputs)."""
    from scipy.stats import qmc

    made = []
    for _ in range(SCRAMBLINGS):
        drawn = qmc.Sobol(2 * inputs, rng=random).random(points)
        a, b = drawn[:, :inputs], drawn[:, inputs:]
        mixed = [np.where(np.arange(inputs) == i, y, x) for x, y in ((a, b), (b, a)) for i in range(inputs)]
        made.append(np.stack([a, b, *mixed]))
    return np.stack(made)


def ishigami(u):
    x = np.pi * (2 * u - 1)
    return np.sin(x[..., 0]) + 7 * np.sin(x[..., 1]) ** 2 + 0.1 * x[..., 2] ** 4 * np.sin(x[..., 0])


def sobol_g(u):
    return np.prod((abs(4 * u - 2) + WEIGHTS) / (1 + WEIGHTS), axis=-1)


def parts_of_ishigami():
    """Return the share of the variance by the inputs that make it."""
    b, quartic = 0.1, np.pi**4
    parts = {
        (0,): (1 + b * quartic / 5) ** 2 / 2,
        (1,): 49 / 8,
        (0, 2): b**2 * quartic**2 * (1 / 18 - 1 / 50),
    }
    return {places: value / sum(parts.values()) for places, value in parts.items()}


def parts_of_sobol_g():
    alone = 1 / (3 * (1 + WEIGHTS) ** 2)
    total = np.prod(1 + alone) - 1
    inputs = range(len(WEIGHTS))
    sets = itertools.chain(*(itertools.combinations(inputs, n) for n in range(1, len(WEIGHTS) + 1)))
    return {places: np.prod(alone[list(places)]) / total for places in sets}


def known(parts, inputs):
    """Return the indices in the order of `labels`."""
    chosen = {
        "first": lambda places, of: places == of,
        "second": lambda places, of: places == of,
        "total": lambda places, of: set(of) <= set(places),
        "closed": lambda places, of: set(places) <= set(of),
    }
    return np.array(
        [
            sum(value for places, value in parts.items() if chosen[label.kind](places, label.places))
            for label in labels(inputs)
        ]
    )


FUNCTIONS = {"ishigami": (3, ishigami, parts_of_ishigami), "sobol_g": (5, sobol_g, parts_of_sobol_g)}


def coverage(name, repetitions):
    """Return the share of bands that hold each index."""
    inputs, function, parts = FUNCTIONS[name]
    truth = known(parts(), inputs)
    random = np.random.default_rng(13)
    held = np.zeros(len(truth))
    for _ in range(repetitions):
        u = blocks(inputs, random)
        answer = indices(function(u), inputs=u)
        held += (answer.low <= truth) & (truth <= answer.high)
    return held / repetitions


@pytest.mark.parametrize("name", FUNCTIONS)
def test_bands_hold_known_indices(name):
    held = coverage(name, 60)
    assert 0.92 <= held.mean() <= 0.985  # 60 repetitions: 93 to 98 % less what chance does
    assert held.min() >= 0.8


@pytest.mark.long
@pytest.mark.parametrize("name", FUNCTIONS)
def test_bands_hold_known_indices_in_500_repetitions(name):
    held = coverage(name, 500)
    assert 0.93 <= held.mean() <= 0.98
    assert held.min() >= 0.88


def test_series_have_the_indices_of_each_time():
    u = blocks(3, np.random.default_rng(1))
    outputs = np.stack([ishigami(u), 3 * u[..., 1] - 1e6, np.zeros(u.shape[:3])], axis=-1)
    errors = np.full(outputs.shape, 0.01)
    together = indices(outputs, errors, u)
    for n in (0, 1):
        alone = indices(outputs[..., n], errors[..., n], u)
        for one, other in zip(vars(together).values(), vars(alone).values(), strict=True):
            np.testing.assert_allclose(one[:, n], other, rtol=1e-9, atol=1e-9)
    assert np.isnan(indices(outputs).estimate[:, 2]).all()  # what does not vary has no index


def test_an_input_without_effect_has_index_zero_to_round_off():
    u = blocks(4, np.random.default_rng(1))
    answer = indices(np.exp(u[..., 0]) * u[..., 2] + u[..., 3])
    of_second = [n for n, label in enumerate(labels(4)) if 1 in label.places and label.kind != "closed"]
    assert np.abs(answer.estimate[of_second]).max() < 1e-14


def test_what_is_a_sum_has_no_second_order_index_but_round_off():
    u = blocks(3, np.random.default_rng(8))
    answer = indices(u[..., 0] ** 3 + 2 * u[..., 1] ** 2 - u[..., 2], inputs=u)
    of_second = [n for n, label in enumerate(labels(3)) if label.kind == "second"]
    assert np.abs(answer.estimate[of_second]).max() < 1e-6
    assert answer.sampling[of_second].max() < 1e-6
    assert answer.sampling.max() < 0.1


def test_failed_runs_bound_the_indices():
    u = blocks(3, np.random.default_rng(2))
    outputs = ishigami(u)
    whole = indices(outputs)
    with_failures = outputs.copy()
    with_failures[np.random.default_rng(3).random(outputs.shape) < 0.003] = np.nan
    with_failures[2, :, 5] = np.nan  # a point that fails whatever is exchanged
    answer = indices(with_failures)
    assert np.isnan(with_failures).sum() > 20
    assert np.all(answer.least < answer.most)
    assert np.all((answer.least <= answer.estimate) & (answer.estimate <= answer.most))
    assert np.all((answer.least <= whole.estimate) & (whole.estimate <= answer.most))
    assert np.all(answer.low < answer.least)
    for seed in range(20):  # whatever they might have been
        guess = np.random.default_rng(seed).choice(
            [np.nanmin(with_failures), np.nanmax(with_failures)], outputs.shape
        )
        guess = indices(np.where(np.isnan(with_failures), guess, with_failures)).estimate
        assert np.all((answer.least <= guess) & (guess <= answer.most))


def errors_of_grids(u):
    """Return errors, within half-widths of 1, of the kinds that grids make."""
    random = np.random.default_rng(5)
    return {
        "alike": np.ones(u.shape[:3]),
        "trend": 2 * u[..., 1] - 1,
        "place in a cell": np.clip(random.normal(0, 0.5, u.shape[:3]), -1, 1),
        "uniform": random.uniform(-1, 1, u.shape[:3]),
        "wave": np.sin(20 * u[..., 0] + 9 * u[..., 2]),
    }


def test_bands_hold_the_errors_of_grids():
    u = blocks(3, np.random.default_rng(4))
    exact = ishigami(u)
    half_widths = 0.05 * exact.std() * (1 + u[..., 2])
    for name, error in errors_of_grids(u).items():
        answer = indices(exact + error * half_widths, half_widths, u)
        moved = np.abs(answer.estimate - indices(exact, inputs=u).estimate)
        assert np.all(moved <= answer.grid + 0.1 * answer.sampling), name
    assert np.all(indices(exact, half_widths, u).grid < 0.1)


def test_main_effects_are_means_over_the_other_inputs():
    u = blocks(3, np.random.default_rng(6))
    outputs = ishigami(u)
    answer = effect(outputs, u[..., 0])
    exact = (1 + 0.1 * np.pi**4 / 5) * np.sin(np.pi * (2 * u[..., 0] - 1)) + 3.5
    truth = effect(exact, u[..., 0])
    np.testing.assert_allclose(answer.value, (np.arange(12) + 0.5) / 12, atol=2e-3)
    assert np.all(np.abs(answer.mean - truth.mean) < 2 * answer.sampling)
    assert answer.sampling.max() < 0.5
    failed = outputs.copy()
    failed[:, :, 7] = np.nan
    bounds = effect(failed, u[..., 0], np.full(outputs.shape, 0.1))
    assert np.all((bounds.least <= answer.mean) & (answer.mean <= bounds.most))
    assert np.all(bounds.most[1:] > bounds.least[1:])
    np.testing.assert_allclose(bounds.grid, 0.1)


@pytest.mark.parametrize("groups", [1, 2])
def test_a_law_of_few_groups_is_told_as_far_as_it_is(groups):
    variables = np.exp(np.random.default_rng(3).normal(size=(groups, 6, 2)))
    values = 2 * variables[..., 0] ** 0.5 / variables[..., 1]
    law = fit(values, variables)
    np.testing.assert_allclose(law.terms, [2, 0.5, -1])
    ends = np.full((2, 3), np.nan) if groups == 1 else [law.terms, law.terms]
    np.testing.assert_allclose([law.low, law.high], ends)
    assert np.isnan(law.errors).all() == (groups == 1)
    assert np.isnan(fit(-values, variables).terms).all()


@pytest.mark.filterwarnings("error")
def test_what_too_few_runs_do_not_tell_is_missing():
    inputs = blocks(2, np.random.default_rng(4), points=1)[:1]
    outputs = np.exp(inputs[..., 0]) * (1 + inputs[..., 1])
    told = indices(outputs, 0.01 * outputs, inputs)
    assert np.isfinite(told.estimate).all()
    assert np.isnan([told.low, told.high]).all()
    along = effect(outputs, inputs[..., 0])
    assert np.isnan(along.mean).any()
    assert np.isnan([along.low, along.high]).all()
    constant = indices(np.ones_like(outputs), 0.01 * outputs, inputs)
    assert np.isnan([constant.estimate, constant.low, constant.high]).all()
    nothing = indices(np.full_like(outputs, np.nan), None, inputs)
    assert np.isnan([nothing.estimate, nothing.low, nothing.high]).all()
