"""Hostile values of keys, in files and as options; and hostile files."""

import os
import random
from collections.abc import Iterator
from pathlib import Path

from fuzz_calling import ANY, BAD, GOOD, Input

from subslide.keys.entries import ENTRIES
from subslide.points import RUN_KEYS

LONG = "x" * 100_000
NOT_A_VALUE = (
    *("{}", "{1: 2}", "{a: {b: [c]}}", "[[1]]", "[]", "[1, [2]]", "[{}]", "&a [*a]", "&a {b: *a}"),
    *(
        '"\\e[31mred"',
        '"\\0"',
        '"a\\nb"',
        '"\\u202e"',
        f'"{LONG}"',
        f"[{'[' * 60}{']' * 60}]",
        "«½»",
        "１",
        "а",
    ),
    *(
        "!!python/object/apply:os.system ['touch marker']",
        "!!python/name:os.getcwd ''",
        "!!set {a}",
        "!!binary aGk=",
    ),
    *(
        "!!omap [a: 1]",
        "2024-01-01",
        "2024-01-01 10:00:00",
        "!x 1",
        "!!timestamp 2024-01-01",
        "=",
        "1__0",
        "1:30",
    ),
    *(
        "0o17x",
        "'1,2'",
        "--",
        "%",
        "'#'",
        "1e",
        "+",
        ".",
        "0200",
        "-0777",
        "1:2:3.5",
        "'0.5 '",
        "''",
        "null",
        "~",
        "",
    ),
)
"""YAML of values that no number, choice or truth is."""

NOT_A_NUMBER = (
    "true",
    "no",
    "abc",
    "'1'",
    "'0.5'",
    ".nan",
    ".inf",
    "-.inf",
    "1.0e+400",
    "9" * 400,
    "9" * 5000,
    "-1",
    "1e308",
    "-5e-324",
)
TINY = ("5e-324", "1.0e-310", "1e-40", "1.0e-200")
KEYS = ("c.yaml", "a_H", "detla", "cases", "<<", "nope", "2024-01-01", "a\\x1b[31mb", "a\\x00b")
"""What a message on a whole file names: it, or the key that is wrong."""

DIVISORS = ("a_2", "radius", "g", "cfl")
"""Keys that are divided by, or multiply a scale: their tiny values make no run."""


def kinds_of(key: str) -> Iterator[tuple[str, str]]:
    """YAML of hostile values of a key, and how a study with each ends."""
    about = ENTRIES[key]
    listed = key in ("figures", "snapshot_times", "gauges", "cases")
    for text in NOT_A_VALUE:
        if text == {"scene_options": "{}", "cases": "{}"}.get(key, "[]" if listed else ""):
            continue
        if key == "study" and text in (
            "1__0",
            "1:30",
            "1:2:3.5",
            "0200",
            "-0777",
            "2024-01-01",
            "--",
            "1e",
            "0o17x",
        ):
            continue  # texts in this place, if a strict reader says so
        yield text, BAD
    if about.get("type") in ("number", "integer") or key == "t_end":
        yield from ((text, BAD) for text in NOT_A_NUMBER)
        yield from ((text, BAD if key in DIVISORS else ANY) for text in TINY)
        yield from ((text, ANY) for text in ("0x10", "1_0", "0b1", "-0.0", "'1e3'", "1E3", "[1, 1.0]"))
    elif "enum" in about:
        yield from (
            (text, BAD)
            for text in ("nope", "Auto", "true", "3.5", "-1", ".nan", "'1'", "[auto, nope]", "9" * 400)
        )
    elif about.get("type") == "boolean":
        yield from ((text, BAD) for text in ("'yes'", "'true'", "1", "0", "0.0", "maybe", ".nan", "'false'"))
    elif key == "study":
        yield from (
            (text, BAD)
            for text in ("2024", "1.5", "true", "../x", "a/b", "A", "a b", "é", "a" * 300, "'a\nb'", ".")
        )
    elif listed:
        yield from (
            (text, BAD)
            for text in ("3x", "[nope]", "[a, a]", "[true]", "[.nan]", "[-1]", "true", "['1']", "[null]")
        )
        if key == "snapshot_times":
            yield f"[{', '.join(map(str, range(1001)))}]", BAD


def written(values: dict[str, str]) -> bytes:
    """A YAML file of texts by key."""
    return "".join(f"{key}: {text}\n" for key, text in values.items()).encode("utf-8", "surrogatepass")


