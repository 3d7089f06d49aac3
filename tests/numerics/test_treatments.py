"""What is done where wave speeds are complex: each treatment does what it says, and nothing where they are real."""

import dataclasses

import numpy as np
import pytest
from states import advance, axial, inner, plane

from subslide.exact.shear import growth_rate
from subslide.kernels import samples as columns
from subslide.kernels.hyperbolicity import FLAGS as TREATMENTS
from subslide.kernels.hyperbolicity import is_complex
from subslide.scenes.shear import base, critical_shear
from subslide.solver import solve
from subslide.study import config

R = 0.8
EDGES = np.arange(41) * 0.05


def sheared(part, treatment, **keys):
    """Run of the scene `shear`, second order, over two times in which its wave grows by e (or at 1.5 would)."""
    options = {"shear": part, "amplitude": 1e-3}
    values = {"scene": "shear", "scene_options": options, "boundary": "periodic", "delta": 0, "r": R, **keys}
    point = config.make_point({**values, "treatment": treatment})
    at = point if part > 1 else dataclasses.replace(point, scene_options=(("shear", 1.5),))
    return solve(dataclasses.replace(point, t_end=2 / growth_rate(at)))


@pytest.mark.parametrize("scheme", ["ifcph", "ifcp"])
@pytest.mark.parametrize("part", [1.5, 2.0])
def test_real_parts_and_hll_grow_where_friction_does_not(part, scheme):
    """Surfaces a third of a layer high and more, bounded as layers that part take HLL, against a thousandth of one."""
    runs = {name: sheared(part, name, cells=400, scheme=scheme) for name in ("real", "hll", "friction")}
    assert runs["hll"].status == runs["friction"].status == "ok"
    highest = {name: run.max_abs_eta.max() / (0.56 * 0.0705) for name, run in runs.items()}
    assert 0.33 < highest["real"] < 1
    assert highest["hll"] < 0.85
    assert highest["friction"] < 1e-3
    assert runs["hll"].nonhyperbolic_cells.max() == 400
    for run in runs.values():
        for volume in (run.sediment_volume, run.water_volume):
            assert np.abs(volume / volume[0] - 1).max() < 1e-12


@pytest.mark.parametrize("scheme", ["ifcph", "roe"])
def test_below_the_limit_no_treatment_changes_a_bit(scheme):
    runs = [sheared(0.95, name, scheme=scheme, cells=100) for name in ("hll", "friction", "stop")]
    real = sheared(0.95, "real", scheme=scheme, cells=100)
    assert not real.nonhyperbolic_cells.any()
    if scheme == "ifcph":  # whose lean kernels iterate wave speeds less often
        np.testing.assert_allclose(runs[0].h2, real.h2, rtol=1e-8)
        real = runs[0]
    for run in runs:
        assert np.array_equal(run.h2, real.h2)


def test_hll_has_its_own_answer_in_a_run_of_hll():
    """Where every edge is complex the treatment is the scheme HLL."""
    one, other = (sheared(1.5, treatment, scheme=scheme, cells=50, order=1)
                  for treatment, scheme in (("hll", "ifcp"), ("stop", "hll")))  # fmt: skip
    assert other.status == "hyperbolicity_lost"
    np.testing.assert_allclose(
        one.h2[-1], sheared(1.5, "real", scheme="hll", cells=50, order=1).h2[-1], rtol=1e-9
    )


def worst(model):
    """Whether any cell's speeds are complex along its shear."""
    h1, h2 = inner(model, "h1").ravel(), inner(model, "h2").ravel()
    square = sum((inner(model, a) - inner(model, b)).ravel() ** 2 for a, b in (("u1", "u2"), ("v1", "v2")))
    wet = np.minimum(h1, h2) > 1e-6
    return any(is_complex(a, b, c, R) for a, b, c in zip(h1[wet], h2[wet], square[wet], strict=True))


def momentum(model):
    """Momentum of both layers in each cell, along x and along y."""
    h1, h2 = inner(model, "h1"), inner(model, "h2")
    return np.array(
        [R * h1 * inner(model, a) + h2 * inner(model, b) for a, b in (("u1", "u2"), ("v1", "v2"))]
    )


RUB = {"treatment": TREATMENTS["friction"], "r": R, "m": 0.0, "walls": (2, 2), "level": 2.0}


