"""Scenes: what they hold, their symmetry to the bit, the models they allow, and that shortcuts give the same answer."""

import math

import netCDF4
import numpy as np
import pytest
from states import advance, inner

from subslide import scenes
from subslide.exact import slide
from subslide.models.build import build
from subslide.models.grid import make_grid
from subslide.scenes import _discs, cylinder
from subslide.solver import solve
from subslide.study import choice, config

HALF = 20
DX = 0.6 / (2 * HALF) / 0.0705
FRICTION = math.tan(math.radians(32)) / 0.56
SLOPE = 0.95 * FRICTION
WALL = {"boundary": "wall"}
BOX = 2 * HALF * DX
UNION = 2 * math.pi - (2 * math.acos(0.65) - 0.65 * math.sqrt(4 - 1.3**2))

# name of the case: (scene, options, other keys, models it allows, volume of grains on a line or in the plane)
CASES = {
    "cylinder": ("cylinder", {}, {}, "radial quarter plane", math.pi),
    "slab": ("slab", {}, {}, "line", 2.0),
    "paraboloid": ("paraboloid", {}, {}, "radial quarter plane", math.pi / 2),
    "dam": ("dam_break", {}, WALL, "line", BOX / 2),
    "wet dam": ("dam_break", {"downstream": 0.2}, WALL, "line", 0.6 * BOX),
    "water dam": ("dam_break", {"layer": "water"}, {}, "line", 0.0),
    "surface wave": ("standing_wave", {}, WALL, "line", BOX),
    "round wave": ("standing_wave", {"kind": "internal", "shape": "round"}, WALL, "radial", math.pi * (BOX / 2) ** 2),
    "ellipse": ("ellipse", {"elongation": 2.0}, {}, "quarter plane", math.pi),
    "upright ellipse": ("ellipse", {"elongation": 2.0, "angle": 90}, {}, "quarter plane", math.pi),
    "turned ellipse": ("ellipse", {"elongation": 2.0, "angle": 30}, {}, "plane", math.pi),
    "round ellipse": ("ellipse", {"elongation": 1, "angle": 30}, {}, "radial quarter plane", math.pi),
    "column": ("columns", {}, {}, "radial quarter plane", math.pi),
    "column aside": ("columns", {"x": 0.3, "y": -0.7}, {}, "plane", math.pi),
    "columns": ("columns", {"count": 2}, {}, "quarter plane", 2 * math.pi),
    "columns that overlap": ("columns", {"count": 2, "distance": 1.3}, {}, "quarter plane", UNION),
    "columns aside": ("columns", {"count": 2, "distance": 1.3, "x": 0.1, "y": 0.2}, {}, "plane", UNION),
    "cone": ("pile", {}, {}, "radial quarter plane", math.pi / (3 * SLOPE**2)),
    "pyramid": ("pile", {"shape": "pyramid", "angle": 45}, {}, "quarter plane", 4 / (3 * SLOPE**2)),
    "turned pyramid": ("pile", {"shape": "pyramid", "angle": 22.5}, {}, "plane", 4 / (3 * SLOPE**2)),
    "riemann": ("riemann", {}, WALL, "line", BOX / 2),
    "slide": ("slide", {}, WALL, "line", BOX),
    "shear": ("shear", {}, {"boundary": "periodic"}, "line", BOX),
}  # fmt: skip
RUNS = [(case, model) for case, (*_, models, _) in CASES.items() for model in models.split()]


def point(case, **changes):
    scene, options, keys, *_ = CASES[case]
    return config.make_point({"scene": scene, "scene_options": options, "cells": 2 * HALF, **keys, **changes})


def grains(case, model="auto", **changes):
    """h2 of a case at the start, on the smallest box of a model."""
    p = point(case, model=model, **changes)
    return scenes.load(p.scene).initial(make_grid(choice.of(p).geometry, DX, HALF), p).h2


def test_every_scene_is_a_case_or_the_raster():
    assert {scene for scene, *_ in CASES.values()} | {"raster"} == set(scenes.NAMES)


