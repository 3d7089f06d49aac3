"""Formulas of the paper taken literally, and friction left out of the viscosity: what each of them does."""

import math

import numpy as np
import pytest
from states import advance, inner, plane, settings

from subslide.kernels.printed import FLAGS, braking, carried
from subslide.models.build import settings_of
from subslide.solver import solve
from subslide.study import config


def solved(**keys):
    """Run of a point."""
    return solve(config.make_point({"cells": 60, **keys}))


@pytest.mark.parametrize("order", [1, 2])
def test_the_printed_test_of_rest_never_stops_a_pile(order):
    usual, printed = (solved(order=order, as_printed=name) for name in ("none", "friction"))
    assert usual.status == "ok"
    assert usual.time_at_rest < usual.time[-1]
    assert printed.status == "not_at_rest"
    assert printed.time[-1] > 10 * usual.time[-1]
    assert math.isnan(printed.time_at_rest)


def test_the_printed_test_compares_speed_and_deceleration_as_numbers():
    """u* = u - dt g (1-r) mu is kept up to |u*| = g (1-r) mu, here 2.52 m/s; faster grains stop."""
    point = config.make_point({"as_printed": "friction", "r": 0.4, "delta": 40, "a_2": 0.56})
    s = settings_of(point, 2, 0.04, 1e-6)
    speed = math.sqrt(9.81 * 0.56 * 0.0705)
    assert s.printed_bound * speed == pytest.approx(9.81 * 0.6 * math.tan(math.radians(40)))
    reach = 0.01
    bound = float(s.printed_bound)
    assert braking(s, reach, bound, 1.0) == pytest.approx(1 - reach / bound)
    assert braking(s, reach, bound + 2 * reach, 0.0) == 0
    assert braking(s, reach, 0.004, 1.0) == pytest.approx(1 - 0.01 / 0.004)  # turned round
    assert braking(s, reach, 0.0, 0.0) == 0
    usual = settings(0.04, treatment=1)
    assert braking(usual, reach, bound + 1, 0.0) == pytest.approx(1 - reach / (bound + 1))
    assert braking(usual, reach, 0.004, 0.0) == 0


def test_printed_upwinding_takes_the_other_side_over_the_wrong_depth():
    usual, printed = (settings(0.04, as_printed=FLAGS[name], treatment=1) for name in ("none", "upwinding"))
    for flux, one, other in ((1.0, 3.0, 0.5 * 7 / 0.25), (-1.0, 7.0, 3.0)):
        assert carried(usual, flux, 0.25, 3.0, 0.5, 7.0) == one
        assert carried(printed, flux, 0.25, 3.0, 0.5, 7.0) == other
    assert carried(printed, 1.0, 0.5, 3.0, 0.5, 7.0) == 7.0
    assert math.isfinite(carried(printed, 1.0, 0.0, 0.0, 0.5, 7.0))


def test_printed_upwinding_lets_ripples_of_the_tangential_velocity_grow():
    """A flow that carries them along at constant speed smooths them if momentum comes from upstream."""
    edges = np.arange(21) * 0.05
    ripples = np.broadcast_to(1e-6 * np.sin(2 * np.pi * (np.arange(20) + 0.5) / 20), (20, 20))
    heights = {}
    for name in ("none", "upwinding"):
        options = {
            "as_printed": FLAGS[name],
            "treatment": 1,
            "m": 0.0,
            "walls": (2,) * 4,
            "level": 2.0,
        }
        model = plane(edges, 1.0, 1.0, u1=0.3, u2=0.3, v1=ripples, v2=ripples, **options)
        advance(model, steps=40)
        heights[name] = [np.abs(inner(model, v)).max() / 1e-6 for v in ("v1", "v2")]
    assert np.all(np.array(heights["none"]) < 1)
    assert np.all(np.array(heights["upwinding"]) > 1.1)


def test_printed_upwinding_changes_a_column_in_the_plane_and_not_its_volume():
    usual, printed = (
        solved(model="quarter", cells=40, t_end=0.2, as_printed=a) for a in ("none", "upwinding")
    )
    assert np.abs(printed.sediment_volume / printed.sediment_volume[0] - 1).max() < 1e-12
    assert np.abs(printed.h2[-1] - usual.h2[-1]).max() > 1e-3 * usual.h2[0].max()


@pytest.mark.parametrize("order", [1, 2])
@pytest.mark.parametrize("keys", [{"model": "radial"}, {"model": "one-layer", "r": 0}])
def test_piles_creep_unless_the_viscosity_sees_their_friction(order, keys):
    def centre(seen, t_end):
        return solved(scene="pile", order=order, t_end=t_end, friction_in_viscosity=seen, **keys).h2[-1, 0]

    start = centre(True, 0.01)
    assert centre(True, 1.0) == start
    creeping = [centre(False, t_end) / start for t_end in (0.25, 1.0)]
    assert creeping[0] < 0.99
    assert creeping[1] < creeping[0] - 0.01
