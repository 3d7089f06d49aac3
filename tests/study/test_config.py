"""Configurations: what is accepted, and that each mistake gives one line with key, value and what is allowed."""

import itertools
import re
import time

import pytest

from subslide import catalogue, pages
from subslide.keys import schema, words
from subslide.keys.schema import ConfigError
from subslide.points import RUN_KEYS, Point
from subslide.study import config

MISTAKES = {
    "r: 1.5": ("r: 1.5", "from 0 to 0.99999"),
    "a_H: -1": ("a_H: -1", "from 0 to 1000"),
    "cells: ten": ("cells: ten", "whole number from 10"),
    "cells: 200.5": ("cells: 200.5", "whole number"),
    "cels: 100": ("cels", "100", "did you mean 'cells'?"),
    "A_h: 1": ("A_h", "did you mean 'a_H'?"),
    "zzzz: 1": ("zzzz", "allowed: study, figures"),
    "a_H: []": ("a_H: []", "empty grid"),
    "a_H: [1, [2]]": ("a_H: [2]", "a number"),
    "a_H: {x: 1}": ("a_H", "a number"),
    "a_H: '1'": ("a_H: '1' is text", "a number from 0 to 1000, without quotes"),
    "order: '1'": ("order: '1' is text", "one of 1, 2, without quotes"),
    "bands: 'false'": ("bands: 'false' is text", "true or false, without quotes"),
    "bands: yes": ("bands: yes is not allowed", "true or false"),
    "t_end: '0.5'": ("t_end: '0.5' is text", "rest or a number", "without quotes"),
    "a_H:": ("a_H: nothing", "a number"),
    "r: .nan": ("r: .nan", "a number"),
    "a_H: [1, .inf]": ("a_H: .inf", "a number"),
    "r: true": ("r: true", "a number"),
    "order: true": ("order: true", "1"),
    "scheme: ifcpf": ("scheme: ifcpf", "hll", "did you mean 'ifcp"),
    "model: Radial": ("model: Radial", "did you mean 'radial'?"),
    "t_end: rst": ("t_end: rst", "did you mean 'rest'?"),
    "t_end: 0": ("t_end: 0", "from 1e-09 to 1e+09"),
    "snapshot_times: [0, -1]": ("snapshot_times", "-1", "list of at most 1,000 numbers"),
    "fields: 3": ("fields: 3", "true or false"),
    "{fields: true, model: radial}": ("fields: true", "model: radial (asked for)", "allowed: quarter, plane"),
    "{fields: true, scene: slab}": ("fields: true", "model: line", "allowed: quarter, plane"),
    "gauges: [0.1, 0]": ("gauges: [0.1, 0]", "a list of at most 100 places [x, y] in the box (m)"),
    "gauges: [[0.1, 0, 0]]": ("gauges: [[0.1, 0, 0]]", "places [x, y]"),
    "gauges: [[0.1, .nan]]": ("gauges: [[0.1, NaN]]", "places [x, y]"),
    "gauges: [[0.1, 0], [0.1, 0]]": ("gauges: [0.1, 0] is there twice", "each once"),
    "gauges: [[0.31, 0]]": ("gauges: [0.31, 0.0] lies outside the box", "x and y up to 0.3 m"),
    "{gauges: [[0.25, 0.25]], boundary: wall}": ("gauges: [0.25, 0.25]", "at up to 0.3 m from the axis"),
    "{gauges: [[0.1, 0]], grid: fitted}": ("grid: fitted", "gauges are asked for", "uniform, or auto"),
    "{footprints: true, grid: fitted}": ("grid: fitted", "footprints are asked for", "uniform, or auto"),
    "{runout_directions: 8, scene: slab}": (
        "runout_directions: 8",
        "model: line",
        "radial, quarter, plane",
    ),
    "boundary: periodic": ("boundary: periodic", "model: radial", "allowed: line, plane"),
    "{boundary: periodic, model: quarter}": ("boundary: periodic", "model: quarter", "allowed: line, plane"),
    "as_printed: upwinding": ("as_printed: upwinding", "model: radial", "allowed: quarter, plane"),
    "as_printed: fricton": ("as_printed: fricton", "did you mean 'friction'?"),
    "treatment: hl": ("treatment: hl", "real, hll, friction, stop"),
    "friction_in_viscosity: 1": ("friction_in_viscosity: 1", "true or false"),
    "cfl: 4.5": ("cfl: 4.5", "to 4"),
    "model: one-layer": ("one-layer", "r: 0.4", "only with r: 0"),
    "{model: plane, cells: 99999}": ("cells: 99999", "at most"),
    "figures: [no_such_figure]": ("figures: no_such_figure", "allowed"),
    "numerics: papr": ("numerics: papr", "did you mean 'paper'?"),
    "a_H: 1\na_H: 2": ("line 3", "'a_H' is given twice"),
    "a_H: [1": ("not valid YAML",),
    "a_H: \x00": ("line 2", "character \x00"),
    "a_H: &a [*a]": ("line 2", "a_H", "*a refers to itself"),
    "bands: 3": ("bands: 3", "true or false"),
    "{bands: true, cells: 50}": ("cells: 50", "bands: true", "multiple of 4 from 40"),
    "{bands: true, cells: 36}": ("cells: 36", "bands: true", "multiple of 4 from 40"),
    "{bands: true, cells: [80, 81]}": ("cells: 81", "bands: true"),
    "cases: []": ("cases: []", "list of mappings"),
    "cases:": ("cases: nothing", "list of mappings"),
    "cases: {a_H: 1}": ("cases: ", "list of mappings"),
    "cases: [{}, 3]": ("cases[1]: 3", "a mapping of keys of a run"),
    "cases: [{}, {}, {delta: 95}]": ("cases[2].delta: 95", "from 0 to 89"),
    "cases: [{a_H: []}]": ("cases[0].a_H: []", "empty grid"),
    "cases: [{detla: 30}]": ("cases[0].detla", "30", "did you mean 'delta'?"),
    "cases: [{figur: none}]": ("cases[0].figur", "no such key"),
    "cases: [{}, {bands: true}]": ("cases[1].bands: true", "within a case"),
    "cases: [{cases: [{}]}]": ("cases[0].cases", "within a case"),
    "cases: [{study: x}]": ("cases[0].study: x", "within a case"),
    "cases: [{figures: none}]": ("cases[0].figures: none", "within a case"),
    "cases: [{r: 0, model: one-layer}, {r: 0.4, model: one-layer}]": ("cases[1].model: one-layer", "r: 0.4"),
    "cases: [{a_H: 1, a_H: 2}]": ("line 2", "'a_H' is given twice"),
}