def config_values(rng: random.Random, count: int) -> list[Input]:
    """Hostile values of every key, in a study that is checked or the file of one run."""
    every = [(key, text, ends) for key in ENTRIES for text, ends in kinds_of(key)]
    inputs = []
    for n, (key, text, ends) in enumerate(rng.sample(every, min(count, len(every)))):
        values = {"study": "s", "figures": "none", "cells": "20", "t_end": "0.01", key: text}
        alone = ends == BAD and n % 3 == 0
        verb = ["run", "--config", "c.yaml", "-o", "o.nc"] if alone else ["check", "c.yaml"]
        content = written(values)
        inputs.append(Input(f"{key}: {text[:60]}", verb, ends, ("c.yaml", key), _file("c.yaml", content)))
    return inputs


def option_values(rng: random.Random, count: int) -> list[Input]:
    """Hostile values of every key as options of `run`."""
    texts = (
        "",
        " ",
        "abc",
        "nan",
        "inf",
        "-inf",
        "1e999",
        "1,2",
        "0x10",
        "1__0",
        "１",
        "[1]",
        "{}",
        "1:30",
        "null",
        "\x1b[31m",
        "a\nb",
        LONG,
        "9" * 5000,
        "½",
        "\udcff",
        "--",
        ",",
        "1,",
        "=",
    )
    keys = [key for key in ("numerics", *RUN_KEYS) if ENTRIES[key].get("type") != "boolean"]
    every = [(key, text) for key in keys for text in texts if not (key == "snapshot_times" and text == "1,2")]
    every += [(key, "-1") for key in keys] + [(key, "9" * 400) for key in keys]
    inputs = []
    for key, text in rng.sample(every, min(count, len(every))):
        if key == "scene_options" and text in ("", ","):
            continue
        flag = "--" + key.replace("_", "-")
        words = (
            ["run", f"{flag}={text}", "--cells=20", "-o", "o.nc"]
            if key != "cells"
            else ["run", f"{flag}={text}", "-o", "o.nc"]
        )
        inputs.append(Input(f"{flag} {text[:40]!r}", words, BAD, (flag, key)))
    return inputs


