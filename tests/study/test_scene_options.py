"""Scenes in studies: options are checked, make ids and axes, and reach tables; the model that was chosen is told."""

import json

import netCDF4
import numpy as np
import pandas as pd
import pytest

from subslide import jobs, points
from subslide.__main__ import main
from subslide.keys import schema, words
from subslide.keys.schema import ConfigError
from subslide.records.netcdf import read
from subslide.scenes import NAMES, load
from subslide.study import config
from subslide.study.batches import read_batch, spec_text

MISTAKES = {
    ("elipse", ""): ("scene: elipse is not allowed", "did you mean 'ellipse'?"),
    ("ellipse", "elongatoin=2"): ("elongatoin", "its value: 2", "did you mean 'elongation'?"),
    ("ellipse", "zzz=2"): ("zzz", "allowed: elongation, angle"),
    ("ellipse", "elongation=99"): ("elongation: 99 is not allowed", "from 0.0625 to 16"),
    ("ellipse", "elongation=long"): ("elongation: long", "a number"),
    ("ellipse", "angle=200"): ("angle: 200", "(degree)"),
    ("ellipse", "elongation"): ("--scene-options: elongation is not allowed", "NAME=VALUE"),
    ("ellipse", "angle=1,angle=2"): ("angle: given twice",),
    ("cylinder", "elongation=2"): ("the scene cylinder has no such option", "allowed: none"),
    ("dam_break", "layer=grain"): ("layer: grain is not allowed", "did you mean 'grains'?"),
    ("columns", "count=3"): ("count: 3 is not allowed", "one of 1, 2"),
    ("columns", "x=4"): ("x: 4 puts a column beyond the box", "at most 3.255"),
    ("standing_wave", "mode=1.5"): ("mode: 1.5", "whole number"),
    ("raster", ""): ("file: the scene raster needs this option",),
    ("raster", "file=absent.nc"): ("file: absent.nc: there is no such file",),
}  # fmt: skip