@pytest.mark.parametrize("text", MISTAKES)
def test_mistake_gives_one_line_with_key_value_and_range(text, write_yaml):
    inside = re.sub(", (?=[a-z]+:)", "\n", text.strip("{}")) if text.startswith("{") else text
    path = write_yaml(f"study: t\n{inside}\n")
    with pytest.raises(ConfigError) as caught:
        config.read_study(path)
    message = str(caught.value)
    assert "\n" not in message
    assert message.startswith(str(path))
    for part in MISTAKES[text]:
        assert part in message


@pytest.mark.parametrize(
    ("text", "part"),
    [
        ("", "empty"),
        ("- 1", "key: value"),
        ("a_H: 1", "study: this key is missing"),
        ("study: A b", "study: A b"),
    ],
)
def test_file_without_a_study_is_refused(text, part, write_yaml):
    with pytest.raises(ConfigError, match=part):
        config.read_study(write_yaml(text))


def test_missing_file_names_the_nearest(write_yaml, tmp_path):
    write_yaml("study: t", "mine.yaml")
    with pytest.raises(ConfigError, match=r"no such file; did you mean 'mine.yaml'"):
        config.read_study(tmp_path / "mien.yaml")


def test_not_a_text_file_is_refused(tmp_path):
    (tmp_path / "x.yaml").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(ConfigError, match="UTF-8"):
        config.read_study(tmp_path / "x.yaml")


def test_grid_is_a_product_in_the_order_of_keys_and_lists():
    study = config.make_study({"study": "t", "r": [0.4, 0], "a_H": [2, 1], "model": "radial"})
    assert [(p.a_H, p.r) for p in study.points] == [(2, 0.4), (2, 0), (1, 0.4), (1, 0)]


