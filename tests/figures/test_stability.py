"""Figures of stability draw every method and mark what failed; on the real study with made-up results."""

import importlib
import json

import numpy as np
import pandas as pd
import pytest
import xarray as xr

from subslide import catalogue, exact
from subslide.points import RUN_KEYS, options_text, to_dict
from subslide.results import StudyRun
from subslide.study import choice
from subslide.study.config import make_study, read_study
from subslide.tables import atlas

NAMES = [name for name in catalogue.names("figures") if name.startswith("stability_")]


class MadeUp:
    """The stability study: methods err by their order, films fail, waves grow as theory has it."""

    def __init__(self, study):
        self.runs_of_study = [StudyRun(point.id, label, point, "") for label, point in study.runs]
        self.all = {point.id: point for point in study.points}
        self.finest = {column(point): point.id for point in study.points if point.cells == 800}
        self.atlas = pd.DataFrame([self.row(point) for point in study.points])
        methods = [(m, s, o) for m in ("line", "radial") for s in ("ifcph", "hll") for o in (1, 2)]
        self.cfl = pd.DataFrame(
            {"model": m, "scene": "cylinder", "scheme": s, "order": o, "cfl": cfl, "theory": 1.0,
             "stable": cfl < 1, "limit": cfl == 0.9 and (s, o) != ("hll", 1)}
            for m, s, o in methods for cfl in (0.6, 0.9, 1.2)
        )  # fmt: skip

    def row(self, point):
        """Return the row of the atlas."""
        row = {key: value for key, value in to_dict(point).items() if key in atlas.COLUMNS}
        status = "step_collapse" if point.a_H == 0.0215 else "left_domain" if point.delta == 0 else "ok"
        rate = exact.load("shear").growth_rate(point) if point.scene == "shear" else np.nan
        return {
            **row,
            "id": point.id,
            "scene_options": options_text(point),
            "status": status,
            "steps": 100,
            "L_f_error": 0.1 / point.order if status == "ok" else np.nan,
            "energy_rise": 1.0 if point.a_H == 0.01 else 0.0,
            "reference": self.finest.get(column(point), ""),
            "nonhyperbolic_length": 0.2 if point.cells == 800 and point.a_H < 0.2 else 0.0,
            "growth_rate": rate,
            "growth_rate_theory": rate,
        }

    def profiles(self, name):
        """Return the record of one run, which has profiles."""
        point = self.all[name]
        half = point.cells // 2
        line = choice.of(point).model == "line"
        x = (np.arange(-half if line else 0, half) + 0.5) * point.dx
        time = np.linspace(0, 1, 21)
        shots = np.array([0, 0.1, 0.2, 1.0])
        h2 = np.exp(-(x**2)) * np.ones((4, 1))
        variables = {
            "h2": (("snapshot", "x"), h2),
            "eta": (("snapshot", "x"), 0 * h2),
            "energy": ("step", 2 - time),
        }
        return xr.Dataset(
            {**variables, "snapshot_time": ("snapshot", shots), "time": ("step", time)}, {"x": x}
        )


@pytest.fixture(scope="module")
def results(request):
    """Return the made-up study."""
    return MadeUp(read_study(request.config.rootpath / "config/stability.yaml"))


def column(point):
    """Return what tells the columns of the study apart."""
    return point.scene, point.boundary, point.a_H, point.a_2, point.r, point.delta


def draw(name, results):
    """Return the figure called `name`."""
    return importlib.import_module(f"subslide.figures.{name}").draw(results)


def seen(figure):
    """Return the axes that hold something, without the bar of colours."""
    return [ax for ax in figure.axes if ax.has_data() and ax.get_label() != "<colorbar>"]


def symbols(ax, color):
    """Return the number of symbols of a colour."""
    return sum(line.get_color() == color and line.get_linestyle() == "None" for line in ax.get_lines())


