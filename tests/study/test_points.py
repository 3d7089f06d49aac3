"""Ids depend on values alone: not on how numbers are written, nor on the order of keys, nor on other points."""

import math
import pickle
from dataclasses import FrozenInstanceError

import pytest
from hypothesis import given
from hypothesis import strategies as st

from subslide import points
from subslide.keys import schema
from subslide.points import Point
from subslide.study import config

OTHER = {
    "scene": "other",
    "scene_options": (("name", 1.0),),
    "t_end": 1.0,
    "snapshot_times": (0.0,),
    "gauges": ((0.1, 0.0),),
}
"""Values that are not the default, of keys whose entry does not tell another."""

PINNED = (
    (Point(), "pd4d3bd1daa49"),
    (Point(a_H=10, r=0.0, model="quarter", order=1, front_flux="hll"), "pfcbded22cff9"),
    (
        Point(
            scene="ellipse", scene_options=(("angle", 30.0), ("elongation", 2.0)), model="plane", fields=True
        ),
        "p499cfac018af",
    ),
    (
        Point(
            delta=20,
            t_end=0.5,
            snapshot_times=(0.0, 0.1),
            cells=40,
            dtype="float32",
            friction="voellmy",
            xi=100,
        ),
        "p10fbdf051702",
    ),
    (
        Point(treatment="stop", friction_in_viscosity=False, radius=1, g=1.62, cfl=0.45, boundary="wall"),
        "pdb862e916bc7",
    ),
)


def test_ids_are_pinned():
    """A changed id makes every finished study run again: change it only with intent."""
    for point, name in PINNED:
        assert point.id == name


def other(key):
    """Return a value of a key that is not its default."""
    about = schema.properties()[key]
    default = about["default"]
    if key in OTHER:
        return OTHER[key]
    if "enum" in about:
        return next(value for value in about["enum"] if value != default)
    return not default if isinstance(default, bool) else type(default)(default / 2 or 1)


@pytest.mark.parametrize("key", points.RUN_KEYS)
def test_every_key_enters_the_id(key):
    assert Point().with_values(**{key: other(key)}).id != Point().id


def test_the_open_sea_has_not_the_ids_of_the_zero_gradient():
    """What `open` was before is `paper`: the old id of a run with it is no run's now."""
    old = "p51850e7838c3"
    assert old not in {Point(boundary=boundary).id for boundary in schema.properties()["boundary"]["enum"]}


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


def test_a_point_is_made_of_the_keys_of_a_run_and_cannot_be_changed():
    assert tuple(points.to_dict(Point())) == points.RUN_KEYS
    assert set(schema.properties()) - set(points.RUN_KEYS) == set(
        schema.with_role("study", "preset", "design")
    )
    assert points.to_dict(Point()) == {key: schema.properties()[key]["default"] for key in points.RUN_KEYS}
    assert pickle.loads(pickle.dumps(Point(r=0.1))) == Point(r=0.1)
    assert len({Point(), Point(r=0.4), Point(r=0.1)}) == 2
    with pytest.raises(FrozenInstanceError):
        Point().r = 0.1
    with pytest.raises(TypeError, match="foo"):
        Point(foo=1)


def test_a_point_with_other_values_is_another_point():
    point = Point(r=0.1, cells=100)
    assert point.id != point.with_values(cells=50).id == Point(r=0.1, cells=50).id
    assert point == Point(r=0.1, cells=100)
    assert point.with_values() == point
    with pytest.raises(TypeError, match="foo"):
        point.with_values(foo=1)


def test_a_point_knows_what_follows_from_it():
    point = Point(a_H=2, a_2=0.5, radius=0.2, g=10, delta=45, cells=101, xi=40)
    assert point.column_height == pytest.approx(0.1)
    assert (point.level, point.scaled_level) == (pytest.approx(0.3), 3)
    assert point.time_scale == pytest.approx(0.2)
    assert point.speed_scale == pytest.approx(1)
    assert point.speed_scale * point.time_scale == pytest.approx(point.radius)
    assert point.wave_speed == pytest.approx(math.sqrt(3))
    assert point.friction_number == pytest.approx(2)
    assert point.turbulence == pytest.approx(0.5)
    assert point.dx == pytest.approx(point.scaled_dx * point.radius)
    assert point.half_cells == 51
    assert point.half_box == pytest.approx(51 * 0.6 / 101 / 0.0705)
    edge_time = points.edge_time(point.a_H, point.a_2, point.radius, point.g)
    assert edge_time == pytest.approx((0.3 / 0.0705 - 1) * 0.2 / math.sqrt(3))
    assert Point().profile_times == (0, 0.08, 0.16, 0.24, 0.54)
    assert Point(snapshot_times=(0.2, 0.1)).profile_times == (0.1, 0.2)