@pytest.mark.parametrize(("scene", "text"), MISTAKES)
def test_mistakes_on_the_command_line_give_one_line(scene, text, capsys, tmp_path):
    output = tmp_path / "x.nc"
    assert main(["run", "--scene", scene, "--scene-options", text, "-o", str(output)]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.count("\n") == 1
    for part in MISTAKES[scene, text]:
        assert part in err
    assert not output.exists()


@pytest.mark.parametrize(
    ("values", "part"),
    [
        ({"scene": "dam_break"}, "boundary: open is not allowed with scene: dam_break"),
        ({"scene": "pile", "delta": 0}, "delta: 0 is not allowed with scene: pile"),
        ({"scene": "standing_wave", "boundary": "wall", "a_H": 0}, "a_H: 0 is not allowed"),
        ({"scene": "shear"}, "boundary: open is not allowed with scene: shear"),
        ({"scene": "shear", "boundary": "periodic", "a_H": 0}, "a_H: 0 is not allowed"),
        ({"scene": "ellipse", "model": "radial"}, "model: radial is not allowed with scene: ellipse"),
        ({"model": "line"}, "model: line is not allowed with scene: cylinder"),
        ({"scene": "ellipse", "scene_options": {"angle": []}}, "angle: [] makes an empty grid"),
        ({"scene_options": 3}, "scene_options: 3 is not allowed; allowed: a mapping"),
        ({"scene": "ellipse", "scene_options": {"angle": {"a": 1}}}, "angle: "),
        (
            {"scene": "raster", "scene_options": {"file": ["a.nc", "b.nc"]}},
            'file: ["a.nc", "b.nc"] is not allowed',
        ),
        ({"scene": "ellipse", "scene_options": {3: 1}}, "the scene ellipse has no such option"),
    ],
)
def test_mistakes_in_a_study_give_one_line(values, part):
    with pytest.raises(ConfigError) as caught:
        config.make_study({"study": "t", **values})
    assert part in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("name", NAMES)
def test_every_scene_and_option_is_described(name):
    module = load(name)
    assert module.__doc__
    for about in module.OPTIONS.values():
        assert about["description"]
        assert words.range_of(about)
        if "default" in about:
            assert schema.conform(about, about["default"], name) == about["default"]


def test_scenes_of_the_schema_are_those_of_the_folder():
    assert schema.properties()["scene"]["enum"] == list(NAMES)


def test_options_make_the_id_and_how_they_are_written_does_not():
    def point(**options):
        return config.make_point({"scene": "ellipse", "scene_options": options})

    assert point(elongation=2).id == point(angle=0, elongation=2.0).id == point(angle=-0.0, elongation=2).id
    assert point().id == point(elongation=1.5).id
    assert len({point().id, point(elongation=2).id, point(angle=30).id}) == 3
    again = points.from_dict(json.loads(json.dumps(points.to_dict(point(angle=30)))))
    assert again == point(angle=30)


def test_options_are_axes_like_other_keys():
    study = config.make_study(
        {
            "study": "t",
            "scene": "ellipse",
            "r": [0, 0.4],
            "scene_options": {"elongation": [2, 1, 1.0], "angle": [0, 30]},
        }
    )
    assert len(study.points) == 8
    assert [dict(p.scene_options)["elongation"] for p in study.points[:4]] == [2, 2, 1, 1]


def test_a_run_tells_its_model_and_why(capsys, tmp_path):
    path = str(tmp_path / "x.nc")
    base = ["run", "--cells", "20", "--t-end", "0.02", "-o", path]
    for arguments, model, reason in (
        ([], "radial", "auto: round scene"),
        (["--model", "radial"], "radial", "asked for"),
        (
            ["--r", "0", "--quantities", "grains"],
            "one-layer",
            "auto: round scene, r = 0 and grains alone asked for",
        ),
        (
            ["--scene", "slide", "--scene-options", "speed=0.5", "--boundary", "wall"],
            "line",
            "auto: scene on a line",
        ),
        (
            ["--scene", "ellipse", "--scene-options", "elongation=2,angle=90"],
            "quarter",
            "auto: scene with two mirrors",
        ),
        (["--scene", "columns", "--scene-options", "x=0.5"], "plane", "auto: scene without mirrors"),
    ):
        assert main([*base, *arguments]) == 0
        assert f"{model} ({reason})" in capsys.readouterr().out
        found, attrs = read(path)
        assert (attrs["model"], attrs["model_reason"]) == (model, reason)
        assert found["model_reason"].values[0] == reason


def test_a_study_of_scenes_goes_from_points_to_tables(tmp_path, write_tables, solve_study):
    values = {"scene": "ellipse", "scene_options": {"elongation": [1, 1.5]}, "cells": 20, "t_end": 0.02}
    study = config.make_study({"study": "t", **values})
    solve_study(study, tmp_path, lambda points: [jobs.solved(point, 1) for point in points])
    write_tables(tmp_path)
    runs = pd.read_csv(tmp_path / "tables" / "runs.csv")
    assert runs["id"].tolist() == [p.id for p in study.points]
    assert runs["scene_options"].tolist() == [
        '{"angle":0.0,"elongation":1.0}',
        '{"angle":0.0,"elongation":1.5}',
    ]
    assert runs["resolved_model"].tolist() == ["radial", "quarter"]
    assert runs["sediment_volume_error"].max() < 1e-12
    record, _ = read(tmp_path / "records/0001.nc")
    assert json.loads(record["scene_options"].values[0])["angle"] == 0


def test_a_changed_raster_is_noticed_by_its_batch(tmp_path):
    path = tmp_path / "x.nc"

    def write(depth):
        with netCDF4.Dataset(path, "w") as data:
            for key in ("y", "x"):
                data.createDimension(key, 8)
                data.createVariable(key, "f8", (key,))[:] = np.linspace(-0.1, 0.1, 8)
            data.createVariable("h2", "f8", ("y", "x"))[:] = depth

    write(0.01)
    study = config.make_study(
        {"study": "t", "scene": "raster", "scene_options": {"file": str(path)}, "cells": 20}
    )
    spec = tmp_path / "b.json"
    spec.write_text(spec_text(study.points))
    assert [p.id for p in read_batch(spec).points] == [study.points[0].id]
    write(0.02)
    with pytest.raises(ConfigError, match="has changed"):
        read_batch(spec)
