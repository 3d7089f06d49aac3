"""Mistakes in designs: each gives one line that names the key, the value and what is allowed."""

import re

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from subslide.keys import designs as words_of_designs
from subslide.keys.schema import ConfigError
from subslide.study import config


def study(**values):
    """Return the study of values."""
    return config.make_study({"study": "t", **values})


def one(kind, **options):
    """Return a design with one option replaced."""
    return {kind: {"points": 4, "over": {"a_H": [1, 2]}, **options}}


MISTAKES = {
    "a_H: {linspce: [0, 1, 3]}": ("a_H", "linspce", "linspace", "did you mean 'linspace'?"),
    "a_H: {linspace: [0, 1]}": ("a_H: linspace: [0, 1]", "[first, last, count], three numbers"),
    "a_H: {linspace: [0, 1, 2.5]}": ("a_H: linspace", "2.5", "a whole number from 2 to 200000"),
    "a_H: {linspace: [0, true, 2]}": ("a_H: linspace", "three numbers"),
    "a_H: {linspace: [0, .inf, 2]}": ("a_H: linspace", "three numbers"),
    "a_H: {geomspace: [0, 1, 3]}": ("a_H: geomspace: [0, 1, 3]", "above 0"),
    "a_H: {arange: [0, 1, -1]}": ("a_H: arange", "a step of -1", "from first to last"),
    "a_H: {arange: [0, 1, 1e-300]}": ("a_H: arange", "more than 200000 values"),
    "a_H: {linspace: [-1, 1, 3]}": ("a_H: -1", "from 0 to 1000"),
    "cells: {linspace: [100, 101, 3]}": ("cells: 100.5", "a whole number"),
    "scheme: {linspace: [1, 2, 3]}": ("scheme", "one of"),
    "design: 3": ("design: 3", "a mapping with one of zip, file"),
    "design: {}": ("design: {}", "a mapping with one of zip, file"),
    "design: {zipp: {a_H: [1]}}": ("design", "zipp", "did you mean 'zip'?"),
    "design: [{zip: {a_H: [1]}}, {zip: {a_H: [1], r: [0, 0.1]}}]": (
        "design[1]: zip",
        "a_H has 1 values, r has 2",
    ),
    "design: {zip: {a_H: [1, -2]}}": ("design: zip: a_H: -2", "from 0 to 1000"),
    "design: {zip: {a_H: 1}}": ("design: zip: a_H: 1", "a list of at least one"),
    "design: {zip: {a_h: [1]}}": ("design: zip: a_h", "did you mean 'a_H'?"),
    "design: {zip: {fields: [true]}}": ("design: zip: fields", "no such key here"),
    "design: {sobol: {points: 0, over: {a_H: [1, 2]}}}": ("design: sobol: points: 0", "from 1 to 200000"),
    "design: {sobol: {over: {a_H: [1, 2]}}}": ("design: sobol: points", "missing"),
    "design: {sobol: {points: 4}}": ("design: sobol: over", "missing"),
    "design: {sobol: {points: 4, over: {}}}": ("design: sobol: over: {}", "a mapping from keys"),
    "design: {sobol: {points: 4, sed: 1, over: {a_H: [1, 2]}}}": ("sobol: sed", "did you mean 'seed'?"),
    "design: {sobol: {points: 4, seed: -1, over: {a_H: [1, 2]}}}": ("sobol: seed: -1", "from 0 to"),
    "design: {sobol: {points: 4, over: {cells: [100, 200]}}}": ("over: cells", "no such key here"),
    "design: {sobol: {points: 4, over: {a_H: [2, 1]}}}": ("over: a_H: [2, 1]", "low below high"),
    "design: {sobol: {points: 4, over: {a_H: 1}}}": ("over: a_H: 1", "[low, high]"),
    "design: {sobol: {points: 4, over: {r: [0, 1]}}}": ("over: r: 1", "to 0.99999"),
    "design: {sobol: {points: 4, over: {t_end: [0, 1]}}}": ("over: t_end: 0", "from 1e-09"),
    "design: {sobol: {points: 4, over: {r: {unifrm: [0, 1]}}}}": ("over: r", "did you mean 'uniform'?"),
    "design: {sobol: {points: 4, over: {r: {log_uniform: [0, 0.5]}}}}": (
        "over: r",
        "log_uniform from above 0",
    ),
    "design: {sobol: {points: 4, over: {r: {truncated_normal: [0, 0, 0, 0.5]}}}}": (
        "over: r",
        "deviation above 0",
    ),
    "design: {sobol: {points: 4, over: {r: {truncated_normal: [9, 0.1, 0, 0.5]}}}}": (
        "over: r",
        "between them",
    ),
    "design: {sobol: {points: 4, over: {r: {file: nothing.csv}}}}": (
        "over: r: file: nothing.csv",
        "no such file",
    ),
    "design: {file: nothing.csv}": ("design: file: nothing.csv", "no such file"),
    "design: {saltelli: {points: 200000, over: {a_H: [1, 2]}}}": (
        "design: saltelli",
        "12800000 points",
        "at most",
    ),
    "a_H: 1\ndesign: {zip: {a_H: [1]}}": ("design: zip: a_H", "stands beside it too", "one place"),
    "design: [{zip: {a_H: [1]}}, {zip: {a_H: [1]}}]": ("design[1]: zip: a_H", "is in design[0]: zip too"),
    "a_2: 1\ndelta: 30\ndesign: {zip: {m: [1]}}": ("design: zip: m", "a_2 and delta"),
    "delta: 30\ndesign: {zip: {m: [0]}}": ("m: 0", "delta: 30", "a_2 inf", "from 0.001 to 100"),
    "a_2: 10\ndesign: {zip: {m: [99]}}": ("m: 99", "a_2: 10", "delta 89.9", "from 0 to 89"),
    "cases: [{}, {design: {zip: {a_H: [-1]}}}]": ("cases[1].design: zip: a_H: -1",),
    "a_H: [1, 2]\ndesign: {sobol: {points: 150000, over: {r: [0, 0.1]}}}": (
        "300000 points",
        "at most 200000",
    ),
}


