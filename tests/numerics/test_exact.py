"""Convergence to exact solutions."""

import numpy as np
import pytest
from states import advance, axial, inner

from subslide.exact.paraboloid import depth, radius, ring_mean

END = np.sqrt((2.69**2 - 1) / 2)  # R / R0 = 2.69


def error(dx, order, layers):
    """Relative L1 error of the paraboloid's depth at END; CFL 0.9."""
    edges = np.arange(round(3.2 / dx) + 1) * dx
    h2 = ring_mean(edges, 0.0)
    h1 = 0 if layers == 1 else 2.0 - h2
    model = axial(
        edges,
        h1,
        0,
        h2,
        0,
        level=2.0,
        layers=layers,
        r=0.0,
        friction=0.0,
        order=order,
        radial=True,
        walls=(True, False),
    )
    advance(model, stop=END)
    exact = ring_mean(edges, END)
    ring = np.diff(edges**2)
    return np.abs((inner(model, "h2") - exact) * ring).sum() / (exact * ring).sum()


@pytest.mark.parametrize(("order", "rate", "largest"), [(1, 0.8, 0.04), (2, 1.7, 0.003)])
def test_dry_paraboloid_converges_from_2_to_half_a_millimetre(order, rate, largest):
    errors = [error(size / 70.5, order, layers=1) for size in (2.0, 1.0, 0.5)]
    assert errors[0] < largest
    assert np.log2(errors[0] / errors[2]) / 2 > rate


@pytest.mark.parametrize("order", [1, 2])
def test_paraboloid_under_weightless_water_converges(order):
    errors = [error(size / 70.5, order, layers=2) for size in (2.0, 0.5)]
    assert np.log2(errors[0] / errors[1]) / 2 > 0.5


def test_the_paraboloid_keeps_its_volume():
    edges = np.linspace(0, 4, 4001)
    for t in (0.0, 0.7, END):
        assert np.isclose((ring_mean(edges, t) * np.diff(edges**2)).sum() * np.pi, np.pi / 2, rtol=1e-12)
        assert depth(radius(t), t) == 0
        centres = (edges[1:] + edges[:-1]) / 2
        np.testing.assert_allclose(ring_mean(edges, t), depth(centres, t), atol=1e-3)
