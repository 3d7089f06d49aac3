"""Plug-ins keep their contract: tables say what they are, what they read and hold, and load nothing heavy."""

import os
import shutil
import subprocess
import sys

import pytest

from subslide import _sources, catalogue, tables
from subslide._sources import imported, source_hash
from subslide.points import RUN_KEYS, Point
from subslide.study.config import make_study

NAMES = catalogue.names("tables")
NEEDED = ("bands: true", "figures of stability", "numerics: paper and resolved", "scene: ")


def test_the_tables_of_the_folder_are_known():
    assert set(NAMES) >= {"runs", "timing", "series", "bands", "claims", "errors", "atlas", "cfl"}
    assert not any(name.startswith("_") for name in NAMES)


@pytest.mark.parametrize("name", NAMES)
def test_a_table_says_what_it_is(name):
    module, about = tables.load(name), catalogue.table(name)
    assert module.__doc__
    assert about.title
    assert set(about.reads) <= {"records", *NAMES} - {name}
    assert about.reads or about.kernels
    assert len(tables.about(name)) > 10
    assert all(len(entry) == 2 and entry[1] for entry in module.COLUMNS.values())
    assert tables.files(name, [Point()], "all")[0] == f"{name}.csv"
    assert callable(getattr(module, "table", None) or module.columns)


@pytest.mark.parametrize("name", NAMES)
def test_a_table_imports_no_other_that_it_does_not_read(name):
    others = {other for other in imported("tables", name) if other in NAMES} - {name}
    assert others <= set(catalogue.table(name).reads), "its sources would not tell when it is out of date"


def test_planning_a_study_loads_nothing_heavy():
    code = (
        "import sys; from subslide import catalogue, tables; from subslide.study.config import read_study;"
        "study = read_study('config/paper.yaml');"
        "wanted = [name for name in catalogue.names('tables') if not tables.load(name).needs(study)];"
        "assert {'bands', 'claims', 'runs', 'series', 'timing'} <= set(wanted), wanted;"
        "assert 'atlas' not in wanted;"
        "heavy = {'xarray', 'pandas', 'dask', 'matplotlib', 'seaborn', 'numba', 'netCDF4'} & set(sys.modules);"
        "assert not heavy, heavy"
    )
    root = catalogue.PACKAGE.parents[1]
    subprocess.run([sys.executable, "-c", code], check=True, cwd=root)


@pytest.mark.parametrize("name", ["atlas", "bands", "cfl", "claims", "errors"])
def test_what_a_plain_study_lacks_for_a_table_is_told(name):
    plain = make_study({"study": "t", "model": "radial", "figures": "none"})
    assert tables.load(name).needs(plain).startswith(NEEDED)


def test_a_table_says_which_of_its_columns_hold_numbers():
    assert catalogue.layout("bands").columns == tuple(tables.load("bands").COLUMNS)
    assert set(catalogue.layout("bands").numbers) == set(catalogue.layout("bands").columns) - {
        *("id", "quantity", "convergence")
    }


def test_literals_are_read_from_sources():
    assert catalogue.literals("tables", "cfl")["KERNELS"] == tables.load("cfl").KERNELS
    assert set(catalogue.figure("fig05_h2_by_r").needs) <= set(RUN_KEYS)
    assert imported("tables", "claims") >= {
        "claims",
        "_claims",
        "_claims/grains",
        "_claims/evidence",
    }


def test_constants_with_a_type_are_read_too(tmp_path, monkeypatch):
    (tmp_path / "tables").mkdir()
    text = 'TITLE: str = "a title"\nREADS = ("runs",)\nLATER: int\n'
    (tmp_path / "tables" / "typed.py").write_text(text)
    monkeypatch.setattr(catalogue, "PACKAGE", tmp_path)
    assert catalogue.table("typed") == ("a title", "5 Tables", ("runs",), ())


def test_parts_of_the_sources_follow_the_rooms(tmp_path, monkeypatch):
    """Each edit changes the hashes of what it can change, and no other."""
    from shutil import copytree

    package = copytree(catalogue.PACKAGE, tmp_path / "subslide")
    monkeypatch.setattr("subslide._sources.PACKAGE", package)
    parts = {
        "solver": ("solver",),
        "records": ("record",),
        "claims": ("table", "claims"),
        "runs": ("table", "runs"),
        "figure": ("figure", "fig05_h2_by_r"),
    }

    def changed(name):
        before = {part: source_hash.__wrapped__(*words) for part, words in parts.items()}
        with open(package / name, "a") as file:
            file.write("# a change\n")
        return {part for part, words in parts.items() if source_hash.__wrapped__(*words) != before[part]}

    assert changed("kernels/waves.py") == set(parts)
    assert changed("study/config.py") == {"records", "claims", "runs", "figure"}
    assert changed("laboratory/lube.py") == {"claims", "runs", "figure"}
    assert changed("tables/_claims/grains.py") == {"claims", "figure"}
    assert changed("tables/bands.py") == {"runs", "figure"}
    assert changed("tables/timing.py") == {"figure"}
    assert changed("figures/fig05_h2_by_r.py") == {"figure"}
    for name in ("pages/tables.py", "commands/solving.py", "figures/fig06_fronts.py", "__main__.py"):
        assert changed(name) == set()


def test_the_top_of_the_package_stays_small():
    assert len(list(catalogue.PACKAGE.glob("*.py"))) <= 12


def test_what_editors_leave_beside_modules_counts_for_nothing(tmp_path, monkeypatch):
    package = tmp_path / "subslide"
    shutil.copytree(_sources.PACKAGE, package, ignore=shutil.ignore_patterns("__pycache__"))
    monkeypatch.setattr(_sources, "PACKAGE", package)
    monkeypatch.setattr(catalogue, "PACKAGE", package)
    parts = [("solver",), ("record",), ("table", "runs"), ("figure", "fig06_fronts")]
    before = [source_hash.__wrapped__(*part) for part in parts], catalogue.names("tables")
    for room in ("kernels", "tables", "figures", ".ipynb_checkpoints"):
        (package / room).mkdir(exist_ok=True)
        (package / room / ".#runs.py").symlink_to("me@host.1:2")
        (package / room / "gone.py").symlink_to("nowhere")
        (package / room / "._runs.py").write_bytes(b"\0\5\x16\7")
        (package / room / "runs-checkpoint.py").write_text("x = 1")
        (package / room / "folder.py").mkdir()
        os.mkfifo(package / room / "pipe.py")
    assert ([source_hash.__wrapped__(*part) for part in parts], catalogue.names("tables")) == before
    (package / "kernels" / "extra.py").write_text("")
    assert source_hash.__wrapped__("solver") != before[0][0]
