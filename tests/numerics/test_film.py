"""Columns that a film of water covers, or that stand out of it: runs end well, and none gains energy.

A seeded sample of 24 columns in `make test`; 1,000 with `--long` (`make test-all`).
"""

import numpy as np
import pytest
from states import advance, axial, inner, plane

from subslide.keys.names import SCHEMES
from subslide.records import energy
from subslide.solver import solve
from subslide.study.config import make_point

MOST = 0.01
"""Energy that a run may gain, over what the start can release."""


def columns(count):
    """Columns of the sample, four in five of them on a radius."""
    draw = np.random.default_rng(2026)
    for _ in range(count):
        film = draw.choice([0.0, 0.2 * draw.random() ** 2, 0.2 * draw.random()], p=[0.15, 0.4, 0.45])
        values = {
            "a_H": float(film),
            "r": float(draw.choice([0.0, draw.uniform(0, 0.9)], p=[0.1, 0.9])),
            "delta": float(draw.uniform(10, 60)),
            "a_2": float(draw.uniform(0.3, 1.5)),
            "scheme": str(draw.choice(list(SCHEMES))),
            "order": int(draw.integers(1, 3)),
            "boundary": str(draw.choice(["wall", "open"])),
        }
        quarter = draw.random() < 0.2
        half = int(draw.integers(20, 51) if quarter else draw.integers(50, 201))
        yield make_point(values | {"model": "quarter" if quarter else "radial", "cells": 2 * half})


def gain(run):
    """Largest rise of the energy, over what can be released, less that of the water that came in at the level."""
    point = run.point
    brought = point.r * point.g * point.level * (run.water_volume - run.water_volume[0])
    series = {"time": run.time, **run.series, "energy": run.energy - brought}
    return energy.rise(point, run.model, run.box_half_width, series)


@pytest.mark.parametrize("count", [24, pytest.param(1000, marks=pytest.mark.long)])
def test_films_end_well_and_gain_no_energy(count):
    for point in columns(count):
        run = solve(point)
        assert run.status in ("ok", "not_at_rest", "left_domain"), (run.status, point)
        assert gain(run) <= MOST, (gain(run), point)


@pytest.mark.parametrize("order", [1, 2])
@pytest.mark.parametrize("scheme", SCHEMES)
@pytest.mark.parametrize("radial", [False, True])
def test_a_pile_that_stands_out_of_still_water_keeps_still(scheme, order, radial):
    """To the bit; at second order the cell at the shore has a slope, and its water swings by a part of its depth."""
    edges = np.arange(61) * 0.05
    h2 = np.maximum(1.0 - 0.02 * np.arange(60), 0.1)
    h1 = np.maximum(0.0, 0.7 - h2)
    model = axial(edges, h1, 0, h2, 0, level=0.7, m=1.0, r=0.4, scheme=scheme, order=order, radial=radial)
    advance(model, steps=200)
    np.testing.assert_array_equal(inner(model, "h2"), h2)
    np.testing.assert_allclose(inner(model, "h1"), h1, rtol=0, atol=0 if order == 1 else 0.005)


@pytest.mark.parametrize("order", [1, 2])
def test_such_a_pile_is_bit_still_in_the_plane(order):
    edges = np.arange(31) * 0.1
    x = (edges[1:] + edges[:-1]) / 2
    h2 = np.maximum(1.0 - 0.4 * (x[:, None] + x), 0.1)
    h1 = np.maximum(0.0, 0.7 - h2)
    model = plane(edges, h1, h2, level=0.7, m=1.0, r=0.4, order=order)
    advance(model, steps=100)
    np.testing.assert_array_equal(inner(model, "h2"), h2)
    np.testing.assert_array_equal(inner(model, "h1"), h1)
