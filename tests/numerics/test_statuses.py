"""Each status of the contract, reached by a real run where one can reach it, else by a state put in by hand."""

import time

import numpy as np
import pytest
from states import advance, axial

from subslide.kernels import clock as k
from subslide.naming import STATUSES
from subslide.solver import ENDED, loop, solve
from subslide.study.config import make_point

SHEAR = {"scene": "shear", "boundary": "periodic", "delta": 0, "cells": 60, "t_end": 0.1}
REACHED = {
    "ok": {},
    "not_at_rest": {"as_printed": "friction"},
    "left_domain": {"delta": 0},
    "step_collapse": {"cfl": 3, "delta": 0, "boundary": "wall", "cells": 100, "order": 1},
    "hyperbolicity_lost": {**SHEAR, "scene_options": {"shear": 1.5}, "treatment": "stop"},
}
"""A run for each status that a real run was seen to end in."""
NEVER = ("diverged", "negative_depth")
"""Statuses that none of the atlas's thousands of runs ends in: depths stay non-negative by what leaves a cell, and the
time step collapses long before a speed overflows."""


def test_every_status_is_here():
    assert {*REACHED, *NEVER} == set(STATUSES)


@pytest.mark.parametrize("status", REACHED)
def test_a_real_run_reaches(status):
    run = solve(make_point({"cells": 40, **REACHED[status]}))
    assert run.status == status
    assert np.isfinite(run.time).all()
    if status == "ok":
        assert run.status_detail == ""
        assert np.isfinite(run.L_f).all()
    else:
        assert STATUSES[status] in run.status_detail
        assert "step" in run.status_detail
    if status not in ("ok", "not_at_rest"):
        assert np.isnan(run.L_f).all()


def test_below_the_limit_of_hyperbolicity_treatment_stop_does_not_stop():
    run = solve(make_point({**SHEAR, "scene_options": {"shear": 0.9}, "treatment": "stop"}))
    assert run.status == "ok"
    assert run.nonhyperbolic_cells.max() == 0


@pytest.mark.parametrize(
    ("code", "status", "h2"), [(k.NOT_FINITE, "diverged", np.nan), (k.NEGATIVE, "negative_depth", -0.5)]
)
def test_a_state_put_in_by_hand_reaches(code, status, h2):
    model = axial(np.linspace(0, 1, 21), 1.0, 0.0, np.where(np.arange(20) == 7, h2, 1.0), 0.0, level=2.0)
    samples, outcome = advance(model, stop=1.0)
    assert outcome == code
    assert ENDED[outcome] == status
    assert len(samples) == 1
    assert "cell 7" in model.suspect()


def test_compiling_is_said_once(monkeypatch, capsys):
    """A loop that takes long to load says so; the same compiled code says it no more."""

    class Slow:
        settings, level = (), np.float64(1)

        def advance(self, thresholds, track):
            time.sleep(0.2)

    monkeypatch.setattr(loop, "PATIENCE", 0.05)
    monkeypatch.setattr(loop, "_loaded", set())
    loop.warm_up(Slow())
    assert capsys.readouterr().err == loop.COMPILING + "\n"
    loop.warm_up(Slow())
    assert capsys.readouterr().err == ""
