"""What the default numerics promise on the paper's column and around it, against the limit of ever finer grids."""

import functools

import numpy as np
import pytest

from subslide.points import Point
from subslide.solver import solve
from subslide.tables._convergence import estimate

TIMES = (0.08, 0.16, 0.24)
CORNERS = [
    # a_H, a_2, r, delta: the paper's column, and where the front is hardest to follow
    (1.0, 0.56, 0.4, 32.0),
    (10.0, 0.3, 0.8, 40.0),
    (0.5, 0.3, 0.8, 20.0),
    (0.5, 0.3, 0.0, 40.0),
    (2.0, 1.5, 0.4, 25.0),
]


@functools.cache
def measured(point, cells, model="radial", **options):
    """L_f at 1 %, x_front at TIMES (over R) and max|eta| (m) at 0.24 s, of a run with default numerics."""
    a_H, a_2, r, delta = point
    run = solve(Point(a_H=a_H, a_2=a_2, r=r, delta=delta, cells=cells, model=model, **options))
    assert run.status == "ok"
    fronts = [np.interp(time, run.time, run.x_front[0]) for time in TIMES]
    return np.array([*np.array([run.L_f[0], *fronts]) / 0.0705, np.interp(0.24, run.time, run.max_abs_eta)])


def limit(point):
    """Limit of `measured`: Richardson's from 3200 and 6400 cells, with the order of a front, 0.8 or more."""
    middle, fine = measured(point, 3200), measured(point, 6400)
    return fine + (fine - middle) / (2**0.9 - 1)


@pytest.mark.parametrize("point", CORNERS)
def test_800_cells_give_fronts_within_2_percent(point):
    error = measured(point, 800)[:4] / limit(point)[:4] - 1
    assert np.all(np.abs(error) < [0.02, 0.035, 0.02, 0.02])


@pytest.mark.parametrize("point", CORNERS)
def test_3200_cells_give_fronts_within_0_7_percent(point):
    error = measured(point, 3200)[:4] / limit(point)[:4] - 1
    assert np.all(np.abs(error) < [0.007, 0.012, 0.007, 0.007])


@pytest.mark.parametrize("point", [CORNERS[0], CORNERS[4], (1.0, 0.5, 0.2, 35.0)])
def test_800_cells_give_the_wave_at_240_ms_within_5_percent(point):
    assert abs(measured(point, 800)[4] / limit(point)[4] - 1) < 0.05


@pytest.mark.parametrize("point", CORNERS[:4])
def test_the_plane_gives_lengths_within_11_percent_at_200_cells(point):
    bound = 0.07 if point[1] == 0.56 else 0.11
    assert abs(measured(point, 200, model="quarter")[0] / limit(point)[0] - 1) < bound


def test_the_plane_at_400_cells_spreads_alike_along_the_axis_and_the_diagonal():
    run = solve(Point(model="quarter", cells=400))
    assert abs(run.L_f[0] / 0.0705 / limit(CORNERS[0])[0] - 1) < 0.035
    depth = 0.01 * 0.56 * 0.0705
    last = np.flatnonzero(run.h2_diagonal[-1] > depth)[-1]
    h, x = run.h2_diagonal[-1][last : last + 2], np.sqrt(2) * run.x[last : last + 2]
    diagonal = x[0] + (h[0] - depth) / (h[0] - h[1]) * (x[1] - x[0])
    assert abs(diagonal / run.L_f[0] - 1) < 0.02


@pytest.mark.parametrize("cells", [200, 400])
@pytest.mark.parametrize(("threshold", "length"), [(0, 2.21), (1, 1.965)])
def test_the_band_of_weightless_water_holds_its_known_lengths(cells, threshold, length):
    values = [
        solve(Point(r=0.0, delta=30.0, model="radial", cells=n)).L_f[threshold] / 0.0705
        for n in (cells, cells // 2, cells // 4)
    ]
    assert abs(values[0] - length) < estimate(*values, 1.0).band


def test_two_fluxes_at_the_front_and_two_models_have_one_limit():
    """With weightless water: exact and HLL front, one layer and two."""
    found = []
    for options in ({"front_flux": "exact"}, {"front_flux": "hll"}, {"model": "one-layer"}):
        values = [
            solve(Point(**{"r": 0.0, "delta": 30.0, "model": "radial", "cells": n, **options})).L_f[0]
            for n in (3200, 1600)
        ]
        order = 0.9 if options.get("front_flux") == "hll" else np.inf
        found.append(values[0] + (values[0] - values[1]) / (2**order - 1))
    assert np.ptp(found) < 0.001 * np.mean(found)
