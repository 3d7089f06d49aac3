"""The reader of YAML: what a text may say in one way is read so, whatever else is refused in one line, at once."""

import math
import os
import socket
import time

import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st

from subslide.__main__ import main
from subslide.keys import plain, words
from subslide.keys.schema import ConfigError
from subslide.study import yaml_files
from subslide.study.yaml_files import read_overrides, read_yaml, values_of

BOMB = "a0: &a0 [1, 1, 1, 1, 1, 1, 1, 1, 1, 1]\n" + "".join(
    f"a{n}: &a{n} [{', '.join([f'*a{n - 1}'] * 10)}]\n" for n in range(1, 9)
)

SEVERAL_WAYS = (
    *("0200", "010", "-07", "00.5", "010.5", "0o17", "0x1F", "0b101", "1_000", "1__0", "1_0.5", "-1_0e+3"),
    *("1:30", "1:20:30", "1:30.5", "2024-01-01", "2024-1-1 10:00:00"),
)

REFUSED = {
    "a_H: 1e400": ("line 1: a_H: 1e400", "about 1e308"),
    "a_H: 1e-400": ("a_H: 1e-400", "1e-308"),
    "a_H: 5e-324": ("a_H: 5e-324", "1e-308"),
    "cells: 1" + "0" * 5000: ("line 1: cells: 1000", "..."),
    "a_H: [1, 2, 0200]": ("a_H[2]: 0200",),
    "a: 1\ncases:\n  - r: 0\n  - {delta: 1:20}": ("line 4: cases[1].delta: 1:20",),
    "a: 1\nb: 2\na: 3": ("line 3", "'a' is given twice"),
    "a: 1\n'a': 3": ("line 2", "'a' is given twice"),
    "a: {b: 1, c: 2, b: 3}": ("line 1: a: the key 'b' is given twice",),
    "a: !!python/object:os.system ls": ("line 1: a:", "tags are not allowed"),
    "a: !!float 1": ("tags are not allowed",),
    "a: !!binary aGk=": ("tags are not allowed",),
    "a: !!set {b, c}": ("tags are not allowed",),
    "a: ! 1": ("tags are not allowed",),
    "a: 1\n---\nb: 2": ("line 2", "second document"),
    "? [a, b]\n: 1": ("is no key",),
    "? {a: b}\n: 1": ("is no key",),
    "a: &x b\n*x : 1": ("is no key",),
    "a: *x": ("refers to",),
    "a: &x [*x]": ("a[0]: *x refers to itself",),
    "a: &x 1\nb: &x 2": ("&x is given twice",),
    "<<: 3": ("<<: 3", "a mapping"),
    "<<: []": ("<<: []", "a mapping"),
    "a: &a {b: 1}\n<<: *a\n<<: *a": ("'<<' is given twice",),
    "a: " + "[" * 30 + "]" * 30: ("line 1", "at most 20 levels"),
    "a: " + "[" * 100_000: ("line 1", "at most 20 levels"),
    "a:\n" + "".join(" " * n + "- a:\n" for n in range(1, 60, 2)): ("at most 20 levels",),
    BOMB: ("more than 200000 values",),
    "a: [" + "1," * 300_000 + "]": ("line 1: a", "more than 200000 values"),
    'a: "x\\0y"': ("line 1: a: x\\x00y", "control character"),
    'a: "x\\e[31my"': ("x\\x1b[31my",),
    '"x\\e[31my": 1': ("the key x\\x1b[31my",),
    "a: |\n  x\n  y\n": ("a: x y", "one line"),
    "a: x\x07y": ("character \\x07",),
    "a: x\x9by": ("character \\x9b",),
    "a: [1": ("not valid YAML",),
    "a: 1: 2": ("not valid YAML",),
    "\ta: 1": ("not valid YAML",),
    "a: @x": ("not valid YAML",),
}


