"""Words of the command line: verbs, options and names that there are not, or that cannot go on."""

import os
import random
import shutil
import socket
from pathlib import Path

from fuzz_calling import BAD, GOOD, Input

RUN = ("run", "--cells=20", "--t-end=0.01")
LONG = "n" * 300
OF_RESULTS = ("tables", "errors", "verify", "work-precision", "atlas", "claims", "cfl")
NO_NAMES = ("", "nope", "../runs", "a/b", "\x1b[31m", "x" * 5000, "_write", "__init__", "a\nb", "\0", "½")


def plain() -> list[tuple[list[str], tuple[str, ...]]]:
    """Words that are wrong by themselves, and what the message names one of."""
    lines: list[tuple[list[str], tuple[str, ...]]] = [
        ([verb], (verb.partition("=")[0], "command"))
        for verb in (
            "nope",
            "Run",
            "rn",
            "",
            "-",
            "--nope",
            "-x",
            "--config=c.yaml",
            "\x1b[31m",
            "x" * 5000,
            "a\nb",
            "\udcff",
        )
    ]
    takes = {
        "check": "CONFIG",
        "batch": "SPEC",
        "warm": "MODEL:DTYPE",
        "figure": "NAME",
        "table": "NAME",
        "run": "output",
    }
    takes |= dict.fromkeys(OF_RESULTS, "RESULTS")
    lines += [([verb], (takes[verb], takes[verb].lower(), "-o")) for verb in takes]
    lines += [([verb, "--nope", "a"], ("--nope",)) for verb in (*takes, "docs")]
    lines += [
        ([verb, "a", "-o"], ("-o", "--output")) for verb in ("run", "batch", "figure", "verify", "atlas")
    ]
    lines += [([verb, "a", "b", "c"], ("b", "c")) for verb in OF_RESULTS]
    lines += [
        (["table", "runs"], ("RESULTS",)),
        (["figure", "fig06_fronts"], ("results",)),
        (["docs", "x"], ("x",)),
    ]
    for threads in ("0", "-1", "1025", "x", "1.5", "", "１", "9" * 400, "nan"):
        lines.append(([*RUN, f"--threads={threads}", "-o", "o.nc"], ("threads",)))
    for kernel in (
        "nope",
        "radial:float16",
        "radial:float64:x",
        "radial:float64:general:x",
        ":",
        "",
        "radial:",
        "a:b:c:d",
        "\0",
        "\x1b[31m",
        "x" * 5000,
        "../x",
    ):
        lines.append((["warm", kernel], ("kernel", "model", "dtype", kernel[:20])))
    for folder in ("nope", "", ".", "c.yaml", "\0", "x" * 5000, "a\nb"):
        lines += [
            ([verb, folder], ("points.json", folder[:20], "errors.csv", "RESULTS")) for verb in OF_RESULTS
        ]
        lines.append(
            (
                ["figure", "fig06_fronts", "--results", folder, "-o", "f"],
                ("points.json", "runs", "results", folder[:20]),
            )
        )
        lines.append((["table", "runs", folder], ("points.json", folder[:20], "RESULTS")))
    lines += [
        (["batch", spec, "-o", "o.nc"], (spec[:20] or "SPEC", "\\x00"))
        for spec in ("nope.json", "", ".", "\0", "x" * 5000)
    ]
    lines.append((["docs"], ("config/README.md", "docs/", "root of the repository")))
    return lines


def _socket(path: Path) -> None:
    """A socket in the file system."""
    here = socket.socket(socket.AF_UNIX)
    before = Path.cwd()
    os.chdir(path.parent)
    here.bind(path.name)
    os.chdir(before)
    here.close()


