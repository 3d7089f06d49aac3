"""Gauges, footprints and runout by direction: in records of like and unlike runs, as options, and over a sweep."""

import numpy as np
import pytest
import xarray as xr

from subslide import jobs, naming, solver
from subslide.__main__ import main
from subslide.points import Point
from subslide.records import netcdf, thinning
from subslide.results import open_record
from subslide.study import choice, config

SHORT = {"cells": 40, "t_end": 0.05, "snapshot_times": (0.0,)}
GAUGES = ((0.1, 0.0), (0.05, -0.05))
WATCHED = {"gauges": GAUGES, "footprints": True, "runout_directions": 8}


@pytest.fixture(scope="module")
def runs():
    """One run that is asked for all, one for other gauges and directions, one for nothing."""
    asked = (WATCHED, {"gauges": GAUGES[1:], "runout_directions": 12, "a_H": 2.0}, {"a_H": 3.0})
    return [solver.solve(Point(**SHORT, **more)) for more in asked]


def test_a_record_holds_what_each_run_was_asked_for(tmp_path, runs):
    netcdf.write(tmp_path / "a.nc", runs)
    with open_record(tmp_path / "a.nc") as data:
        for name in (*naming.GAUGES, *naming.LARGEST, *naming.RUNOUT):
            assert data[name].dims == naming.MEASURED[name].dims
            assert data[name].attrs["units"] == naming.MEASURED[name].unit
            assert np.isnan(data[name].values[2]).all()
        np.testing.assert_array_equal(data["gauge_x"], [[0.1, 0.05], [0.05, np.nan], [np.nan] * 2])
        np.testing.assert_array_equal(data["gauge_y"], [[0.0, -0.05], [-0.05, np.nan], [np.nan] * 2])
        for n, run in enumerate(runs[:2]):
            gauges, samples = len(run.point.gauges), len(run.time)
            series = data["gauge_eta"].values[n]
            np.testing.assert_array_equal(series[:gauges, :samples], run.measured["gauge_eta"])
            assert np.isnan(series[gauges:]).all()
            by_angle = data["runout"].sel(direction=run.directions).values[n]
            np.testing.assert_array_equal(by_angle, run.measured["runout"])
        assert list(data["direction"]) == sorted({*runs[0].directions, *runs[1].directions})
        assert np.isfinite(data["runout"].values[1]).sum() == 3 * 12
        assert {"time", "gauge_x", "gauge_y"} <= set(data["gauge_u2"].coords)


def test_a_record_of_runs_that_ask_for_nothing_is_as_it_was(tmp_path, runs):
    netcdf.write(tmp_path / "a.nc", runs[2:])
    variables, _ = netcdf.read(tmp_path / "a.nc")
    assert not {*naming.MEASURED, "gauge_x", "gauge_y", "direction", "y", "gauges", "footprints"} & {
        *variables
    }


@pytest.mark.parametrize(
    ("keep", "kept"),
    [("series", {*naming.GAUGES, *naming.RUNOUT}), ("summary", {*naming.RUNOUT})],
)
def test_less_is_kept_of_a_run_that_keeps_less(runs, keep, kept):
    short = thinning.kept(runs[0], keep)
    assert set(short.measured) == kept
    assert set(runs[0].measured) == {*naming.GAUGES, *naming.LARGEST, *naming.RUNOUT}
    assert set(jobs.solved(runs[0].point, 1, keep=keep).measured) == kept


def test_gauges_are_thinned_with_the_series(runs, monkeypatch):
    monkeypatch.setattr(thinning, "HEAD", 4)
    monkeypatch.setattr(thinning, "LONGEST", 45)
    run = solver.solve(Point(cells=200, t_end=0.2, gauges=GAUGES))
    short = thinning.thinned(run)
    places = np.searchsorted(run.time, short.time)
    assert len(short.time) < len(run.time)
    np.testing.assert_array_equal(short.measured["gauge_u2"], run.measured["gauge_u2"][:, places])


def test_options_of_run(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    options = ("--gauges", "0.1,0; 0.05,-0.05", "--runout-directions", "8", "--footprints")
    assert (
        main(["run", "--cells", "40", "--t-end", "0.05", "--snapshot-times", "0", *options, "-o", "a.nc"])
        == 0
    )
    assert "R, runout up to 0." in capsys.readouterr().out
    with xr.open_dataset("a.nc") as data:
        np.testing.assert_array_equal(data["gauge_x"][0], [0.1, 0.05])
        np.testing.assert_array_equal(data["gauge_y"][0], [0.0, -0.05])
        assert data["runout"].shape == (1, 3, 8)
        assert data["largest_abs_eta"].shape == data["h2"].isel(snapshot=0).shape
    for text in ("0.1", "0.1,0;", "0.1,0,0", "a,b", "0.1,0;0.1,0", "9,9"):
        capsys.readouterr()
        assert main(["run", "--gauges", text, "-o", "b.nc"]) == 2
        said = capsys.readouterr().err.strip().splitlines()
        assert "gauges" in said[-1]
        assert "allowed" in said[-1]


def test_a_sweep_that_needs_the_plane_has_fields_throughout():
    text = {
        "study": "t",
        "scene": "ellipse",
        "scene_options": {"elongation": [1, 2], "angle": [0, 30]},
        "fields": True,
    }
    study = config.make_study({**text, "cells": 40})
    models = [choice.of(point).model for point in study.points]
    assert models == ["quarter", "quarter", "quarter", "plane"]
    assert choice.of(study.points[0]).reason == "auto: round scene, fields asked for"
    assert choice.of(study.points[2]).reason == "auto: scene with two mirrors"
    run = solver.solve(study.points[0].with_values(**SHORT))
    assert run.h2_field.shape == (2, len(run.x), len(run.x))
    assert choice.of(Point(fields=False)).model == "radial"


def test_a_large_study_with_gauges_keeps_their_series(monkeypatch):
    monkeypatch.setattr(config, "MOST_KEPT_WHOLE", 2)
    study = {"study": "t", "a_H": [1, 2, 3]}
    assert config.make_study(study).keep == "summary"
    assert config.make_study({**study, "gauges": [[0.1, 0]]}).keep == "series"
    assert config.make_study({**study, "gauges": [[0.1, 0]], "keep": "summary"}).keep == "summary"
