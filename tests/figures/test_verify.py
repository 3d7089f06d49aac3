"""Figures of verification draw every case, solver and order, and the exact profile."""

import importlib

import numpy as np
import pandas as pd
import pytest
import xarray as xr

from subslide import catalogue, exact
from subslide.points import options_text
from subslide.results import StudyRun
from subslide.study.config import make_study

CASES = [
    {"scene": "standing_wave", "boundary": "wall", "r": 0.4},
    {"scene": "dam_break", "boundary": "wall", "r": 0, "model": "one-layer"},
    {"scene": "paraboloid", "r": 0, "model": "radial"},
]


class MadeUp:
    """A study of three cases, whose errors fall at the order of their scheme and whose profiles are exact."""

    def __init__(self):
        study = make_study(
            {
                "study": "t",
                "cases": CASES,
                "delta": 0,
                "scheme": ["ifcph", "hll"],
                "order": [1, 2],
                "cells": [40, 80],
                "t_end": 0.1,
            }
        )
        models = {"standing_wave": "line", "dam_break": "one-layer", "paraboloid": "radial"}
        self.runs_of_study = [StudyRun(point.id, label, point, "") for label, point in study.runs]
        self.all = {point.id: point for point in study.points}
        self.runs = pd.DataFrame({"id": point.id, "dx": point.dx} for point in study.points)
        self.errors = pd.DataFrame(
            {
                "id": point.id,
                "scene": point.scene,
                "options": options_text(point),
                "scheme": point.scheme,
                "order": point.order,
                "model": models[point.scene],
                "cells": point.cells,
                "time": 0.1,
                "quantity": "h2",
                "error": point.cells**-point.order,
            }
            for point in study.points
        )

    def profiles(self, name):
        """Return the record of one run, which has profiles."""
        point = self.all[name]
        half = point.cells // 2
        x = (np.arange(0 if point.scene == "paraboloid" else -half, half) + 0.5) * point.dx
        h2 = [exact.load(point.scene).solution(point, x, time)["h2"] for time in (0.0, 0.1)]
        return xr.Dataset({"h2": (("snapshot", "x"), np.array(h2))}, {"x": x})


def draw(name):
    """Return the figure called `name` of the made-up study."""
    return importlib.import_module(f"subslide.figures.{name}").draw(MadeUp())


def test_a_line_for_each_solver_and_order_and_two_slopes():
    axes = [ax for ax in draw("verify_orders").axes if ax.has_data()]
    assert [ax.get_title() for ax in axes] == [
        "(a) surface wave, on a line",
        "(b) Ritter, grains alone",
        "(c) paraboloid, under water",
    ]
    for ax in axes:
        lines = ax.get_lines()
        assert len(lines) == 2 * 2 + 2
        slopes = [np.ptp(np.log(line.get_ydata())) / np.ptp(np.log(line.get_xdata())) for line in lines]
        np.testing.assert_allclose(np.sort(slopes), [1, 1, 1, 2, 2, 2], rtol=1e-6)
        assert ax.get_xscale() == ax.get_yscale() == "log"


def test_profiles_of_two_grids_and_orders_lie_on_the_exact_one():
    axes = [ax for ax in draw("verify_profiles").axes if ax.has_data()]
    assert len(axes) == 3
    for ax in axes:
        known, *solved = ax.get_lines()
        assert len(solved) == 4
        for line in solved[1::2]:
            size = np.ptp(known.get_ydata())
            near = np.interp(line.get_xdata(), known.get_xdata(), known.get_ydata())
            np.testing.assert_allclose(line.get_ydata(), near, atol=0.1 * size)


@pytest.mark.parametrize("name", ["verify_orders", "verify_profiles"])
def test_runs_without_one_size_of_cells_are_left_out(name):
    study = MadeUp()
    study.runs.loc[study.runs["id"].isin(study.errors["id"][study.errors["scene"] == "paraboloid"]), "dx"] = (
        np.nan
    )
    figure = importlib.import_module(f"subslide.figures.{name}").draw(study)
    titles = [ax.get_title() for ax in figure.axes if ax.has_data()]
    assert titles == ["(a) surface wave, on a line", "(b) Ritter, grains alone"]


@pytest.mark.parametrize("name", ["verify_orders", "verify_profiles"])
def test_only_studies_with_these_scenes_have_the_figures(name):
    assert catalogue.figure(name).needs == {"scene": ("dam_break", "paraboloid", "standing_wave")}
    assert name in make_study({"study": "t", "cases": CASES, "delta": 0}).figures
    assert name not in make_study({"study": "t"}).figures