@pytest.mark.parametrize("part", [0.9, 1.0001, 1.5, 2.5])
def test_friction_brings_uniform_layers_to_the_boundary_and_no_further(part):
    critical = critical_shear(0.7, 1.3, R)
    model = axial(EDGES, 0.7, 0.2 + part * critical, 1.3, 0.2, **RUB)
    before = momentum(model)
    advance(model, steps=1)
    np.testing.assert_allclose(inner(model, "u1") - inner(model, "u2"), min(part, 1) * critical, rtol=1e-12)
    np.testing.assert_allclose(momentum(model), before, rtol=1e-14)
    assert np.all(inner(model, "h1") == 0.7)
    assert not worst(model)


@pytest.mark.parametrize("order", [1, 2])
def test_friction_keeps_rough_flows_hyperbolic_and_their_volumes_and_momentum(order):
    rng = np.random.default_rng(5)
    h1, h2 = rng.uniform(0.2, 1.5, (2, 40))
    u1, u2 = rng.uniform(-0.8, 0.8, (2, 40))
    model = axial(EDGES, h1, u1, h2, u2, order=order, **RUB)
    assert worst(model)
    before = momentum(model).sum(axis=1)
    energies = []
    for _ in range(40):
        samples, _ = advance(model, steps=1)
        energies.append(samples[0, columns.ENERGY])
        assert not worst(model)
    np.testing.assert_allclose(momentum(model).sum(axis=1), before, atol=1e-13)
    np.testing.assert_allclose(inner(model, "h1").sum(), h1.sum(), rtol=1e-14)
    np.testing.assert_allclose(inner(model, "h2").sum(), h2.sum(), rtol=1e-14)
    assert np.diff(energies).max() < 0


def test_friction_in_the_plane_shortens_the_shear_and_does_not_turn_it():
    critical = critical_shear(1.0, 1.0, R)
    options = {**RUB, "walls": (2,) * 4, "u1": 1.2 * critical, "v1": 0.1 - 0.9 * critical, "v2": 0.1}
    model = plane(EDGES[:11], 1.0, 1.0, **options)
    before = momentum(model)
    advance(model, steps=1)
    np.testing.assert_allclose(inner(model, "u1") - inner(model, "u2"), 0.8 * critical, rtol=1e-12)
    np.testing.assert_allclose(inner(model, "v1") - inner(model, "v2"), -0.6 * critical, rtol=1e-12)
    np.testing.assert_allclose(momentum(model), before, rtol=1e-13, atol=1e-15)
    assert not worst(model)


def told(run, name):
    """Value of one variable of the state in a run's status_detail."""
    return float(run.status_detail.split(f"{name} = ")[1].split(",")[0])


COLUMN = {"a_H": 0.03, "a_2": 10, "r": 0.8, "delta": 70, "cells": 100}


def test_friction_lets_a_column_collapse_without_a_complex_cell():
    real, friction = (
        solve(config.make_point({**COLUMN, "treatment": name})) for name in ("real", "friction")
    )
    assert real.nonhyperbolic_cells.max() > 0
    assert not friction.nonhyperbolic_cells.any()
    assert friction.status == "ok"
    assert friction.L_f[0] == pytest.approx(real.L_f[0], rel=0.01)


@pytest.mark.parametrize("keys", [{}, {"model": "quarter", "cells": 60}])
def test_stop_ends_the_run_with_time_step_cell_and_state(keys):
    run = solve(config.make_point({**COLUMN, **keys, "treatment": "stop"}))
    assert run.status == "hyperbolicity_lost"
    assert run.steps > 0
    assert run.nonhyperbolic_cells[-1] > 0
    assert not run.nonhyperbolic_cells[:-1].any()
    assert np.isnan(run.L_f).all()
    for part in (f"t = {run.time[-1]:.6g} s", f"step {run.steps}, cell ", "scaled h1 = ", "u2 = "):
        assert part in run.status_detail
    shear = (told(run, "u1") - told(run, "u2"), told(run, "v1") - told(run, "v2") if keys else 0.0)
    assert is_complex(told(run, "h1"), told(run, "h2"), shear[0] ** 2 + shear[1] ** 2, 0.8)


def test_a_start_beyond_the_limit_stops_at_once():
    run = sheared(1.2, "stop")
    assert (run.status, run.steps) == ("hyperbolicity_lost", 0)
    for name, value in zip(("h1", "u1", "h2", "u2"), base(run.point), strict=True):
        assert told(run, name) == pytest.approx(value, abs=2e-3)
