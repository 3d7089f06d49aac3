"""Records that open as one dataset: by xarray alone, and by `open_study`."""

import re
import shutil
import subprocess
import sys
import warnings
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from fitted import fitted

import subslide
from subslide import naming
from subslide.checksums import seal
from subslide.files import RecordError
from subslide.keys.schema import ConfigError
from subslide.points import Point
from subslide.records import netcdf, thinning
from subslide.results import Results, alike
from subslide.results.scaled import interpolated
from subslide.study import config
from subslide.study.pruning import prune

MINE = {"study": "mine", "model": "radial", "cells": 40}
MIXED = {"study": "mixed", "model": "radial", "cells": 40}
ONE = {"data_vars": "minimal", "coords": "minimal", "compat": "override"}
NESTED = {"combine": "nested", "concat_dim": "run", "join": "outer"}


@pytest.fixture(scope="module")
def solve(solve_study, make_run):
    """Function that solves a study in a folder's results/NAME, with made-up runs of unlike lengths, boxes and grids."""

    def made(point, keep):
        run = make_run(point, steps=20 + int(5 * point.a_H), grown=int(2 * point.a_H))
        if point.r == 0.8:
            vars(run).update(status="diverged", status_detail="at once", L_f=np.full(3, np.nan))
        if point.grid == "fitted":
            fitted(run, seed=int(point.a_H))
        if point.gauges:
            depth = np.outer(1 + np.arange(len(point.gauges)), run.time)
            run.measured = {"gauge_h2": depth, "largest_h2": run.h2.max(axis=0)}
        return thinning.kept(run, keep)

    def solve(folder, base, **values):
        study = config.make_study(base | values)
        results = folder / "results" / study.name
        solve_study(study, results, lambda points: [made(point, study.keep) for point in points])
        return results

    return solve


@pytest.fixture(scope="module")
def mine(solve, tmp_path_factory):
    """A study of uniform runs that was widened twice; nothing changes it."""
    folder = tmp_path_factory.mktemp("mine")
    solve(folder, MINE, a_H=[1, 2], r=[0.2, 0.4])
    solve(folder, MINE, a_H=[1, 2, 4], r=[0.2, 0.4])
    return solve(folder, MINE, a_H=[1, 2, 4], r=[0.2, 0.4, 0.8])


@pytest.fixture(scope="module")
def mixed(solve, tmp_path_factory):
    """A study of unlike cells, grids and scenes, of some runs a summary alone; nothing changes it."""
    folder = tmp_path_factory.mktemp("mixed")
    uniform = {"a_H": [1, 2], "r": 0.2}
    others = [
        {"a_H": [1, 3], "cells": 60, "gauges": [[0.1, 0], [0.05, 0]]},
        {"a_H": [1, 2], "grid": "fitted", "quantities": "grains", "cells": 24, "r": 0.1},
        {"scene": "ellipse", "scene_options": {"elongation": [1.5, 2]}, "model": "plane", "fields": True},
    ]
    solve(folder, MIXED, keep="summary", cases=[uniform])
    solve(folder, MIXED, cases=[uniform, others[0]])
    return solve(folder, MIXED, cases=[uniform, *others])


