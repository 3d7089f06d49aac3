"""The chart of error against seconds draws every run, the two methods, the front and the factor between them."""

from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest

from subslide import catalogue
from subslide.figures import work_precision
from subslide.points import Point
from subslide.study.config import make_study
from subslide.tables import work_precision as table
from subslide.tables._problems import METHOD

METHODS = {
    "default": {"model": "radial", "scheme": "ifcph", "order": 2, "seconds": 1e-3, "error": 0.04},
    "paper": {"model": "plane", "scheme": "ifcph", "order": 1, "seconds": 1.0, "error": 0.16},
    "": {"model": "quarter", "scheme": "roe", "order": 1, "seconds": 0.5, "error": 0.2},
}
ABOUT = {"a_2": 0.56, "r": 0.4, "delta": 32.0, "radius": 0.0705}
USUAL = {key: getattr(Point(), key) for key in METHOD}


def made_up(depths=(1.0, 10.0), failed=False, also=None):
    """Return a table with runs on 50, 100 and 200 cells of three methods: errors halve, seconds grow eightfold.

    also: more methods.
    """
    rows = []
    for a_H in depths:
        for quantity in table.QUANTITIES:
            some = []
            for name, method in {**METHODS, **(also or {})}.items():
                for k, cells in enumerate((50, 100, 200)):
                    lost = failed and (name, cells) == ("", 200)
                    some.append(
                        {
                            **ABOUT,
                            **USUAL,
                            **method,
                            "id": f"{a_H}{name}{cells}",
                            "a_H": a_H,
                            "quantity": quantity,
                            "cells": cells,
                            "method": name,
                            "status": "diverged" if lost else "ok",
                            "seconds": method["seconds"] * 8.0**k,
                            "error": np.nan if lost else method["error"] / 2.0**k,
                            "uncertainty": 0.001,
                        }
                    )
            table.judge(some)
            rows += some
    return SimpleNamespace(work_precision=pd.DataFrame(rows))


def panels(figure):
    """Return the panels of the chart."""
    return [ax for ax in figure.axes if ax.has_data()]


def words(figure):
    """Return the text below and above the panels."""
    return " ".join(text.get_text() for text in figure.texts).replace("\n", " ")


def test_a_panel_for_each_quantity_and_depth_on_logarithmic_scales():
    axes = panels(work_precision.draw(made_up()))
    assert len(axes) == 4 * 2
    for ax in axes:
        assert ax.get_xscale() == ax.get_yscale() == "log"
    assert [ax.get_xlabel() for ax in axes[-2:]] == ["time of a run (s)"] * 2
    assert all(ax.get_ylabel().endswith("(%)") for ax in axes[::2])
    assert axes[1].get_title() == "(b) $L_f$, $a_H$ = 10"


def test_every_run_is_a_symbol_and_methods_and_front_are_lines():
    ax = panels(work_precision.draw(made_up()))[0]
    points = {
        (x, y)
        for line in ax.get_lines()
        if line.get_linestyle() == "None"
        for x, y in zip(np.round(line.get_xdata(), 9), np.round(line.get_ydata(), 9), strict=True)
    }
    assert len(points) == 9
    strong = {line.get_color(): line for line in ax.get_lines() if line.get_linestyle() == "-"}
    np.testing.assert_allclose(strong["black"].get_ydata(), [4, 2, 1])
    np.testing.assert_allclose(strong[work_precision.STRONG["paper"]["color"]].get_ydata(), [16, 8, 4])
    front = next(line for line in ax.get_lines() if line.get_linewidth() > 3)
    np.testing.assert_allclose(np.unique(front.get_ydata()), [1, 2, 4])


def test_fitted_grids_have_a_line_and_a_marker_where_there_are_any():
    fitted = {
        "model": "radial",
        "scheme": "ifcph",
        "order": 2,
        "grid": "fitted",
        "seconds": 1e-4,
        "error": 0.02,
    }
    plain, more = (work_precision.draw(made_up(also=also)) for also in ({}, {"fitted": fitted}))
    for figure, count in ((plain, 0), (more, 1)):
        labels = [text.get_text() for legend in figure.legends for text in legend.get_texts()]
        assert sum(label.startswith("the same on a fitted grid") for label in labels) == count
        assert sum(label == "radial, fitted grid" for label in labels) == count
    color = work_precision.STRONG["fitted"]["color"]
    ax = panels(more)[0]
    (line,) = (line for line in ax.get_lines() if line.get_color() == color and line.get_linestyle() == "-")
    np.testing.assert_allclose(line.get_ydata(), [2, 1, 0.5])
    markers = {line.get_marker() for line in ax.get_lines() if line.get_linestyle() == "None"}
    assert work_precision.FITTED in markers
    assert work_precision.FITTED not in {line.get_marker() for line in panels(plain)[0].get_lines()}


def test_the_factor_is_that_at_the_error_of_the_papers_finest_grid():
    figure = work_precision.draw(made_up())
    for ax in panels(figure):
        assert [text.get_text() for text in ax.texts if "times" in text.get_text()] == ["64,000 times"]
    assert "takes at least 1,000 times as long" in words(figure)


def test_failed_runs_are_not_drawn_but_told():
    figure = work_precision.draw(made_up(failed=True))
    assert "did not end well (2 diverged)" in words(figure)
    assert "all 18 runs" in words(figure)


def test_columns_that_are_not_shown_are_told():
    figure = work_precision.draw(made_up(depths=(1.0, 2.0, 5.0, 10.0)))
    assert len(panels(figure)) == 4 * 3
    assert "not shown here: 1 more" in words(figure)


def test_what_no_run_has_gets_no_panel():
    """As of waves where the truth is on a grid that is fitted to the grains."""
    results = made_up()
    rows = results.work_precision
    rows.loc[rows["quantity"].str.contains("eta"), ["error", "sure_error", "truth"]] = np.nan
    rows.loc[(rows["quantity"] == "x_front") & (rows["a_H"] == 10), "sure_error"] = np.nan
    figure = work_precision.draw(results)
    assert [ax for ax in figure.axes if ax.get_visible()] == panels(figure)
    assert len(panels(figure)) == 3


def test_a_study_without_the_table_gets_an_empty_figure():
    figure = work_precision.draw(SimpleNamespace(work_precision=pd.DataFrame()))
    assert "no such run" in figure.get_suptitle()


@pytest.mark.parametrize(("value", "rounded"), [(1999.0, 1900), (64000.0, 64000), (7.9, 7), (123.0, 120)])
def test_factors_are_rounded_down(value, rounded):
    assert work_precision._round(value) == rounded


def test_only_studies_with_a_sweep_have_the_figure():
    assert catalogue.figure("work_precision").needs["model"] == ("plane", "radial")
    sweep = {"study": "t", "model": ["radial", "plane"], "order": [1, 2]}
    assert "work_precision" in make_study(sweep).figures
    assert "work_precision" not in make_study({"study": "t"}).figures