OUTPUTS = {
    "a folder": ("d", lambda folder: (folder / "d").mkdir()),
    "a pipe": ("p.nc", lambda folder: os.mkfifo(folder / "p.nc")),
    "a socket": ("s.nc", lambda folder: _socket(folder / "s.nc")),
    "a link to a pipe": ("l.nc", lambda folder: (os.mkfifo(folder / "p"), (folder / "l.nc").symlink_to("p"))),
    "a loop": ("l.nc", lambda folder: (folder / "l.nc").symlink_to("l.nc")),
    "in no folder": ("no/o.nc", lambda folder: None),
    "in a file": ("f/o.nc", lambda folder: (folder / "f").write_text("")),
    "nothing": ("", lambda folder: None),
    "here": (".", lambda folder: None),
    "a table": ("o.csv", lambda folder: None),
    "a picture": ("o.PNG", lambda folder: None),
    "of 300 letters": (LONG + ".nc", lambda folder: None),
    "of 5000 letters": ("x" * 5000 + ".nc", lambda folder: None),
    "with nul": ("a\0.nc", lambda folder: None),
    "with a slash": ("o.nc/", lambda folder: None),
}
"""Outputs that cannot be: the word, and what makes it so."""

CONFIG = "a_H: 1\n"


def options(rng: random.Random, count: int, source: Path) -> list[Input]:
    """Words of every verb; `source` is a finished study."""
    inputs = [Input(" ".join(words)[:80], words, BAD, names) for words, names in plain()]

    def add(
        name: str,
        words: list[str],
        names: tuple[str, ...],
        fill=lambda folder: None,
        ends: str = BAD,
        makes=(),
    ) -> None:
        inputs.append(Input(name, words, ends, names, fill, makes))

    def study(folder: Path) -> None:
        shutil.copytree(source, folder / "t")

    def spec(folder: Path) -> None:
        shutil.copy(next((source / "batches").glob("*.json")), folder / "b.json")

    def config(folder: Path) -> None:
        (folder / "c.yaml").write_text(CONFIG)
        (folder / "l").symlink_to("c.yaml")
        os.link(folder / "c.yaml", folder / "h")

    for name, (word, make) in OUTPUTS.items():
        add(f"run: output is {name}", [*RUN, "-o", word], ("output",), make)
        both = lambda folder, make=make: (make(folder), spec(folder))  # noqa: E731
        add(f"batch: output is {name}", ["batch", "b.json", "-o", word], ("output",), both)
        words = ["batch", "b.json", "-o", "o.nc", "--ledger", word]
        add(f"batch: ledger is {name}", words, ("ledger",), both)
        of_study = lambda folder, make=make: (make(folder), study(folder))  # noqa: E731
        add(f"report: output is {name}", ["report", "t", "-o", word], ("output",), of_study)
    for word in ("c.yaml", "l", "h", "./c.yaml"):
        words = [*RUN, "--config=c.yaml", "-o", word]
        add(f"output is the input by {word}", words, ("output",), config)
    for name in NO_NAMES:
        add(f"table {name[:20]!r}", ["table", name, "t"], ("table",), study)
        add(
            f"figure {name[:20]!r}",
            ["figure", name, "--results", "t", "-o", "f"],
            ("figure", "name", "NAME"),
            study,
        )
    for verb in ("work-precision",):
        add(f"{verb} of a study without", [verb, "t"], ("t", "stability", "sweep"), study)
    for page in ("nope.md", ".", "", "no/p.md"):
        add(f"verify: page {page!r}", ["verify", "t", "-o", page], ("output",), study)
    for name in ("fig06_fronts",):
        taken = lambda folder: (study(folder), (folder / "f").write_text(""))  # noqa: E731
        add(
            f"figure {name} into a file",
            ["figure", name, "--results", "t", "-o", "f"],
            ("output", "f"),
            taken,
        )
        add(f"figure {name} into nul", ["figure", name, "--results", "t", "-o", "a\0"], ("output",), study)
    rng.shuffle(inputs)
    inputs = inputs[: count - 12]
    for words in (
        ["--help"],
        ["-h"],
        ["--version"],
        *([verb, "--help"] for verb in ("run", "check", "batch", "figure", "tables", "docs")),
    ):
        add(" ".join(words), words, (), ends=GOOD)
    linked = lambda folder: (folder / "l.nc").symlink_to("o.nc")  # noqa: E731
    add("run", [*RUN, "-o", "o.nc"], (), ends=GOOD, makes=("o.nc",))
    add("run through a link", [*RUN, "-o", "l.nc"], (), linked, GOOD, ("o.nc",))
    add("tables as they are", ["tables", "t"], (), study, GOOD)
    return inputs
