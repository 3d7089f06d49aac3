"""Files of rasters: what a file may be, whatever it holds; good ones are read rightly, others get one line."""

import os
import random
import shutil
import sys
import time
from pathlib import Path

import netCDF4
import numpy as np
import pytest

from subslide import scenes
from subslide.__main__ import main
from subslide.keys.schema import ConfigError
from subslide.scenes import _raster_file
from subslide.study import config

N, STEP = 20, 0.01
CENTRES = (np.arange(N) + 0.5) * STEP - 0.5 * N * STEP
DEPTH = np.clip(0.03 - 0.3 * np.hypot(*np.meshgrid(CENTRES, CENTRES)), 0, None)


@pytest.fixture(autouse=True)
def in_a_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def write(path="r.nc", change=None, kind="f8", depth=DEPTH, **how):
    """Write a good raster, but for what `change` does to the open file, and return its path."""
    with netCDF4.Dataset(path, "w", **how) as data:
        for key in "yx":
            data.createDimension(key, N)
            data.createVariable(key, "f8", (key,))[:] = CENTRES
        data.createVariable("h2", kind, ("y", "x"))
        if change:
            change(data)
        data["h2"][:] = depth
    return path


def values_of(path):
    """h2 as the scene reads it."""
    point = point_of(path)
    return scenes.load("raster").read(path, scenes.options(point)["sha256"]).h2


def point_of(path, **more):
    """A run of a raster."""
    return config.make_point({"scene": "raster", "scene_options": {"file": path}, "cells": 20, **more})


def refusal(path):
    """The one short line that a raster gets."""
    with pytest.raises(ConfigError) as caught:
        point_of(path)
    said = str(caught.value)
    assert "\n" not in said
    assert len(said) <= 300
    return said


NAMES = [
    "a,b.nc",
    "a b.nc",
    "höhe η 山.nc",
    "#x.nc",
    "a=b.nc",
    "%41.nc",
    "x:y.nc",
    "-.nc",
]


@pytest.mark.parametrize("name", NAMES)
def test_any_name_of_a_file_is_one(name, capsys):
    write()
    shutil.move("r.nc", name)
    assert main(["run", "--scene", "raster", "--scene-options", f"method=bilinear,file={name}", "--cells", "20",
                 "--t-end", "0.01", "-o", "o.nc"]) == 0, capsys.readouterr().err  # fmt: skip


def test_names_that_are_none_get_one_line():
    os.mkfifo("pipe")
    os.mkdir("folder")
    for name, part in {
        "a\0b": "null byte",
        "pipe": "not a regular file",
        "folder": "not a regular file",
        "/dev/zero": "not a regular file",
        "http://localhost:1/x.nc": "an address",
        "file://r.nc": "an address",
        "x" * 5000: "too long",
        "\x1b[31m": "\\x1b[31m",
        "~/r.nc": "no such file",
    }.items():
        assert part in refusal(name)


def packed(data):
    data["h2"].setncatts({"scale_factor": 2.0**-16, "add_offset": 0.5})


def unsigned(data):
    data["h2"].setncatts({"scale_factor": 2.0**-20, "_Unsigned": "true"})


@pytest.mark.parametrize(
    ("kind", "change", "rounding"),
    [("f4", None, 1e-8), ("i2", packed, 2.0**-17), ("i2", unsigned, 2.0**-21)],
)
def test_stored_types_are_read_rightly(kind, change, rounding):
    np.testing.assert_allclose(values_of(write(kind=kind, change=change)), DEPTH, rtol=0, atol=rounding)


