"""Configurations: what is accepted, and that each mistake gives one line with key, value and what is allowed."""

import pytest

from subslide import config, docs, figures, schema
from subslide.points import RUN_KEYS, Point
from subslide.schema import ConfigError

MISTAKES = {
    "r: 1.5": ("r: 1.5", "from 0 to below 1"),
    "a_H: -1": ("a_H: -1", "from 0 to 1000"),
    "cells: ten": ("cells: ten", "whole number from 10"),
    "cells: 200.5": ("cells: 200.5", "whole number"),
    "cels: 100": ("cels", "100", "did you mean 'cells'?"),
    "A_h: 1": ("A_h", "did you mean 'a_H'?"),
    "zzzz: 1": ("zzzz", "allowed: study, figures"),
    "a_H: []": ("a_H: []", "empty grid"),
    "a_H: [1, [2]]": ("a_H: [2]", "a number"),
    "a_H: {x: 1}": ("a_H", "a number"),
    "a_H: '1'": ("a_H: '1'", "a number"),
    "a_H:": ("a_H: nothing", "a number"),
    "r: .nan": ("r: .nan", "a number"),
    "a_H: [1, .inf]": ("a_H: .inf", "a number"),
    "r: true": ("r: true", "a number"),
    "order: true": ("order: true", "1"),
    "scheme: ifcpf": ("scheme: ifcpf", "hll", "did you mean 'ifcp"),
    "model: Radial": ("model: Radial", "did you mean 'radial'?"),
    "t_end: rst": ("t_end: rst", "did you mean 'rest'?"),
    "t_end: 0": ("t_end: 0", "above 0"),
    "snapshot_times: [0, -1]": ("snapshot_times", "-1", "list of numbers"),
    "fields: 3": ("fields: 3", "true or false"),
    "fields: true": ("fields: true", "quarter, plane"),
    "model: one-layer": ("one-layer", "r: 0.4", "only with r: 0"),
    "{model: plane, cells: 99999}": ("cells: 99999", "at most"),
    "figures: [no_such_figure]": ("figures: no_such_figure", "allowed"),
    "numerics: papr": ("numerics: papr", "did you mean 'paper'?"),
    "a_H: 1\na_H: 2": ("line 3", "'a_H' is given twice"),
    "a_H: [1": ("not valid YAML",),
    "a_H: \x00": ("not valid YAML",),
    "a: &a [*a]": ("a:", "no such key"),
}


@pytest.mark.parametrize("text", MISTAKES)
def test_mistake_gives_one_line_with_key_value_and_range(text, write_yaml):
    inside = text.strip("{}").replace(", ", "\n") if text.startswith("{") else text
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
    assert set(schema.properties()) == {"study", "figures", "numerics", *RUN_KEYS}


def test_every_key_is_described():
    for key, about in schema.properties().items():
        assert about["description"]
        assert schema.allowed(key)
        assert "default" in about or key == "study"


def test_the_papers_study_has_its_fifteen_runs(root):
    study = config.read_study(root / "config/paper.yaml")
    assert {(p.a_H, p.r) for p in study.points} == {
        (a, r) for a in (1, 2, 10) for r in (0, 0.2, 0.4, 0.6, 0.8)
    }
    assert {(p.a_2, p.delta, p.radius) for p in study.points} == {(0.56, 32, 0.0705)}
    assert study.figures == tuple(figures.names())


def test_every_study_of_the_repository_is_valid(root):
    for name in ("paper", "smoke"):
        assert config.read_study(root / f"config/{name}.yaml").name == name


def test_generated_pages_are_current(root):
    for path, text in docs.pages().items():
        assert (root / path).read_text(encoding="utf-8") == text, f"run `make docs` to renew {path}"


def test_every_figure_says_what_it_is():
    for name in figures.names():
        about = figures.about(name)
        assert about.title != name
        assert about.category
        assert set(about.needs) <= set(RUN_KEYS)