@pytest.fixture
def here(tmp_path, monkeypatch):
    """The current folder, an empty one."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


def copied(folder, here):
    """Path of a copy of a study that may be changed."""
    return Path(shutil.copytree(folder, here / "results" / folder.name))


def names(folder):
    """Paths of the records of a study."""
    return sorted(map(str, (folder / "records").glob("*.nc")))


@pytest.mark.parametrize("new", [False, True], ids=["defaults of today", "announced defaults"])
def test_xarray_gives_every_run_of_a_study_that_was_widened_twice(mine, new):
    results = Results(mine)
    assert len(names(mine)) == 3
    with warnings.catch_warnings(), xr.set_options(use_new_combine_kwarg_defaults=new):
        warnings.simplefilter("error")
        data = xr.open_mfdataset(names(mine), decode_times=False, **NESTED, **ONE).load()
    assert data["run"].values.tolist() == list(range(1, 10))
    assert set(data["id"].values) == {run.id for run in results.runs_of_study}
    for run in results.runs_of_study:
        one, record = data.isel(run=data["id"].values.tolist().index(run.id)), results.record(run.id)
        assert (float(one["a_H"]), float(one["r"])) == (run.point.a_H, run.point.r)
        for name in ("time", "x_front", "h2", "snapshot_time"):
            got = one[name].dropna(one[name].dims[-1], how="all")
            np.testing.assert_array_equal(got, record[name], err_msg=name)
    assert {"a_H", "a_2", "r", "delta", "radius", "cells", "cfl", "scheme", "model", "time"} <= set(
        data.coords
    )


@pytest.mark.parametrize("new", [pytest.param(False, marks=pytest.mark.long), True])
def test_xarray_joins_unlike_records_that_are_made_alike(mixed, new):
    results = Results(mixed)
    with xr.set_options(use_new_combine_kwarg_defaults=new):
        data = xr.open_mfdataset(names(mixed), preprocess=alike, decode_times=False, **NESTED, **ONE).load()
    assert {run.id for run in results.runs_of_study} <= set(data["id"].values)
    assert len(set(data["run"].values.tolist())) == data.sizes["run"]
    compare_profiles(data, results)


def compare_profiles(data, results):
    """Compare the profiles of each run with its record, whatever its grid."""
    compared = set()
    for run in results.runs_of_study:
        record = results.record(run.id)
        one = data.isel(run=data["id"].values.tolist().index(run.id))
        if "h2" not in record:
            assert one["h2"].isnull().all()
            continue
        there = np.isfinite(one["h2"].values)
        np.testing.assert_array_equal(one["h2"].values[there], record["h2"].values.ravel())
        x = np.broadcast_to(record["x"].values, record["h2"].shape)
        np.testing.assert_array_equal(one["x"].values[there], x.ravel())
        widths = record["cell_width"].values if "cell_width" in record else np.full(x.shape, record["dx"])
        np.testing.assert_array_equal(one["cell_width"].values[there], widths.ravel())
        compared.add(str(record["grid"].values))
    assert compared == {"uniform", "fitted"}


def test_a_study_opens_as_one_lazy_dataset(mine, here):
    data, results = subslide.open_study(mine), Results(mine)
    assert data["run"].values.tolist() == list(range(1, 10))
    assert {run.id for run in results.runs_of_study} == set(data["id"].values)
    assert all(data[name].chunks for name in ("time", "x_front", "h2"))
    assert (data["status"] == "diverged").sum() == 3
    assert data["numerics"].values.tolist() == ["default"] * 9
    for number, name in enumerate(data["id"].values):
        record = results.record(name)
        one = data.isel(run=number, step=slice(record.sizes["step"]))
        np.testing.assert_array_equal(one["x_front"], record["x_front"])
        np.testing.assert_array_equal(one["h2"].dropna("x", how="all"), record["h2"])
    assert data.where(data.a_H == 2, drop=True).sizes["run"] == 3
    data.load().to_netcdf("out.nc")
    with xr.open_dataset("out.nc", decode_times=False) as back:
        xr.testing.assert_identical(back.drop_encoding().load(), data)


def test_runs_that_the_study_asks_for_no_more_are_left_out(solve, mine, here):
    folder = copied(mine, here)
    solve(here, MINE, a_H=[2], r=[0.2, 0.8])
    data = subslide.open_study(folder)
    assert data["a_H"].values.tolist() == [2, 2]
    assert data["run"].values.tolist() == [3, 8]
    prune(config.make_study(MINE | {"a_H": 2, "r": 0.2}), folder)
    with pytest.raises(
        RecordError, match=r"mine is not finished: 1 of 2 runs have no record \(batch 0003: p"
    ):
        subslide.open_study(folder)


def test_by_axes_a_full_grid_has_a_dimension_for_each(mine, here):
    data, results = subslide.open_study(mine, by="axes"), Results(mine)
    assert data["L_f"].dims == ("a_H", "r", "front_threshold")
    assert dict(data.sizes) | {"a_H": 3, "r": 3} == dict(data.sizes)
    assert (data["delta"].ndim, float(data["delta"]), str(data["scheme"].values)) == (0, 32, "ifcph")
    for run in results.runs_of_study:
        one, record = data.sel(a_H=run.point.a_H, r=run.point.r), results.record(run.id)
        assert str(one["id"].values) == run.id
        np.testing.assert_array_equal(one["h2"].dropna("x", how="all"), record["h2"])
        np.testing.assert_array_equal(one["L_f"], record["L_f"])
    data.to_netcdf("out.nc")


def test_keys_that_follow_from_others_are_no_axes_and_rest_is_at_infinity(solve, here):
    folder = solve(here, {"study": "t"}, numerics=["paper", "resolved"], model="radial", t_end=["rest", 0.5])
    data = subslide.open_study(folder, by="axes")
    assert data["L_f"].dims[:2] == ("numerics", "t_end")
    assert data["t_end"].values.tolist() == [0.5, np.inf]
    assert data["cells"].dims == ("numerics",)


def test_by_axes_a_study_of_one_run_is_that_run(solve, here):
    folder = solve(here, {"study": "t", "cells": 40, "t_end": 0.1}, a_H=2)
    data = subslide.open_study(folder, by="axes", scaled_time=np.int64(5))
    assert (data["L_f"].dims, data["x_front"].dims) == (
        ("front_threshold",),
        ("front_threshold", "scaled_time"),
    )
    assert (float(data["a_H"]), data["run"].shape, data.sizes["scaled_time"]) == (2, (), 5)
    np.testing.assert_array_equal(data["h2"], subslide.open_study(folder)["h2"][0])


def test_runs_with_and_without_gauges_on_one_grid_open_whole(solve, here):
    folder = solve(here, MINE, cases=[{"a_H": 1}, {"a_H": 2, "cells": 40, "gauges": [[0.1, 0]]}])
    solve(here, MINE, cases=[{"a_H": [1, 3]}, {"a_H": 2, "gauges": [[0.1, 0]]}])
    data = subslide.open_study(folder)
    assert "x" in data.dims
    assert data["gauge_x"].dims == ("run", "gauge")
    assert {"gauge_x", "gauge_y"} <= set(data.coords)
    data.to_netcdf("out.nc")


def test_runs_that_are_no_full_grid_are_refused(solve, here):
    folder = solve(here, MINE, cases=[{"a_H": [1, 2], "r": [0.1, 0.2]}, {"a_H": 3, "r": 0.2}])
    assert subslide.open_study(folder).sizes["run"] == 5
    with pytest.raises(ConfigError, match="5 runs are no full grid of 3 a_H x 2 r; allowed: run"):
        subslide.open_study(folder, by="axes")


def test_a_study_of_unlike_grids_opens_whole(mixed, here):
    data = subslide.open_study(mixed)
    compare_profiles(data, Results(mixed))
    assert np.nanmax(data["elongation"].values) == 2
    assert "elongation" in data.coords
    assert not set(naming.FIELDS_2D) & set(data)
    data.to_netcdf("out.nc")
    gauged = data["a_H"].where(data["cells"] == 60, drop=True)["run"]
    np.testing.assert_array_equal(data["gauge_x"].sel(run=gauged), [[0.1, 0.05]] * 2)
    assert data["gauge_h2"].isnull().all(["gauge", "step"]).sum() == data.sizes["run"] - 2
    assert data["largest_h2"].dims == ("run", "cell")
    laid = subslide.open_study(mixed, scaled_time=30)
    assert laid["gauge_h2"].dims == ("run", "gauge", "scaled_time")
    assert laid["max_abs_eta"].sel(run=laid["grid"] == "fitted").isnull().all()
    assert laid["x_front"].notnull().all()


@pytest.mark.parametrize("keep", ["series", "summary"])
def test_series_and_summaries_open_too(solve, here, keep):
    folder = solve(here, MINE, a_H=[1, 2], keep=keep)
    data, results = subslide.open_study(folder), Results(folder)
    for number, name in enumerate(data["id"].values):
        record = results.record(name)
        one = data.isel(run=number, step=slice(record.sizes["step"]))
        np.testing.assert_allclose(one["x_front"], record["x_front"], rtol=1e-6)
    assert "snapshot_time" in xr.open_dataset(names(folder)[0], decode_times=False).coords


def test_series_lie_on_a_common_scaled_time(mine):
    data, results = subslide.open_study(mine, scaled_time=50), Results(mine)
    assert data["x_front"].dims == ("run", "front_threshold", "scaled_time")
    assert "step" not in data.dims
    for number, name in enumerate(data["id"].values):
        record, one = results.record(name), data.isel(run=number)
        time = record["time"].values / float(one["time_scale"])
        assert float(one["time_scale"]) == pytest.approx(np.sqrt(0.0705 / (9.81 * 0.56)))
        inside = data["scaled_time"].values <= time[-1]
        expected = np.interp(data["scaled_time"], time, record["max_abs_eta"])
        np.testing.assert_allclose(one["max_abs_eta"][inside], expected[inside], atol=1e-12)
    assert float(data["scaled_time"][-1]) == float(data["scaled_end"].max())


def test_what_a_run_ends_with_goes_on_unless_it_failed_or_was_gone():
    common, time = np.linspace(0, 4, 5), np.array([0, 1, 2, np.nan])
    values = np.array([3.0, 5, 7, np.nan])
    np.testing.assert_array_equal(interpolated(common, time, values, True), [3, 5, 7, 7, 7])
    np.testing.assert_array_equal(interpolated(common, time, values, False), [3, 5, 7, np.nan, np.nan])
    gone = np.array([np.nan, 5, np.nan, np.nan])
    np.testing.assert_array_equal(interpolated(common, time, gone, True), [np.nan, 5, np.nan, np.nan, np.nan])
    between = np.array([3.0, np.nan, 7, np.nan])  # as volumes on fitted grids are sampled
    np.testing.assert_array_equal(interpolated(common, time, between, True), [3, 5, 7, 7, 7])
    assert np.isnan(interpolated(common, time, np.full(4, np.nan), True)).all()


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"folder": "nowhere"}, "nowhere/points.json: there is no such file; allowed: the folder of a study"),
        ({"by": "rows"}, "by: rows is not allowed; allowed: run, axes"),
        ({"scaled_time": 1}, "scaled_time: 1 is not allowed; allowed: a whole number from 2"),
        ({"scaled_time": True}, "scaled_time: true is not allowed"),
        ({"scaled_time": 2.5}, "scaled_time: 2.5 is not allowed"),
    ],
)
def test_what_is_no_study_or_not_allowed_is_said(mine, arguments, words):
    with pytest.raises(ConfigError, match=re.escape(words)):
        subslide.open_study(**{"folder": mine, **arguments})


def test_a_damaged_record_is_told(mine, here):
    folder = copied(mine, here)
    path = folder / "records/0002.nc"
    path.write_bytes(path.read_bytes()[:-1])
    with pytest.raises(RecordError, match=r"0002\.nc does not match its checksum"):
        subslide.open_study(folder)


def test_records_of_an_earlier_version_are_told(mine, here):
    folder = copied(mine, here)
    path = folder / "records/0001.nc"
    with xr.open_dataset(path, decode_times=False) as record:
        old = record.load().drop_vars("run")
    path.unlink()
    old.to_netcdf(path)
    seal(path)
    with pytest.raises(
        RecordError, match=r"0001\.nc: the record is of another version; make the study again"
    ):
        subslide.open_study(folder)


def test_importing_the_package_loads_no_library_of_data():
    code = "import subslide, sys; assert not {'xarray', 'pandas', 'dask'} & set(sys.modules); subslide.open_study"
    subprocess.run([sys.executable, "-c", code], check=True)


def test_the_page_on_opening_does_as_it_says(mine, mixed, here, make_run, root):
    copied(mine, here), copied(mixed, here)
    netcdf.write("plane.nc", [make_run(Point(cells=20, model="plane", fields=True))])
    blocks = re.findall(r"```python\n(.*?)```", (root / "docs/opening.md").read_text(), re.S)
    assert len(blocks) == 7
    space = {}
    for block in blocks:
        if "to_zarr" in block and not has_zarr():
            block = block.replace("study.to_zarr", "# study.to_zarr")
        exec(block, space)
        if "front = " in block:
            assert space["front"].dims == ("scaled_time",)
            assert space["front"].notnull().all()
        if "grid = " in block:
            assert space["grid"]["L_f"].dims == ("front_threshold", "a_H", "r")
            assert space["grid"].sizes["a_H"] == 3
    assert space["steep"].sizes["run"] == 3
    assert set(space["runs"]["scene"].values) == {"cylinder", "ellipse"}
    assert space["one"]["id"].size == 1
    with xr.open_dataset("fields.nc") as fields:
        assert fields["h2_field"].dims == ("snapshot_time", "y", "x")


def has_zarr():
    """Whether zarr is installed."""
    try:
        import zarr  # noqa: F401
    except ImportError:
        return False
    return True


@pytest.mark.long
def test_a_study_goes_to_zarr(mine, mixed, here):
    pytest.importorskip("zarr", reason="pip install 'subslide[zarr]'")
    for folder, options in ((mine, {}), (mine, {"by": "axes"}), (mixed, {"scaled_time": 20})):
        data = subslide.open_study(folder, **options)
        data.to_zarr("out.zarr", mode="w", zarr_format=2)
        with xr.open_zarr("out.zarr", decode_times=False) as back:
            xr.testing.assert_allclose(back.load(), data.load())


@pytest.mark.long
def test_records_are_cf_1_11_by_the_ioos_checker(mine, mixed, here):
    checker = here / "checker/bin/compliance-checker"
    subprocess.run([sys.executable, "-m", "venv", here / "checker"], check=True)
    installed = subprocess.run(
        [checker.with_name("python"), "-m", "pip", "install", "-q", "compliance-checker"], check=False
    )
    if installed.returncode:
        pytest.skip("compliance-checker cannot be installed: no package index can be reached")
    for path in (*names(mine)[:1], *names(mixed)):
        told = subprocess.run([checker, "-t", "cf:1.11", path], capture_output=True, text=True, check=False)
        assert "All tests passed!" in told.stdout, f"{path}: {told.stdout}"
