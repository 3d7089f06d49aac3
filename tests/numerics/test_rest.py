"""States at rest stay at rest to the bit; steeper ones move (Theorem 3.1)."""

import numpy as np
import pytest
from states import advance, axial, inner, plane

from subslide.points import Point
from subslide.scenes import level_off
from subslide.solver import solve

MU = 0.8
STATE = ("h1", "u1", "v1", "h2", "u2", "v2")
EDGES = np.linspace(-1.5, 1.5, 41)
X = (EDGES[1:] + EDGES[:-1]) / 2


def cone(slope):
    return np.maximum(0.0, 1.0 - slope * np.hypot(X[:, None], X[None, :]))


def pyramid(slope, degrees):
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    x, y = X[None, :], X[:, None]
    return np.maximum(0.0, 1.0 - slope * np.maximum(np.abs(c * x + s * y), np.abs(c * y - s * x)))


def unmoved(h2, steps, order=1, r=0.4, edges=EDGES):
    """Whether grains h2 under a flat surface are the same bits after `steps` steps."""
    h1, h2 = level_off(h2, 2.0)
    model = plane(edges, h1, h2, level=2.0, r=r, m=MU, order=order)
    before = [inner(model, name).copy() for name in STATE]
    advance(model, steps=steps)
    return all(np.array_equal(inner(model, n), b) for n, b in zip(STATE, before, strict=True))


@pytest.mark.parametrize("order", [1, 2])
def test_a_cone_with_a_dry_foot_is_bit_still_for_10000_steps(order):
    assert unmoved(cone(0.95 * MU if order == 1 else 0.9 * MU), 10_000, order)


@pytest.mark.parametrize("order", [1, 2])
def test_pyramids_at_any_angle_side_by_side_are_bit_still_for_10000_steps(order):
    small = 2 * EDGES[2:-2:2] / EDGES[-3]  # four boxes of 2 x 2
    x = (small[1:] + small[:-1]) / 2
    piles = []
    for degrees, (x0, y0) in zip((0.0, 22.5, 45.0, 67.5), ((-1, -1), (1, -1), (-1, 1), (1, 1)), strict=True):
        c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
        a, b = c * (x[None, :] - x0) + s * (x[:, None] - y0), c * (x[:, None] - y0) - s * (x[None, :] - x0)
        piles.append(np.maximum(0.0, 0.5 - 0.9 * MU * np.maximum(np.abs(a), np.abs(b))))
    assert unmoved(sum(piles), 10_000, order, edges=small)


@pytest.mark.parametrize("order", [1, 2])
@pytest.mark.parametrize("r", [0.0, 0.8])
def test_a_round_pile_is_bit_still_for_10000_steps_and_moves_if_too_steep(order, r):
    edges = np.linspace(0, 2, 61)
    x = (edges[1:] + edges[:-1]) / 2
    for slope, still in ((0.9, True), (1.05, False)):
        h1, h2 = level_off(np.maximum(0.0, 1 - slope * MU * x), 2.0)
        model = axial(edges, h1, 0, h2, 0, level=2.0, radial=True, r=r, m=MU, order=order)
        advance(model, steps=10_000 if still else 200)
        found = [inner(model, name) for name in ("h1", "u1", "h2", "u2")]
        same = all(np.array_equal(a, b) for a, b in zip(found, (h1, 0 * x, h2, 0 * x), strict=True))
        assert same == still


@pytest.mark.parametrize("order", [1, 2])
@pytest.mark.parametrize("degrees", [0.0, 22.5, 45.0])
def test_a_pyramid_at_any_angle_to_the_grid_is_bit_still(order, degrees):
    assert unmoved(pyramid(0.95 * MU if order == 1 else 0.9 * MU, degrees), 1_000, order)


@pytest.mark.parametrize("order", [1, 2])
@pytest.mark.parametrize(
    "shape", [cone, lambda slope: pyramid(slope, 45.0), lambda slope: pyramid(slope, 0.0)]
)
def test_a_pile_steeper_than_friction_moves(order, shape):
    assert not unmoved(shape(1.05 * MU), 200, order)


@pytest.mark.parametrize("order", [1, 2])
def test_a_lake_over_grains_as_steep_as_friction_allows_is_bit_still(order):
    edges = np.linspace(0, 2, 101)
    x = (edges[1:] + edges[:-1]) / 2
    h1, h2 = level_off(0.4 + 0.3 * np.sin(3 * x), 1.5)
    model = axial(edges, h1, 0, h2, 0, level=1.5, m=1.0, order=order)
    advance(model, steps=10_000)
    np.testing.assert_array_equal(inner(model, "h2"), h2)
    np.testing.assert_array_equal(inner(model, "u1"), 0)


@pytest.mark.parametrize("model", ["radial", "one-layer", "quarter"])
def test_the_column_comes_fully_to_rest_with_its_centre_untouched(model):
    run = solve(Point(r=0.0, a_2=0.56, delta=30.0, model=model, cells=100))
    assert run.status == "ok"
    assert run.time_at_rest < 0.25
    assert run.h2[-1][0] == run.point.a_2 * run.point.radius
    np.testing.assert_array_equal(run.x_front[:, -1], run.L_f)