@pytest.mark.parametrize("how", ["NETCDF3_CLASSIC", "NETCDF3_64BIT_OFFSET", "NETCDF3_64BIT_DATA"])
def test_a_classic_file_is_read_whole_or_refused(how):
    np.testing.assert_array_equal(values_of(write(format=how)), DEPTH)
    with open("r.nc", "rb") as file:
        body = file.read()
    for size in (len(body) - 8, len(body) // 2, 100, 3):
        with open("r.nc", "wb") as file:
            file.write(body[:size])
        assert "not a whole one" in refusal("r.nc")


def set_missing(data):
    data["h2"].missing_value = DEPTH[3, 4]


def set_range(data):
    data["h2"].valid_max = 0.02


def in_millimetres(data):
    data["h2"].units = "mm"


def in_numbers(data):
    data["x"].units = np.arange(50)


@pytest.mark.parametrize(
    ("change", "part"),
    [
        (set_missing, "missing or infinite values"),
        (set_range, "missing or infinite values"),
        (in_millimetres, "units: mm of h2"),
        (in_numbers, "units: [0, 1"),
    ],
)
def test_what_is_not_metres_or_missing_is_refused(change, part):
    assert part in refusal(write(change=change))


def made(dims, kind="f8", shape=(N, N)):
    """Write a file whose h2 has other dimensions, type or shape."""
    with netCDF4.Dataset("r.nc", "w") as data:
        for key, size in zip("yx", shape, strict=True):
            data.createDimension(key, size)
            data.createVariable(key, "f8", (key,))
        if kind == "complex":
            kind = data.createCompoundType(np.dtype([("re", "f8"), ("im", "f8")]), "complex")
        elif kind == "vlen":
            kind = data.createVLType("f8", "vlen")
        data.createVariable("h2", kind, dims)
    return "r.nc"


@pytest.mark.parametrize(
    ("path", "part"),
    [
        (lambda: made(("x", "y")), "h2(x, y) is not allowed; allowed: h2(y, x)"),
        (lambda: made(("y", "x"), str), "h2 is not an array of numbers"),
        (lambda: made(("y", "x"), "complex"), "h2 is not an array of numbers"),
        (lambda: made(("y", "x"), "vlen"), "h2 is not an array of numbers"),
        (lambda: made(("y",)), "h2 is not an array of numbers"),
        (lambda: made(("y", "x"), shape=(None, N)), "not an array of numbers"),
        (lambda: made(("y", "x"), shape=(19_000, 19_000)), "19000 x 19000 values; allowed: 20000 along"),
        (lambda: made(("y", "x"), shape=(2, 10**9)), "1000000000 values; allowed"),
    ],
)
def test_other_shapes_and_types_are_refused_unread(path, part):
    started = time.monotonic()
    assert part in refusal(path())
    assert time.monotonic() - started < 5


def test_coordinates_are_even_within_what_their_type_rounds():
    n = 2400
    with netCDF4.Dataset("r.nc", "w") as data:
        centres = (np.arange(n) + 0.5) / n * 0.5 - 0.25
        for key, size in (("y", 2), ("x", n)):
            data.createDimension(key, size)
            data.createVariable(key, "f4", (key,))[:] = centres[:size]
        data.createVariable("h2", "f4", ("y", "x"))[:] = 0.01
    raster = scenes.load("raster").read("r.nc", _raster_file.content("r.nc"))
    np.testing.assert_allclose(np.diff(raster.x), 0.5 / n, rtol=1e-6)

    def one_off(data):
        x = CENTRES.copy()
        x[7] += 1e-3 * STEP
        data["x"][:] = x

    assert "x has unequal steps" in refusal(write(change=one_off))


def test_grains_as_high_as_the_level_may_be_rounded_up():
    level = 0.56 * 0.0705
    assert float(np.float32(level)) > level * (1 + 1e-9)
    at_level = np.where(DEPTH > 0, level, 0)
    assert point_of(write(kind="f4", depth=at_level), a_H=0).level == level
    with pytest.raises(ConfigError, match="above the water's level"):
        point_of(write(kind="f4", depth=at_level * (1 + 1e-6)), a_H=0)


def test_flipped_bits_never_end_or_hold_the_process():
    write()
    with open("r.nc", "rb") as file:
        body = file.read()
    draw, said = random.Random(10), set()
    for n in range(60):
        damaged = bytearray(body)
        for _ in range(draw.choice((1, 20, 200))):
            damaged[draw.randrange(min(len(body), draw.choice((100, 3000, 10**6))))] ^= 1 << draw.randrange(8)
        with open(f"{n}.nc", "wb") as file:
            file.write(damaged)
        try:
            point_of(f"{n}.nc")
        except ConfigError as error:
            said.add(str(error).split(": ")[3][:20])
    assert said


@pytest.mark.parametrize(("end", "part"), [(os.abort, "crashed"), (lambda: time.sleep(60), "did not end")])
def test_a_reader_that_crashes_or_hangs_gets_one_line(monkeypatch, end, part):
    monkeypatch.setattr(_raster_file, "SECONDS", 0.2)
    monkeypatch.setattr(_raster_file, "_variables", lambda data: end())
    assert part in refusal(write())


def test_the_child_that_reads_a_raster_loads_no_library(monkeypatch):
    """Loading what reads NetCDF takes it 0.3 s; reading takes it some 10 ms."""
    write()
    point_of("r.nc")
    monkeypatch.setattr(sys, "meta_path", [])
    assert isinstance(_raster_file._in_child(Path("r.nc").read_bytes()), dict)
