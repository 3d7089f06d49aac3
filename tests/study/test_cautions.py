"""Guard rails: each unsafe region is earned by a real run in it, and a normal run says nothing."""

import itertools

import netCDF4
import numpy as np
import pytest

from subslide import exact
from subslide.__main__ import main
from subslide.keys import words
from subslide.points import Point
from subslide.records import energy
from subslide.records.energy import GAINED
from subslide.solver import solve
from subslide.study import cautions, config

REGIONS = {region.name: region for region in cautions.REGIONS}


def gain(run):
    """Largest rise of a run's energy over what its start can release."""
    return energy.rise(run.point, run.model, run.box_half_width, {"time": run.time, **run.series})


def jump(run):
    """Largest jump of the surface between neighbouring cells, over H2."""
    return np.abs(np.diff(run.eta[-1])).max() / (run.point.a_2 * run.point.radius)


def off(run):
    """Mean distance of h2 from linear theory over the exact amplitude at the end of the scene `shear`."""
    answer = exact.load("shear")
    h2 = answer.solution(run.point, run.x, run.time[-1])["h2"]
    size = answer.amplitude(run.point, run.time[-1]) * run.point.a_2 * run.point.radius
    return np.abs(run.h2[-1] - h2).mean() / size


HARM = {
    "Courant number": lambda run: run.status != "ok" or gain(run) > GAINED,
    "little friction": lambda run: run.status in ("left_domain", "not_at_rest"),
    "floating grains": lambda run: gain(run) > GAINED,
    "printed formula": lambda run: run.status == "not_at_rest",
    "creeping": lambda run: np.abs(run.h2[-1] - run.h2[0]).max() > 1e-3 * run.h2.max(),
    "standing jump": lambda run: jump(run) > 0.2,
    "stairs": lambda run: np.abs(run.h2[-1] - run.h2[0]).max() > 0.01 * run.h2.max(),
    "sliding layers": lambda run: np.ptp(run.h2[-1]) > 0.05 * run.h2.mean(),
}
"""What goes wrong in each region, as a function of a run."""


@pytest.fixture(autouse=True)
def cone(tmp_path, monkeypatch):
    """The raster that an example reads: a cone, less steep than friction holds, in pixels of 1 cm."""
    monkeypatch.chdir(tmp_path)
    c = (np.arange(20) + 0.5) * 0.01 - 0.1
    with netCDF4.Dataset("cone.nc", "w") as data:
        for key in "yx":
            data.createDimension(key, 20)
            data.createVariable(key, "f8", (key,))[:] = c
        slope = 0.9 * np.tan(np.radians(32))
        depth = np.clip(0.0353 - slope * np.hypot(*np.meshgrid(c, c)), 0, None)
        data.createVariable("h2", "f8", ("y", "x"))[:] = depth


@pytest.mark.parametrize("name", REGIONS)
def test_a_region_is_earned_and_its_advice_mends(name):
    region = REGIONS[name]
    wrong, right = (config.make_point(values) for values in (region.example, region.example | region.instead))
    assert region.holds(wrong)
    assert not region.holds(right)
    assert HARM[name](solve(wrong))
    assert not HARM[name](solve(right))


def test_grains_with_little_friction_leave_the_largest_box():
    for a_2, delta, held in ((10.0, 30.0, True), (4.64, 15.0, True), (0.56, 5.0, False)):
        point = Point(a_2=a_2, delta=delta, cells=60)
        assert REGIONS["little friction"].holds(point) == held
        assert (solve(point).status == "left_domain") == held


def test_every_region_is_tested_and_says_what_to_choose():
    assert set(HARM) == set(REGIONS)
    for region in cautions.REGIONS:
        (line,) = [
            text for text in cautions.cautions([config.make_point(region.example)]) if region.name in text
        ]
        assert region.reason in line
        assert f"Choose {region.advice}" in line


@pytest.mark.parametrize("region", cautions.REGIONS, ids=list(REGIONS))
def test_a_caution_of_the_largest_study_is_not_cut(region, monkeypatch):
    monkeypatch.setattr(cautions, "REGIONS", (region._replace(holds=lambda point: True),))
    (line,) = cautions.cautions([None] * config.MOST_POINTS)
    assert "(200000 of 200000 runs)" in line
    assert len(f"subslide: {line}") <= words.MOST


def test_every_region_was_seen_in_a_study(root):
    for region in filter(lambda region: region.seen, cautions.REGIONS):
        study = config.read_study(root / "config" / f"{region.seen.split(',')[0]}.yaml")
        assert any(map(region.holds, study.points)), region.name


def test_the_default_and_the_papers_range_are_in_no_region():
    assert cautions.cautions([Point()]) == []
    for a_H, r, order in itertools.product((0.01, 0.5, 1, 10), (0, 0.4, 0.8), (1, 2)):
        assert cautions.regions_of(Point(a_H=a_H, r=r, order=order)) == []


def test_a_study_says_it_once_for_each_region():
    points = [Point(cfl=cfl, delta=0.0) for cfl in (0.5, 1.5, 2.0)]
    lines = cautions.cautions(points)
    assert len(lines) == 2
    assert "(2 of 3 runs)" in lines[0]
    assert "(3 of 3 runs)" in lines[1]


def test_a_normal_run_is_silent_and_an_unsafe_one_says_so_once(tmp_path, capfd):
    options = ["run", "--cells", "100", "--t-end", "0.01", "-o", str(tmp_path / "a.nc")]
    assert main(options) == 0
    assert capfd.readouterr().err == ""
    assert main([*options, "--cfl", "1.5"]) == 0
    said = capfd.readouterr().err
    assert said.count("\n") == said.count("caution") == 1
    assert "subslide: caution, Courant number (this run)" in said


def test_check_cautions_of_a_study(write_yaml, capfd):
    path = write_yaml("study: t\ncfl: [0.9, 1.5]\ncells: 20\nfigures: none\n")
    assert main(["check", str(path)]) == 0
    said = capfd.readouterr()
    assert "2 runs" in said.out
    assert "Courant number (1 of 2 runs)" in said.err
