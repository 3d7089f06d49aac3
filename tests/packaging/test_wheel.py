"""The wheel in a clean environment: a study to its report, and through another workflow; an sdist that tests itself.

The wheel is made from the source distribution, as others would make it, and installed with all that it declares, in the
versions of this environment.
"""

import os
import re
import shutil
import subprocess
import sys
import tarfile
from importlib import metadata
from pathlib import Path

import pandas as pd
import pytest

ROOT = Path(__file__).resolve().parents[2]
FENCE = re.compile(r"^```(?:python|yaml)\n# (\S+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
"""A block of docs/workflow.md that is a file: its name, and the file without the line that says it."""

STUDY = """study: columns
a_H: [1, 2]
model: radial
cells: 100
t_end: 0.1
figures: [fig06_fronts]
"""

pytestmark = [pytest.mark.slow, pytest.mark.long]


def run(*command, cwd, status=0, **environment):
    """Text that a command prints; it knows nothing of this environment, and must end with this status."""
    plain = {
        name: os.environ[name] for name in os.environ if not name.startswith(("PYTHON", "VIRTUAL", "NUMBA"))
    }
    plain["PATH"] = "/usr/local/bin:/usr/bin:/bin"
    done = subprocess.run(
        [str(word) for word in command], cwd=cwd, capture_output=True, text=True, env={**plain, **environment}
    )
    assert done.returncode == status, done.stdout + done.stderr
    return done.stdout + done.stderr


@pytest.fixture(scope="module")
def unpacked(tmp_path_factory):
    """The source distribution of what is tracked, or would be, unpacked."""
    source, there = tmp_path_factory.mktemp("source"), tmp_path_factory.mktemp("sdist")
    listed = run("git", "ls-files", "--cached", "--others", "--exclude-standard", cwd=ROOT)
    for name in filter(lambda name: (ROOT / name).is_file(), listed.splitlines()):
        (source / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(ROOT / name, source / name)
    build = "import sys; from setuptools import build_meta; print(build_meta.build_sdist(sys.argv[1]))"
    run(sys.executable, "-c", build, there, cwd=source)
    (archive,) = there.iterdir()
    with tarfile.open(archive) as opened:
        opened.extractall(there, filter="data")
    return there / archive.name.removesuffix(".tar.gz")


@pytest.fixture(scope="module")
def clean(unpacked, tmp_path_factory):
    """Folder of the commands of a new environment that has the wheel and what it asks for."""
    there = tmp_path_factory.mktemp("clean")
    wheels, home = there / "wheels", there / "env"
    run(sys.executable, "-m", "venv", home, cwd=there)
    run(
        sys.executable,
        "-m",
        "pip",
        "wheel",
        "-q",
        "--no-deps",
        "--no-build-isolation",
        "-w",
        wheels,
        unpacked,
        cwd=there,
    )
    (wheel,) = wheels.iterdir()
    versions = [
        f"{d.name}=={d.version}" for d in metadata.distributions() if d.name not in ("subslide", "pip")
    ]
    (there / "versions.txt").write_text("\n".join(versions))
    run(home / "bin/python", "-m", "pip", "install", "-q", "-c", "versions.txt", wheel, cwd=there)
    return home / "bin"


def test_a_study_is_run_to_its_report_from_the_wheel(clean, tmp_path):
    (tmp_path / "mine.yaml").write_text(STUDY)
    text = run(clean / "subslide", "study", "mine.yaml", "--cores", "2", cwd=tmp_path)
    assert "study 'columns', 2 runs, 1 figures" in text
    results = tmp_path / "results/columns"
    assert pd.read_csv(results / "tables/runs.csv")["a_H"].tolist() == [1, 2]
    page = (results / "report.html").read_text(encoding="utf-8")
    assert "<h1>columns</h1>" in page
    assert caption("fig06_fronts") in page
    assert {path.name for path in tmp_path.iterdir()} == {"mine.yaml", "results", ".snakemake"}
    again = run(clean / "subslide", "study", "mine.yaml", "--", "--dry-run", cwd=tmp_path)
    assert "Nothing to be done" in again
    refused = run(
        clean / "subslide", "study", "mine.yaml", "--", "--until", "nothing", cwd=tmp_path, status=1
    )
    assert "nothing" in refused


def test_another_workflow_imports_it_with_its_report(clean, tmp_path):
    """The page's own example."""
    for name, text in FENCE.findall((ROOT / "docs/workflow.md").read_text(encoding="utf-8")):
        (tmp_path / name).write_text(text)
    run(clean / "snakemake", "--cores", "2", cwd=tmp_path)
    runs = pd.read_csv(tmp_path / "results/columns/tables/runs.csv")
    assert (tmp_path / "longest.txt").read_text().split() == [runs["id"].iloc[-1]]
    run(clean / "snakemake", "--report", "its.html", cwd=tmp_path)
    page = (tmp_path / "its.html").read_text(encoding="utf-8")
    assert caption("fig06_fronts")[:40] in page


def test_the_source_distribution_tests_itself(unpacked):
    """What keeps order passes in it, by its own sources."""
    python = (sys.executable, "-c", "import subslide; print(subslide.__file__)")
    assert run(*python, cwd=unpacked, PYTHONPATH=str(unpacked / "src")).startswith(str(unpacked))
    house = ("-m", "pytest", "-q", "-p", "no:cacheprovider", "tests/house")
    assert " passed" in run(sys.executable, *house, cwd=unpacked, PYTHONPATH=str(unpacked / "src"))


def caption(name):
    """Beginning of a caption, as pages have it."""
    text = " ".join((ROOT / f"workflow/report/{name}.rst").read_text(encoding="utf-8").split())
    return re.match(r"[\w ,]+", text)[0]
