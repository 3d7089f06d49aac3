"""Bare Snakemake on bad studies, and its commands that only look: one line of ours, and nothing is written."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from fuzz_calling import LONGEST, changes, rng_of, snapshot
from fuzz_studies import STUDY, flips

pytestmark = pytest.mark.slow

SECONDS = 60
PREFIX = "configuration: "
"""What our line begins with inside Snakemake's frame."""

PLAIN = "study: t\nfigures: none\nmodel: radial\ncells: 20\nt_end: 0.05\n"
MANY = [n / 5000 for n in range(5000)]
REFUSED = {
    "a key that there is not": (PLAIN + "detla: 3\n", "detla"),
    "a key given twice": (PLAIN + "cells: 40\n", "cells"),
    "octal": (PLAIN.replace("20", "0200"), "cells"),
    "base 60": (PLAIN + "delta: 1:20\n", "delta"),
    "not a number": (PLAIN + "r: .nan\n", "r"),
    "a long name": (PLAIN.replace("study: t", f"study: {'t' * 300}"), "study"),
    "millions of points": (f"{PLAIN}r: {MANY[:4000]}\ndelta: {MANY[::2]}\n", "points"),
    "a pipe as raster": (PLAIN + "scene: raster\nscene_options: {file: pipe.nc}\n", "pipe.nc"),
    "too many hours": (PLAIN.replace("0.05", "1e9"), "max_core_hours"),
    "an escape": (PLAIN + '"a\\e[31mb": 1\n', "a\\x1b[31mb"),
}  # fmt: skip
"""Configurations that are refused, and what the line names."""

NOT_READ = {
    "empty": "",
    "a list": "- study: t\n",
    "not YAML": PLAIN + "r: [0\n",
    "a tag": PLAIN + "r: !!python/object/apply:os.system ['touch marker']\n",
}
"""Files that Snakemake itself refuses, in its words, before it reads ours."""

LOOKS = ("-n", "--list-rules", "--dag", "--summary", "--lint", "--report")
"""Commands that only look; the last writes its page and nothing else."""


class Project:
    """A copy of the workflow in a folder, with a configuration and what is in its results."""

    def __init__(self, folder: Path):
        """Copy the workflow."""
        root = Path(__file__).resolve().parents[2]
        for name in ("Snakefile", "workflow", "profiles", "config"):
            copy = shutil.copytree if (root / name).is_dir() else shutil.copy
            copy(root / name, folder / name)
        self.folder = folder

    def look(self) -> dict:
        """What is in the folder, but for what Snakemake keeps for itself and compiled code."""
        seen = snapshot(self.folder)
        return {
            name: value
            for name, value in seen.items()
            if not name.startswith(".snakemake") and "__pycache__" not in name
        }

    def snakemake(self, *arguments: str) -> tuple[int, str, dict[str, str]]:
        """Exit status of a bare Snakemake, what it printed, and what changed."""
        before = self.look()
        command = [sys.executable, "-m", "snakemake", "--configfile", "t.yaml", "--cores", "1", *arguments]
        done = subprocess.run(
            command,
            cwd=self.folder,
            capture_output=True,
            text=True,
            timeout=SECONDS,
            stdin=subprocess.DEVNULL,
        )
        return done.returncode, done.stdout + done.stderr, changes(before, self.look())


@pytest.fixture
def project(tmp_path):
    """A project of its own."""
    return Project(tmp_path)


def said(text: str) -> list[str]:
    """Our lines in what Snakemake printed."""
    return [line for line in text.splitlines() if PREFIX in line]


@pytest.mark.parametrize("name", REFUSED)
def test_a_bad_configuration_is_one_line_in_snakemakes_frame(name, project):
    text, names = REFUSED[name]
    (project.folder / "t.yaml").write_text(text)
    os.mkfifo(project.folder / "pipe.nc")
    assert_refused(project.snakemake(), names)


@pytest.mark.parametrize(("override", "names"), [("a_H=x", "a_H"), ("detla=3", "detla")])
def test_a_bad_override_is_one_line_too(override, names, project):
    (project.folder / "t.yaml").write_text(PLAIN)
    assert_refused(project.snakemake("--config", override), names)


def assert_refused(done: tuple[int, str, dict[str, str]], names: str) -> None:
    """Fail unless a study was refused in one line that names something, and nothing was written."""
    status, printed, changed = done
    assert status != 0
    assert "Traceback" not in printed
    assert changed == {}
    lines = said(printed)
    assert len(lines) == 1, printed
    assert len(lines[0]) <= LONGEST + len(PREFIX)
    assert lines[0].isprintable()
    assert names in lines[0]


@pytest.mark.parametrize("name", NOT_READ)
def test_what_snakemake_does_not_read_leaves_nothing(name, project):
    (project.folder / "t.yaml").write_text(NOT_READ[name])
    status, printed, changed = project.snakemake()
    assert status != 0
    assert "Config file" in printed
    assert changed == {}


@pytest.mark.parametrize("look", LOOKS)
def test_commands_that_look_write_nothing_though_records_are_damaged(look, project, finished, seed):
    (project.folder / "t.yaml").write_text(STUDY)
    shutil.copytree(finished, project.folder / "results/t")
    record = sorted((project.folder / "results/t/records").glob("*.nc"))[0]
    record.write_bytes(flips(rng_of(seed, look), 20)(record.read_bytes()))
    (project.folder / "results/t/batches/0001-old.json").write_text("{")
    _, printed, changed = project.snakemake(look)
    assert "Traceback" not in printed
    assert set(changed) <= ({"report.html"} if look == "--report" else set())