@pytest.mark.parametrize("text", MISTAKES)
def test_mistake_gives_one_line(text, write_yaml, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    path = write_yaml(f"study: t\n{text}\n")
    with pytest.raises(ConfigError) as caught:
        config.read_study(path)
    assert "\n" not in str(caught.value)
    for part in (str(path), *MISTAKES[text]):
        assert part in str(caught.value)


@pytest.mark.parametrize(
    ("text", "part"),
    [
        ("", "no rows"),
        ("a_H,r\n", "no rows"),
        ("a_H,a_H\n1,2\n", "line 1: a_H is there twice"),
        ("a_H,rr\n1,2\n", "line 1: rr: no column may have this name; did you mean 'r'?"),
        ("a_H;r\n1;2\n", "line 1: a_H;r"),
        ("a_H,r\n1\n", "line 2: 1 values; allowed: 2"),
        ("a_H,r\n1,0\n\n1,x\n", "line 4: r: x is not allowed; allowed: a number from 0 to 0.99999"),
        ("a_H,r\n1,\n", "line 2: r: nothing is not allowed"),
        ("a_H,r\n1,010\n", "line 2: r: 010 may be read in several ways"),
        ('a_H,r\n1,"0"x\n', "line 2"),
        ("a_H,scheme\n1,hlll\n", "line 2: scheme: hlll is not allowed", ),
        ("a_H,cells\n1,20.5\n", "line 2: cells: 20.5 is not allowed"),
    ],
)  # fmt: skip
def test_mistake_in_a_file_is_named_by_line_and_column(text, part, tmp_path):
    path = tmp_path / "points.csv"
    path.write_text(text)
    with pytest.raises(ConfigError, match=re.escape(part)) as caught:
        study(design={"file": str(path)})
    assert str(caught.value).startswith(f"design: file: {path}")


def test_a_column_that_a_distribution_needs_is_missed_by_name(tmp_path):
    path = tmp_path / "samples.csv"
    path.write_text("a_h,b\n1,2\n")
    with pytest.raises(ConfigError, match=r"over: a_H: file: .*no column a_H.*did you mean 'a_h'"):
        study(design=one("sobol", over={"a_H": {"file": str(path)}}))


def test_one_run_takes_no_design_and_no_more_than_one_value():
    with pytest.raises(ConfigError, match=r"design: .*is not allowed for one run; allowed: only in a study"):
        config.make_point({"design": one("sobol")})
    with pytest.raises(ConfigError, match=r"a_H: .* has 3 values; allowed: one for one run"):
        config.make_point({"a_H": {"linspace": [0, 1, 3]}})


WORDS = [
    "points",
    "over",
    "scramblings",
    "uniform",
    "file",
    "a_H",
    "r",
    "m",
    "linspace",
    "hll",
    "x.csv",
    "/",
    "",
]
LEAVES = st.none() | st.booleans() | st.integers() | st.floats() | st.sampled_from(WORDS)
ANYTHING = st.recursive(
    LEAVES, lambda c: st.lists(c, max_size=3) | st.dictionaries(st.sampled_from(WORDS), c, max_size=3)
)
SHAPED = st.fixed_dictionaries(
    {"points": st.integers(1, 4), "over": st.dictionaries(st.sampled_from(WORDS), ANYTHING, max_size=2)}
)
KINDS = st.sampled_from(list(words_of_designs.DESIGNS))


@settings(deadline=None, max_examples=150)
@given(ANYTHING | st.dictionaries(KINDS, ANYTHING | SHAPED, min_size=1, max_size=1))
def test_whatever_stands_for_a_design_is_one_or_gives_one_line(value):
    try:
        assert study(design=value).runs
    except ConfigError as error:
        (line,) = str(error).split("\n")
        if not re.match(r"design|m: ", line):
            raise
