"""The file of an emulator: small, whole, read by numpy alone; and the one that the package has."""

import json
import math
import subprocess
import sys

import numpy as np
import pytest
from learned import inner

from subslide.emulator import Emulator, coordinates, growing, model
from subslide.emulator import measures as named
from subslide.files import RecordError
from subslide.points import Point


def test_the_file_gives_the_same_and_is_small(trained, saved):
    again = Emulator.load(saved)
    rows = np.array(inner(64)).T
    for name, (value, band) in trained.emulator.predict(*rows).items():
        other = again.predict(*rows)[name]
        assert np.allclose(other.value, value, rtol=5e-5)  # numbers of float32
        assert np.allclose(other.band, band, rtol=1e-4)
    assert saved.stat().st_size < 60_000
    assert again.about["leave_one_out"]["L_f_1pc"]["of_95_percent"] < 0.01


def test_predicting_needs_numpy_alone(saved):
    code = (
        "import sys; from subslide.emulator import Emulator;"
        f"Emulator.load({str(saved)!r}).predict(2, 0.4, 1.1);"
        "print([name for name in ('sklearn', 'scipy', 'numba', 'xarray', 'pandas') if name in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


@pytest.mark.parametrize(
    "harm", [lambda t: t[:-20], lambda t: t.replace("subslide emulator 1", "x"), lambda t: "[]"]
)
def test_a_damaged_file_is_told(saved, harm):
    saved.write_text(harm(saved.read_text()))
    with pytest.raises(RecordError, match="no file of an emulator"):
        Emulator.load(saved)


def test_the_file_says_what_it_is(saved):
    told = json.loads(saved.read_text())
    assert told["format"] == model.FORMAT
    assert told["about"]["study"] == "formulas"
    assert told["groups"]["fronts"]["points"]["shape"] == [64, 3]


def test_the_packages_emulator_answers_as_the_solver_does():
    """Nine columns, on grids that err by less than what is asked: L_f within 0.5 %, the peak within 4 %."""
    emulator, shares = Emulator.load(), {"L_f_1pc": [], "x_front_1pc": [], named.PEAK: []}
    for a_H, r, m in inner(24)[:9]:
        column = Point(a_H=a_H, r=r, a_2=0.56, delta=math.degrees(math.atan(0.56 * m)), snapshot_times=())
        fitted = column.with_values(grid="fitted", quantities="grains", cells=192)
        waves = [column.with_values(cells=cells, t_end=5.0001 * column.time_scale) for cells in (400, 800)]
        solved = [growing._values(point) for point in (fitted, *waves)]
        known = emulator.predict(a_H, r, m, times=named.FRONT_NODES[8] / named.front_clock(r, m))
        peak = [max(one[name] for name in named.WINDOWS) for one in solved[1:]]
        shares["L_f_1pc"].append(solved[0]["L_f_1pc"] / known["L_f_1pc"].value[0] - 1)
        shares["x_front_1pc"].append(solved[0]["x_front_1pc@8"] / known["x_front_1pc"].value[0, 0] - 1)
        shares[named.PEAK].append((2 * peak[1] - peak[0]) / known[named.PEAK].value[0] - 1)
    for name, most in {"L_f_1pc": 0.005, "x_front_1pc": 0.005, named.PEAK: 0.04}.items():
        assert np.abs(shares[name]).max() < most, name


def test_the_packages_emulator_is_small_and_knows_the_whole_range():
    emulator = Emulator.load()
    assert model.SHIPPED.stat().st_size < 300_000
    assert set(emulator.quantities) == set(named.QUANTITIES)
    for key, ends in coordinates.RANGE.items():
        assert emulator.range[key] == pytest.approx(ends, rel=1e-6)
