"""Cells at rest are left alone, and cells without grains solved as water alone: both to the same bits."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from states import settings

from subslide.kernels import samples as columns
from subslide.kernels.active import FIRST, LAST, WET_FIRST, WET_LAST
from subslide.kernels.arrays import Cells, CellTerms, Side, Track, allocate
from subslide.kernels.axial_faces import faces, water_faces
from subslide.kernels.clock import started
from subslide.kernels.edge.roe_matrix import Normal
from subslide.kernels.edge.two_layers import edge_fluxes
from subslide.kernels.edge.water import water_edge_fluxes
from subslide.kernels.waves import outer_bounds, outer_speeds, water_speeds
from subslide.models.build import build
from subslide.points import Point
from subslide.solver import DRY_DEPTH
from subslide.solver.loop import thresholds

DEPTHS = st.floats(0.0, 3.0) | st.sampled_from([0.0, 1e-9, 1.0])
SPEEDS = st.floats(-2.0, 2.0)


def advanced(model, order, dtype, *, everywhere=False, **values):
    """Return a model of a column after 40 steps; `everywhere`: nothing counts as still."""
    boundary = (
        "open" if model in ("quarter", "plane") else "paper"
    )  # a sea where nothing is still has no room
    point = Point(model=model, order=order, dtype=dtype, cells=100, boundary=boundary, **values)
    found = build(point, 50, DRY_DEPTH)
    if everywhere:
        real = type(found.settings.r)
        found.watch = found.watch._replace(still1=real(-1), still2=real(-1))
    clock = started(math.inf)
    track = Track(clock, np.zeros((41, columns.COLUMNS)), np.zeros(2, np.int64))
    found.advance(thresholds(found), track)
    return found, track.samples


@pytest.mark.parametrize("order", [1, 2])
@pytest.mark.parametrize(
    ("model", "dtype"),
    [
        ("radial", "float64"),
        ("radial", "float32"),
        ("one-layer", "float64"),
        ("plane", "float64"),
        ("quarter", "float64"),
    ],
)
def test_leaving_alone_what_is_at_rest_changes_no_bit(model, dtype, order):
    values = {"r": 0.0} if model == "one-layer" else {}
    short, fewer = advanced(model, order, dtype, **values)
    whole, samples = advanced(model, order, dtype, everywhere=True, **values)
    for name in ("h1", "u1", "v1", "h2", "u2", "v2", "eta"):
        assert np.array_equal(getattr(short.cells, name), getattr(whole.cells, name)), name
    fronts = range(columns.FRONT, columns.FRONT + columns.FRONTS)
    exact = [columns.TIME, *fronts, columns.ETA, columns.ETA_OUTSIDE, columns.COMPLEX]
    assert np.array_equal(fewer[:, exact], samples[:, exact])
    eps = np.finfo(dtype).eps
    assert np.allclose(fewer, samples, rtol=100 * eps, atol=0)


def test_a_column_leaves_most_of_the_box_alone():
    plane, _ = advanced("quarter", 1, "float64")
    rows = plane.spans[2:-2]
    worked = np.maximum(0, rows[:, LAST] - rows[:, FIRST]).sum()
    wet = np.maximum(0, rows[:, WET_LAST] - rows[:, WET_FIRST]).sum()
    cells = rows.shape[0] ** 2
    moved = (plane.cells.u1[2:-2, 2:-2] != 0).sum()
    assert moved <= worked < 0.9 * cells  # 40 steps reach 40 of 50 cells at most
    assert (plane.cells.h2 > 0).sum() <= wet < 0.5 * cells


@given(DEPTHS, SPEEDS, st.floats(0.0, 0.99))
def test_speeds_without_grains_are_those_of_water_to_the_bit(h1, u1, r):
    alone = water_speeds(h1, u1)
    assert alone == outer_bounds(h1, u1, 0.0, 0.0, r)
    assert alone == outer_speeds(h1, u1, 0.0, 0.0, r)


@pytest.mark.parametrize("scheme", ["ifcph", "hll", "rusanov"])
@given(DEPTHS, SPEEDS, DEPTHS, SPEEDS, st.floats(0.0, 0.99), st.booleans(), st.booleans())
def test_fluxes_without_grains_are_those_of_water_to_the_bit(scheme, h_i, u_i, h_j, u_j, r, stuck, exact):
    s = settings(0.1, scheme=scheme, r=r, exact_front=exact)
    slowest = min(water_speeds(h_i, u_i)[0], water_speeds(h_j, u_j)[0])
    fastest = max(water_speeds(h_i, u_i)[1], water_speeds(h_j, u_j)[1])
    before, after = Normal(h_i, u_i, 0.0, 0.0), Normal(h_j, u_j, 0.0, 0.0)
    both = edge_fluxes(s, stuck, slowest, fastest, before, after, h_j - h_i)
    alone = water_edge_fluxes(s, slowest, fastest, h_i, u_i, h_j, u_j, h_j - h_i)
    assert both[:3] == alone
    assert both[3:] == (0.0, 0.0, 0.0)


@given(st.integers(0, 10_000), st.booleans())
def test_faces_without_grains_are_those_of_water_to_the_bit(seed, frictionless):
    rng = np.random.default_rng(seed)
    n = 24
    s = settings(0.1, order=2, m=0.0 if frictionless else 1.0)
    c = allocate(Cells, (n,), np.float64)
    c.h1[:] = np.where(rng.random(n) < 0.2, 0.0, rng.uniform(0, 2, n))
    c.u1[:] = rng.normal(0, 1, n)
    c.eta[:] = c.h1
    source = rng.normal(0, 1, n)
    sides = [[allocate(Side, (n,), np.float64) for _ in range(2)] for _ in range(2)]
    terms = [allocate(CellTerms, (n,), np.float64) for _ in range(2)]
    faces(s, c, *sides[0], terms[0], source, None, 0, n - 2, 0.01)
    water_faces(s, c, *sides[1], terms[1], source, 0, n - 2, 0.01)
    for both, alone in zip(*sides, strict=True):
        for name in ("eta", "h1", "u1", "h2"):
            assert np.array_equal(getattr(both, name), getattr(alone, name)), name
    assert np.array_equal(terms[0].inner_p1x, terms[1].inner_p1x)
