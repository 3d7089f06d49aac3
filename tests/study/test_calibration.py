"""Calibration: truths lie in their regions as often as it says, and what data cannot tell is told."""

import json
import math

import numpy as np
import pytest
from learned import columns, measured

from subslide.__main__ import main
from subslide.emulator import Emulator, calibration, observed, posterior, training
from subslide.keys.schema import ConfigError
from subslide.points import Point

TIMES = np.append(np.linspace(0.3, 4, 10), math.nan)
"""Scaled times, and the deposit."""


@pytest.fixture(scope="session")
def emulator():
    """Emulator of formulas."""
    return training.learn(measured(columns(64)), {"study": "formulas"}).emulator


def made_up(emulator, seed, share=0.01, fixed=None, threshold=0.01):
    """Return a model with fronts of a column drawn at random, errors of a share, and the place of that column."""
    rng = np.random.default_rng(seed)
    column = Point(a_2=0.7)
    times = TIMES * column.time_scale
    data = observed.Data(times, np.ones(len(times)), np.ones(len(times)), threshold)
    model = observed.Model(emulator, data, column, fixed or {}, 0.0)
    unit = rng.random((1, len(model.free)))
    place = model.fronts(unit)[0][0]
    error = share * place
    exact = data._replace(place=place + error * rng.standard_normal(len(place)), error=error)
    return model._replace(data=exact), unit


def truths_inside(emulator, seeds, **how):
    """Return how many truths lie in their 95 % regions."""
    inside = 0
    for seed in seeds:
        model, unit = made_up(emulator, seed, **how)
        inside += bool(model.log_likelihood(unit)[0] >= posterior.sample(model).level)
    return inside


def test_truths_lie_in_their_regions(emulator):
    assert truths_inside(emulator, range(12), fixed={"r": 0.4}) >= 10  # 11.4 are expected


def test_the_best_fit_is_the_truth_where_data_are_exact(emulator):
    model, unit = made_up(emulator, 5, share=1e-4, fixed={"r": 0.4, "a_H": 2.0})
    answer = calibration.calibrate(model, check=False)
    truth = model.parameters(unit)[0, 2]
    assert answer.parameters["delta"].best == pytest.approx(truth, rel=2e-3)
    assert answer.parameters["delta"].verdict == "told"
    assert answer.parameters["delta"].low < truth < answer.parameters["delta"].high


def test_what_data_cannot_tell_is_told(emulator):
    """The formulas hardly know a_H; r and delta shorten the deposit both."""
    model, _ = made_up(emulator, 3)
    answer = calibration.calibrate(model, check=False)
    assert answer.parameters["a_H"].verdict != "told"
    assert answer.parameters["delta"].verdict.startswith("told")
    rise = answer.parameters["delta"].profile[1]
    assert rise.min() == pytest.approx(0, abs=0.1)
    assert rise[0] > calibration.RISE < rise[-1]


def test_profiles_are_minima(emulator):
    """No point of the posterior near a value of the profile fits better than it, but for how far it lies off."""
    model, _ = made_up(emulator, 8)
    answer = calibration.calibrate(model, check=False)
    logs = answer.posterior.log_likelihood
    values = model.parameters(answer.posterior.unit)[:, 2]
    along, rise = answer.parameters["delta"].profile
    compared = 0
    for value, above in zip(along, rise, strict=True):
        near = np.abs(values - value) < 0.02 * (along[1] - along[0])
        if near.any() and above < 20:
            compared += 1
            assert above < -2 * (logs[near].max() - logs.max()) + 0.3
    assert compared > 5


def test_a_term_for_the_models_error_widens_all(emulator):
    model, _ = made_up(emulator, 4, fixed={"r": 0.4, "a_H": 2.0})
    one, two = (
        calibration.calibrate(some, check=False).parameters["delta"]
        for some in (model, model._replace(discrepancy=0.05))
    )
    assert two.high - two.low > 2 * (one.high - one.low)


def test_the_same_data_give_the_same_answer(emulator):
    model, _ = made_up(emulator, 2)
    one, two = posterior.sample(model), posterior.sample(model)
    assert np.array_equal(one.weight, two.weight)


def test_a_gaussian_is_sampled_as_it_is():
    """A likelihood that is known: its moments, and the level of its 95 % region (chi-squared of 3: 7.815)."""

    class Known:
        free = ("a", "b", "c")

        def log_likelihood(self, unit):
            x = (unit - 0.5) / [0.02, 0.05, 0.01]
            y = np.stack([x[:, 0], (x[:, 1] - 0.8 * x[:, 0]) / 0.6, x[:, 2]], axis=1)
            return -0.5 * (y**2).sum(axis=1)

    seen = posterior.sample(Known())
    assert seen.effective > 1000
    assert seen.weight @ seen.unit == pytest.approx([0.5, 0.5, 0.5], abs=0.004)
    spread = np.sqrt(seen.weight @ (seen.unit - 0.5) ** 2)
    assert spread == pytest.approx([0.02, 0.05, 0.01], rel=0.05)
    assert -2 * seen.level == pytest.approx(7.815, rel=0.05)


