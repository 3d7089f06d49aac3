"""Records: whole or absent, with a checksum that finds every change, in the layout that is promised."""

import errno
import json
import os

import netCDF4
import numpy as np
import pytest
import xarray as xr
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from subslide import naming, source_hash
from subslide.files import replacing
from subslide.points import Point
from subslide.records import netcdf as records
from subslide.records import variables as layout
from subslide.results import open_record, trimmed

PROMISED = {
    "x_front": ("run", "front_threshold", "step"),
    "L_f": ("run", "front_threshold"),
    "time_of_arrest": ("run", "front_threshold"),
    "time": ("run", "step"),
    "max_abs_eta": ("run", "step"),
    "max_abs_eta_outside": ("run", "step"),
    "eta_gauge": ("run", "step"),
    "sediment_volume": ("run", "step"),
    "water_volume": ("run", "step"),
    "energy": ("run", "step"),
    "nonhyperbolic_cells": ("run", "step"),
    "hyperbolic_margin": ("run", "step"),
    "h2": ("run", "snapshot", "x"),
    "eta": ("run", "snapshot", "x"),
    "snapshot_time": ("run", "snapshot"),
    **{name: ("run",) for name in ("a_H", "a_2", "r", "delta", "radius", "status", "status_detail", "steps")},
    "wall_seconds": ("run",),
    "id": ("run",),
}


@pytest.fixture
def record(tmp_path, make_run):
    path = tmp_path / "one.nc"
    records.write(path, [make_run(Point(cells=40))])
    return path


def test_layout_is_as_promised(record):
    with xr.open_dataset(record, decode_times=False) as data:
        for name, dims in PROMISED.items():
            assert data[name].dims == dims, name
        for name in ("x_front", "max_abs_eta", "h2", "x", "time"):
            assert data[name].attrs["units"]
            assert data[name].attrs["long_name"]
        assert data.attrs["Conventions"] == "CF-1.11"
        assert data["front_threshold"].values.tolist() == list(naming.FRONT_THRESHOLDS)
        assert data["status"].values.tolist() == ["ok"]


def test_a_single_run_states_its_provenance(record):
    with xr.open_dataset(record, decode_times=False) as data:
        for name in (
            "scheme",
            "order",
            "model",
            "cells",
            "dtype",
            "status",
            "steps",
            "wall_seconds",
            "version",
        ):
            assert name in data.attrs, name
        assert data.attrs["source_hash"] == source_hash()
        assert json.loads(data.attrs["config"])["cells"] == 40


def test_identical_runs_give_identical_files(tmp_path, make_run):
    paths = [tmp_path / "a.nc", tmp_path / "b.nc"]
    for path in paths:
        records.write(path, [make_run(Point(cells=40))])
    assert paths[0].read_bytes() == paths[1].read_bytes()


def test_a_batch_pads_short_runs_and_gives_each_back_whole(tmp_path, make_run):
    runs = [
        make_run(Point(cells=40, a_H=1.0), steps=5),
        make_run(Point(cells=40, a_H=2.0), steps=9, grown=3, snapshot_time=np.array([0, 0.5, 0.7])),
        make_run(Point(cells=40, a_H=3.0, model="plane", fields=True), steps=7),
    ]
    records.write(tmp_path / "b.nc", runs)
    with open_record(tmp_path / "b.nc") as data:
        for run in runs:
            one = trimmed(data, run.point.id)
            for name in ("time", "x_front", "max_abs_eta", "snapshot_time", "h2", "x"):
                np.testing.assert_allclose(one[name].values, getattr(run, name), rtol=1e-15, err_msg=name)
            assert int(one["steps"]) == run.steps
        assert trimmed(data, runs[2].point.id)["h2_field"].shape == runs[2].h2_field.shape


def test_a_failed_run_is_a_record_too(tmp_path, make_run):
    run = make_run(Point(cells=40), status="diverged", time_at_rest=np.nan, L_f=np.full(3, np.nan))
    records.write(tmp_path / "f.nc", [run])
    found, attrs = records.read(tmp_path / "f.nc")
    assert attrs["status"] == "diverged"
    assert np.isnan(found["L_f"].values).all()


@pytest.mark.parametrize("part", [0, 0.1, 0.5, 0.9, 0.999])
def test_a_truncated_record_is_refused(record, part):
    os.truncate(record, int(part * record.stat().st_size))
    with pytest.raises(records.RecordError, match="one.nc"):
        records.read(record)


