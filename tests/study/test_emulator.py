"""What an emulator predicts: limits of ever finer grids, at any time and of many columns, within its range."""

import math

import numpy as np
import pytest
from learned import answer, inner

from subslide.__main__ import main
from subslide.emulator import measures as named
from subslide.emulator import model
from subslide.keys.schema import ConfigError


def test_it_gives_the_limit_of_ever_finer_grids(trained):
    rows = inner(256)
    predicted = trained.emulator.predict(*np.array(rows).T)
    for name in ("L_f_1pc", "time_of_arrest_3pc"):
        exact = np.array([answer(*row)[name] for row in rows])
        assert (
            np.quantile(np.abs(predicted[name].value / exact - 1), 0.95) < 2e-3
        )  # grids are off by up to 3e-3
    peak = np.array([max(answer(*row)[name] for name in named.WINDOWS) for row in rows])
    assert np.quantile(np.abs(predicted[named.PEAK].value / peak - 1), 0.95) < 5e-3


def test_a_2_and_delta_stand_for_m(trained):
    m = math.tan(math.radians(32)) / 0.56
    by_m = trained.emulator.predict(2, 0.4, m)["L_f_1pc"].value
    assert trained.emulator.predict(2, 0.4, a_2=0.56, delta=32)["L_f_1pc"].value == by_m
    with pytest.raises(ConfigError, match="allowed: one of the two"):
        trained.emulator.predict(2, 0.4, m, a_2=0.56, delta=32)


@pytest.mark.parametrize(
    ("row", "told"), [((20, 0.4, 1), "a_H"), ((2, 0.9, 1), "r"), ((2, 0.4, 5), "m = tan")]
)
def test_it_refuses_what_it_has_not_learned(trained, row, told):
    with pytest.raises(ConfigError, match=f"{told}.*outside what the emulator learned; allowed"):
        trained.emulator.predict(*row)


def test_fronts_at_any_time_go_on_and_end_as_the_deposit(trained):
    times = np.linspace(0, 30, 301)
    predicted = trained.emulator.predict([1.0, 4.0], [0.2, 0.6], [0.5, 1.5], times=times)
    front = predicted["x_front_1pc"].value
    assert front.shape == (2, 301)
    assert np.allclose(front[:, 0], 1)
    assert (np.diff(front, axis=1) > -1e-3).all()
    assert np.allclose(front[:, -1], predicted["L_f_1pc"].value)
    bands = predicted["x_front_1pc"].band
    assert np.allclose(bands[:, -1], predicted["L_f_1pc"].band)  # at rest no cubic errs


def test_points_are_the_same_alone_and_in_bulk(trained):
    rows = np.array(inner(900))
    bulk = trained.emulator.predict(*rows.T)["x_front_3pc"].value
    alone = trained.emulator.predict(*rows[-1])["x_front_3pc"].value
    assert len(rows) > model.CHUNK
    assert np.allclose(bulk[-1], alone[0], rtol=1e-12)


def test_columns_broadcast_and_may_be_none(trained):
    emulator = trained.emulator
    depths, ratios = np.array([[1.0], [2.0]]), np.array([[0.2, 0.4, 0.6]])
    every = emulator.predict(depths, ratios, 1.0, quantities="L_f_1pc")["L_f_1pc"].value
    assert every[4] == pytest.approx(emulator.predict(2, 0.4, 1.0)["L_f_1pc"].value[0])
    assert every.shape == (6,)
    assert emulator.predict([], 0.4, 1.0)["x_front_1pc"].value.shape == (0, len(named.TIMES))


def test_predict_prints_scaled_values_and_si_units(saved, capsys):
    assert main(["predict", "--a-H", "2", "--r", "0.4", "--a-2", "0.56", "--emulator", str(saved)]) == 0
    printed = capsys.readouterr().out
    row = next(line for line in printed.splitlines() if line.startswith("L_f_1pc"))
    value, _, metres = (float(word) for word in row.split()[1:4])
    assert metres == pytest.approx(0.0705 * value, rel=1e-3)
    assert main(["predict", "--a-H", "20", "--emulator", str(saved)]) == 2
    assert "allowed: 0.5" in capsys.readouterr().err


def test_predict_prints_nothing_of_what_it_refuses(saved, capsys):
    assert main(["predict", "--emulator", str(saved), "--a-H", "20"]) == 2
    printed = capsys.readouterr()
    assert printed.out == ""
    assert printed.err.startswith("subslide: a_H: 20 is outside what the emulator learned")
