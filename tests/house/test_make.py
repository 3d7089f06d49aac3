"""The two commands: what `make` would do, by its own dry run."""

import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def planned(*arguments):
    """Return the commands that make would run."""
    done = subprocess.run(["make", "-n", *arguments], cwd=ROOT, capture_output=True, text=True, check=True)
    return done.stdout


def test_make_alone_runs_the_papers_study():
    assert "subslide study config/paper.yaml" in planned()


def test_make_with_a_config_runs_that_study():
    assert planned("CONFIG=config/smoke.yaml") == planned("study", "CONFIG=config/smoke.yaml")
    assert "config/paper.yaml" not in planned("CONFIG=config/smoke.yaml")
