"""Layers that part faster than their waves: a slab that slides away from a wall tears off, and the run ends well."""

import itertools

import numpy as np
import pytest

from subslide.keys.names import SCHEMES
from subslide.solver import solve
from subslide.study.config import make_point


def slab(speed, scheme, order, **values):
    """Run of a slab of grains that slides from one wall to the other."""
    about = {"scene": "slide", "scene_options": {"speed": speed}, "boundary": "wall", "cells": 100}
    return solve(make_point({**about, "scheme": scheme, "order": order, **values}))


@pytest.mark.parametrize("order", [1, 2])
@pytest.mark.parametrize("scheme", SCHEMES)
def test_a_slab_tears_off_a_wall(scheme, order):
    for speed, a_H, r in itertools.product((0.5, 1, 1.5, 2, 3), (0.5, 1, 4), (0, 0.4, 0.8)):
        run = slab(speed, scheme, order, a_H=a_H, r=r, t_end=0.5)
        assert run.status == "ok", (run.status_detail, speed, a_H, r)


@pytest.mark.parametrize("speed", [2, 2.5, 3])
@pytest.mark.parametrize(
    ("scheme", "order", "most"),
    [("hll", 2, 0.01), ("roe", 1, 0.01), ("roe", 2, 0.02), ("ifcph", 2, 1), ("ifcp", 2, 1)],
)
def test_a_slab_that_climbs_a_wall_gains_no_energy(scheme, order, most, speed):
    """Beyond the limit of hyperbolicity, as here, the parabolas gain some; speeds of what is left in cells none."""
    energy = slab(speed, scheme, order, r=0.4, t_end=0.4).series["energy"]
    assert (energy - np.minimum.accumulate(energy)).max() < most * energy[0]