@pytest.mark.parametrize("case", CASES)
def test_scenes_allow_the_models_that_are_exact_for_them(case):
    models = CASES[case][3].split()
    assert choice.of(point(case)).model == models[0]
    lone = ["one-layer"] if models[0] in ("radial", "line") else []
    assert set(lone + models) <= set(choice.exact_models(point(case, r=0)))
    assert choice.of(point(case, r=0, quantities="grains")).model == (lone + models)[0]
    for model in {"radial", "line", "quarter", "plane"} - set(models):
        with pytest.raises(config.ConfigError, match="^model: "):
            point(case, model=model)


@pytest.mark.parametrize(("case", "model"), [*RUNS, ("cylinder", "one-layer"), ("dam", "one-layer")])
def test_scenes_run_and_hold_their_volume(case, model):
    run = solve(point(case, model=model, t_end=0.01, r=0 if model == "one-layer" else 0.4))
    assert (run.status, run.model) == ("ok", model)
    assert run.steps >= 1
    on_line = choice.of(run.point).geometry == "line"
    volume = run.sediment_volume / (0.56 * 0.0705 ** (2 if on_line else 3))
    np.testing.assert_allclose(volume[0], CASES[case][4], rtol=2e-4, atol=1e-12)
    np.testing.assert_allclose(volume, volume[0], rtol=1e-12, atol=1e-12)


@pytest.mark.parametrize("case", [case for case, model in RUNS if model == "quarter"])
def test_scenes_with_two_mirrors_are_symmetric_to_the_bit(case):
    h2 = grains(case, "plane")
    assert np.array_equal(h2, h2[::-1])
    assert np.array_equal(h2, h2[:, ::-1])
    assert np.array_equal(h2[HALF:, HALF:], grains(case, "quarter"))


@pytest.mark.parametrize("case", ["turned ellipse", "turned pyramid"])
def test_half_a_turn_changes_no_bit(case):
    h2 = grains(case)
    assert np.array_equal(h2, h2[::-1, ::-1])


def test_a_mirror_along_y_is_kept_by_columns_aside_along_x():
    h2 = grains("column aside", scene_options={"count": 2, "x": 0.3})
    assert np.array_equal(h2, h2[::-1])


@pytest.mark.parametrize("case", ["column", "round ellipse"])
@pytest.mark.parametrize("model", ["radial", "quarter", "plane"])
def test_what_is_a_cylinder_has_its_bits(case, model):
    assert np.array_equal(grains(case, model), grains("cylinder", model))


def test_discs_have_their_exact_share_of_each_cell():
    edges = np.arange(HALF + 1) * DX
    share = _discs.fraction(_discs.ellipse_area(edges, edges), edges, edges)
    np.testing.assert_allclose(share, cylinder.quadrant_depth(edges), rtol=0, atol=1e-13)
    assert np.array_equal(share == 1, cylinder.quadrant_depth(edges) == 1)
    assert np.array_equal(share == 0, cylinder.quadrant_depth(edges) == 0)


def test_a_turned_and_shifted_ellipse_has_its_share_of_each_cell():
    edges = np.linspace(-2, 2, 13)
    share = _discs.ellipse_area(edges, edges, (0.3, -0.2), (1.4, 0.5), 0.6) / (1 / 3) ** 2
    n = 200
    fine = np.linspace(-2, 2, 12 * n + 1)
    x, y = np.meshgrid((fine[1:] + fine[:-1]) / 2 - 0.3, (fine[1:] + fine[:-1]) / 2 + 0.2)
    u, v = x * np.cos(0.6) + y * np.sin(0.6), y * np.cos(0.6) - x * np.sin(0.6)
    counted = ((u / 1.4) ** 2 + (v / 0.5) ** 2 < 1).reshape(12, n, 12, n).mean(axis=(1, 3))
    np.testing.assert_allclose(share, counted, rtol=0, atol=5e-4)


