"""Expanding a study is fast; it gives what a plain product of its axes gives, one point after the other."""

import hashlib
import itertools
import json
import subprocess
import sys

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from subslide import catalogue
from subslide.keys import names, schema
from subslide.keys.schema import ConfigError
from subslide.keys.values import RUN_KEYS, STANDS_FOR
from subslide.points import Point, from_dict, to_dict
from subslide.study import choice, config, scene_options, together
from subslide.study.remembering import Remembered

AXES = {
    "numerics": ["default", "paper", "fronts"],
    "a_H": [0, 1, 1.0, 2.5, 1e-9],
    "r": [0, 0.4, 0.8],
    "delta": [0, 25, 32.5, 42],
    "scene": ["cylinder", "ellipse", "columns", "pile", "slab", "standing_wave"],
    "quantities": ["all", "grains"],
    "friction": ["coulomb", "pouliquen"],
    "model": ["auto", "one-layer", "radial", "quarter", "plane", "line"],
    "as_printed": ["none", "upwinding"],
    "cells": [40, 44, 50.0, 20000],
    "grid": ["uniform", "fitted", "auto"],
    "dtype": ["float64", "float32"],
    "boundary": ["open", "wall", "paper", "periodic"],
    "t_end": ["rest", 0.5],
}
OPTIONS = {"elongation": [1, 2], "angle": [0, 30], "x": [0, 0.5], "shape": ["cone", "round"], "speed": [1]}


@st.composite
def grids(draw):
    """Draw a configuration of some axes of few values, as a rule without more than one that is rarely allowed."""
    keys = draw(st.lists(st.sampled_from(sorted(AXES)), max_size=5, unique=True))
    values = {key: draw(st.lists(st.sampled_from(AXES[key]), min_size=1, max_size=3)) for key in keys}
    if draw(st.booleans()):
        chosen = draw(st.lists(st.sampled_from(sorted(OPTIONS)), max_size=2, unique=True))
        values["scene_options"] = {name: OPTIONS[name] for name in chosen}
    if draw(st.booleans()):
        values["snapshot_times"] = draw(st.lists(st.sampled_from([0, 0.1, 0.2]), max_size=2, unique=True))
    if draw(st.booleans()):
        values["gauges"] = draw(st.sampled_from([[], [[0.1, 0]], [[0.29, 0.29], [0, 0.2]]]))
    for key, value in (("fields", True), ("runout_directions", 8), ("footprints", True)):
        if draw(st.integers(0, 5)) == 0:
            values[key] = value
    return values


def plain(values):
    """Return label and point of each combination, in order and without repeats, by no shortcut."""
    axes = {}
    for key in ("numerics", *RUN_KEYS):
        if key == "scene_options" and key in values:
            axes[key] = scene_options.along_axes(values[key])
        elif key in values:
            listed = values[key] if schema.is_axis(key) and isinstance(values[key], list) else [values[key]]
            each = [schema.checked(key, value) for value in listed]
            axes[key] = each if key in ("snapshot_times", "gauges") else list(dict.fromkeys(each))
    runs = {}
    for combination in itertools.product(*axes.values()):
        one = dict(zip(axes, combination, strict=True))
        options = scene_options.checked(
            one.get("scene", "cylinder"), one.get("scene_options", {}), "scene_options"
        )
        label = one.pop("numerics", "default")
        point = from_dict({**names.NUMERICS[label], **one, "scene_options": options})
        together.check.function(point)
        runs.setdefault(plain_id(point), (label, point))
    return list(runs.values())


def plain_id(point):
    """Return a point's id from the text that JSON gives of all its values."""
    values = {key: getattr(point, key) for key in RUN_KEYS}
    for key, value in values.items():
        if value is None:
            values[key] = STANDS_FOR[key]
        elif schema.is_real(schema.properties()[key]):
            values[key] = float(value) + 0.0
    values["scene_options"] = dict(point.scene_options)
    if values["boundary"] == "open":
        values["boundary"] = "sea"
    for key, default in {
        "grid": "uniform",
        "gauges": (),
        "runout_directions": 0,
        "footprints": False,
    }.items():
        if values[key] == default:
            del values[key]
    for name in catalogue.options_that_read(point.scene):
        values["scene_options"].pop(name, None)
    text = json.dumps(values, separators=(",", ":"), sort_keys=True)
    return "p" + hashlib.sha256(text.encode()).hexdigest()[:12]


