"""The open sea: no bit of an answer knows how long it is, and in the plane waves leave it; the paper's edge, until when
no wave has been there, and that the surface is the wide box's till then."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from states import axial, inner

from subslide.kernels import clock as k
from subslide.models import axial as axial_model
from subslide.points import PAPER_BOX, Point
from subslide.solver import attempt, solve
from subslide.solver.loop import Samples, advance_to

RADIUS = {
    "lean": {"a_H": 1.0, "cells": 100},
    "order 1": {"a_H": 10.0, "order": 1, "cells": 101},
    "far": {"a_2": 1.5, "delta": 20.0, "r": 0.8, "cells": 60},
    "out": {"delta": 0.0, "cells": 40},
    "single": {"a_H": 5.0, "dtype": "float32", "cells": 80},
    "roe": {"a_H": 3.0, "scheme": "roe", "cells": 40},
    "alone": {"r": 0.0, "model": "one-layer", "a_2": 1.5, "delta": 20.0, "cells": 60},
    "foot": {"scene": "pile", "delta": 5.0, "scene_options": (("steepness", 1.5),), "cells": 40},
}


def assert_same(one, other):
    """Hold every number of two runs to the bit."""
    for name in (*one.series, "time", "snapshot_time", "x", "h2", "eta", "L_f"):
        np.testing.assert_array_equal(getattr(one, name), getattr(other, name), name)
    for name in ("status", "steps", "time_at_rest", "box_half_width", "wave_free_until"):
        np.testing.assert_equal(getattr(one, name), getattr(other, name), name)


@pytest.mark.parametrize("name", RADIUS)
def test_no_bit_knows_how_long_the_sea_was_at_the_start(name):
    point = Point(**{"model": "radial", **RADIUS[name]})
    short = attempt(point, point.half_cells, None)
    assert_same(short, attempt(point, 16 * point.half_cells, None))
    assert_same(short, solve(point))
    assert short.status == ("left_domain" if name == "out" else "ok")


@given(a_H=st.floats(0.2, 10), a_2=st.floats(0.3, 1.5), r=st.floats(0, 0.8), cells=st.integers(20, 120))
@settings(max_examples=10, deadline=None)
def test_nor_at_any_point(a_H, a_2, r, cells):
    point = Point(model="radial", a_H=a_H, a_2=a_2, r=r, cells=cells, t_end=0.54)
    assert_same(attempt(point, point.half_cells, None), attempt(point, 7 * point.half_cells + 3, None))


@pytest.mark.parametrize("order", [1, 2])
def test_a_line_is_lengthened_at_both_ends_to_the_same_bits(order):
    dx, n = 0.125, 16

    def sea(half):
        edges = np.arange(-half, half + 1) * dx
        h2 = np.where(np.abs(edges[:-1] + 0.25) < 0.6, 0.8, 0.0)
        model = axial(edges, 2.0 - h2, 0.0, h2, 0.0, level=2.0, walls=(0, 0), order=order)
        outcome, _ = advance_to(model, k.started(3.0), Samples(), lambda now: None)
        return model, outcome

    (short, outcome), (long, _) = sea(n), sea(16 * n)
    assert outcome == k.REACHED
    assert len(short.x) > 4 * n
    assert short.free_until == math.inf
    away = (len(long.x) - len(short.x)) // 2
    for name in ("h1", "u1", "h2", "u2"):
        np.testing.assert_array_equal(inner(short, name), inner(long, name)[away:-away])


def test_the_sea_keeps_its_volumes_and_gains_no_energy():
    run = solve(Point(model="radial", a_H=10.0, cells=101, t_end=0.54))
    for volume in (run.water_volume, run.sediment_volume):
        np.testing.assert_allclose(volume, volume[0], rtol=1e-13)
    assert np.diff(run.energy).max() < 1e-12 * run.energy[0]
    width = run.box_half_width
    assert width == pytest.approx(51 * run.dx)
    whole = run.water_volume[0] + run.sediment_volume[0]
    assert whole == pytest.approx(math.pi * width**2 * run.point.level)


def test_a_sea_at_its_cap_has_an_end_and_says_since_when(monkeypatch):
    monkeypatch.setattr(axial_model, "MOST_CELLS", 150)
    point = Point(model="radial", a_H=10.0, cells=100, t_end=0.54)
    run = attempt(point, point.half_cells, None)
    right = attempt(point, 16 * point.half_cells, None)
    assert 0.1 < run.wave_free_until < 0.4
    assert run.status == "ok"
    off = np.abs(run.max_abs_eta_outside - right.max_abs_eta_outside)
    assert off[run.time <= run.wave_free_until].max() == 0
    assert off.max() > 0


def test_profiles_reach_the_end_of_the_papers_box_or_of_the_grains():
    near, far = (solve(Point(model="radial", cells=60, a_2=a_2, delta=20.0, r=0.8)) for a_2 in (0.5, 1.5))
    assert near.x[-1] + near.dx / 2 == pytest.approx(PAPER_BOX * near.point.radius)
    assert far.x[-1] > far.L_f[0] > near.x[-1]
    assert far.h2.shape == far.eta.shape == (len(far.snapshot_time), len(far.x))


SHOWN = (
    {"a_H": 0.73, "a_2": 0.9, "r": 0.48, "delta": 20.6, "cells": 101},
    {"a_H": 3.22, "a_2": 0.74, "r": 0.41, "delta": 33.3, "cells": 120},
    {"a_H": 9.5, "a_2": 0.9, "r": 0.1, "delta": 39.0, "cells": 111},
)


def reflected(boundary, *, widened=3, **values):
    """Return how far max|eta| beyond R is off a wider box's at most, over its largest after 20 ms; by `solve`'s box."""
    point = Point(model="quarter", t_end=0.54, snapshot_times=(), boundary=boundary, **values)
    run = solve(point)
    box = round(run.box_half_width / run.dx)
    wide = attempt(point.with_values(boundary="open"), widened * box, None)
    assert run.status == wide.status == "ok"
    off = np.interp(wide.time, run.time, run.max_abs_eta_outside) - wide.max_abs_eta_outside
    return np.abs(off).max() / wide.max_abs_eta_outside[wide.time > 0.02].max()


@pytest.mark.parametrize("values", SHOWN)
def test_waves_leave_the_plane(values):
    assert reflected("open", **values) < 0.01
    assert reflected("paper", **values) > 0.08


@pytest.mark.long
def test_waves_leave_the_plane_at_sixty_points():
    rng = np.random.default_rng(60)
    for _ in range(60):
        low, high = (0.5, 0.3, 0.0, 20.0), (10.0, 1.5, 0.8, 40.0)
        values = dict(zip(("a_H", "a_2", "r", "delta"), map(float, rng.uniform(low, high)), strict=True))
        cells = int(rng.integers(100, 201))
        assert reflected("open", cells=cells, **values) < 0.015, (values, cells)


@pytest.mark.parametrize("model", ["radial", "quarter", "plane"])
@pytest.mark.parametrize("cells", [60, 61])
def test_the_surface_is_watched_to_the_papers_box_on_every_grid(model, cells):
    """A wave that is watched to the end of the box, by profiles in a box that is wider."""
    times = tuple(np.arange(1, 20) * 0.01 + 0.1)
    point = Point(
        model=model, cells=cells, a_H=5.0, t_end=0.3, snapshot_times=times, fields=model != "radial"
    )
    wide = attempt(point, 2 * point.half_cells, None)
    end = PAPER_BOX * point.radius
    x = wide.x if model == "radial" else (np.arange(len(wide.eta_field[0])) + 0.5) * wide.dx
    if model == "plane":
        x = x - len(x) / 2 * wide.dx
    if model == "radial":  # whose profiles end with the box
        wide = attempt(point.with_values(boundary="wall"), 4 * point.half_cells, None)
        x = wide.x
    for n, time in enumerate(times):
        last = int(np.searchsorted(x, end * (1 + 1e-9)))  # first cell beyond
        seen = np.abs(x) <= end * (1 + 1e-9)
        if model == "radial":
            right = np.abs(wide.eta[n][seen]).max()
            if cells % 2 == 0:
                right = max(right, abs(wide.eta[n][last - 1 : last + 1].mean()))
        else:
            field = wide.eta_field[n].astype(float)
            right = np.abs(field[np.ix_(seen, seen)]).max()
            if cells % 2 == 0:
                rows = field[last - 1 : last + 1].mean(axis=0)
                right = max(right, np.abs(rows[seen]).max())
        measured = wide.max_abs_eta[np.argmin(np.abs(wide.time - time))]
        assert measured == pytest.approx(right, rel=1e-6)


def compared(cells, **values):
    """Run in the paper's box, and how far its surface is off that of an open sea, by snapshot."""
    times = tuple(np.arange(1, 28) * 0.02)
    point = Point(cells=cells, model="radial", t_end=0.54, snapshot_times=times, **values)
    box, wide = solve(point.with_values(boundary="paper")), solve(point)
    right = wide.eta[:, : len(box.x)]
    return box, np.abs(box.eta - right).max(axis=1) / np.abs(right).max(axis=1)


