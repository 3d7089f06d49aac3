"""The published schema: it takes every study of the repository, refuses mistakes, and the file on disk is current."""

import json

import jsonschema
import pytest
import yaml

from subslide import catalogue, scenes
from subslide.keys import published, schema
from subslide.keys.schema import ConfigError
from subslide.study import config
from subslide.tables import errors

WRONG = {
    "an unknown key": {"detla": 30},
    "a missing name": {"study": None},
    "a value out of range": {"r": 1.5},
    "a value out of range in a list": {"r": [0, 1.5]},
    "a wrong type in a list": {"a_H": [1, "two"]},
    "an empty list": {"a_H": []},
    "a list within a list": {"a_H": [1, [2]]},
    "a wrong name": {"scheme": "ifcpf"},
    "a wrong name in a list": {"model": ["radial", "Quarter"]},
    "a list for a key that is no axis": {"fields": [True, False]},
    "half a cell": {"cells": 200.5},
    "a word for a time": {"t_end": "rst"},
    "an unknown figure": {"figures": ["fig99"]},
    "an unknown scene": {"scene": "elipse"},
    "an unknown option": {"scene": "ellipse", "scene_options": {"elongatoin": 2}},
    "an option out of range": {"scene": "ellipse", "scene_options": {"elongation": [1, 99]}},
    "a case that is no mapping": {"cases": [3]},
    "an unknown key in a case": {"cases": [{"detla": 30}]},
    "a key of a whole study in a case": {"cases": [{"bands": True}]},
    "a wrong value in a case": {"cases": [{}, {"delta": [30, 95]}]},
    "no cases": {"cases": []},
    "a form of another name": {"a_H": {"linspce": [0, 1, 3]}},
    "a form with a number missing": {"a_H": {"linspace": [0, 1]}},
    "a form for words": {"scheme": {"linspace": [0, 1, 3]}},
    "a design of another name": {"design": {"sobl": {"points": 4, "over": {"r": [0, 0.8]}}}},
    "two designs in one mapping": {"design": {"zip": {"a_H": [1]}, "file": "x.csv"}},
    "a design without points": {"design": {"sobol": {"over": {"r": [0, 0.8]}}}},
    "a design over cells": {"design": {"sobol": {"points": 4, "over": {"cells": [100, 200]}}}},
    "a distribution of three numbers": {"design": {"sobol": {"points": 4, "over": {"r": [0, 0.1, 0.8]}}}},
    "a value out of range in a zip": {"design": {"zip": {"r": [0, 1.5]}}},
}
RIGHT = (
    {},
    {"a_H": 1, "r": [0, 0.4], "cells": [100, 200.0], "t_end": ["rest", 0.5], "snapshot_times": [0, 0.1]},
    {"scene": "ellipse", "scene_options": {"elongation": [1, 2], "angle": 30}},
    {"numerics": ["paper", "resolved"], "bands": True, "figures": ["fig06_fronts"]},
    {"a_H": {"linspace": [0, 1, 3]}, "cells": {"geomspace": [100, 400, 3]}, "r": {"arange": [0, 0.4, 0.1]}},
    {
        "design": {"zip": {"r": [0, 0.4], "m": [1, 2]}},
        "cases": [{}, {"design": [{"zip": {"scheme": ["hll"]}}]}],
    },
    {
        "design": {
            "saltelli": {"points": 2, "seed": 1, "scramblings": 2, "over": {"m": [1, 2], "r": [0, 0.8]}}
        }
    },
    {"design": {"sobol": {"points": 2, "over": {"r": {"truncated_normal": [0, 1, 0, 0.8]}}}}},
    {"design": [], "scene": "ellipse", "scene_options": {"elongation": {"linspace": [1, 2, 3]}}},
    {"order": [1, 2], "cases": [{"a_H": [1, 2]}, {"numerics": "paper", "friction_in_viscosity": False}]},
)


@pytest.fixture(scope="module")
def validator():
    """Validator of the schema that the code makes."""
    made = published.study_schema({name: scenes.load(name).OPTIONS for name in scenes.NAMES})
    jsonschema.Draft202012Validator.check_schema(made)
    return jsonschema.Draft202012Validator(made)


def studies(root):
    """Paths of the studies that the repository ships."""
    return sorted(root.glob("config/*.yaml"))


def test_every_shipped_study_satisfies_it_and_names_it(root, validator):
    assert studies(root)
    for path in studies(root):
        text = path.read_text(encoding="utf-8")
        assert text.startswith("# yaml-language-server: $schema=study.schema.json\n"), path.name
        validator.validate(yaml.safe_load(text))


def test_the_file_on_disk_is_the_schema(root, validator):
    assert json.loads((root / "config/study.schema.json").read_text(encoding="utf-8")) == validator.schema


@pytest.mark.parametrize("values", RIGHT)
def test_what_it_takes_is_a_study(validator, values):
    values = {"study": "t", **values}
    validator.validate(values)
    assert config.make_study(values).runs


@pytest.mark.parametrize("name", WRONG)
def test_what_it_refuses_is_no_study(validator, name):
    values = {key: value for key, value in {"study": "t", **WRONG[name]}.items() if value is not None}
    assert not validator.is_valid(values)
    with pytest.raises(ConfigError):
        config.make_study(values)


def test_every_key_option_and_name_is_in_it(validator):
    properties = validator.schema["properties"]
    assert list(properties) == list(schema.properties())
    options = {option for scene in scenes.NAMES for option in scenes.load(scene).OPTIONS}
    assert set(properties["scene_options"]["properties"]) == options
    assert properties["figures"]["anyOf"][1]["items"]["enum"] == catalogue.names("figures")
    assert properties["scene"]["anyOf"][0]["enum"] == list(scenes.NAMES)
    for about in properties.values():
        assert about["description"]


@pytest.mark.parametrize("name", ["accuracy", "stability"])
def test_studies_against_exact_solutions_keep_profiles_however_many_runs_they_have(root, name):
    study = config.read_study(root / f"config/{name}.yaml")
    assert len(study.solved) > config.MOST_KEPT_WHOLE
    assert study.keep == "all"
    assert errors.needs(study) == ""
