"""Points made by hand: the engine solves what a study could ask for, and nothing else."""

import timeit

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from subslide.keys.schema import ConfigError
from subslide.points import RUN_KEYS, Point
from subslide.study import checking, config

WRONG = {
    "order": (3, "1", None, True),
    "cells": (5, 10**6, 20.5, "20", None, [20], np.array([20])),
    "t_end": (-1.0, 0.0, float("nan"), "rest", "0.5", True, (0.1,)),
    "r": (1.0, 2.0, -0.1, float("inf"), None, 1j, 10**5000),
    "scheme": ("ifcpf", 3, None, b"hll"),
    "scene": ("x", "../x", 3, None),
    "scene_options": ((("x", 1.0),), 3, None, "ab", (("a", 1, 2),)),
    "snapshot_times": ((-1.0,), 3.0, "abc", ("0.1",), (float("nan"),), tuple(range(1001))),
    "fields": ("false", 1, None),
    "gauges": (
        3.0,
        "abc",
        (0.1, 0.0),
        ((0.1,),),
        [[0.1, 0.0]],
        ([0.1, 0.0],),
        ((float("nan"), 0.0),),
        ((0.31, 0.0),),
    ),
    "runout_directions": (-1, 3601, 0.5, "4", None),
    "footprints": ("true", 1, None),
    "model": ("one-layer", "line"),
}


@pytest.mark.parametrize("key", WRONG)
def test_a_wrong_value_of_a_point_is_named_in_one_line(key):
    for value in WRONG[key]:
        if (key, value) == ("t_end", "rest"):
            continue
        with pytest.raises(ValueError, match=key) as caught:
            checking.check_point(Point(**{key: value}))
        assert isinstance(caught.value, ConfigError)
        assert "\n" not in str(caught.value)


def test_points_of_a_study_are_not_checked_again():
    point = config.make_study({"study": "t", "a_H": 3}).points[0]
    assert min(timeit.repeat(lambda: checking.check_point(point), number=1000)) < 1e-3
    by_hand = Point(a_H=3)
    checking.check_point(by_hand)
    assert min(timeit.repeat(lambda: checking.check_point(by_hand), number=1000)) < 1e-3
    assert by_hand == point
    assert by_hand.id == point.id
    with pytest.raises(ConfigError, match="r: 2"):
        checking.check_point(by_hand.with_values(r=2))


def test_scene_options_may_be_left_to_their_defaults():
    checking.check_point(
        Point(scene="ellipse", scene_options=(("elongation", 2.0),), snapshot_times=(0.1, 0.0))
    )


@given(
    st.sampled_from(RUN_KEYS),
    st.recursive(
        st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=5), st.lists, max_leaves=3
    ),
)
def test_any_value_is_one_that_a_study_takes_or_refused(key, value):
    value = tuple(value) if isinstance(value, list) else value
    try:
        checking.check_point(Point(**{key: value}))
    except ConfigError:
        return
    assert Point(**{key: value}).id