@pytest.mark.parametrize(("threshold", "weights"), [(0.01, {0: 1.0}), (0.03, {1: 1.0}), (0.05, {2: 1.0})])
def test_emulated_thresholds_stand_for_themselves(threshold, weights):
    assert observed.weights_of(threshold) == weights


def test_a_threshold_between_lies_between():
    shares = observed.weights_of(0.02)
    assert set(shares) == {0, 1}
    assert sum(shares.values()) == pytest.approx(1)


@pytest.fixture
def files(emulator, tmp_path):
    """Paths of data and of an emulator."""
    model, _ = made_up(emulator, 6)
    rows = zip(model.data.time, model.data.place, model.data.error, strict=True)
    lines = ["time,x_front,error", *(f"{'' if math.isnan(t) else t},{x},{e}" for t, x, e in rows)]
    (tmp_path / "data.csv").write_text("\n".join(lines) + "\n")
    emulator.save(tmp_path / "emulator.json")
    return str(tmp_path / "data.csv"), str(tmp_path / "emulator.json")


def test_the_command_prints_and_writes(files, tmp_path, capsys):
    data, emulator = files
    out = tmp_path / "fit.json"
    words = ["calibrate", data, "--threshold", "1%", "--a-2", "0.7", "--emulator", emulator, "--no-check"]
    assert main([*words, "--r", "0.4", "-o", str(out), "--figure", str(tmp_path / "fit.png")]) == 0
    printed = capsys.readouterr().out
    assert "the model's own error is not counted" in printed
    assert (tmp_path / "fit.png").read_bytes().startswith(b"\x89PNG")
    told = json.loads(out.read_text())
    assert set(told["parameters"]) == {"a_H", "delta"}
    assert told["threshold"] == 0.01
    assert len(told["parameters"]["delta"]["profile"]["value"]) == 31


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["--threshold", "9%"], "--threshold: 9% is not emulated; allowed: 1% to 5%"),
        (["--threshold", "x"], "allowed: a share such as"),
        (["--threshold", "1%", "--delta", "80"], "delta: 80 is outside what the emulator learned"),
        (["--threshold", "1%", "--a-H", "1", "--r", "0.1", "--delta", "30"], "all are given"),
    ],
)
def test_bad_input_is_told(files, words, told, capsys):
    data, emulator = files
    assert main(["calibrate", data, "--a-2", "0.7", "--emulator", emulator, *words]) == 2
    assert told in capsys.readouterr().err


def test_data_that_no_column_has_are_told_however_few(tmp_path, capsys):
    (tmp_path / "mm.csv").write_text("time,x_front,error\n0.08,92,1\n0.16,119,1\n")
    words = ["calibrate", str(tmp_path / "mm.csv"), "--threshold", "1%", "--no-check"]
    assert main([*words, "--a-2", "0.56"]) == 0
    assert "the model does not fit these data: they are not in m and s" in capsys.readouterr().out
    assert main([*words, "--a-2", "50"]) == 2
    assert "a_2: 50 is outside what the emulator learned; allowed: up to 20.5" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("time,x_front\n1,2\n", "there is no column error"),
        ("time,x_front,error\n1,2,0\n", "line 2: error"),
        ("time,x_front,error\n1,-2,1\n", "line 2: x_front"),
        ("time,x_front,error\n-1,2,1\n", "line 2: time"),
    ],
)
def test_bad_data_are_told(tmp_path, text, told):
    (tmp_path / "data.csv").write_text(text)
    with pytest.raises(ConfigError, match=told):
        observed.read(str(tmp_path / "data.csv"), 0.01)


@pytest.mark.long
def test_500_truths_of_the_emulator():
    emulator = Emulator.load()
    inside = sum(
        truths_inside(emulator, [(7, n) for n in range(first, 500, 3)], threshold=threshold)
        for first, threshold in enumerate((0.01, 0.02, 0.05))
    )
    assert inside >= 470


@pytest.mark.long
def test_20_truths_of_the_solver():
    emulator, inside = Emulator.load(), 0
    for n in range(20):
        model, unit = made_up(emulator, (9, n))
        truth = dict(zip(observed.FREE, model.parameters(unit)[0].tolist(), strict=True))
        exact = calibration.by_solver(model, model.column.with_values(**truth))
        noise = np.random.default_rng((10, n)).standard_normal(len(exact))
        solved = model._replace(
            data=model.data._replace(place=exact * (1 + 0.01 * noise), error=0.01 * exact)
        )
        inside += bool(solved.log_likelihood(unit)[0] >= posterior.sample(solved).level)
    assert inside >= 18
