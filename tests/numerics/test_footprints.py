"""Footprints: what every step's field holds, joined, on any model, and on a sea that grows."""

import numpy as np
import pytest

from subslide import naming, solver
from subslide.kernels import clock as k
from subslide.models.build import build
from subslide.points import Point
from subslide.solver import DRY_DEPTH, first_box, solve
from subslide.solver.loop import Samples, thresholds

END = 0.12
SCENES = {
    "plane": {"scene": "ellipse", "scene_options": (("angle", 30.0), ("elongation", 2.0))},
    "quarter": {"model": "quarter"},
    "radial": {},
}


def point_of(kind, **values):
    """Return a short run with footprints."""
    return Point(
        **{"cells": 100, "t_end": END, "snapshot_times": (END,), "footprints": True, **SCENES[kind], **values}
    )


def every_step(point):
    """Return time, h2 and |eta| (cells along x last), scaled, of every step of a run, by a loop of its own."""
    model = build(point, first_box(point), DRY_DEPTH)
    clock, kept, states = k.started(END / point.time_scale), Samples(), []

    def state():
        fields = model.fields() or model.profile()
        return float(clock[k.NOW]), fields["h2"], np.abs(fields["eta"])

    states.append(state())
    while clock[k.NOW] < clock[k.STOP]:
        model.advance(thresholds(model), kept.track(clock, 2))
        states.append(state())
    return states


@pytest.mark.parametrize("kind", SCENES)
def test_footprints_are_those_of_every_steps_field(kind):
    point = point_of(kind)
    run, states = solve(point), every_step(point)
    assert len(states) == run.steps + 1 > 20
    suffix = "" if kind == "radial" else "_field"
    part = (slice(len(run.x)),) * (1 if kind == "radial" else 2)
    for name, place in (("h2", 1), ("eta", 2)):
        seen = np.array([state[place][part] for state in states])
        largest = run.measured[f"largest_{'abs_' * (name == 'eta')}{name}{suffix}"]
        np.testing.assert_allclose(largest, point.column_height * seen.max(axis=0), rtol=1e-6, atol=0)
        came = (seen >= 0.01).any(axis=0)
        first = np.array([state[0] for state in states])[(seen >= 0.01).argmax(axis=0)] * point.time_scale
        arrival = run.measured[f"arrival_{name}{suffix}"]
        np.testing.assert_allclose(arrival, np.where(came, first, np.nan), rtol=1e-6, atol=0)
        assert came.any()
        assert not came.all()


def test_they_stay_where_they_are_as_the_sea_grows(monkeypatch):
    long = solve(point_of("radial", t_end=0.3))
    monkeypatch.setattr(solver, "first_box", lambda point: point.half_cells)
    grown = solve(point_of("radial", t_end=0.3))
    for name in naming.LARGEST:
        np.testing.assert_array_equal(grown.measured[name], long.measured[name])


def test_a_radius_has_those_of_a_plane():
    """Along x, to what a square grid of 60 cells differs by."""
    radius, quarter = solve(point_of("radial")), solve(point_of("quarter"))
    along = quarter.measured["largest_h2_field"][0]
    away = np.abs(radius.x - 0.0705) > 0.02  # the step of the column's side is one cell wide
    np.testing.assert_allclose(radius.measured["largest_h2"][away], along[away], atol=0.06 * 0.0395)
