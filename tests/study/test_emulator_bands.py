"""Bands of an emulator hold what they should, of columns that it never saw."""

import numpy as np
import pytest
from learned import answer, columns, inner, measured

from subslide.emulator import Emulator, coordinates, fitting, grids, group, judging, training
from subslide.emulator import measures as named


def test_bands_hold_what_they_should(trained):
    for name, one in trained.left_out.items():
        assert one.covered > 0.9, name
    rows = inner(256)
    value, band = trained.emulator.predict(*np.array(rows).T)["L_f_1pc"]
    exact = np.array([answer(*row)["L_f_1pc"] for row in rows])
    assert np.mean(np.abs(value - exact) <= band) > 0.9
    assert np.median(band / value) < 5e-3


def test_leave_one_out_is_what_a_fit_without_the_point_predicts(trained):
    """By the formula for all at once; the kernel is the same, so only that point's part may differ."""
    fronts = trained.emulator.groups["fronts"]
    runs = training.limits(measured(columns(64)))["fronts"]
    kept = np.arange(64) != 5
    z = coordinates.of(fronts.kind, runs.inputs)
    basis = coordinates.quadratic(z)
    rest = (runs.values / np.exp(basis @ fronts.law) - basis @ fronts.trend)[:, 0]
    covariance = group.kernel(z / fronts.process.lengths, z / fronts.process.lengths) + 1e-6 * np.eye(64)
    inverse = np.linalg.inv(covariance)
    quick = rest[5] - (inverse @ rest)[5] / inverse[5, 5]
    slow = covariance[5, kept] @ np.linalg.solve(covariance[np.ix_(kept, kept)], rest[kept])
    assert quick == pytest.approx(slow, rel=1e-6, abs=1e-12)


def test_held_out_columns_change_nothing(trained):
    known = training.limits(measured(inner(64)))
    errors = judging.against(trained.emulator, known)
    assert errors["L_f_1pc"].covered > 0.8
    assert np.quantile(np.abs(errors["L_f_1pc"].error), 0.5) < 1e-3
    assert len(errors["x_front_1pc"].value) == len(known["fronts"].inputs) * len(named.FRONT_NODES)


def test_a_band_holds_its_share_of_errors():
    rng = np.random.default_rng(3)
    rows = np.array(columns(2000))
    size = 0.01 * rows[:, 0]  # errors that grow tenfold over the range
    errors = size * rng.standard_normal(2000)
    coefficients = fitting.band_of(coordinates.GRAINS, rows, errors, np.zeros(2000))
    band = np.exp(coordinates.of_errors(coordinates.of(coordinates.GRAINS, rows)) @ coefficients)
    for half in (rows[:, 0] < 2, rows[:, 0] >= 2):
        assert 0.93 < np.mean(np.abs(errors[half]) <= band[half]) < 0.97


@pytest.mark.parametrize("count", [20, 40])
def test_bands_of_few_columns_hold_columns_that_were_not_seen(count):
    names = ("L_f_1pc", "L_f_5pc")

    def values(rows):
        told = Emulator.load().predict(*rows.T, quantities=names)
        return np.stack([told[name].value for name in names], axis=1)

    others, held = np.array(inner(400)), []
    for seed in range(4):
        rows = np.array(columns(count, seed))
        known = fitting.learn(
            coordinates.GRAINS, names, rows, *(values(rows) * share for share in (1, 1e-4, 1e-4))
        ).group
        guess, band = known(others)
        held.append(np.abs(guess - values(others)) <= band)
    assert np.mean(held) > 0.95
    assert np.mean(held, axis=1).min() > 0.85


def test_what_the_finest_grid_changes_is_bias_and_what_jumps_is_noise():
    z = coordinates.of(coordinates.GRAINS, np.array(columns(200)))
    cells, rng = np.array([128, 192, 256]), np.random.default_rng(1)
    curved = 2 + np.full((200, 1), 30) / cells + 4000 / cells**2  # off by the same in every column
    smooth = grids.limit(curved, cells, z)
    assert (np.abs(smooth.value - 2) <= 1.96 * smooth.bias).all()
    assert (smooth.noise < smooth.bias).all()
    jumping = grids.limit(2 + 30 / cells + 1e-3 * rng.standard_normal((200, 3)), cells, z)
    assert np.std(jumping.value - 2) == pytest.approx(np.median(jumping.noise), rel=0.8)
    two = grids.limit(curved[:, :2], cells[:2], z)
    assert np.array_equal(two.bias, two.noise)  # which of the two cannot be told


def test_columns_left_out_of_an_even_design_are_further_from_the_others_than_any():
    rows = np.array(columns(256))
    values = np.array([[answer(*row)["L_f_1pc"]] for row in rows])
    known = fitting.learn(coordinates.GRAINS, ("L_f_1pc",), rows, values, 1e-6 * values, 0 * values)
    others = np.array(inner(1000))
    exact = np.array([answer(*row)["L_f_1pc"] for row in others])
    ratio = np.median(np.abs(known.group(others)[0][:, 0] - exact)) / np.median(
        np.abs(known.left_out - values)
    )
    assert known.nearer < 0.95
    assert ratio < 0.95


def test_a_group_keeps_its_first_columns_and_all_are_judged(monkeypatch):
    monkeypatch.setitem(named.MOST, "surface", 32)
    runs = measured(columns(64))
    few = training.learn(runs, {})
    assert few.known["surface"] == 32
    assert len(training.limits(runs)["surface"].inputs) == 64