def test_points_that_come_twice_run_once():
    study = config.make_study({"study": "t", "a_H": [1, 1.0, 2], "numerics": ["default", "default"]})
    assert [p.a_H for p in study.points] == [1, 2]


def test_cases_are_joined_products_whose_keys_win_over_those_beside_them(write_yaml):
    study = config.read_study(
        write_yaml(
            "study: t\nmodel: radial\na_H: [1, 2]\ndelta: 25\ncases:\n"
            "  - r: [0, 0.4]\n  - {delta: [30, 35], a_H: 4}\n  - {a_H: 2, r: 0.4}\n  - {}\n"
        )
    )
    assert [(p.a_H, p.r, p.delta) for p in study.points] == [
        *((a_H, r, 25) for a_H in (1, 2) for r in (0, 0.4)),
        *((4, 0.4, delta) for delta in (30, 35)),
    ]
    assert {p.model for p in study.points} == {"radial"}


def test_axes_of_a_case_run_in_the_order_of_keys_wherever_they_stand():
    one = config.make_study({"study": "t", "r": [0, 0.4], "a_H": [1, 2]})
    assert config.make_study({"study": "t", "r": [0, 0.4], "cases": [{"a_H": [1, 2]}]}).runs == one.runs


def test_cases_may_differ_in_what_is_no_axis_and_in_numerics():
    study = config.make_study(
        {
            "study": "t",
            "snapshot_times": [0.1],
            "cases": [{"numerics": "paper", "fields": True}, {"snapshot_times": [0.2, 0.3]}],
        }
    )
    first, second = study.points
    assert (first.fields, first.snapshot_times, first.model) == (True, (0.1,), "quarter")
    assert (second.fields, second.snapshot_times, second.model) == (False, (0.2, 0.3), "auto")
    assert [label for label, _ in study.runs] == ["paper", "default"]


def test_too_many_points_in_all_cases_are_refused():
    values = {key: [n / 1000 for n in range(1, 400)] for key in ("a_H", "r")}
    assert 399**2 < config.MOST_POINTS < 2 * 399**2
    with pytest.raises(ConfigError, match="318402 points"):
        config.make_study({"study": "t", "cases": [values, values]})


def test_combinations_of_scene_options_are_counted_before_they_are_made():
    options = {"x": [n / 1000 for n in range(400)], "y": [n / 1000 for n in range(400)]}
    start = time.monotonic()
    with pytest.raises(ConfigError, match="80000000 points; allowed: at most 200000"):
        config.make_study({"study": "t", "scene": "columns", "cases": [{"scene_options": options}] * 500})
    axes = {key: [0.1 + n / 1000 for n in range(500)] for key in ("a_H", "r", "a_2")}
    with pytest.raises(ConfigError, match="125000000 points"):
        config.make_study({"study": "t", **axes})
    assert time.monotonic() - start < 3


def test_companions_for_bands_count_as_points():
    values = {"study": "t", "a_H": [n / 1000 for n in range(300)], "r": [n / 1000 for n in range(300)]}
    with pytest.raises(ConfigError, match="270000 points, companions for bands among them"):
        config.make_study({**values, "bands": True})


@pytest.mark.parametrize(
    ("text", "parts"),
    [
        ("a_2: 1e-40", ("a_2: 1e-40", "from 0.001 to 100")),
        ("radius: 1e-300", ("radius: 1e-300", "from 1e-06")),
        ("r: 0.99999999", ("r: 0.99999999", "from 0 to 0.99999")),
        ("g: 1e-30", ("g: 1e-30", "from 1e-06")),
        ("cfl: 1e-9", ("cfl: 1e-09", "from 0.01 to 4")),
        ("t_end: 1e-30", ("t_end: 1e-30", "from 1e-09")),
        ("xi: 1e-30", ("xi: 1e-30", "from 0.001")),
        ("pouliquen_length: 1e-30", ("pouliquen_length: 1e-30", "from 1e-06")),
        ("delta: 89.999", ("delta: 89.999", "from 0 to 89")),
        ("a_H: 1e-9\ndtype: float32", ("a_H: 1e-09 is lost beside 1 in float32", "6e-08", "dtype: float64")),
        ("delta: 1e-40\ndtype: float32", ("delta: 3.1", "no number of float32")),
        (
            "dtype: float32\nscene: columns\nscene_options: {x: 1e-40}",
            ("x: 1e-40", "no number of float32", "1.18e-38"),
        ),
        ("dtype: [float64, float32]\ndelta: 1e-40", ("no number of float32",)),
    ],
)
def test_values_that_the_equations_cannot_hold_are_refused(text, parts, write_yaml):
    with pytest.raises(ConfigError) as caught:
        config.read_study(write_yaml(f"study: t\n{text}\n"))
    for part in parts:
        assert part in str(caught.value)