def test_columns_that_overlap_are_one_deep_where_they_do():
    h2 = grains("columns aside")
    assert h2.max() == 1
    middle = np.searchsorted(np.arange(-HALF, HALF) * DX, [0.2, 0.1])
    assert h2[tuple(middle - 1)] == 1


@pytest.mark.parametrize("case", ["ellipse", "columns"])
def test_the_quarter_gives_the_planes_answer(case):
    quarter, plane = (
        solve(point(case, model=model, t_end=0.15, fields=True)) for model in ("quarter", "plane")
    )
    assert quarter.steps == plane.steps > 10
    for name in ("x_front", "max_abs_eta", "sediment_volume", "water_volume", "energy"):
        np.testing.assert_allclose(getattr(quarter, name), getattr(plane, name), rtol=1e-10, atol=1e-14)
    np.testing.assert_allclose(
        quarter.h2_field, plane.h2_field[:, plane.h2_field.shape[1] // 2 :, len(plane.x) // 2 :], atol=1e-9
    )


@pytest.mark.parametrize("order", [1, 2])
@pytest.mark.parametrize("case", ["cone", "pyramid", "turned pyramid"])
def test_piles_rest_unless_they_are_too_steep(case, order):
    options = CASES[case][1]
    still = solve(point(case, order=order, t_end=0.3))
    assert still.steps > 20
    assert np.array_equal(still.h2[0], still.h2[-1])
    steep = solve(point(case, order=order, t_end=0.3, scene_options={**options, "steepness": 1.1}))
    assert not np.array_equal(steep.h2[0], steep.h2[-1])


@pytest.mark.parametrize(("law", "delta"), [("coulomb", 0), ("coulomb", 20), ("voellmy", 20), ("voellmy", 0)])
def test_a_slide_slows_as_its_friction_law_says(law, delta):
    p = point("slide", friction=law, delta=delta, xi=50, cells=400)
    model = build(p, 200, 1e-6)
    advance(model, stop=0.5)
    time = 0.5 * math.sqrt(p.radius / (p.g * p.a_2))
    speed = float(slide.speed_of(p, time)) / math.sqrt(p.g * p.a_2 * p.radius)
    assert inner(model, "u2")[200] == pytest.approx(speed, rel=2e-3)
    profile = slide.solution(p, model.x * p.radius, time)
    known = np.isfinite(profile["h2"])
    assert known[200]
    assert not known[0]
    middle = np.abs(model.x) < 1
    assert known[middle].all()
    np.testing.assert_allclose(inner(model, "h2")[middle], 1, rtol=1e-9)
    assert np.all(inner(model, "u1")[middle] == 0)


@pytest.fixture
def raster(tmp_path):
    """Function that writes a raster of x, y and h2 (m) and returns its path."""

    def write(x, y, h2, name="h2", file="raster.nc"):
        path = tmp_path / file
        with netCDF4.Dataset(path, "w") as data:
            for key, values in (("y", y), ("x", x)):
                data.createDimension(key, len(values))
                data.createVariable(key, "f8", (key,))[:] = values
            data.createVariable(name, "f8", ("y", "x"))[:] = h2
        return str(path)

    return write


@pytest.mark.parametrize("method", ["conservative", "bilinear"])
def test_a_raster_of_the_cylinder_is_the_cylinder(raster, method):
    centres = (np.arange(-HALF, HALF) + 0.5) * DX * 0.0705
    path = raster(centres, centres[::-1], grains("cylinder", "plane") * 0.56 * 0.0705)
    p = config.make_point(
        {
            "scene": "raster",
            "scene_options": {"file": path, "method": method},
            "cells": 2 * HALF,
            "t_end": 0.1,
        }
    )
    assert choice.of(p).model == "plane"
    found = scenes.load("raster").initial(make_grid("plane", DX, HALF), p).h2
    np.testing.assert_allclose(found, grains("cylinder", "plane"), rtol=0, atol=1e-12)
    run, reference = solve(p), solve(point("cylinder", model="plane", t_end=0.1))
    np.testing.assert_allclose(
        run.x_front[:, 1:], reference.x_front[:, 1:], rtol=1e-6
    )  # a raster knows no sides


def test_a_raster_of_any_step_keeps_its_volume(raster):
    x, y = np.linspace(-0.1, 0.11, 64), np.linspace(-0.09, 0.12, 30)
    h2 = 0.02 * np.exp(-((x[None, :] / 0.03) ** 2) - ((y[:, None] - 0.01) / 0.03) ** 2)
    p = config.make_point({"scene": "raster", "scene_options": {"file": raster(x, y, h2)}, "cells": 2 * HALF})
    found = scenes.load("raster").initial(make_grid("plane", DX, HALF), p).h2
    volume = found.sum() * DX**2 * 0.56 * 0.0705**3
    assert volume == pytest.approx(h2.sum() * (x[1] - x[0]) * (y[1] - y[0]), rel=1e-12)


def test_the_id_follows_the_rasters_content(raster):
    x = np.linspace(-0.1, 0.1, 10)
    values = {"scene": "raster", "scene_options": {"file": raster(x, x, np.full((10, 10), 0.01))}}
    first, again = config.make_point(values), config.make_point(values)
    raster(x, x, np.full((10, 10), 0.011))
    other = config.make_point(values)
    assert first.id == again.id != other.id
    with pytest.raises(config.ConfigError, match="has changed"):
        scenes.check(first)


@pytest.mark.parametrize(
    ("name", "change", "part"),
    [
        ("h2", lambda x, h: h.__setitem__((0, 0), -1e-6), "h2 is -1e-06 m"),
        ("h2", lambda x, h: h.__setitem__((0, 0), np.nan), "missing or infinite"),
        ("h2", lambda x, h: h.__setitem__((5, 5), 0.5), "above the water's level"),
        ("h2", lambda x, h: x.__setitem__(9, 0.2), "unequal steps"),
        ("h2", lambda x, h: x.__imul__(10), "beyond the box"),
        ("depth", lambda x, h: None, "no variable h2"),
    ],
)
def test_rasters_that_cannot_be_used(raster, name, change, part):
    x, h2 = np.linspace(-0.1, 0.1, 10), np.full((10, 10), 0.01)
    change(x, h2)
    with pytest.raises(config.ConfigError, match=part) as caught:
        config.make_point({"scene": "raster", "scene_options": {"file": raster(x, x, h2, name)}})
    assert "\n" not in str(caught.value)


def test_a_file_that_is_no_raster(tmp_path):
    (tmp_path / "x.nc").write_text("text")
    for file, part in (("x.nc", "not a NetCDF file"), ("absent.nc", "there is no such file")):
        with pytest.raises(config.ConfigError, match=part):
            config.make_point({"scene": "raster", "scene_options": {"file": str(tmp_path / file)}})


@pytest.mark.parametrize(
    ("values", "place"),
    [
        ({}, 1.0),
        ({"model": "quarter"}, 1.0),
        ({"model": "plane"}, 1.0),
        ({"scene": "ellipse", "scene_options": {"elongation": 4, "angle": 90}}, 0.5),
        ({"scene": "columns", "scene_options": {"count": 2, "distance": 2.5}}, 2.25),
        ({"scene": "columns", "scene_options": {"x": 0.5, "y": 0.6}}, 1.3),
        ({"scene": "dam_break", "boundary": "wall"}, 0.0),
    ],
)
@pytest.mark.parametrize("cells", [40, 41])
def test_the_front_starts_at_the_upright_side_on_every_grid(values, place, cells):
    run = solve(config.make_point({"cells": cells, "t_end": 1e-4, **values}))
    np.testing.assert_allclose(run.x_front[:, 0], place * 0.0705, rtol=1e-12)


def test_columns_beside_the_axis_have_no_front_at_the_start():
    run = solve(
        config.make_point({"scene": "columns", "scene_options": {"y": 1.5}, "cells": 40, "t_end": 1e-4})
    )
    assert np.isnan(run.x_front[:, 0]).all()
