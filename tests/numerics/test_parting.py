"""Layers that part faster than their waves: a slab that slides away from a wall tears off, and the run ends well."""

import itertools

import pytest

from subslide.keys.names import SCHEMES
from subslide.scenes.shear import critical_shear
from subslide.solver import solve
from subslide.study.config import make_point


@pytest.mark.parametrize("order", [1, 2])
@pytest.mark.parametrize("scheme", SCHEMES)
def test_a_slab_tears_off_a_wall(scheme, order):
    for speed, a_H, r in itertools.product((0.5, 1, 1.5, 2, 3), (0.5, 1, 4), (0, 0.4, 0.8)):
        if speed > 2.5 * critical_shear(a_H, 1.0, r):
            continue  # waves between the layers grow without end, and leave films over what piles up
        point = make_point(
            {
                "scene": "slide",
                "scene_options": {"speed": speed},
                "boundary": "wall",
                "scheme": scheme,
                "order": order,
                "a_H": a_H,
                "r": r,
                "cells": 100,
                "t_end": 0.5,
            }
        )
        run = solve(point)
        assert run.status == "ok", (run.status_detail, speed, a_H, r)