def yaml_files(rng: random.Random, count: int) -> list[Input]:
    """Whole files that are no study, and good ones with random bytes changed."""
    plain = b"study: s\nfigures: none\na_H: [1, 2]\ncells: 20\nt_end: 0.01\n"
    bomb = "a: &a [1,1,1,1,1,1,1,1,1,1]\n" + "".join(
        f"{b}: &{b} [{','.join('*' + a for _ in range(10))}]\n"
        for a, b in zip("abcdefgh", "bcdefghi", strict=True)
    )
    whole = {
        "empty": b"",
        "blank": b" \n\n",
        "comment": b"# nothing\n",
        "utf-16": plain.decode().encode("utf-16"),
        "utf-32": plain.decode().encode("utf-32"),
        "latin-1": plain + "# \xe9\n".encode("latin-1"),
        "binary": bytes(rng.randrange(256) for _ in range(500)),
        "png": b"\x89PNG\r\n\x1a\n" + bytes(99),
        "list": b"- study: s\n",
        "text": b"study\n",
        "number": b"3\n",
        "quoted": b"'study: s'\n",
        "null": b"null\n",
        "deep list": plain + b"delta: " + b"[" * 20_000,
        "deep map": plain + b"delta: " + b"{a: " * 20_000,
        "deep closed": plain + b"delta: " + b"[" * 5_000 + b"]" * 5_000,
        "bomb": (plain.decode() + bomb).encode(),
        "twice": plain + b"a_H: 3\n",
        "twice in a case": plain + b"cases: [{r: 0, r: 0.1}]\n",
        "twice in options": plain + b"scene: columns\nscene_options: {x: 1, x: 2}\n",
        "quoted twice": plain + b"'a_H': 3\n",
        "two documents": plain + b"---\n" + plain,
        "end and more": plain + b"...\nr: 0\n",
        "tag": plain + b"r: !!python/object/apply:os.system ['touch marker']\n",
        "tag on top": b"!!python/object/apply:os.system ['touch marker']\n",
        "new": plain + b"r: !!python/object/new:os.system ['touch marker']\n",
        "unknown alias": plain + b"r: *nope\n",
        "merge a number": plain + b"<<: 3\n",
        "merge nothing": plain + b"<<: *b\n",
        "number as key": plain + b"1: 2\n",
        "null as key": plain + b"~: 2\n",
        "list as key": plain + b"? [a]\n: 1\n",
        "map as key": plain + b"? {a: 1}\n: 1\n",
        "true as key": plain + b"true: 1\n",
        "date as key": plain + b"2024-01-01: 1\n",
        "tab": plain + b"\tr: 0\n",
        "directive": b"%YAML 9.9\n---\n" + plain,
        "nul": plain + b"\x00",
        "control": plain + b"# \x07\n",
        "escape as key": plain + b'"a\\e[31mb": 1\n',
        "nul as key": plain + b'"a\\0b": 1\n',
        "long key": plain + LONG.encode() + b": 1\n",
        "2 MB of comment": plain + b"# " + b"x" * (1 << 21) + b"\n",
        "2 MB of values": plain + b"r: [" + b"0.1, " * (1 << 19) + b"0.2]\n",
        "2 MB of keys": plain + b"".join(b"k%d: 1\n" % n for n in range(200_000)),
        "10 million points": plain
        + b"r: ["
        + b", ".join(b"0.%04d" % n for n in range(4000))
        + b"]\ndelta: ["
        + b", ".join(b"%d.5" % (n % 80) + b"%d" % n for n in range(2500))
        + b"]\n",
        "578 days": plain.replace(b"0.01", b"1e9"),
        "surrogate": plain + b'r: "\\ud800"\n',
        "bad utf-8": plain + b"r: \xff\xfe\n",
        "json cut": b'{"study": "s", "cells": 20',
        "html": b"<html><body>study: s</body></html>\n",
        "typo": plain + b"detla: 3\n",
        "unbalanced": plain + b"r: [0, 0.1\n",
        "only a case": plain + b"cases: {r: 0}\n",
        "case in a case": plain + b"cases: [{cases: [{}]}]\n",
    }
    good = {
        "crlf": plain.replace(b"\n", b"\r\n"),
        "no end": plain.rstrip(),
        "json": b'{"study": "s", "figures": "none", "cells": 20, "t_end": 0.01}',
        "anchor": plain.replace(b"[1, 2]", b"&a [1, 2]"),
        "marks": b"---\n" + plain + b"...\n",
    }
    inputs = [
        Input(name, ["check", "c.yaml"], BAD, KEYS, _file("c.yaml", content))
        for name, content in whole.items()
    ]
    inputs += [
        Input(
            f"{name} by run",
            ["run", "--config", "c.yaml", "-o", "o.nc"],
            BAD,
            KEYS,
            _file("c.yaml", content),
        )
        for name, content in rng.sample(sorted(whole.items()), 12)
        if name not in ("10 million points",)
    ]
    inputs += [
        Input(name, ["check", "c.yaml"], GOOD, (), _file("c.yaml", content)) for name, content in good.items()
    ]
    inputs += [
        Input(f"{name}", ["check", "c.yaml"], BAD, ("c.yaml",), made) for name, made in NO_FILES.items()
    ]
    inputs += [
        Input(f"{name} by run", ["run", "--config", "c.yaml", "-o", "o.nc"], BAD, ("c.yaml",), made)
        for name, made in NO_FILES.items()
    ]
    inputs += [
        Input("zeros for ever", ["check", "/dev/zero"], BAD, ("/dev/zero",)),
        Input("nul in the name", ["check", "a\0b"], BAD, ("a",)),
        Input("long name", ["check", "x" * 5000], BAD, ("xxx",)),
    ]
    rng.shuffle(inputs)
    inputs = inputs[: 2 * count // 3]
    while len(inputs) < count:
        content = bytearray(plain)
        for _ in range(rng.randrange(1, 4)):
            content[rng.randrange(len(content))] = rng.randrange(256)
        inputs.append(
            Input(
                f"bytes {bytes(content)!r}",
                ["check", "c.yaml"],
                ANY,
                ("c.yaml",),
                _file("c.yaml", bytes(content)),
            )
        )
    return inputs


def _unreadable(folder: Path) -> None:
    """A file that its owner may not read (root may, and finds it empty)."""
    (folder / "c.yaml").write_text("")
    (folder / "c.yaml").chmod(0)


NO_FILES = {
    "pipe": lambda folder: os.mkfifo(folder / "c.yaml"),
    "folder": lambda folder: (folder / "c.yaml").mkdir(),
    "nothing": lambda folder: None,
    "loop": lambda folder: (folder / "c.yaml").symlink_to("c.yaml"),
    "dangling": lambda folder: (folder / "c.yaml").symlink_to("nowhere.yaml"),
    "unreadable": _unreadable,
}


def _file(name: str, content: bytes):
    """Function that writes a file into a folder."""
    return lambda folder: (folder / name).write_bytes(content)
