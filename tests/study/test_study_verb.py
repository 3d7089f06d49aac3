"""`subslide study`: what it refuses, and what it hands over to Snakemake."""

import os
import sys

import pytest

from subslide import SNAKEFILE
from subslide.__main__ import main
from subslide.commands import study

QUICK = "study: t\nmodel: radial\ncells: 200\nt_end: 0.05\nfigures: none\n"


@pytest.fixture(autouse=True)
def here(tmp_path, monkeypatch):
    """A folder with a study, in which nothing takes the place of the tests."""
    monkeypatch.delattr(os, "execv")
    monkeypatch.chdir(tmp_path)
    (tmp_path / "t.yaml").write_text(QUICK)
    return tmp_path


@pytest.fixture
def handed(monkeypatch):
    """Function that runs the verb and returns the words after `python -P -m snakemake`."""
    started = []
    monkeypatch.setattr(os, "execv", lambda path, words: started.append(words), raising=False)

    def call(*words):
        assert main(["study", *words]) == 0
        (command,) = started
        assert command[:4] == [sys.executable, "-P", "-m", "snakemake"]
        return command[4:]

    return call


def test_snakemake_gets_the_file_this_machine_and_what_follows(handed, capsys):
    words = handed("t.yaml", "--cores", "2", "--", "--config", "cells=300")
    first = [f"--snakefile={study.STARTED}", "--configfile=t.yaml"]
    assert words == [*first, words[2], "--cores=2", "--config", "cells=300"]
    assert words[2].endswith("/profiles/default")
    assert study.STARTED.read_text() == study.INCLUDED
    assert "t.yaml: study 't', 1 runs" in capsys.readouterr().out


def test_all_cores_are_used_unless_a_profile_says_how_many(handed):
    assert handed("t.yaml")[-1] == "--cores=all"


def test_a_profile_of_the_package_is_taken_with_its_jobs(handed):
    (profile,) = handed("t.yaml", "--profile", "slurm")[2:]
    assert profile == f"--workflow-profile={study.ROOT / 'profiles/slurm'}"


def test_a_profile_here_goes_before_the_packages(handed, here):
    (here / "profiles/slurm").mkdir(parents=True)
    (here / "profiles/slurm/config.yaml").write_text("jobs: 3\n")
    assert handed("t.yaml", "--profile", "slurm")[2:] == ["--workflow-profile=profiles/slurm"]


def test_a_file_may_be_called_like_an_option(handed, here):
    (here / "-t.yaml").write_text(QUICK)
    assert handed("--cores", "all", "--", "-t.yaml", "-n")[1::3] == ["--configfile=-t.yaml", "-n"]


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("none.yaml",), "none.yaml"),
        (("t.yaml", "--profile", "slum"), "allowed: default, slurm; did you mean 'slurm'?"),
        (("t.yaml", "--profile", ""), "--profile: '' is not allowed"),
        (("t.yaml", "--cores", "0"), "--cores"),
        (("t.yaml", "--cores", "al"), "--cores"),
        (("bad.yaml",), "did you mean 'cells'?"),
    ],
)
def test_what_is_wrong_is_said_in_one_line_and_nothing_is_written(here, capsys, words, said):
    (here / "bad.yaml").write_text("study: t\ncels: 3\n")
    assert main(["study", *words]) == 2
    error = capsys.readouterr().err
    assert said in error
    assert error.count("\n") == 1
    assert not (here / ".snakemake").exists()


def test_other_workflows_are_told_where_this_one_lies(capsys):
    assert main(["workflow"]) == 0
    assert capsys.readouterr().out == f"{SNAKEFILE}\n"
    assert SNAKEFILE.endswith("/workflow/Snakefile")
