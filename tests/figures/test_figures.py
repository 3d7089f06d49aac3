"""Every figure draws, says what it shows with units, and hides no failed run."""

import importlib
import re
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from made_up import RESOLVED, MadeUpResults, grid

from subslide import catalogue
from subslide.figures import _profiles, _slices, _style, _words
from subslide.keys import schema
from subslide.laboratory import lube as laboratory
from subslide.tables.runs import UNTOLD

NAMES = [name for name in catalogue.names("figures") if name.startswith("fig")]
"""Figures of collapses; those of verification are in test_verify.py."""
CAPTIONS = Path(__file__).parents[2] / "workflow" / "report"
UNIT = re.compile(r"\((mm|cm|m|km|ms|s|%)\)|/R\$|/H_2\$|^\$r\$$")


def draw(name, results):
    """Return the figure called `name` of a study."""
    return importlib.import_module(f"subslide.figures.{name}").draw(results)


def seen(figure):
    """Return the axes of a figure that are shown and hold something."""
    return [ax for ax in figure.axes if ax.get_visible() and ax.has_data()]


def words(figure):
    """Return all text of a figure: title, notes and legends."""
    titles = [ax.get_title() for ax in figure.axes]
    return " ".join([figure.get_suptitle(), *titles, *(text.get_text() for text in figure.texts)]).replace(
        "\n", " "
    )


@pytest.mark.parametrize("name", NAMES)
def test_labels_have_units(name, paper):
    figure = draw(name, paper)
    labels = [text for ax in seen(figure) for text in (ax.get_xlabel(), ax.get_ylabel()) if text]
    assert labels
    assert [text for text in labels if not UNIT.search(text)] == []
    assert figure.get_suptitle()
    assert "first-order IFCPH, cells of 3 mm" in words(figure)


@pytest.mark.parametrize("name", catalogue.names("figures"))
def test_is_described(name):
    about = catalogue.figure(name)
    assert (CAPTIONS / f"{name}.rst").read_text(encoding="utf-8").strip()
    assert re.match(r"\d \w", about.category)
    assert about.title != name
    assert isinstance(about.needs, dict)


@pytest.mark.parametrize("name", NAMES)
def test_any_study_that_has_the_needs(name):
    needs = catalogue.figure(name).needs
    few = grid(needs.get("a_H", (3,)), needs.get("r", (0.3,)), radius=7.0, a_2=0.8, delta=25.0, order=2)
    figure = draw(name, MadeUpResults(few))
    assert seen(figure)
    assert "Not converged" not in words(figure)


@pytest.mark.parametrize("name", NAMES)
def test_a_large_study_says_what_is_left_out(name, large):
    text = words(draw(name, large))
    assert "$a_2$ = 0.56" in text
    assert "Also in this study, not shown here: $a_2$ = 1." in text


@pytest.mark.parametrize("name", NAMES)
def test_failed_runs_are_named(name):
    runs = grid((1, 2, 10), (0, 0.4, 0.8))
    for run in runs:
        if run["a_H"] == 1 and run["r"] in (0, 0.4):
            run["status"] = "diverged"
        elif run["r"] == 0.8:
            run["status"] = "not_at_rest"
    text = words(draw(name, MadeUpResults(runs)))
    assert "Status diverged (a value is not finite" in text


@pytest.mark.parametrize("name", NAMES)
def test_short_run_of_the_grains_alone(name, tmp_path):
    needs = catalogue.figure(name).needs
    values = {"resolved_model": "one-layer", "t_end": "0.05", "until": 0.05}
    figure = draw(name, MadeUpResults(grid(needs.get("a_H", (1,)), needs.get("r", (0,)), **values)))
    figure.savefig(tmp_path / "figure.svg", bbox_inches="tight")
    if "surface" in catalogue.figure(name).title:
        assert "water surface" in words(figure)


@pytest.mark.parametrize("name", NAMES)
def test_runs_on_a_fitted_grid(name, tmp_path):
    """Grains are drawn where they are; of the surface, which such runs do not resolve, there is a word and no axis."""
    needs = catalogue.figure(name).needs
    values = {"resolved_grid": "fitted", "cells": 48}
    figure = draw(name, MadeUpResults(grid(needs.get("a_H", (1, 10)), needs.get("r", (0, 0.4)), **values)))
    figure.savefig(tmp_path / "figure.svg", bbox_inches="tight")
    shown = [ax for ax in figure.axes if ax.get_visible()]
    assert seen(figure) == shown
    assert bool(shown) == (name not in ("fig08_max_eta", "fig09_surface"))
    assert "nan" not in words(figure)
    if "surface" in catalogue.figure(name).title:
        assert "on a grid fitted to the grains" in words(figure)
    else:
        assert "48 fitted cells" in words(figure)


