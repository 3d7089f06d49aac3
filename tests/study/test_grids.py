"""Runs on unlike grids, and on grids that move: in one record, out of it as they were, in tables and in words."""

import dataclasses
import math

import netCDF4
import numpy as np
import pytest
import xarray as xr
from fitted import WAVES, fitted
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from subslide import exact, jobs, solver
from subslide.pages import report
from subslide.points import Point
from subslide.records import by_run, thinning
from subslide.records import netcdf as records
from subslide.records import variables as layout
from subslide.results import open_record, positions, trimmed
from subslide.study import config
from subslide.tables import _norms

ARRAYS = ("time", "x_front", "max_abs_eta", "snapshot_time", "h2", "eta")
PROFILES = ("h2", "eta", "h2_diagonal", "h2_field", "eta_field")

still = st.tuples(
    st.just("uniform"), st.integers(10, 30), st.integers(0, 9), st.sampled_from(("radial", "plane"))
)
moving = st.tuples(st.just("fitted"), st.integers(2, 60), st.integers(1, 6), st.integers(0, 99))


def made(make_run, kinds):
    """Runs of the kinds that were drawn: uniform ones of some cells and sea, fitted ones of cells and snapshots."""
    runs = []
    for n, (kind, cells, size, more) in enumerate(kinds):
        if kind == "uniform":
            runs.append(make_run(Point(cells=cells, a_H=n + 1.0, model=more), steps=3 + n, grown=size))
        else:
            runs.append(fitted(make_run(Point(cells=20, a_H=n + 1.0)), more, size, cells))
    return runs


def volumes(x, width, h2):
    """Volume of grains at each snapshot, on a radius."""
    return (2 * np.pi * x * width * h2).sum(axis=-1)


