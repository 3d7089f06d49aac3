"""Runs on the fitted grid: what no run may break, wherever its cells go, and what is not to depend on them.

120 random points in `make test`; 2,000 with `--long` (`make test-all`). See `test_fitted_grid` for the cells alone.
"""

import math

import numpy as np
import pytest
from hypothesis import strategies as st
from test_range import drive, lane, logarithmic

from subslide.keys import names
from subslide.keys.schema import ConfigError
from subslide.points import Point
from subslide.records import energy
from subslide.solver import loop, solve
from subslide.study import choice
from subslide.study.config import make_point

MOST_GAINED = 0.01
"""Energy that a run in double precision may gain, over what the start can release; the worst of 2,000: 5.4e-4, and of
10,000 nearly without friction (delta 0.5 to 4, a_2 1 to 5) on 10 to 19 cells 0.0035."""

WAVES = ("max_abs_eta", "max_abs_eta_outside", "eta_gauge")
LEAN_SCHEMES = names.lean(names.SCHEMES)

ANY = st.fixed_dictionaries(
    {
        "a_H": st.floats(0.01, 20) | logarithmic(0.01, 1) | st.just(0.0),
        "a_2": logarithmic(0.05, 5),
        "r": st.floats(0, 0.99) | logarithmic(0.01, 1).map(lambda gap: 1 - gap) | st.just(0.0),
        "delta": st.floats(0.5, 60),
        "friction": st.sampled_from(["coulomb", "voellmy", "pouliquen"]),
        "delta_2": st.floats(60.5, 80),
        "scheme": st.sampled_from(LEAN_SCHEMES),
        "order": st.sampled_from([1, 2]),
        "dtype": st.sampled_from(["float64", "float64", "float32"]),
        "cells": st.integers(10, 128),
        "scene": st.sampled_from(["cylinder", "slab", "columns"]),
        "t_end": st.none() | logarithmic(1e-4, 1),
    }
).map(lambda values: Point(grid="fitted", **values))


def fitted(**values):
    """Run on 48 cells that go with its grains."""
    return solve(Point(**{"grid": "fitted", "cells": 48, **values}))


def drift(volume):
    """Largest relative change of a volume, where it was measured."""
    known = volume[np.isfinite(volume)]
    return np.abs(known / known[0] - 1).max()


def gain(run):
    """Largest rise of the energy, over what the start can release."""
    return energy.rise(run.point, run.model, run.box_half_width, {"time": run.time, **run.series})


def ends_well(run):
    """Nothing; a run ended in time or at rest, kept its volumes, its order of cells and its energy.

    Round-off is that of all water on the grid, which may be a thousand times what is counted, that of the paper's box.
    """
    single = run.point.dtype == "float32"
    assert run.status in ("ok", "not_at_rest"), run.status_detail
    assert np.isfinite(run.time).all()
    assert run.h2.min() >= 0
    assert drift(run.sediment_volume) < (3e-5 if single else 1e-13)
    if run.model != "one-layer":
        larger = run.width[0].sum() / run.box_half_width
        whole = max(1.0, larger ** (1 if run.model == "line" else 2))
        assert drift(run.water_volume) < (1e-5 if single else 1e-13) * whole
    assert (run.width > 0).all()
    np.testing.assert_allclose(run.width.sum(axis=1), run.width[0].sum(), rtol=1e-13)
    turn = 2.0 if run.model == "line" else 2 * np.pi * run.x
    there = (turn * run.width * run.h2).sum(axis=1)
    np.testing.assert_allclose(there, run.sediment_volume[0], rtol=3e-5 if single else 1e-12)
    if not single:
        assert not gain(run) > MOST_GAINED  # NaN where there is nothing to release


@lane(120, 2000)
def test_any_column_ends_well(count):
    drive(count, ANY, lambda point: ends_well(solve(point)))


@lane(40, 400)
def test_volumes_are_whole_over_the_range_of_sensitivity(count):
    points = st.fixed_dictionaries(
        {
            "a_H": st.floats(0.5, 10),
            "a_2": st.floats(0.3, 1.5),
            "r": st.floats(0, 0.8),
            "delta": st.floats(20, 40),
        }
    )

    def judge(values):
        run = fitted(**values)
        ends_well(run)
        assert drift(run.water_volume) < 1e-13

    drive(count, points, judge)


@lane(1, 1000)
def test_2000_seeded_columns_end_well(count):
    seed = 12
    draw = np.random.default_rng(seed)
    print(f"seed {seed}")
    for _ in range(2 * count):
        low, high = (0.0, math.log(0.05), 0.0, 0.5), (20.0, math.log(5), 0.99, 60.0)
        a_H, log_a_2, r, delta = map(float, draw.uniform(low, high))
        values = {"a_H": a_H, "a_2": math.exp(log_a_2), "r": r, "delta": delta}
        numerics = {"order": int(draw.integers(1, 3)), "scheme": str(draw.choice(LEAN_SCHEMES))}
        ends_well(fitted(**values, **numerics, cells=int(draw.integers(10, 129))))


@pytest.mark.parametrize("a_H", [0.0, 0.005, 0.02, 0.1, 100.0])
def test_films_and_deep_water_end_well(a_H):
    for r in (0.0, 0.4, 0.8):
        for scheme in LEAN_SCHEMES:
            for order in (1, 2):
                ends_well(fitted(a_H=a_H, r=r, scheme=scheme, order=order))


