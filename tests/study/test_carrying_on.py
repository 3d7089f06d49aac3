"""CONTRIBUTING.md is true: its examples, put into a copy of the package as they stand on the page, work together."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import xarray as xr

import subslide

ROOT = Path(__file__).resolve().parents[2]
FENCE = re.compile(
    r"^```(python|diff|yaml|rst)\n(?:#|\.\.) (\S+/\S+\.\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL
)
"""A fenced block that names its file in its first line: its language, the file, and the rest."""

NEW = {
    "src/subslide/scenes/ring.py",
    "src/subslide/kernels/viscosity/pvm2u.py",
    "src/subslide/kernels/friction/viscous.py",
    "src/subslide/kernels/measures/depth.py",
    "src/subslide/tables/arrival.py",
    "src/subslide/figures/arrival_by_angle.py",
    "workflow/report/arrival_by_angle.rst",
    "config/rings.yaml",
}
"""Files that the page adds: one a thing, and the caption of the figure."""

CHANGED = {
    "src/subslide/keys/names.py",
    "src/subslide/keys/entries.py",
    "src/subslide/naming.py",
    "src/subslide/points.py",
    "src/subslide/solver/run.py",
    "src/subslide/solver/answer.py",
}
"""Files that its examples change."""

pytestmark = pytest.mark.slow


def examples() -> list[tuple[str, str, str]]:
    """Return the page's examples: language, file and text of each."""
    return FENCE.findall((ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8"))


def changed(text: str, lines: list[str]) -> str:
    """Return a text after a change: lines that begin with '+' come, with '-' go, with a space say where."""
    before = "\n".join(line[1:] for line in lines if line[0] in " -")
    after = "\n".join(line[1:] for line in lines if line[0] in " +")
    assert text.count(before) == 1, (
        f"CONTRIBUTING.md changes what is there {text.count(before)} times:\n{before}"
    )
    return text.replace(before, after)


class Copy:
    """Copy of the package and the workflow with the page's examples in it."""

    def __init__(self, folder: Path):
        self.folder = folder
        plain = shutil.ignore_patterns("__pycache__")
        shutil.copytree(Path(subslide.__file__).parent, folder / "src/subslide", ignore=plain)
        for name in ("workflow", "config", "docs"):
            shutil.copytree(ROOT / name, folder / name)
        shutil.copy(ROOT / "Snakefile", folder)
        for kind, file, body in examples():
            path = folder / file
            if kind == "diff":
                body = changed(path.read_text(encoding="utf-8"), body.splitlines())
            else:
                assert not path.exists()
            path.write_text(body, encoding="utf-8")

    def python(self, *arguments: str) -> str:
        """Return what the copy's Python prints."""
        paths = {"PYTHONPATH": str(self.folder / "src"), "NUMBA_CACHE_DIR": str(self.folder / "cache")}
        done = subprocess.run(
            [sys.executable, *arguments],
            cwd=self.folder,
            env={**os.environ, **paths},
            text=True,
            capture_output=True,
        )
        assert done.returncode == 0, done.stdout + done.stderr
        return done.stdout

    def subslide(self, *arguments: str) -> str:
        """Return what the copy's command line prints."""
        return self.python("-m", "subslide", *arguments)


@pytest.fixture(scope="module")
def copy(tmp_path_factory):
    """Copy of the package with the page's examples."""
    made = Copy(tmp_path_factory.mktemp("copy"))
    where = made.python("-c", "import subslide; print(subslide.__file__)").strip()
    assert Path(where).is_relative_to(made.folder)
    return made


@pytest.fixture(scope="module")
def results(copy):
    """Folder of the page's study, solved, tabulated and drawn by the copy's workflow."""
    folder = "results/rings"
    wanted = ("tables/arrival.csv", "tables/runs.csv", "tables/series.csv", "figures/arrival_by_angle.png")
    config = ("--configfile", "config/rings.yaml", "--cores", "1")
    copy.python("-m", "snakemake", *config, *(f"{folder}/{name}" for name in wanted))
    return copy.folder / folder


def test_a_thing_is_one_file_and_the_line_that_names_it():
    files = {kind == "diff": set() for kind, _, _ in examples()}
    for kind, file, _ in examples():
        files[kind == "diff"].add(file)
    assert files == {False: NEW, True: CHANGED}


def test_new_files_pass_what_make_test_asks(copy):
    files = [file for file in sorted(NEW) if file.endswith(".py")]
    shutil.copy(ROOT / "pyproject.toml", copy.folder)
    copy.python("-m", "ruff", "check", *files)
    copy.python("-m", "ruff", "format", "--check", *files)
    copy.python("-m", "mypy")


def test_the_study_is_checked(copy):
    assert "study 'rings', 8 runs, 1 figures" in copy.subslide("check", "config/rings.yaml")


def test_help_names_what_is_new(copy):
    text = " ".join(copy.subslide("run", "--help").split())
    assert "ifcph|ifcp|hll|rusanov|roe|pvm2u" in text
    assert "coulomb|voellmy|pouliquen|viscous" in text
    assert "kinematic viscosity nu of viscous friction [m2 s-1]; a number from 0 to 1000" in text
    assert "--rest-cap" in text
    assert "ring" in text


def test_the_pages_tell_what_is_new(copy):
    written = copy.subslide("docs").split()
    assert "config/README.md" in written
    pages = {name: (copy.folder / name).read_text(encoding="utf-8") for name in written}
    assert "### ring\n\nA round column of grains with a hole on its axis" in pages["config/README.md"]
    assert "| `rest_cap` | cap on runs to rest" in pages["config/README.md"]
    assert "## arrival.csv" in pages["docs/tables.md"]
    assert "- `max_h2` (m): largest depth of grains" in pages["docs/tables.md"]
    assert "| `max_h2` | run, step | m | largest depth of grains |" in pages["docs/records.md"]
    assert "| `mean_step` | run | s | mean time step |" in pages["docs/records.md"]
    for word in ('"ring"', '"hole"', '"pvm2u"', '"viscous"', '"rest_cap"'):
        assert word in pages["config/study.schema.json"]


def test_every_run_ends_as_the_new_key_says(results):
    runs = pd.read_csv(results / "tables/runs.csv")
    assert runs.groupby("rest_cap")["status"].agg(list).to_dict() == {
        0.8: ["not_at_rest"] * 4,
        60: ["ok"] * 4,
    }
    assert set(runs["scheme"]) == {"pvm2u"}
    assert set(runs["friction"]) == {"viscous"}
    assert set(runs["resolved_model"]) == {"radial"}
    assert runs["sediment_volume_error"].max() < 1e-12


def test_the_record_has_the_series_and_the_number(results):
    (path,) = (results / "records").glob("*.nc")
    with xr.open_dataset(path) as record:
        depth = record["max_h2"].to_numpy()
        column = (record["a_2"] * record["radius"]).to_numpy()
        steps = record["steps"].to_numpy()
        time = record["time"].max("step").to_numpy()
        assert record["mean_step"].to_numpy() == pytest.approx(time / steps)
        assert record["max_h2"].attrs["units"] == "m"
        first = record["h2"].isel(snapshot=0).max("x").to_numpy()
    assert (np.nanmax(depth, axis=1) <= column).all()
    assert depth[:, 0] == pytest.approx(first)


def test_series_and_table_hold_the_new_series(results):
    series = pd.read_csv(results / "tables/series.csv")
    depths = series[series["quantity"] == "max_h2"].groupby("id")["value"].max()
    arrivals = pd.read_csv(results / "tables/arrival.csv").set_index("id")
    runs = pd.read_csv(results / "tables/runs.csv").set_index("id")
    assert list(arrivals.index) == list(runs.index)
    assert (arrivals["time"] > 0).all()
    assert (arrivals["depth"] < depths[arrivals.index]).all()


def test_the_figure_is_drawn(results):
    assert (results / "figures/arrival_by_angle.png").read_bytes().startswith(b"\x89PNG")
    assert (results / "figures/arrival_by_angle.svg").read_text(encoding="utf-8").count("<use") > 4
