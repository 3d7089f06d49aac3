"""Kernels as plain Python: every model, order and kind of kernels takes some steps within its arrays."""

import numpy as np
import pytest

from subslide.points import from_dict
from subslide.solver import solve
from subslide.study import choice

ROUND = {"cells": 60, "t_end": 0.15, "snapshot_times": [0.05]}
"""A column of seven cells a radius, until its grains have run over as many more."""

GENERAL = {"scheme": "roe", "friction": "pouliquen", "treatment": "friction"}
"""Choices that only general kernels have."""

MODELS = {
    "radial": {"model": "radial"},
    "one-layer": {"model": "one-layer", "r": 0},
    "quarter": {"model": "quarter", "cells": 24, "fields": True},
    "plane": {"model": "plane", "cells": 20, "fields": True},
    "line": {"model": "line", "scene": "dam_break", "boundary": "wall", "scene_options": {"downstream": 0.2}},
}


def run_of(**values):
    """Return the run of a column, solved without the compiler."""
    return solve(from_dict({**ROUND, **values}))


def change(series):
    """Return the largest relative change of a series."""
    return np.max(np.abs(series / series[0] - 1))


def assert_sound(run):
    """Hold a run to what holds for any: it ends well, no depth is negative, and volumes stay."""
    assert run.status == "ok"
    assert run.steps > 3
    assert (run.h2 >= 0).all()
    assert change(run.sediment_volume) < 1e-12
    if run.model != "one-layer":
        assert (run.h2 - run.eta <= run.point.level * (1 + 1e-12)).all()  # h1 is not negative
        assert change(run.water_volume) < 1e-12


def test_the_compiler_is_off():
    from subslide.kernels.viscosity import alpha

    assert not hasattr(alpha, "py_func")


@pytest.mark.parametrize("general", [False, True], ids=["lean", "general"])
@pytest.mark.parametrize("order", [1, 2])
@pytest.mark.parametrize("model", MODELS)
def test_a_run_stays_within_its_arrays(model, order, general):
    run = run_of(**{"boundary": "wall", "order": order, **MODELS[model], **(GENERAL if general else {})})
    assert choice.of(run.point).general is general
    assert_sound(run)
    if run.h2_field is not None:
        assert_symmetric(run)


def assert_symmetric(run):
    """Hold the fields of a run in the plane to the mirrors of its round column, to the bit."""
    for field in (run.h2_field, run.eta_field):
        assert np.array_equal(field, field.swapaxes(1, 2))
        if run.model == "plane":
            assert np.array_equal(field, field[:, ::-1])
            assert np.array_equal(field, field[:, :, ::-1])


@pytest.mark.parametrize("scheme", ["rusanov", "hll", "ifcp", "ifcph"])
def test_every_lean_solver(scheme):
    assert_sound(run_of(model="radial", boundary="wall", scheme=scheme))


@pytest.mark.parametrize(
    "values",
    [
        {"treatment": "hll"},
        {"friction": "voellmy"},
        {"as_printed": "friction"},
        {"wave_speeds": "approximate"},
        {"friction_in_viscosity": False},
    ],
    ids=str,
)
def test_every_other_choice_of_general_kernels(values):
    assert_sound(run_of(model="radial", boundary="wall", **values))


@pytest.mark.parametrize("dtype", ["float64", "float32"])
def test_an_open_sea_keeps_the_grains_and_the_water(dtype):
    run = run_of(model="radial", boundary="open", dtype=dtype)
    eps = np.finfo(dtype).eps
    assert run.status == "ok"
    assert change(run.sediment_volume) < 100 * eps
    assert change(run.water_volume) < 100 * eps


def test_the_papers_box_keeps_the_grains_and_most_of_the_water():
    run = run_of(model="radial", boundary="paper", a_H=10, cells=30)
    assert run.status == "ok"
    assert change(run.sediment_volume) < 1e-13
    assert 1e-13 < change(run.water_volume) < 0.05


@pytest.mark.parametrize("model", ["quarter", "plane"])
def test_an_open_edge_of_the_plane_keeps_the_grains_and_most_of_the_water(model):
    run = run_of(model=model, boundary="open", a_H=10, cells=16)
    assert run.status == "ok"
    assert change(run.sediment_volume) < 1e-4  # of so few cells the thinnest film gets to the edge
    assert 1e-13 < change(run.water_volume) < 0.05


@pytest.mark.parametrize("general", [False, True], ids=["lean", "general"])
@pytest.mark.parametrize("order", [1, 2])
@pytest.mark.parametrize(
    "values",
    [{}, {"model": "one-layer", "r": 0}, {"scene": "slab"}, {"a_H": 0}, {"dtype": "float32"}],
    ids=str,
)
def test_cells_that_go_with_the_grains_stay_within_their_arrays(values, order, general):
    values = {"grid": "fitted", "cells": 16, **values, "order": order, **(GENERAL if general else {})}
    run = run_of(**values)
    eps = np.finfo(run.point.dtype).eps
    assert run.status == "ok"
    assert (run.h2 >= 0).all()
    assert (run.width > 0).all()
    for volume in (run.sediment_volume, run.water_volume)[: 1 if run.model == "one-layer" else 2]:
        assert change(volume[np.isfinite(volume)]) < 1000 * eps


def test_a_periodic_line_has_no_end():
    run = run_of(model="line", scene="shear", boundary="periodic", t_end=0.03)
    assert run.status == "ok"
    assert change(run.sediment_volume) < 1e-12
    assert change(run.water_volume) < 1e-12


def test_a_pile_under_still_water_changes_no_bit():
    run = run_of(model="radial", scene="pile", boundary="wall")
    assert np.array_equal(run.h2[0], run.h2[-1])
    assert run.max_abs_eta.max() == 0