@settings(max_examples=15, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(kinds=st.lists(still | moving, min_size=1, max_size=5))
def test_every_run_comes_back_as_it_was_whatever_is_beside_it(tmp_path, make_run, kinds):
    runs = made(make_run, kinds)
    path = tmp_path / "b.nc"
    records.write(path, runs)
    ids = [run.point.id for run in runs]
    arrays = by_run.read(path, ids, ("x", "cell_width", "h2_diagonal", *ARRAYS))
    with open_record(path) as data:
        for run in runs:
            one, plain = trimmed(data, run.point.id), arrays[run.point.id]
            for name in ARRAYS:
                np.testing.assert_array_equal(plain[name], getattr(run, name), err_msg=name)
                np.testing.assert_array_equal(one[name], getattr(run, name), err_msg=name)
            np.testing.assert_allclose(plain["x"], run.x, rtol=1e-15)
            np.testing.assert_array_equal(plain["x"], one["x"])
            for n in range(len(run.snapshot_time)):
                np.testing.assert_array_equal(positions(one, n), positions(plain, n))
            assert ("cell_width" in plain) == ("cell_width" in one) == (run.grid == "fitted")
            if run.grid == "fitted":
                assert one["h2"].dims == one["x"].dims == ("snapshot", "cell")
                there = volumes(plain["x"], plain["cell_width"], plain["h2"])
                np.testing.assert_array_equal(there, volumes(run.x, run.width, run.h2))
            else:
                assert one["h2"].dims == ("snapshot", "x")
                if run.h2_diagonal is not None:
                    np.testing.assert_array_equal(plain["h2_diagonal"], run.h2_diagonal)


@settings(max_examples=8, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(kind=still, others=st.lists(moving, min_size=1, max_size=3))
def test_a_run_on_a_uniform_grid_reads_alike_alone_and_beside_others(tmp_path, make_run, kind, others):
    runs = made(make_run, [kind, *others])
    answers = []
    for name, some in (("alone", runs[:1]), ("beside", runs)):
        records.write(tmp_path / f"{name}.nc", some)
        with open_record(tmp_path / f"{name}.nc") as data:
            answers.append(trimmed(data, runs[0].point.id).load())
    xr.testing.assert_allclose(*answers, rtol=1e-15, atol=0)


@settings(max_examples=40, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    cells=st.integers(10, 30), seas=st.lists(st.integers(0, 9), min_size=1, max_size=4), plane=st.booleans()
)
def test_runs_on_one_uniform_grid_have_the_layout_of_before(make_run, cells, seas, plane):
    points = [Point(cells=cells, a_H=n + 1.0) for n in range(len(seas))]
    runs = [make_run(point, grown=grown) for point, grown in zip(points, seas, strict=True)]
    if plane:
        runs.append(make_run(Point(cells=cells, model="plane", fields=True, a_H=9.0)))
    record = layout.variables(runs)
    first = -round(4.2553 * 0.0705 / runs[0].dx) if plane else 0
    last = max(len(run.x) if run.x[0] > 0 else len(run.x) // 2 for run in runs)
    np.testing.assert_array_equal(record["x"].values, (np.arange(first, last) + 0.5) * runs[0].dx)
    assert record["x"].attrs.keys() == {"units", "long_name"}  # by an axis, readers take it for a longitude
    assert "cell_width" not in record
    assert not any("cell" in variable.dims for variable in record.values())
    for name in PROFILES:
        if name not in record:
            continue
        variable = record[name]
        assert variable.dims == ("run", "snapshot", *(["y", "x"] if "field" in name else ["x"]))
        assert variable.attrs["coordinates"] == "id a_H a_2 r delta snapshot_time"
        for n, run in enumerate(runs):
            values, kept = variable.values[n], getattr(run, name)
            start = round(run.x[0] / run.dx - 0.5) - first
            part = slice(start, start + len(run.x))
            where = (..., *[part] * (variable.values.ndim - 2))
            if kept is not None:
                np.testing.assert_array_equal(values[where], kept)
            assert np.isfinite(values).sum() == (0 if kept is None else kept.size)


def test_a_volume_is_the_sum_of_its_rings(tmp_path):
    """Of a solved run, its cells joined by ones, twos and threes in another order at each snapshot."""
    run = solver.solve(Point(cells=60, t_end=0.2, snapshot_times=(0.05, 0.1), boundary="wall"))
    random, count = np.random.default_rng(2), len(run.x)
    sizes = [random.permutation([1, 2, 3] * (count // 6) + [1] * (count % 6)) for _ in run.snapshot_time]
    first = np.cumsum(sizes, axis=1) - sizes
    width = run.dx * np.array(sizes)
    x = run.dx * first + width / 2
    rings = [np.add.reduceat(run.x * run.dx * h2, start) for h2, start in zip(run.h2, first, strict=True)]
    joined = dataclasses.replace(run, x=x, width=width, h2=rings / (x * width), eta=x * np.nan)
    joined = dataclasses.replace(joined, grid="fitted", dx=np.nan)
    records.write(tmp_path / "a.nc", [thinning.thinned(joined)])
    with open_record(tmp_path / "a.nc") as data:
        one = trimmed(data, run.point.id)
        there = np.interp(one["snapshot_time"], one["time"], one["sediment_volume"])
        np.testing.assert_allclose(volumes(one["x"], one["cell_width"], one["h2"]), there, rtol=1e-12)


def test_positions_on_unlike_grids_are_coordinates_by_the_conventions(tmp_path, make_run):
    runs = [
        fitted(make_run(Point(a_H=1.0))),
        make_run(Point(cells=20, a_H=2.0)),
        make_run(Point(cells=30, a_H=3.0)),
    ]
    records.write(tmp_path / "b.nc", runs)
    with netCDF4.Dataset(tmp_path / "b.nc") as data:
        for name in ("x", "cell_width", "h2", "eta"):
            assert data[name].dimensions == ("run", "snapshot", "cell")
            assert np.isnan(data[name]._FillValue)
            assert data[name].units == "m"
        for name in ("h2", "eta", "cell_width"):
            assert data[name].coordinates == "id a_H a_2 r delta snapshot_time x"
        assert data["x"].coordinates == "id a_H a_2 r delta snapshot_time"
        assert np.isnan(data["dx"][0])
        assert list(data["grid"][:]) == ["fitted", "uniform", "uniform"]
    with open_record(tmp_path / "b.nc") as data:
        assert {"x", "snapshot_time", "id"} <= set(data["h2"].coords)


def test_a_single_fitted_run_states_its_grid(tmp_path, make_run):
    records.write(tmp_path / "a.nc", [fitted(make_run(Point()), grid_reason="auto: grains alone")])
    _, attrs = records.read(tmp_path / "a.nc")
    assert (attrs["grid"], attrs["grid_reason"]) == ("fitted", "auto: grains alone")


def test_a_position_that_was_changed_is_noticed(tmp_path, make_run):
    records.write(tmp_path / "a.nc", [fitted(make_run(Point()))])
    with netCDF4.Dataset(tmp_path / "a.nc", "a") as data:
        data["x"][0, 1, 2] += 1e-15
    with pytest.raises(records.RecordError, match="checksum"):
        records.read(tmp_path / "a.nc")


@pytest.mark.parametrize("other", [fitted, lambda run: run])
def test_fields_over_the_plane_need_one_grid(tmp_path, make_run, other):
    runs = [make_run(Point(cells=20, model="plane", fields=True)), other(make_run(Point(a_H=3.0)))]
    with pytest.raises(ValueError, match="fields over the plane need one cell size"):
        records.write(tmp_path / "b.nc", runs)
    assert list(tmp_path.iterdir()) == []


@pytest.fixture
def study(tmp_path, make_run, solve_study, write_tables):
    """Results of a study with bands of two columns, the second on a fitted grid, and all tables."""

    def finish(**values):
        asked = {"study": "t", "model": "radial", "cells": 80, "a_H": [1, 2], "bands": True, **values}

        def solve(points):
            return [fitted(make_run(p), cells=p.cells) if p.a_H == 2 else make_run(p) for p in points]

        solve_study(config.make_study(asked), tmp_path, solve)
        return write_tables(tmp_path)

    return finish


@pytest.mark.parametrize("boundary", ["wall", "open", "paper"])
def test_what_a_fitted_run_lacks_is_empty_in_tables(study, boundary):
    results = study(boundary=boundary)
    rows = results.runs.set_index("a_H")
    assert rows["resolved_grid"].to_dict() == {1: "uniform", 2: "fitted"}
    lacking = ["dx", *(f"{name}_peak" for name in WAVES), *(f"{name}_peak_time" for name in WAVES)]
    assert rows.loc[1, lacking].notna().all()
    assert rows.loc[2, lacking].isna().all()
    assert rows.loc[2, "L_f_1pc"] == rows.loc[1, "L_f_1pc"]
    assert rows.loc[2, "sediment_volume_error"] == 0
    ids = rows["id"]
    of_fitted = results.series[results.series["id"] == ids[2]]["quantity"]
    assert not set(WAVES) & set(of_fitted)
    assert "x_front_1pc" in set(of_fitted)
    assert results.table("timing").set_index("id").loc[ids[2], "cells_in_box"] == 80
    assert not results.bands[results.bands["id"] == ids[2]]["quantity"].str.contains("eta").any()
    assert results.record(ids[2])["h2"].dims == ("snapshot", "cell")


def test_the_report_of_fitted_runs_leaves_waves_out(study, tmp_path):
    page = report.text(study(a_H=[2]), tmp_path)
    assert "Final length L_f over R" in page
    assert "eta_gauge_peak</th>" not in page
    assert ">nan" not in page.lower()
    assert "eta_gauge_peak</th>" in report.text(study(a_H=[1]), tmp_path)


def test_the_line_on_a_fitted_run_names_its_grid_and_no_wave(make_run):
    text = jobs.summary(fitted(make_run(Point()), grid_reason="auto: grains alone asked for"))
    assert "fitted grid (auto: grains alone asked for)" in text
    assert "nan" not in text
    assert "η" not in text
    assert "grid" not in jobs.summary(make_run(Point()))


PARABOLOID = Point(scene="paraboloid", model="one-layer", r=0.0, a_H=0.0, delta=0.0, boundary="wall")


def paraboloid_record(width, shift=0.0):
    """Variables of a run of the paraboloid on cells of these widths (snapshots, cells), off by a share of H2."""
    x = np.cumsum(width, axis=1) - width / 2
    record = {
        "x": x,
        "cell_width": width,
        "dx": math.nan,
        "snapshot_time": np.arange(len(x)) * 0.1,
        "model": "radial",
    }
    answer = exact.load("paraboloid")
    known = [_norms.cell_means(answer, PARABOLOID, record, t)["h2"] for t in record["snapshot_time"].tolist()]
    height = PARABOLOID.column_height
    return {**record, "h2": np.array(known) + shift * height, "eta": np.full(x.shape, np.nan)}


def test_errors_on_cells_of_one_size_are_those_of_a_uniform_grid():
    width = np.full((2, 90), 0.004)
    moving = paraboloid_record(width, 0.01)
    still = {**moving, "x": moving["x"][0], "dx": 0.004}
    answer = exact.load("paraboloid")
    there, here = (dict(_norms.errors_at(answer, PARABOLOID, record, 0.1)) for record in (moving, still))
    assert there.keys() == here.keys() == {"h2"}
    assert there["h2"] == pytest.approx(here["h2"], rel=1e-12)
    assert there["h2"] > 0.01


def test_errors_weigh_cells_of_unlike_sizes_by_their_rings():
    width = 0.01 * np.random.default_rng(1).uniform(0.1, 1, (2, 90))
    record = paraboloid_record(width, 0.01)
    ((quantity, error),) = _norms.errors_at(exact.load("paraboloid"), PARABOLOID, record, 0.1)
    rings = 2 * np.pi * record["x"][1] * width[1]
    off = 0.01 * PARABOLOID.column_height
    assert quantity == "h2"
    assert error == pytest.approx(off * rings.sum() / (rings * (record["h2"][1] - off)).sum(), rel=1e-12)
    (_, none) = next(_norms.errors_at(exact.load("paraboloid"), PARABOLOID, record, 0.07))
    assert math.isnan(none)