@pytest.mark.parametrize("name", NAMES)
def test_runs_on_a_fitted_grid_beside_others(name):
    values = ((1, 2, 10), (0, 0.2, 0.4, 0.6, 0.8))
    kinds = grid(*values) + grid(*values, **RESOLVED, resolved_grid="fitted")
    figure = draw(name, MadeUpResults(kinds, bands=True))
    assert seen(figure) == [ax for ax in figure.axes if ax.get_visible()]
    assert "nan" not in words(figure)


def test_profiles_on_a_fitted_grid_are_drawn_at_the_places_of_their_time():
    results = MadeUpResults(grid((1,), (0.4,), resolved_grid="fitted"))
    record = results.record(results.runs["id"][0])
    axes = seen(draw("fig05_h2_by_r", results))
    for n, ax in enumerate(axes[:5]):  # the times that were asked for
        line = ax.get_lines()[0]
        np.testing.assert_allclose(line.get_xdata()[1:], 1e2 * record["x"][n])
        np.testing.assert_allclose(line.get_ydata()[1:], 1e3 * record["h2"][n])


def test_profiles_that_agree_on_cells_that_moved_are_one_line():
    x = np.linspace(0, 1, 40)
    one, other = (_profiles.Profile(t, at, 1 - at, True, False, False) for t, at in ((0.0, x), (0.1, x**2)))
    assert len(_profiles.together([one, other], 1e-3)) == 1
    assert len(_profiles.together([one, other._replace(values=1 - x)], 1e-3)) == 2


def test_every_run_of_a_slice_is_a_line(paper):
    axes = seen(draw("fig06_fronts", paper))
    assert [len(ax.get_lines()) for ax in axes[:3]] == [5, 5, 5]
    looks = {(line.get_color(), line.get_marker()) for line in axes[0].get_lines()}
    assert len(looks) == 5


def test_laboratory_law():
    assert laboratory.runout(0.56) == pytest.approx(1.6944)
    assert laboratory.runout(4.0) == pytest.approx(4.2)


def test_height_and_time_of_rest_stand_beside_the_laboratorys(paper):
    row = paper.select(a_H=2.0, r=0.0).iloc[0]
    record = paper.record(row["id"])
    top = np.interp(0, record["x"], record["h2"].isel(snapshot=-1)) / row["radius"]
    text = words(draw("fig04_profiles_r0", paper))
    assert f"{top:.2f}" in text
    assert f"{1e3 * row['time_at_rest']:.3g} ms" in text
    assert f"{3e3 * np.sqrt(0.56 * 0.0705 / 9.81):.3g} ms" in text


def test_depth_at_the_laboratory_runout_is_measured(paper):
    record = paper.record(paper.select(a_H=2.0, r=0.0)["id"].iloc[0])
    depth = 100 * np.interp(1.6944 * 0.0705, record["x"], record["h2"].isel(snapshot=-1)) / (0.56 * 0.0705)
    assert f"{depth:.1f} % ($a_H$ = 2)" in words(draw("fig04_profiles_r0", paper))


def test_depths_at_the_laboratory_runout_are_told_for_each_kind_of_numerics(both):
    text = words(draw("fig04_profiles_r0", both))
    assert "Paper's numerics: Depth there" in text
    assert "Resolved: Depth there" in text


def test_slice_keeps_one_value_of_what_does_not_vary():
    runs = grid((1, 2), (0, 0.4)) + grid((1, 2), (0, 0.4), cells=100) + grid((1,), (0,), delta=20.0)
    chosen = _slices.cut(MadeUpResults(runs))
    assert set(chosen.runs["cells"]) == {200}
    assert set(chosen.runs["delta"]) == {32.0}
    assert not chosen.runs.duplicated(["a_H", "r"]).any()
    assert "$\\delta$ = 20" in chosen.notes[0]
    assert "cells = 100" in chosen.notes[0]


KEYS = [key for key in ("numerics", *schema.run_keys()) if key not in ("a_H", "r", *UNTOLD)]
"""Keys with a column in the table of runs that figures of collapses keep fixed."""
SHOWN = {"numerics": "paper", "scene_options": "{}", "model": "radial", "fields": True}
"""Values that figures take, of the keys for which that is neither the default nor the largest."""
LEFT_OUT = {"scene_options": '{"steepness":0.5}', "order": 1, "cells": 100}