@pytest.mark.parametrize("scheme", LEAN_SCHEMES)
def test_the_fewest_cells_gain_no_energy_where_grains_run_far(scheme):
    for a_H, r in ((1.0, 0.4), (7.0, 0.97), (14.0, 0.9)):
        ends_well(fitted(a_H=a_H, r=r, a_2=3.0, delta=0.7, scheme=scheme, cells=10))


def test_grains_without_friction_run_on_in_whole_cells():
    run = fitted(delta=0.0, t_end=1.0)
    ends_well(run)
    assert run.L_f[0] > 7 * run.point.radius


@pytest.mark.parametrize("radius", [1e-4, 700.0, 1e6])
@pytest.mark.parametrize("g", [1e-3, 9.81, 1000.0])
def test_scaled_answers_know_neither_size_nor_gravity(radius, g):
    one, other = fitted(snapshot_times=()), fitted(snapshot_times=(), radius=radius, g=g)
    R = one.point.radius
    for name in ("L_f", "x_front", "h2", "x", "width"):
        np.testing.assert_allclose(
            getattr(other, name) / radius, getattr(one, name) / R, rtol=1e-8, atol=1e-11
        )
    np.testing.assert_allclose(
        other.time / other.point.time_scale, one.time / one.point.time_scale, rtol=1e-8
    )


def test_at_r_0_the_grains_do_not_feel_the_water():
    alone, shallow, deep = (
        fitted(r=0.0, **values) for values in ({"model": "one-layer"}, {"a_H": 1.0}, {"a_H": 10.0})
    )
    for run in (alone, deep):
        np.testing.assert_allclose(run.L_f, shallow.L_f, rtol=0.005)
        np.testing.assert_allclose(run.h2[-1], shallow.h2[-1], atol=0.02 * run.point.column_height)


def test_waves_are_missing_and_not_wrong():
    run = fitted()
    for name in WAVES:
        assert np.isnan(getattr(run, name)).all()
    assert np.isnan(run.eta).all()
    assert math.isnan(run.wave_free_until)
    assert math.isnan(run.dx)
    for name in ("energy", "sediment_volume", "water_volume"):
        assert np.isfinite(getattr(run, name)[[0, -1]]).all()


def test_snapshots_have_the_cells_of_their_time():
    times = (0.0, 0.0301, 0.11, 0.2)
    run = fitted(snapshot_times=times, t_end=0.25)
    np.testing.assert_array_equal(run.snapshot_time, (*times, 0.25))
    for n, time in enumerate(times[1:], 1):
        alone = fitted(snapshot_times=(), t_end=time)
        np.testing.assert_allclose(run.width[n], alone.width[-1], rtol=1e-12)
        np.testing.assert_allclose(run.x[n], alone.x[-1], rtol=1e-12)
        np.testing.assert_allclose(run.h2[n], alone.h2[-1], atol=0.02 * run.point.column_height)


def same(one, other):
    """Hold every number of two runs to the bit, and what is missing too."""
    for name in (*one.series, "time", "snapshot_time", "x", "width", "h2", "L_f", "time_of_arrest"):
        np.testing.assert_array_equal(getattr(one, name), getattr(other, name), name)
    assert (one.status, one.steps) == (other.status, other.steps)


@pytest.mark.parametrize("values", [{}, {"r": 0.0, "model": "one-layer"}, {"scene": "slab"}])
def test_no_bit_knows_how_launches_were_cut_nor_of_threads(monkeypatch, values):
    whole = fitted(**values)
    same(whole, solve(whole.point, threads=2))
    for size in (2, 7, 64):
        monkeypatch.setattr(loop, "CHUNK", size)
        monkeypatch.setattr(loop, "FEWEST", size)
        same(whole, fitted(**values))


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ({"boundary": "wall"}, "the boundary is wall, not open"),
        ({"boundary": "paper"}, "the boundary is paper, not open"),
        ({"boundary": "periodic", "model": "line", "scene": "slab"}, "the boundary is periodic, not open"),
        ({"as_printed": "friction"}, "a formula is taken as printed"),
        ({"model": "quarter"}, "the model is of the plane"),
        ({"model": "plane"}, "the model is of the plane"),
        ({"scene": "pile"}, "the scene is not one column about the axis"),
        ({"scene": "ellipse"}, "the scene is not one column about the axis"),
        ({"scene": "columns", "scene_options": {"count": 2}}, "the scene is not one column about the axis"),
        ({"scene": "columns", "scene_options": {"x": 1.0}}, "the scene is not one column about the axis"),
    ],
)
def test_what_it_does_not_fit_is_refused_in_one_line_and_auto_falls_back(values, words):
    with pytest.raises(ConfigError) as refused:
        make_point({"grid": "fitted", **values})
    assert str(refused.value) == f"grid: fitted is not allowed where {words}; allowed: uniform, or auto"
    chosen = choice.of(make_point({"grid": "auto", "quantities": "grains", **values}))
    assert (chosen.grid, chosen.grid_reason) == ("uniform", f"auto: {words}")


def test_auto_takes_it_where_grains_alone_are_asked_for():
    chosen = [choice.of(make_point({"grid": "auto", "quantities": asked})) for asked in ("grains", "all")]
    assert [one.grid for one in chosen] == ["fitted", "uniform"]
    assert chosen[1].grid_reason == "auto: more than grains asked for"
    run = solve(make_point({"grid": "auto", "quantities": "grains", "cells": 48}))
    assert (run.grid, run.grid_reason) == ("fitted", chosen[0].grid_reason)
