"""Friction laws beside Coulomb's against limits where the answer is known: a uniform slab that slides to rest."""

import numpy as np
import pytest
from states import advance, axial, inner

from subslide.kernels.friction import FLAGS as LAWS
from subslide.keys.schema import ConfigError
from subslide.study import config

R, MU, U0 = 0.4, 0.5, 1.5
A = (1 - R) * MU
EDGES = np.linspace(-1.0, 1.0, 21)


def slab(stop, cfl=0.9, h2=1.0, m=MU, **law):
    """Speed of a uniform slab at time `stop`, released at U0 under still water; every cell has it."""
    options = {"r": R, "m": m, "cfl": cfl, "order": 2, **law}
    model = axial(EDGES, 1.0, 0.0, h2, U0, level=1.0 + h2, walls=(3, 3), **options)
    advance(model, stop=stop, thresholds=(9.0, 9.0, 9.0))  # grains may leave through the open ends
    u2 = inner(model, "u2")
    assert np.ptp(u2) == 0
    return u2[0]


def voellmy_speed(t, b):
    """Solution of du/dt = -(A + b u^2), u(0) = U0."""
    return np.sqrt(A / b) * np.tan(np.arctan(U0 * np.sqrt(b / A)) - np.sqrt(A * b) * t)


def pouliquen_speed(t, rise, depths, h2):
    """Solution of du/dt = -(A + (1-R) rise exp(-depths h2^1.5 / u)), by Runge-Kutta with 2,000 steps."""

    def slope(u):
        return -(A + (1 - R) * rise * np.exp(-depths * h2**1.5 / u))

    u, dt = U0, t / 2000
    for _ in range(2000):
        k1 = slope(u)
        k2 = slope(u + dt / 2 * k1)
        k3 = slope(u + dt / 2 * k2)
        u += dt / 6 * (k1 + 2 * k2 + 2 * k3 + slope(u + dt * k3))
    return u


def ratios(error):
    """Ratios of the errors at CFL 0.4, 0.2 and 0.1: friction is split from transport evenly, so its order is two."""
    errors = np.array([abs(error(cfl)) for cfl in (0.4, 0.2, 0.1)])
    assert errors[0] < 0.02 * U0
    return errors[:-1] / errors[1:]


def test_coulomb_slows_a_slab_linearly_and_stops_it():
    assert slab(1.0) == pytest.approx(U0 - A, rel=1e-12)
    assert slab(1.1 * U0 / A) == 0.0


@pytest.mark.parametrize("h2", [1.0, 0.25])
def test_voellmy_slows_a_slab_as_the_closed_form_says(h2):
    turbulence = 0.3
    law = {"law": LAWS["voellmy"], "law_1": turbulence, "h2": h2}
    exact = voellmy_speed(1.0, turbulence / h2)
    np.testing.assert_allclose(ratios(lambda cfl: slab(1.0, cfl, **law) - exact), 4, atol=0.6)


def test_turbulence_alone_is_exact():
    speed = slab(2.0, m=0.0, law=LAWS["voellmy"], law_1=0.3)
    assert speed == pytest.approx(U0 / (1 + 0.3 * U0 * 2.0), rel=1e-12)


@pytest.mark.parametrize("h2", [1.0, 0.25])
def test_pouliquen_slows_a_slab_as_its_equation_says(h2):
    rise, depths = 0.4, 1.5
    law = {"law": LAWS["pouliquen"], "law_1": rise, "law_2": depths, "h2": h2}
    exact = pouliquen_speed(1.0, rise, depths, h2)
    np.testing.assert_allclose(ratios(lambda cfl: slab(1.0, cfl, **law) - exact), 4, atol=0.6)


def test_laws_become_coulombs_where_their_own_part_vanishes():
    coulomb = slab(1.0)
    assert slab(1.0, law=LAWS["voellmy"], law_1=0.0) == pytest.approx(coulomb, rel=1e-12)
    assert slab(1.0, law=LAWS["pouliquen"], law_1=0.0, law_2=1.0) == pytest.approx(coulomb, rel=1e-12)
    assert slab(1.0, law=LAWS["pouliquen"], law_1=0.4, law_2=1e6) == pytest.approx(coulomb, rel=1e-12)
    fast = slab(1.0, law=LAWS["pouliquen"], law_1=0.4, law_2=0.0)
    assert fast == pytest.approx(slab(1.0, m=MU + 0.4), rel=1e-12)


@pytest.mark.parametrize(
    ("name", "law"), [("voellmy", {"law_1": 0.3}), ("pouliquen", {"law_1": 0.4, "law_2": 1.5})]
)
def test_a_pile_at_rest_feels_only_coulomb(name, law):
    x = (EDGES[1:] + EDGES[:-1]) / 2
    h2 = np.maximum(0.0, 0.3 - 0.9 * MU * np.abs(x))
    h1 = 1.0 - h2
    model = axial(EDGES, h1, 0.0, 1.0 - h1, 0.0, level=1.0, r=R, m=MU, order=2, law=LAWS[name], **law)
    advance(model, steps=200)
    np.testing.assert_array_equal(inner(model, "h2"), 1.0 - h1)


@pytest.mark.parametrize("delta", [42, 45])
def test_pouliquen_needs_more_friction_in_fast_flow_than_at_rest(delta):
    with pytest.raises(
        ConfigError, match=rf"delta_2: 42 .* pouliquen and delta: {delta}; allowed: above delta, {delta} to"
    ):
        config.make_point({"friction": "pouliquen", "delta": delta})
    assert config.make_point({"friction": "coulomb", "delta": delta}).delta == delta  # delta_2 has no part
    assert (
        config.make_point({"friction": "pouliquen", "delta": delta, "delta_2": delta + 0.1}).delta_2 > delta
    )