@pytest.mark.parametrize("name", ["stability_depth", "stability_aspect", "stability_film"])
def test_maps_have_a_panel_for_each_scheme_and_order(name, results):
    axes = seen(draw(name, results))
    assert len(axes) == 10
    for ax in axes:
        (mesh,) = [part for part in ax.collections if hasattr(part, "get_coordinates")]
        shown = mesh.get_array()
        assert np.ma.count(shown) > 20
        assert np.ptp(shown.compressed()) == 0
    assert axes[0].get_ylabel().startswith("order 1")
    assert axes[5].get_ylabel().startswith("order 2")


def test_maps_show_what_failed_and_what_gained_energy(results):
    ax = seen(draw("stability_depth", results))[0]
    rows = results.atlas
    tried = rows[(rows["scene"] == "cylinder") & (rows["cells"] == 100) & (rows["delta"] == 32)]
    densities = tried[(tried["a_H"] == 0.0215)]["r"].nunique()
    assert symbols(ax, "#b40426") == 2 * densities  # a_H = 0.0215 failed, 0.01 gained energy
    outline = [line for line in ax.get_lines() if line.get_color() == "black" and line.get_linestyle() == "-"]
    assert len(outline) >= 4  # around the columns that lose hyperbolicity


def test_bars_stand_beside_theory_and_none_is_told(results):
    axes = seen(draw("stability_cfl", results))
    assert len(axes) == 2
    for ax in axes:
        assert len(ax.patches) == 4
        assert sorted({bar.get_height() for bar in ax.patches}) == [0.0, 0.9]
        assert [text.get_text() for text in ax.texts] == ["none"]
        assert [line.get_ydata()[0] for line in ax.get_lines()] == [1.0, 0.9]


def test_growth_rates_lie_on_the_line_of_theory(results):
    axes = seen(draw("stability_shear", results))
    assert len(axes) == results.atlas[results.atlas["scene"] == "shear"]["r"].nunique()
    for ax in axes:
        theory, *runs = ax.get_lines()
        real = [line for line in runs if line.get_markerfacecolor() != "none" and len(line.get_xdata()) > 2]
        assert len(real) == 10
        for line in real:
            near = np.interp(line.get_xdata(), theory.get_xdata(), theory.get_ydata())
            np.testing.assert_allclose(line.get_ydata(), near, atol=0.05 * max(theory.get_ydata()))


def test_grids_have_both_orders_and_precisions(results):
    axes = seen(draw("stability_grids", results))
    assert len(axes) == 6
    for ax in axes:
        lines = [line for line in ax.get_lines() if len(line.get_xdata()) > 2]
        assert len(lines) == 4
        assert all(set(line.get_xdata()) >= {25, 1600} for line in lines)


def test_the_gallery_has_a_real_run_in_every_panel(results):
    figure = draw("stability_failures", results)
    axes = seen(figure)
    assert len(axes) == 4
    assert not any("no such run" in ax.get_title() for ax in axes)
    assert all(ax.get_xlabel() and ax.get_ylabel() for ax in axes)
    assert "None ended as negative_depth or diverged" in figure.texts[-1].get_text().replace("\n", " ")


@pytest.mark.parametrize("name", NAMES)
def test_only_such_studies_have_the_figures_and_others_are_told(name):
    plain = make_study({"study": "t", "model": "radial"})
    assert name not in plain.figures
    empty = MadeUp(plain)
    empty.atlas = empty.atlas.assign(scene="none", cfl=0.5)
    if name != "stability_cfl":
        figure = draw(name, empty)
        words = figure.get_suptitle() + " ".join(ax.get_title() for ax in figure.axes)
        assert "no such run" in words


def test_every_key_of_a_run_is_in_the_atlas_or_aside():
    assert set(RUN_KEYS) <= {*atlas.COLUMNS, *atlas.ASIDE}
    assert set(atlas.NUMERICS) <= set(RUN_KEYS)
    assert json.loads(options_text(make_study({"study": "t"}).points[0])) == {}
