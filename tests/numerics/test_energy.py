"""Energy inside walls: at first order on a line and in the plane it never grows, with the same speeds for both layers.

At second order, and on a radius, a step may give back a part of what the run loses. That part is in proportion to dx;
`GIVEN_BACK` bounds it, over dx, a fifth above the worst that was measured over STATES at 50, 100 and 200 cells (a dam
break without friction on a dry bed; on a radius at first order, waves that meet on the axis).
"""

import itertools

import numpy as np
import pytest
from states import advance, axial, plane

from subslide.kernels import clock as k
from subslide.kernels import samples as columns

SCHEMES = ("rusanov", "hll", "ifcp", "ifcph", "ifcph, exact front")
STATES = tuple(itertools.product((0.0, 0.4, 0.8), (1.0, 10.0), (0.0, 0.3, 1.1)))
GIVEN_BACK = {
    ("line", 2): {
        "rusanov": 0.0092,
        "hll": 0.0102,
        "ifcp": 0.205,
        "ifcph": 0.0112,
        "ifcph, exact front": 0.22,
    },
    ("radius", 1): {
        "rusanov": 4.2e-5,
        "hll": 4.2e-5,
        "ifcp": 3e-5,
        "ifcph": 3e-5,
        "ifcph, exact front": 3.3e-5,
    },
    ("radius", 2): {
        "rusanov": 0.0145,
        "hll": 0.0156,
        "ifcp": 0.276,
        "ifcph": 0.0205,
        "ifcph, exact front": 0.19,
    },
}
WALLED = (9.0, 9.0, 9.0)
"""Thresholds of a front that no state reaches."""


def named(scheme):
    """Options of a scheme in SCHEMES; without `exact front` every edge has the same speeds for both layers."""
    name, *front = scheme.split(", ")
    return {"scheme": name, "exact_front": bool(front)}


def energies(cells, a_H, scheme, radial=False, **options):
    """Energy at each step of a column that collapses between walls, until waves have crossed the box."""
    edges = np.arange(cells + 1) * (4.2 / cells)
    h2 = np.where(edges[1:] <= 1.0 + 1e-9, 1.0, 0.0)
    options.update(named(scheme))
    model = axial(edges, 1 + a_H - h2, 0, h2, 0, level=1 + a_H, radial=radial, **options)
    samples, outcome = advance(model, stop=4.0, thresholds=WALLED)
    assert outcome == k.REACHED
    return samples[:, columns.ENERGY]


@pytest.mark.parametrize("scheme", SCHEMES)
@pytest.mark.parametrize("cells", [50, 100])
def test_energy_never_grows_at_first_order_on_a_line(scheme, cells):
    for r, a_H, m in STATES:
        energy = energies(cells, a_H, scheme, order=1, r=r, m=m)
        assert np.diff(energy).max() <= 1e-14 * energy[0]


@pytest.mark.parametrize("scheme", SCHEMES)
@pytest.mark.parametrize("case", GIVEN_BACK)
def test_a_step_gives_back_energy_in_proportion_to_dx_at_most(scheme, case):
    geometry, order = case
    for cells in (50, 100, 200):
        for r, a_H, m in STATES:
            options = {"order": order, "r": r, "m": m}
            energy = energies(cells, a_H, scheme, geometry == "radius", **options)
            given_back = np.diff(energy).max() / (energy[0] - energy[-1])
            assert given_back <= GIVEN_BACK[case][scheme] * 4.2 / cells


@pytest.mark.parametrize("order", [1, 2])
@pytest.mark.parametrize("scheme", ["hll", "ifcph", "ifcph, exact front"])
def test_energy_never_grows_in_the_plane(scheme, order):
    edges = np.arange(25) * 0.125
    x = (edges[1:] + edges[:-1]) / 2
    h2 = np.where(np.hypot(x[:, None], x) < 1, 1.0, 0.0)
    model = plane(edges, 2 - h2, h2, level=2.0, order=order, m=1.1, **named(scheme))
    samples, outcome = advance(model, stop=1.5, thresholds=WALLED)
    assert outcome == k.REACHED
    assert np.diff(samples[:, columns.ENERGY]).max() <= 1e-14 * samples[0, columns.ENERGY]


@pytest.mark.parametrize("order", [1, 2])
def test_a_front_with_a_flux_of_its_own_raises_no_wave_in_the_first_step(order):
    edges = np.arange(101) * 0.042
    h2 = np.where(edges[1:] < 1, 1.0, 0.0)
    model = axial(edges, 11 - h2, 0, h2, 0, level=11.0, r=0.8, order=order, exact_front=True)
    samples, _ = advance(model, steps=1, thresholds=WALLED)
    assert samples[-1, columns.ETA] < 1e-12
