"""Notes on runs: each is earned by a run, and what is said to be without effect changes nothing."""

import re

import numpy as np
import pytest

from subslide import naming
from subslide.__main__ import main
from subslide.kernels import viscosity
from subslide.keys import words
from subslide.keys.entries import ENTRIES
from subslide.keys.values import default_of
from subslide.points import Point
from subslide.records.thinning import kept
from subslide.solver import solve
from subslide.study import config, notes

NOTES = {note.name: note for note in notes.NOTES}


def error(point):
    """Error of L_f at the run's cells against that on 1,600 cells, over R."""
    return abs(solve(point).L_f[0] - runout(point)) / point.radius


def runout(point):
    """L_f on 1,600 cells."""
    return solve(point.with_values(cells=1600)).L_f[0]


def fine(point):
    """L_f on a uniform grid of 1,600 cells."""
    return solve(point.with_values(grid="uniform", cells=1600)).L_f[0]


HARM = {
    "range": lambda point: error(point) > 0.2 * (runout(point) / point.radius - 1),  # of the way run
    "coarse grid": lambda point: error(point) > 0.15 * runout(point) / point.radius,
    "coarse fitted grid": lambda point: abs(solve(point).L_f[0] / fine(point) - 1) > 0.02,
    "no wave": lambda point: np.isnan(solve(point).max_abs_eta).all(),
    "standing column": lambda point: solve(point).time_at_rest == 0,
}


@pytest.mark.parametrize("name", NOTES)
def test_a_note_is_earned_and_its_advice_mends(name):
    note = NOTES[name]
    wrong, right = (config.make_point(values) for values in (note.example, note.example | note.instead))
    assert note.holds(wrong)
    assert HARM[name](wrong)
    if name != "range":
        assert not note.holds(right)
    assert not HARM[name](right)
    assert any(note.reason in line for line in notes.notes([wrong]))


def test_the_range_is_that_of_the_readme(root):
    said = (root / "README.md").read_text(encoding="utf-8").replace("\n", " ")
    for key, (low, high) in notes.VOUCHED.items():
        assert re.search(rf"{low:g} <= {key} <= {high:g}\b", said), key


def test_the_schemes_with_a_front_are_those_of_the_kernels():
    assert tuple(filter(viscosity.takes_exact_front, ENTRIES["scheme"]["enum"])) == notes.FRONTS


@pytest.mark.parametrize(
    ("key", "value", "others"),
    [
        ("front_flux", "hll", {"scheme": "hll"}),
        ("front_flux", "hll", {"scheme": "ifcp"}),
        ("front_flux", "hll", {"scheme": "rusanov", "model": "one-layer", "r": 0.0}),
        ("scheme", "roe", {"model": "one-layer", "r": 0.0}),
        ("wave_speeds", "approximate", {"model": "one-layer", "r": 0.0}),
        ("treatment", "hll", {"scheme": "hll", "a_H": 0.5, "r": 0.6, "delta": 20.0, "cells": 400}),
        ("treatment", "friction", {"r": 0.0}),
        ("treatment", "stop", {"model": "one-layer", "r": 0.0}),
        ("xi", 10.0, {}),
        ("xi", 10.0, {"friction": "pouliquen"}),
        ("delta_2", 60.0, {"friction": "voellmy"}),
        ("pouliquen_length", 0.1, {}),
    ],
)
def test_what_is_without_effect_changes_nothing_and_is_said(key, value, others):
    plain = Point(**{"cells": 60, "t_end": 0.2, **others})
    asked = plain.with_values(**{key: value})
    (line,) = notes.notes([asked])
    assert f": {key}, such as {value}" in line.replace("10,", "10.0,")
    assert not notes.notes([plain])
    one, two = solve(plain), solve(asked)
    for name in naming.SERIES:
        np.testing.assert_allclose(getattr(one, name), getattr(two, name), rtol=1e-9, atol=1e-12)


@pytest.mark.parametrize(
    "values",
    [
        {"front_flux": "hll"},
        {"wave_speeds": "approximate"},
        {"treatment": "friction", "a_H": 0.5, "r": 0.6, "delta": 20.0, "cells": 400},
        {"friction": "voellmy", "xi": 10.0},
        {"friction": "pouliquen", "delta_2": 60.0},
    ],
)
def test_what_has_an_effect_is_not_said_to_have_none(values):
    point = Point(**{"cells": 60, "t_end": 0.2, **values})
    assert not notes.notes([point])
    key = next(key for key in ("xi", "delta_2", *values) if key in values)
    plain = point.with_values(**{key: default_of(key)})
    assert solve(point).energy[-1] != solve(plain).energy[-1]


def test_ifcp_of_grains_alone_is_hll():
    one, two = (
        solve(Point(scheme=s, model="one-layer", r=0.0, cells=60, t_end=0.2)) for s in ("ifcp", "hll")
    )
    assert notes.notes([one.point])
    assert not notes.notes([two.point])
    np.testing.assert_array_equal(one.energy, two.energy)


def test_a_sweep_says_it_once():
    points = [Point(scheme=scheme, front_flux="hll") for scheme in ("hll", "ifcph", "rusanov")]
    (line,) = notes.notes(points)
    assert "(2 of 3 runs)" in line
    assert len(f"subslide: {line}") <= words.MOST
    assert not notes.notes([Point(scheme=scheme) for scheme in ENTRIES["scheme"]["enum"]])
    for note in NOTES.values():
        text = f"subslide: caution, {note.name} (200000 of 200000 runs): {note.reason}. Choose {note.advice}."
        assert len(text) <= words.MOST


@pytest.mark.parametrize(
    ("keep", "asked", "advice"),
    [
        ("summary", "gauges", "series"),
        ("summary", "fields and gauges", "all"),
        ("series", "fields and footprints", "all"),
        ("series", "", ""),
        ("all", "", ""),
    ],
)
def test_what_records_do_not_keep_is_said_and_so_it_is(keep, asked, advice):
    keys = {"gauges": ((0.1, 0.0),), "fields": True, "footprints": True}
    wanted = [key for key in keys if key in asked] or ["gauges"] * (keep != "summary")
    point = Point(cells=20, t_end=0.02, model="quarter", **{key: keys[key] for key in wanted})
    lines = notes.unkept([Point(), point], keep)
    assert [line.split("asked for by ")[1] for line in lines] == [f"{asked}; keep: {advice} has it"] * bool(
        asked
    )
    run = solve(point, profiles=keep == "all")
    names = {"gauges": "gauge_h2", "footprints": "largest_h2_field"}
    lost = [key for key, name in names.items() if key in wanted and name not in kept(run, keep).measured]
    assert lost == [key for key in names if key in asked]


def test_check_says_what_a_study_does_not_keep(write_yaml, capsys):
    path = write_yaml("study: t\nkeep: summary\ngauges: [[0.1, 0]]\n")
    assert main(["check", str(path)]) == 0
    assert (
        "keep: summary leaves out what is asked for by gauges; keep: series has it" in capsys.readouterr().err
    )
