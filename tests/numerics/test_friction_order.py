"""Second order with friction: smooth flow that moves converges by the square of the cell, by every law.

The scene `shear` in a periodic box, all of it moving, against the same on a fine grid; grains slow down by a third.
"""

import math

import numpy as np
import pytest
from states import advance, inner, plane

from subslide.kernels.boundary import PERIODIC
from subslide.kernels.friction import FLAGS as LAWS
from subslide.scenes.shear import critical_shear, velocities
from subslide.solver import solve
from subslide.study.config import make_point

LAW_KEYS = {
    "coulomb": {"delta": 32},
    "voellmy": {"delta": 20, "friction": "voellmy"},
    "pouliquen": {"delta": 20, "friction": "pouliquen", "delta_2": 45},
}
LEAST = 1.8


def on_a_line(cells, **values):
    """Depth of grains at the end over H2, on a line."""
    common = {"scene": "shear", "scene_options": {"shear": 0.5, "amplitude": 0.1, "drift": 1.0}}
    common |= {"boundary": "periodic", "t_end": 0.08, "snapshot_times": [0], "cells": cells}
    run = solve(make_point(common | values))
    assert run.status == "ok", run.status_detail
    return run.h2[-1] / run.point.column_height


def order(depth, cells, fine):
    """Order of the mean error of `depth(n)` from the first of `cells` to the last, against `fine`."""
    truth = depth(fine)
    errors = [np.abs(depth(n) - truth.reshape(n, -1).mean(axis=1)).mean() for n in cells]
    return math.log(errors[0] / errors[-1]) / math.log(cells[-1] / cells[0])


@pytest.mark.parametrize("law", LAW_KEYS)
@pytest.mark.parametrize("scheme", ["ifcph", "hll"])
def test_smooth_flow_with_friction_is_of_second_order(law, scheme):
    values = {"a_H": 1.0, "r": 0.4, "scheme": scheme, **LAW_KEYS[law]}
    assert order(lambda n: on_a_line(n, **values), (100, 200, 400), 3200) >= LEAST


@pytest.mark.parametrize("turned", [False, True])
@pytest.mark.parametrize(
    "law",
    [{}, {"law": LAWS["voellmy"], "law_1": 0.3}, {"law": LAWS["pouliquen"], "law_1": 0.4, "law_2": 1.5}],
    ids=LAWS,
)
def test_the_same_in_the_plane_along_x_and_along_y(law, turned):
    """Waves along one axis, with the same speed of the grains across it."""

    def depth(n):
        edges = np.arange(n + 1) * (4.0 / n)
        half = 2.0 / n
        wave = 0.1 * np.sinc(0.5 * half) * np.cos(0.5 * math.pi * (edges[1:] - half))
        h2 = np.broadcast_to(1.0 + wave, (n, n))
        u1, u2 = velocities(1.0, 1.0, 0.4, 0.5 * critical_shear(1.0, 1.0, 0.4), 1.0)
        along = {"u1": u1, "u2": u2, "v2": 0.5}
        if turned:
            h2, along = h2.T, {"v1": u1, "v2": u2, "u2": 0.5}
        model = plane(
            edges, 2.0 - h2, h2, level=2.0, walls=(PERIODIC,) * 4, r=0.4, m=0.6, order=2, **along, **law
        )
        advance(model, stop=0.7, thresholds=(9.0, 9.0, 9.0))
        end = inner(model, "h2")
        return end[:, 0] if turned else end[0]

    assert order(depth, (16, 32, 64), 256) >= LEAST