@pytest.fixture
def refused(write_yaml):
    """Function that returns the line, as it is printed, on a text that is refused within a few seconds."""

    def line_of(text):
        path = write_yaml(text)
        start = time.monotonic()
        with pytest.raises(ConfigError) as caught:
            read_yaml(path)
        assert time.monotonic() - start < 5
        assert str(caught.value).startswith(str(path))
        line = words.printable(str(caught.value))
        assert line.isprintable()
        assert len(line) <= words.MOST
        return line

    return line_of


@pytest.mark.parametrize("text", REFUSED, ids=lambda text: repr(text[:40]))
def test_what_is_wrong_is_told_in_one_line(text, refused):
    line = refused(text)
    for part in REFUSED[text]:
        assert part in line


@pytest.mark.parametrize("text", SEVERAL_WAYS)
def test_numbers_that_may_be_read_in_several_ways_are_refused_and_in_quotes_are_text(
    text, refused, write_yaml
):
    line = refused(f"study: t\ncells: {text}\n")
    assert f"line 2: cells: {text}" in line
    assert "decimal" in line
    assert read_yaml(write_yaml(f"cells: '{text}'")) == {"cells": text}
    assert read_yaml(write_yaml(f'cells: "{text}"')) == {"cells": text}


@pytest.mark.parametrize(
    ("text", "value"),
    [
        *(("1", 1), ("-0", 0), ("+3", 3), ("200.", 200.0), (".5", 0.5), ("1e3", 1000.0), ("1e-3", 0.001)),
        *(("1E+2", 100.0), ("0", 0), ("0.0", 0.0), ("0e5", 0.0), (".inf", math.inf), ("-.INF", -math.inf)),
        *(("true", True), ("False", False), ("null", None), ("~", None), ("", None)),
        *(("yes", "yes"), ("off", "off"), ("1e", "1e"), ("0b", "0b"), ("1,000", "1,000"), ("v1_0", "v1_0")),
        *(("١", "١"), ("1-2", "1-2"), ("'1e3'", "1e3"), ("'true'", "true"), ('""', "")),
    ],
)
def test_plain_values(text, value, write_yaml):
    read = read_yaml(write_yaml(f"a: {text}"))["a"]
    assert (read, type(read)) == (value, type(value))
    assert type(values_of(text, "--config a")) is type(value)


def test_merges_take_over_keys_that_are_not_written_out(write_yaml):
    text = "a: &a {x: 1, y: 2}\nb: &b {x: 3, z: 4}\nc: {y: 5, <<: *a}\nd: {<<: [*b, *a], w: 6}\ne: [*a, {<<: *a}]"
    assert read_yaml(write_yaml(text)) == yaml.safe_load(text)


def test_shipped_studies_read_as_any_reader_reads_them(root):
    for path in root.glob("config/*.yaml"):
        assert read_yaml(path) == yaml.safe_load(path.read_text(encoding="utf-8"))


def test_a_byte_order_mark_is_no_part_of_the_text_and_utf_16_is_no_utf_8(tmp_path):
    path = tmp_path / "x.yaml"
    path.write_bytes("a_H: 1\n".encode("utf-8-sig"))
    assert read_yaml(path) == {"a_H": 1}
    for encoding in ("utf-16", "utf-16-le", "utf-32"):
        path.write_bytes("a_H: 1\n".encode(encoding))
        with pytest.raises(ConfigError, match="UTF-8|control characters"):
            read_yaml(path)


def test_only_regular_files_of_some_size_are_read(tmp_path):
    os.mkfifo(tmp_path / "pipe.yaml")
    os.symlink(tmp_path / "pipe.yaml", tmp_path / "link.yaml")
    with socket.socket(socket.AF_UNIX) as server:
        server.bind(os.path.relpath(tmp_path / "socket.yaml"))
    (tmp_path / "large.yaml").write_text("a: 1\n# " + "x" * yaml_files.MOST_BYTES)
    kinds = {"pipe": "a pipe", "link": "a pipe", "socket": "a socket", "large": "at most 1 MB"}
    for name, part in kinds.items():
        with pytest.raises(ConfigError, match=f"{name}.yaml: .*{part}"):
            read_yaml(tmp_path / f"{name}.yaml")
    for path, part in (("/dev/zero", "a device"), (tmp_path, "a folder"), ("a\0b", "null")):
        with pytest.raises(ConfigError, match=part):
            read_yaml(path)