def left_out(key, shown):
    """Return another value of a key than the one that is shown."""
    about = schema.properties()[key]
    if "enum" in about:
        return next(value for value in about["enum"] if value != shown)
    return not shown if about.get("type") == "boolean" else 0.5


@pytest.mark.parametrize("key", KEYS)
def test_one_value_of_every_key_of_a_run_is_shown_and_the_other_told(key):
    shown = SHOWN.get(key, schema.properties()[key]["default"])
    other = LEFT_OUT.get(key, left_out(key, shown))
    chosen = _slices.cut(
        MadeUpResults(grid((1, 2), (0, 0.4), **{key: other}) + grid((1, 2, 10), (0, 0.4), **{key: shown}))
    )
    assert set(chosen.runs[key]) == {shown}
    assert len(chosen.runs) == 6
    assert chosen.notes == [f"Also in this study, not shown here: {_words.values(key, pd.Series([other]))}."]


def test_every_key_of_a_run_is_settled_once():
    assert sorted(_slices.settled_keys()) == sorted(("numerics", *schema.run_keys()))
    assert set(_slices.PREFERRED) <= set(_slices.settled_keys())


def test_a_new_key_of_a_run_is_settled_by_its_entry(monkeypatch):
    entry = {"role": "method", "description": "a new one", "enum": ["new", "old"], "default": "new"}
    monkeypatch.setitem(schema.properties(), "limiter", entry)
    runs = [run | {"limiter": name} for name in ("old", "new") for run in grid((1, 2), (0, 0.4))]
    chosen = _slices.cut(MadeUpResults(runs))
    assert set(chosen.runs["limiter"]) == {"new"}
    assert chosen.notes == ["Also in this study, not shown here: limiter = old."]


def test_a_study_that_sweeps_the_flux_at_fronts_has_one_curve_for_each_run():
    runs = [run | {"front_flux": flux} for flux in ("hll", "exact") for run in grid((1, 2), (0, 0.4))]
    figure = draw("fig06_fronts", MadeUpResults(runs))
    assert [len(ax.get_lines()) for ax in seen(figure)[:2]] == [2, 2]
    assert "Also in this study, not shown here: front_flux = hll." in words(figure)


def test_runs_that_differ_in_no_column_are_shown_once_and_counted():
    chosen = _slices.cut(MadeUpResults(grid((1, 2), (0, 0.4)) * 2))
    assert not chosen.runs.duplicated(["a_H", "r"]).any()
    (note,) = chosen.notes
    assert note.startswith("Also in this study, not shown here: 4 runs that differ in ")
    assert "snapshot_times" in note


def test_the_resolved_runs_with_fields_do_not_hide_the_papers_numerics():
    runs = grid((1, 2), (0, 0.4), fields=False) + grid((1, 2), (0, 0.4), **RESOLVED, fields=True)
    assert set(_slices.cut(MadeUpResults(runs)).runs["numerics"]) == {"paper"}


def test_looks_differ_in_grey():
    looks = _style.looks_of((0, 0.2, 0.4, 0.6, 0.8)).values()
    grey = [np.dot(look["color"][:3], (0.299, 0.587, 0.114)) for look in looks]
    assert np.all(np.diff(grey) > 0.08)
    assert len({str(look["linestyle"]) for look in looks}) == 5


@pytest.mark.parametrize(
    ("length", "name", "factor"), [(0.04, "mm", 1e3), (0.2, "cm", 1e2), (40.0, "m", 1.0), (9e3, "km", 1e-3)]
)
def test_unit_of_lengths(length, name, factor):
    assert _words.length_unit(length) == (name, factor)


def test_the_last_of_the_papers_times_has_its_panel_where_runs_end_there():
    figure = draw("fig09_surface", MadeUpResults(grid((1, 2), (0.2, 0.4), until=0.54)))
    titles = [ax.get_title() for ax in seen(figure)]
    assert sum("540 ms" in title for title in titles) == 2
    end = draw("fig05_h2_by_r", MadeUpResults(grid((1,), (0.2, 0.4), until=0.54)))
    assert any("540 ms" in ax.get_title() for ax in seen(end))


def test_panels_that_the_edge_of_the_box_has_a_part_in_are_grey_and_said_so():
    figure = draw("fig09_surface", MadeUpResults(grid((1,), (0.2, 0.4))))
    shades = [ax.get_facecolor()[0] for ax in seen(figure)]
    assert shades == sorted(shades, reverse=True)  # early panels white, late ones grey
    assert shades[0] == 1 > shades[-1]
    assert "Grey panels: waves have been at the edge of the paper's box" in words(figure)
    sea = draw("fig09_surface", MadeUpResults(grid((1,), (0.2, 0.4), boundary="open")))
    assert {ax.get_facecolor()[0] for ax in seen(sea)} == {1}
    assert "Grey" not in words(sea)
    walled = draw("fig09_surface", MadeUpResults(grid((1,), (0.2, 0.4), boundary="wall")))
    assert {ax.get_facecolor()[0] for ax in seen(walled)} == {1}
    assert "Grey" not in words(walled)