@pytest.mark.parametrize("order", [1, 2])
@pytest.mark.parametrize(("a_H", "r"), [(0.2, 0.2), (1.0, 0.8), (2.0, 0.4), (10.0, 0.4)])
@pytest.mark.parametrize("cells", [100, 200])
def test_the_surface_is_right_until_the_first_wave_may_be_at_the_edge(a_H, r, order, cells):
    box, off = compared(cells, a_H=a_H, r=r, order=order)
    free = box.snapshot_time <= box.wave_free_until
    assert free.sum() >= 3
    assert off[free].max() < 0.003


def test_later_the_edge_may_rule_the_surface():
    box, off = compared(100, a_H=10.0)
    assert box.wave_free_until < 0.112
    assert off[-1] > 1


def free_until(box=None, **values):
    """Return until when a run is free of waves from an edge, in the paper's box or in one of some cells."""
    point = Point(**{"boundary": "paper", **values})
    return (attempt(point, box, None) if box else solve(point)).wave_free_until


def test_it_is_near_the_time_of_a_wave_of_no_height():
    point = Point(a_H=10.0, cells=400, t_end=0.12)
    still = (point.half_box - 1) * point.radius / point.wave_speed
    assert 0.96 * still < free_until(a_H=10.0, cells=400, t_end=0.12) < still


def test_a_run_that_ends_before_says_when_it_would_be():
    long, short = (free_until(a_H=10.0, cells=200, t_end=end) for end in (0.12, 0.02))
    assert short == pytest.approx(long, rel=0.01)


def test_a_box_that_grew_is_free_for_longer_and_a_column_aside_for_less():
    middle = free_until(cells=60, t_end=0.05)
    grown = free_until(45, cells=60, t_end=0.05)
    aside = free_until(cells=60, t_end=0.05, scene="columns", scene_options=(("y", 1.5),))
    assert aside < middle < grown
    assert free_until(cells=60, t_end=0.05, model="quarter", boundary="open") == pytest.approx(
        middle, rel=0.01
    )


@pytest.mark.parametrize(
    "values",
    [
        {"boundary": "wall"},
        {"r": 0.0, "model": "one-layer"},
        {"scene": "shear", "model": "line", "boundary": "periodic", "delta": 0.0},
    ],
)
def test_without_an_open_edge_or_water_there_is_no_such_time(values):
    assert math.isnan(solve(Point(cells=20, t_end=0.02, **values)).wave_free_until)