def test_changed_values_are_noticed(record):
    with netCDF4.Dataset(record, "a") as data:
        data["L_f"][0, 0] += 1e-15
    with pytest.raises(records.RecordError, match="checksum"):
        records.read(record)


def test_changed_attributes_are_noticed(record):
    with netCDF4.Dataset(record, "a") as data:
        data["L_f"].units = "cm"
    with pytest.raises(records.RecordError, match="checksum"):
        records.read(record)


@settings(max_examples=60, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.data())
def test_no_flipped_bit_changes_a_value_unnoticed(tmp_path, make_run, data):
    """A flipped bit is refused, or lies where no value or attribute is kept."""
    path = tmp_path / "bits.nc"
    if not path.exists():
        records.write(path, [make_run(Point(cells=20), steps=3)])
        path.with_suffix(".whole").write_bytes(path.read_bytes())
    whole = path.with_suffix(".whole").read_bytes()
    place = data.draw(st.integers(0, 8 * len(whole) - 1))
    flipped = bytearray(whole)
    flipped[place // 8] ^= 1 << place % 8
    expected = records.read(path.with_suffix(".whole"))[1]["checksum"]
    damaged = path.with_suffix(".flipped")
    damaged.write_bytes(flipped)
    try:
        found, attrs = records.read(damaged)
    except records.RecordError:
        return
    assert records.digest(found, attrs) == expected


def test_a_damaged_list_of_attributes_is_refused(tmp_path, make_run):
    path = tmp_path / "attributes.nc"
    records.write(path, [make_run(Point(cells=20), steps=3)])
    content = bytearray(path.read_bytes())
    content[content.index(b"checksum") - 1] ^= 1
    path.write_bytes(content)
    with pytest.raises(records.RecordError, match="damaged"):
        records.read(path)


def test_other_files_are_refused(tmp_path):
    (tmp_path / "text.nc").write_text("not a record")
    with netCDF4.Dataset(tmp_path / "other.nc", "w") as data:
        data.title = "another file"
    for name in ("text.nc", "other.nc", "absent.nc"):
        with pytest.raises(records.RecordError, match=name):
            records.read(tmp_path / name)


def test_a_full_disk_leaves_the_old_record_and_nothing_else(record, make_run, monkeypatch):
    before = record.read_bytes()

    def full(*_):
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(OSError, match="No space"):
        records.write(record, [make_run(Point(cells=40, r=0.1))])
    assert record.read_bytes() == before
    assert list(record.parent.iterdir()) == [record]


def test_what_was_written_wrong_never_gets_the_name(tmp_path, make_run, monkeypatch):
    """A disk that lost what it took (a full one did) is noticed when the file is read back."""
    store = records._store

    def lossy(path, found, attrs, small):
        changed = {
            **found,
            "L_f": layout.Variable(found["L_f"].dims, found["L_f"].values * 0, found["L_f"].attrs),
        }
        store(path, changed, attrs, small)

    monkeypatch.setattr(records, "_store", lossy)
    with pytest.raises(records.RecordError, match="checksum"):
        records.write(tmp_path / "a.nc", [make_run(Point(cells=40))])
    assert list(tmp_path.iterdir()) == []


def test_an_error_leaves_no_temporary_file(tmp_path):
    def fail():
        with replacing(tmp_path / "a") as temporary:
            temporary.write_text("half")
            raise RuntimeError

    with pytest.raises(RuntimeError):
        fail()
    assert list(tmp_path.iterdir()) == []


def test_numerics_may_differ_within_a_batch(tmp_path, make_run):
    points = [Point(cells=40), Point(cells=40).with_values(scheme="hll", dtype="float32")]
    records.write(tmp_path / "b.nc", [make_run(point) for point in points])
    with open_record(tmp_path / "b.nc") as data:
        assert data["scheme"].values.tolist() == ["ifcph", "hll"]
        assert data["dtype"].values.tolist() == ["float64", "float32"]


def test_options_of_scenes_are_text(tmp_path, make_run):
    options = ((), (("angle", 3.0), ("side", "left")))
    points = [Point(model="radial", cells=20, scene_options=pairs) for pairs in options]
    records.write(tmp_path / "x.nc", [make_run(point) for point in points])
    found, _ = records.read(tmp_path / "x.nc")
    assert [tuple(json.loads(text).items()) for text in found["scene_options"].values] == list(options)