def test_a_failed_run_has_no_final_profile():
    runs = grid((1,), (0, 0.4, 0.8))
    runs[1]["status"] = "diverged"
    figure = draw("fig05_h2_by_r", MadeUpResults(runs))
    assert [len(ax.get_lines()) - 1 for ax in seen(figure)] == [3, 3, 2, 2, 2, 2]
    assert "$r$ = 0.4, end of the run" in words(figure)


def test_the_papers_values_come_first(large):
    chosen = _slices.cut(large, most={"a_H": 4, "r": 6}).runs
    assert chosen["a_H"].unique() == pytest.approx([0.5, 1, 2, 10])
    assert chosen["r"].unique() == pytest.approx([0, 0.2, 0.4, 0.6, 0.8])


def test_a_study_without_the_run_gets_an_empty_figure():
    figure = draw("fig10_view3d", MadeUpResults(grid((1,), (0,)) + grid((2,), (0.4,))))
    assert "no such run (a_H = 1, r = 0.4)" in figure.get_suptitle()


@pytest.mark.parametrize("name", ["fig06_fronts", "fig07_front_aH1_aH10", "fig08_max_eta"])
def test_both_numerics_are_drawn_and_told_apart(name, both):
    legend = told_apart(draw(name, both))
    assert "value whose three grids give no order" in legend


@pytest.mark.parametrize("name", ["fig04_profiles_r0", "fig05_h2_by_r", "fig09_surface"])
def test_profiles_of_both_numerics_are_drawn_and_told_apart(name, both):
    legend = told_apart(draw(name, both))
    assert "value whose three grids give no order" not in legend


def told_apart(figure):
    """Return the texts of the legend of a figure, whose first panel has the curves of two kinds of numerics."""
    curves = [line for line in seen(figure)[0].get_lines() if len(line.get_xdata()) > 10]
    styles = {line.get_linestyle() for line in curves}
    widths = {line.get_linewidth() for line in curves}
    assert len(styles) == len(widths) == 2
    legend = [text.get_text() for box in figure.legends for text in box.get_texts()]
    assert any("first-order IFCPH, cells of 3 mm" in text for text in legend)
    assert any("second-order IFCPH, cells of 0.75 mm" in text for text in legend)
    assert "Also in this study" not in words(figure)
    return legend


def test_views_of_both_numerics_stand_side_by_side(both):
    titles = [ax.get_title() for ax in seen(draw("fig10_view3d", both))]
    assert sum("Paper's numerics" in title for title in titles) == 4
    assert sum("Resolved" in title for title in titles) == 4


def test_bands_are_bars_and_values_without_them_are_open(both):
    ax = seen(draw("fig06_fronts", both))[3]
    bars = [one for one in ax.containers if np.isfinite(one.lines[2][0].get_segments()).any()]
    assert len(bars) == 15  # every resolved length, and none with the paper's numerics
    low, high = bars[0].lines[2][0].get_segments()[0][:, 1]
    assert high - low == pytest.approx(0.02 * bars[0].lines[0].get_ydata()[0])
    hollow = [
        line for line in ax.get_lines() if line.get_markerfacecolor() == "white" and len(line.get_xdata())
    ]
    assert len(hollow) == 15


def test_notes_say_what_the_tables_say(both):
    text = words(draw("fig06_fronts", both))
    lengths = both.runs.set_index(["numerics", "a_H", "r"])["L_f_1pc"]
    short = 100 * (1 - lengths["paper"] / lengths["resolved"])
    assert f"{short.iloc[0]:.3g} % short of the resolved" in text
    dry = lengths["paper"].xs(0.0, level="r")
    assert f"by {100 * np.ptp(dry) / dry.max():.2g} % with the paper's numerics" in text
    assert "paper's numerics 75 of 75, resolved 0 of 75 fronts and lengths" in text


@pytest.mark.parametrize("name", ["fig06_fronts", "fig07_front_aH1_aH10", "fig08_max_eta"])
def test_one_kind_with_bands(name):
    values = grid((1, 2, 10), (0, 0.4, 0.8), **RESOLVED)
    figure = draw(name, MadeUpResults(values, bands=True))
    assert seen(figure)
    assert "paper's numerics" not in words(figure)