def outcome(make, values):
    """Return what a function makes of values, or the message."""
    try:
        return make(values)
    except ConfigError as error:
        return str(error)


@settings(deadline=None, max_examples=250)
@given(grids())
def test_a_study_has_the_points_ids_order_and_messages_of_the_plain_product(values):
    limits = {"max_core_hours": 1e7, "max_memory": 1e5, "max_disk": 1e6}
    made = outcome(lambda v: list(config.make_study({"study": "t", **limits, **v}).runs), values)
    expected = outcome(plain, values)
    assert made == expected
    if not isinstance(made, str):
        for _, point in made:
            assert point.id == plain_id(point)
            assert choice.of(point) == choice._choice.function(point)
            assert from_dict(to_dict(point)) == point


def test_answers_are_worked_out_once_for_points_that_share_what_is_read():
    asked = []

    @Remembered
    def judged(point):
        asked.append(point)
        if point.scene == "slab":
            return point.column_height
        if point.model == "line":
            raise ConfigError("line")
        return point.has_weightless_water

    points = [Point(a_H=a_H, r=r, cells=cells) for a_H in (1, 2) for r in (0.1, 0.2) for cells in (40, 80)]
    assert [judged(point) for point in points] == [False] * 8
    assert judged(Point(r=0.0))
    assert len(asked) == 2
    slabs = [Point(scene="slab", a_2=a_2, r=r, radius=1.0) for a_2 in (0.5, 1.0) for r in (0, 0.4)]
    assert [judged(point) for point in slabs] == [0.5, 0.5, 1.0, 1.0]
    assert len(asked) == 4
    for _ in range(2):
        with pytest.raises(ConfigError):
            judged(Point(model="line"))
    assert len(asked) == 6


def test_an_answer_that_hangs_on_the_id_or_on_all_values_is_not_taken_for_that_of_another_point():
    names, texts = Remembered(lambda point: point.id), Remembered(to_dict)
    for point in (Point(), Point(r=0.1), Point(scene="slab", t_end=1.0)):
        for _ in range(2):
            assert names(point) == point.id
            assert texts(point) == to_dict(point)


LARGE = r"""
import json, re, sys, time
from subslide.points import Point, to_dict
from subslide.study import config
axes = {"a_H": [0.5, 10, 20], "a_2": [0.3, 1.5, 16], "r": [0, 0.8, 20], "delta": [20, 40, int(sys.argv[1])]}
config.make_study({"study": "t", "a_H": [1, 2], "model": "radial"})
start = time.process_time()
study = config.make_study({"study": "t", **{key: {"linspace": form} for key, form in axes.items()}})
seconds = time.process_time() - start
start = time.process_time()
values = to_dict(Point())
for _ in study.runs:
    json.dumps(values, sort_keys=True)
ratio = seconds / (time.process_time() - start)
(kibibytes,) = re.findall(r"VmHWM:\s+(\d+)", open("/proc/self/status").read())  # ru_maxrss has the parent's too
print(len(study.runs), ratio, int(kibibytes) / 1024)
"""


@pytest.mark.parametrize("angles", [4, pytest.param(16, marks=pytest.mark.long)])
def test_many_points_are_expanded_within_seconds_and_little_memory(angles):
    """102,400 took 8.0 s and 257 MiB once, 3.7 s and 111 MiB now; JSON of as many points measures the machine."""
    done = subprocess.run(
        [sys.executable, "-c", LARGE, str(angles)], capture_output=True, text=True, check=True
    )
    count, ratio, mebibytes = map(float, done.stdout.split())
    assert count == 6_400 * angles
    assert ratio < 5
    assert mebibytes < 160
