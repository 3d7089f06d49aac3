"""Ids depend on values alone: not on how numbers are written, nor on the order of keys, nor on other points."""

import math
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from subslide import points
from subslide.points import Point
from subslide.study import config

OTHER = {
    "a_H": 2.0, "a_2": 1.0, "r": 0.1, "delta": 30.0, "radius": 1.0, "g": 9.8, "scene": "other",
    "scene_options": (("name", 1.0),), "quantities": "grains", "friction": "voellmy", "xi": 400.0, "delta_2": 40.0,
    "pouliquen_length": 0.01, "model": "plane", "scheme": "hll", "wave_speeds": "approximate",
    "front_flux": "hll", "treatment": "stop", "as_printed": "friction", "friction_in_viscosity": False, "order": 1,
    "cells": 100, "dtype": "float32", "cfl": 0.5, "boundary": "wall", "t_end": 1.0, "snapshot_times": (0.0,),
    "fields": True,
}  # fmt: skip


def test_ids_are_pinned():
    """A changed id makes every finished study run again: change it only with intent."""
    assert Point().id == "p51850e7838c3"


@pytest.mark.parametrize("key", points.RUN_KEYS)
def test_every_key_enters_the_id(key):
    assert replace(Point(), **{key: OTHER[key]}).id != Point().id


def test_how_a_number_is_written_does_not_matter():
    written = [config.make_point({"a_H": 1, "cells": 100}), config.make_point({"cells": 100.0, "a_H": 1.0})]
    assert written[0].id == written[1].id
    assert Point(r=0).id == Point(r=0.0).id == Point(r=-0.0).id


def test_adding_a_value_renames_nothing():
    few = config.make_study({"study": "t", "a_H": [1, 2]})
    more = config.make_study({"study": "t", "a_H": [0.5, 2, 1]})
    assert {p.id for p in few.points} < {p.id for p in more.points}


@given(
    a_H=st.floats(0, 1000),
    t_end=st.none() | st.floats(1e-6, 1e6),
    times=st.none() | st.lists(st.floats(0, 10)),
)
def test_points_survive_as_plain_values(a_H, t_end, times):
    point = points.from_dict(
        points.to_dict(Point(a_H=a_H, t_end=t_end, snapshot_times=times and tuple(times)))
    )
    assert points.from_dict(points.to_dict(point)) == point
    assert points.from_dict(points.to_dict(point)).id == point.id


def test_similar_points_share_a_key():
    first, second = (
        Point(a_2=1.0, delta=30.0),
        Point(a_2=0.56, delta=math.degrees(math.atan(0.56 * math.tan(math.pi / 6)))),
    )
    assert first.similarity_key[:2] == second.similarity_key[:2]
    assert first.similarity_key[2] == pytest.approx(second.similarity_key[2], rel=1e-6)


def test_cell_size_follows_the_radius():
    assert Point(cells=200).dx == pytest.approx(0.003)
    assert Point(cells=200, radius=705.0).dx == pytest.approx(30.0)
