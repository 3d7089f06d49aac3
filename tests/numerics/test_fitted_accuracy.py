"""How near the fitted grid of a few cells is to a fine uniform one, which shares none of its cells."""

import functools

import numpy as np
import pytest

from subslide.keys.names import SCHEMES, lean
from subslide.points import Point
from subslide.solver import solve

SEED = 12
FINE = 1600


@functools.cache
def columns(count):
    """Columns of the range of config/sensitivity.yaml at random."""
    draw = np.random.default_rng(SEED)
    low, high = (0.5, 0.3, 0.0, 20.0), (10.0, 1.5, 0.8, 40.0)
    return tuple(tuple(map(float, draw.uniform(low, high))) for _ in range(count))


@functools.cache
def fronts(column, cells, grid):
    """Final fronts (over R) of one of them."""
    values = dict(zip(("a_H", "a_2", "r", "delta"), column, strict=True))
    run = solve(Point(**values, cells=cells, grid=grid, snapshot_times=()))
    assert run.status == "ok"
    return run.L_f / run.point.radius


def errors(count, cells):
    """Errors (columns, thresholds) of the final fronts."""
    return np.array(
        [fronts(one, cells, "fitted") / fronts(one, FINE, "uniform") - 1 for one in columns(count)]
    )


@pytest.mark.parametrize("count", [6, pytest.param(60, marks=pytest.mark.long)])
def test_48_cells_give_the_final_fronts(count):
    off = np.abs(errors(count, 48))
    assert off[:, 0].max() < 0.015
    assert off.max() < 0.02


def test_errors_fall_with_more_cells():
    coarse, middle, fine = (np.abs(errors(6, cells)[:, 0]).mean() for cells in (24, 48, 110))
    assert fine < middle < coarse


@pytest.mark.parametrize(
    ("values", "most"),
    [
        *(({"scheme": scheme}, 0.03) for scheme in lean(SCHEMES)),
        ({"order": 1}, 0.04),
        ({"scheme": "roe"}, 0.03),
        ({"friction": "voellmy"}, 0.03),
        ({"friction": "pouliquen"}, 0.03),
        ({"a_H": 0.0}, 0.03),
        ({"a_H": 0.05}, 0.03),
        ({"a_H": 100.0}, 0.03),
        ({"r": 0.0, "model": "one-layer"}, 0.02),
        ({"scene": "slab"}, 0.01),
        ({"scene": "slab", "r": 0.0, "model": "one-layer"}, 0.01),
    ],
    ids=str,
)
def test_it_agrees_with_a_uniform_grid_whatever_is_solved(values, most):
    few = solve(Point(**{"grid": "fitted", "cells": 48, "snapshot_times": (), **values}))
    many = solve(Point(**{"cells": FINE, "snapshot_times": (), **values}))
    np.testing.assert_allclose(few.L_f, many.L_f, rtol=most)
    time = 0.5 * many.time_of_arrest[0]
    passed = [np.interp(time, run.time, run.x_front[0]) for run in (few, many)]
    assert passed[0] == pytest.approx(passed[1], rel=most)
