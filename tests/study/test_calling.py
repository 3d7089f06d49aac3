"""Ways to call Snakemake: each makes a whole study of one configuration, report included, or is refused in one line."""

import shutil
import subprocess
import sys

import pandas as pd
import pytest
from projects import STUDY, Project

pytestmark = pytest.mark.slow

IMPORTING = """configfile: "cfg.yaml"
module subslide:
    snakefile: "project/Snakefile"
    config: config["subslide"]
use rule * from subslide as sub_*
rule mine:
    default_target: True
    input: "results/small/tables/runs.csv", rules.sub_report.output
    output: "n.txt"
    shell: "wc -l {input[0]} > {output}"
"""


@pytest.fixture
def project(root, tmp_path):
    """A project in which nothing was made."""
    (tmp_path / "project").mkdir()
    return Project(root, tmp_path / "project")


def snakemake(folder, *words):
    """End of a Snakemake in a folder."""
    command = [sys.executable, "-m", "snakemake", "--cores", "2", *words]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)


def test_from_elsewhere_with_overrides_the_whole_study_is_that_one(project, tmp_path):
    """Ledger, points, tables and report are of the study that the overrides make, in the folder that was asked for."""
    there = tmp_path / "there"
    there.mkdir()
    shutil.copy(project.folder / "small.yaml", there)
    words = ("--configfile", "small.yaml", "--config", "cells=30", "a_H=[1,2,4]", "study=other")
    done = snakemake(there, "-s", "../project/Snakefile", *words)
    assert done.returncode == 0, done.stderr
    results = there / "results/other"
    runs = pd.read_csv(results / "tables/runs.csv")
    assert runs["cells"].tolist() == [30, 30, 30]
    assert runs["a_H"].tolist() == [1, 2, 4]
    page = (results / "report.html").read_text()
    assert "<h1>other</h1>" in page
    assert "3 runs over a_H (1, 2, 4)." in page
    assert not (there / "results/small").exists()
    assert not list(project.folder.glob("results"))
    again = snakemake(project.folder, "--directory", "../there", *words)
    assert "Nothing to be done" in again.stderr + again.stdout
    before = {path: path.stat().st_mtime_ns for path in results.rglob("*")}
    shown = snakemake(there, "-s", "../project/Snakefile", *words, "--report", "its.html")
    assert shown.returncode == 0, shown.stderr
    assert (there / "its.html").stat().st_size > 0
    assert {path: path.stat().st_mtime_ns for path in results.rglob("*")} == before


def test_another_workflow_can_import_this_one(project, tmp_path):
    (tmp_path / "Snakefile").write_text(IMPORTING)
    indented = "".join(f"  {line}\n" for line in STUDY.splitlines())
    (tmp_path / "cfg.yaml").write_text(f"subslide:\n{indented}")
    done = snakemake(tmp_path)
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "n.txt").read_text().startswith("3 ")
    assert (tmp_path / "results/small/report.html").exists()


def test_a_module_with_a_prefix_is_refused_in_one_line(project, tmp_path):
    """Its jobs would write where Snakemake does not look."""
    text = IMPORTING.replace(
        '    config: config["subslide"]', '    config: config["subslide"]\n    prefix: "pre"'
    )
    (tmp_path / "Snakefile").write_text(text)
    indented = "".join(f"  {line}\n" for line in STUDY.splitlines())
    (tmp_path / "cfg.yaml").write_text(f"subslide:\n{indented}")
    done = snakemake(tmp_path)
    assert done.returncode == 1
    assert "configuration: prefix: is not allowed; allowed: a module without" in done.stderr
    assert not list(tmp_path.rglob("results"))


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (
            ("--configfile", "small.yaml", "config/smoke.yaml"),
            "--configfile: small.yaml, smoke.yaml: allowed: one file",
        ),
        (("--configfile", "twice.yaml"), "twice.yaml, line 3: the key 'a_H' is given twice"),
        (("--configfile", "octal.yaml"), "octal.yaml, line 2: cells: 0200 may be read in several ways"),
        (
            ("--configfile", "small.yaml", "--config", "cells=1:30"),
            "--config cells: 1:30 may be read in several ways",
        ),
        (("--configfile", "small.yaml", "--config", "cels=30"), "did you mean 'cells'?"),
    ],
)
def test_what_is_refused_is_refused_in_one_line_and_leaves_nothing(project, words, said):
    (project.folder / "twice.yaml").write_text("study: t\na_H: 1\na_H: 2\n")
    (project.folder / "octal.yaml").write_text("study: t\ncells: 0200\n")
    done = snakemake(project.folder, *words)
    lines = [line for line in (done.stdout + done.stderr).splitlines() if "configuration: " in line]
    assert done.returncode == 1
    assert len(lines) == 1
    assert said in lines[0]
    assert "Traceback" not in done.stdout + done.stderr
    assert not (project.folder / "results").exists()