def test_a_run_takes_no_cases():
    with pytest.raises(ConfigError, match="cases.*only in a study"):
        config.make_point({"cases": [{"a_H": 1}]})


def test_companions_have_half_and_a_quarter_of_the_cells_and_equal_points_are_solved_once():
    axes = {"study": "t", "model": "radial", "cells": [160, 80]}
    plain, study = config.make_study(axes), config.make_study({**axes, "bands": True})
    assert (plain.companions, plain.solved) == ((), plain.points)
    assert study.points == plain.points
    assert [(run.cells, role, p.cells) for run, role, p in study.companions] == [
        (160, "cells/2", 80),
        (160, "cells/4", 40),
        (80, "cells/2", 40),
        (80, "cells/4", 20),
    ]
    assert [p.cells for p in study.solved] == [160, 80, 40, 20]


def test_too_large_a_grid_is_refused():
    values = {"study": "t", **{key: [n / 1000 for n in range(1, 200)] for key in ("a_H", "r", "a_2")}}
    with pytest.raises(ConfigError, match="at most"):
        config.make_study(values)


def test_explicit_keys_win_over_numerics():
    label, point = config.resolve({"numerics": "paper", "cells": 50})
    assert (label, point.model, point.cells) == ("paper", "quarter", 50)


def test_numbers_that_yaml_reads_as_text_are_numbers(write_yaml):
    assert config.read_study(write_yaml("study: t\nr: 1e-1")).points[0].r == 0.1


def test_defaults_of_points_are_those_of_the_schema():
    assert config.make_point({}) == Point()
    assert set(schema.properties()) == {*schema.with_role("study", "preset", "design"), *RUN_KEYS}


def test_every_key_is_described():
    for key, about in schema.properties().items():
        assert about["description"]
        assert words.allowed(key)
        assert "default" in about or key == "study"


def test_the_papers_study_has_its_fifteen_runs_twice_and_their_companions(root):
    study = config.read_study(root / "config/paper.yaml")
    assert {(p.a_H, p.r) for p in study.points} == {
        (a, r) for a in (1, 2, 10) for r in (0, 0.2, 0.4, 0.6, 0.8)
    }
    assert {(p.a_2, p.delta, p.radius) for p in study.points} == {(0.56, 32, 0.0705)}
    assert {label for label, _ in study.runs} == {"paper", "resolved"}
    assert (len(study.runs), len(study.solved)) == (30, 90)
    assert study.figures == tuple(name for name in catalogue.names("figures") if name.startswith("fig"))


def test_every_study_of_the_repository_is_valid(root):
    for name in ("paper", "smoke", "accuracy", "stability"):
        study = config.read_study(root / f"config/{name}.yaml")
        assert study.name == name
        assert study.keep == "all"  # errors and profiles are what they are for


def test_generated_pages_are_current(root):
    for path, text in pages.generated().items():
        assert (root / path).read_text(encoding="utf-8") == text, f"run `make docs` to renew {path}"


def test_rows_of_generated_tables_are_as_wide_as_their_heads():
    for path, text in pages.generated().items():
        rows = [line.replace("\\|", "") for line in text.splitlines() if re.match(r"\|[ -]", line)]
        heads = [row for row, after in itertools.pairwise(rows) if set(after) <= set("|-")]
        assert heads or path.endswith(".json")
        width = 0
        for row in rows:
            width = row.count("|") if row in heads else width
            assert row.count("|") == width, f"{path}: {row}"


def test_every_figure_says_what_it_is():
    for name in catalogue.names("figures"):
        about = catalogue.figure(name)
        assert about.title != name
        assert about.category
        assert set(about.needs) <= {"design", *RUN_KEYS}