def test_overrides_are_read_as_a_file_is():
    assert read_overrides(["cells=40", "a_H=[1, 2]", "study= x", "t_end=rest", "r=1e-1", "bands=true"]) == {
        "cells": 40,
        "a_H": [1, 2],
        "study": "x",
        "t_end": "rest",
        "r": 0.1,
        "bands": True,
    }
    for text, part in {
        "cells": "--config: cells is not allowed; allowed: KEY=VALUE",
        "=3": "KEY=VALUE",
        "cells=0200": "--config cells: 0200 may be read in several ways",
        "a_H=[1": "not valid YAML",
        "a_H=[1, 1:30]": "--config a_H: [1]: 1:30",
        "a_H=1\n---\n2": "--config a_H: a second document",
        "a_H=\udcff": "--config a_H: there is the character",
    }.items():
        with pytest.raises(ConfigError) as caught:
            read_overrides([text])
        assert part in str(caught.value)
    with pytest.raises(ConfigError, match="--config r: given twice"):
        read_overrides(["r=0", "r=0.1"])


@given(st.text(max_size=40))
def test_any_text_is_read_or_refused_in_one_printable_line(text):
    try:
        values_of(text, "--config a")
    except ConfigError as error:
        line = words.printable(str(error))
        assert line.startswith("--config a: ")
        assert line.isprintable()


@given(st.integers(-(10**12), 10**12) | st.floats(allow_nan=False, allow_subnormal=False))
def test_numbers_are_read_as_they_are_written(number):
    assert plain.value_of(repr(number)) == number


@given(st.text(alphabet="0123456789.eE+-_:xob", min_size=1, max_size=8))
def test_a_number_here_is_the_same_number_to_any_reader_or_text_to_some(text):
    try:
        value = plain.value_of(text)
        other = yaml.safe_load(f"a: {text}")["a"]
    except (ValueError, TypeError, yaml.YAMLError):
        return
    if not isinstance(value, str):
        assert isinstance(other, str) or other == value
    else:
        assert not isinstance(other, int | float)


def test_a_printed_line_is_short_and_gives_no_orders_to_a_terminal():
    assert words.printable("a\x1b[31m\u202e\udcffb\n c η") == "a\\x1b[31m\\u202e\\udcffb c η"
    long = words.printable("key: " + "\x1b" * 10**7 + "; allowed: x")
    assert len(long) == words.MOST - 1
    assert long.startswith("key: \\x1b")
    assert long.endswith("; allowed: x")


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("r\x85: 1\n", r"line 1: there is the character \x85; allowed: text without control"),
        ('"r\\x85": 1\n', r"line 1: the key r\x85 has a control character"),
        ('study: t\nscheme: "h\u2028ll"\n', r"scheme: h\u2028ll is not allowed; allowed: one of ifcph"),
        (
            "study: t\nfigures: [fig06_fronts, fig06_fronts]\n",
            "figures: fig06_fronts is there twice; allowed: ",
        ),
        ("MIT License\n\nPermission is granted\n", "allowed: lines of 'key: value'"),
        ("include ../common.mk\nall: this\n\t@echo\n", "not valid YAML: "),
        ("[project]\nname = 1\n", "allowed: lines of 'key: value'"),
    ],
)
def test_what_is_odd_in_a_file_is_written_out(write_yaml, capsys, text, told):
    assert main(["check", str(write_yaml(text))]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert told in line
    assert line.isprintable()
