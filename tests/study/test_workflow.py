"""The real workflow on a small study: what runs, what does not run again, and what is mended."""

import os
import re
import shutil
import subprocess
import sys

import pandas as pd
import pytest
import xarray as xr
from projects import STUDY, TABLES, Project

NEW_TABLE = '''"""Where runs end."""

TITLE = "Ends of runs"
ABOUT = "One row a run."
READS = ("records", "runs")
COLUMNS = {"id": ("", "name of the run"), "end": ("m", "length of the deposit")}


def needs(study):
    """Return '' for every study."""
    return ""


def table(results):
    """Give the rows."""
    for run, record in results.each("L_f"):
        yield {"id": run.id, "end": record["L_f"][0]}
'''

pytestmark = pytest.mark.slow


@pytest.fixture(scope="session")
def finished(root, tmp_path_factory):
    """A finished study; tests get copies of it."""
    project = Project(root, tmp_path_factory.mktemp("finished"))
    project.first = project.jobs()
    return project


@pytest.fixture
def project(finished, tmp_path):
    """A copy of the finished study, with times of files kept."""
    return finished.copy(tmp_path / "copy")


def test_a_study_ends_with_records_tables_and_report(finished):
    assert set(TABLES) >= {"table_runs", "table_series", "table_timing"}
    assert finished.first == {"points": 1, "batch": 1, **TABLES, "report": 1}
    assert finished.runs()["status"].isin(["ok", "not_at_rest"]).all()
    assert len(finished.runs()) == 2
    for name in ("records/0001.nc", "tables/series.csv", "tables/timing.csv", "report.html"):
        assert (finished.results / name).stat().st_size > 0
    assert (finished.results / "benchmarks/batch-0001.tsv").exists()
    assert (finished.results / "logs/batch-0001.log").read_text().count("\n") == 3


def test_a_figure_does_not_depend_on_its_surroundings(project):
    """A notebook's backend, which is not installed, and the user's settings change no byte."""
    command = [sys.executable, "-m", "subslide", "figure", "fig06_fronts", "--results", "results/small", "-o"]
    plain = {name: value for name, value in os.environ.items() if name != "MPLBACKEND"}
    subprocess.run([*command, "plain"], cwd=project.folder, env=plain, check=True, capture_output=True)
    (project.folder / "matplotlibrc").write_text("text.usetex: True\nlines.linewidth: 9\n")
    notebook = {**plain, "MPLBACKEND": "module://matplotlib_inline.backend_inline"}
    done = subprocess.run(
        [*command, "there"], cwd=project.folder, env=notebook, check=False, capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
    for kind in ("png", "svg"):
        files = [project.folder / folder / f"fig06_fronts.{kind}" for folder in ("plain", "there")]
        assert files[0].read_bytes() == files[1].read_bytes()


def test_the_report_needs_no_network(finished):
    page = (finished.results / "report.html").read_text()
    assert not re.search(r"""<(script|link|img)[^>]+(src|href)=["']https?:""", page)


def test_a_second_run_does_nothing(project):
    before = {path: path.stat().st_mtime_ns for path in project.results.rglob("*") if path.is_file()}
    assert project.jobs() == {}
    assert project.jobs("-n") == {}
    assert before == {path: path.stat().st_mtime_ns for path in project.results.rglob("*") if path.is_file()}


def test_a_wider_grid_computes_only_what_is_new(project):
    record = project.results / "records/0001.nc"
    before = record.stat().st_mtime_ns
    project.configure(STUDY.replace("a_H: [1, 2]", "a_H: [0.5, 2, 1]"))
    assert project.jobs() == {"points": 1, "batch": 1, **TABLES, "report": 1}
    assert record.stat().st_mtime_ns == before
    assert project.runs()["a_H"].tolist() == [0.5, 2, 1]
    assert project.jobs() == {}
    numbers = [
        xr.open_dataset(path)["run"].values.tolist() for path in sorted(project.results.glob("records/*.nc"))
    ]
    assert numbers == [[1, 2], [3]]
    assert (project.results / "batches/next_run").read_text() == "4\n"


def test_bands_solve_companions_alone_and_leave_no_trace_when_removed(project):
    """The study is solved at 20 cells; asked for at 40, it has those runs as companions, and lacks 10 cells alone."""
    text = STUDY.replace("cells: 20", "cells: 40")
    project.configure(text)
    assert project.jobs() == {"points": 1, "batch": 1, **TABLES, "report": 1}
    plain = project.runs()
    records = {path: path.stat().st_mtime_ns for path in project.results.glob("records/*.nc")}
    project.configure(text + "bands: true\n")
    assert project.jobs() == {"points": 1, "batch": 1, **TABLES, "table_bands": 1, "report": 1}
    assert records.items() <= {p: p.stat().st_mtime_ns for p in project.results.glob("records/*.nc")}.items()
    assert project.jobs("-n") == {}
    bands, runs = pd.read_csv(project.results / "tables/bands.csv"), project.runs()
    assert list(dict.fromkeys(bands["id"])) == runs["id"].tolist() == plain["id"].tolist()
    final = bands[bands["quantity"] == "L_f_1pc"]
    assert final["value"].tolist() == runs["L_f_1pc"].tolist()
    assert final["convergence"].tolist() == runs["L_f_1pc_convergence"].tolist()
    assert set(pd.read_csv(project.results / "tables/series.csv")["id"]) == set(runs["id"])
    project.configure(text)
    assert project.jobs() == {"points": 1, **TABLES, "report": 1}
    assert not (project.results / "tables/bands.csv").exists()
    pd.testing.assert_frame_equal(project.runs(), plain)


def test_another_order_or_fewer_points_renew_the_tables_alone(project):
    project.configure(STUDY.replace("a_H: [1, 2]", "a_H: [2.0, 1]"))
    assert project.jobs("-n") == {"points": 1, **TABLES, "report": 1}
    project.configure(STUDY.replace("a_H: [1, 2]", "a_H: [2]"))
    assert project.jobs() == {"points": 1, **TABLES, "report": 1}
    assert project.runs()["a_H"].tolist() == [2]


def test_changed_code_runs_everything_again(project):
    source = shutil.copytree(project.root / "src", project.folder / "src")
    assert project.jobs("-n", PYTHONPATH=str(source)) == {}
    with open(source / "subslide/naming.py", "a") as file:
        file.write("# a change\n")
    again = project.jobs("-n", PYTHONPATH=str(source))
    assert again == {"batch": 1, **TABLES, "report": 1}


def test_a_process_elsewhere_reads_the_plan_and_never_the_configuration(project):
    """As an executor starts it for one job: here the configuration is no YAML any more."""
    project.configure(STUDY.replace("a_H: [1, 2]", "a_H: [1, 2, 3]"))
    project.snakemake("--until", "points")
    (plan,) = (project.folder / ".snakemake/subslide/small").glob("plan-*.json")
    project.configure("study: [")
    text = project.snakemake(
        *("--mode", "remote", "--target-jobs", "batch:batch=0002", "--allowed-rules", "batch", "--force"),
        *("--nolock", "--no-hooks", "--target-files-omit-workdir-adjustment", "--config"),
        f"subslide_plan={plan.relative_to(project.folder)}",
        configured=False,
    )
    assert "1 of 1 steps (100%) done" in text
    assert (project.results / "batches/0002.json").exists()
    project.configure(STUDY.replace("a_H: [1, 2]", "a_H: [1, 2, 3]"))
    assert "batch" not in project.jobs("-n")


def change(source, name):
    """Add a comment to a source file of the package."""
    with open(source / "subslide" / name, "a") as file:
        file.write("# a change\n")


def test_a_changed_table_page_or_figure_solves_nothing(project):
    source = shutil.copytree(project.root / "src", project.folder / "src")
    for name in ("figures/__init__.py", "pages/tables.py", "tables/claims.py", "__main__.py"):
        change(source, name)
    assert project.jobs("-n", PYTHONPATH=str(source)) == {}
    change(source, "tables/timing.py")
    assert project.jobs("-n", PYTHONPATH=str(source)) == {"table_timing": 1, "report": 1}
    change(source, "tables/_convergence.py")  # bands are made with it, and runs repeat bands
    assert project.jobs("-n", PYTHONPATH=str(source)) == {"table_runs": 1, "table_timing": 1, "report": 1}
    change(source, "results/__init__.py")
    assert project.jobs("-n", PYTHONPATH=str(source)) == {**TABLES, "report": 1}


def test_a_new_table_is_one_file(project):
    source = shutil.copytree(project.root / "src", project.folder / "src")
    (source / "subslide/tables/ends.py").write_text(NEW_TABLE)
    assert project.jobs(PYTHONPATH=str(source)) == {"table_ends": 1, "report": 1}
    ends = pd.read_csv(project.results / "tables/ends.csv")
    assert ends["end"].tolist() == project.runs()["L_f_1pc"].tolist()
    (source / "subslide/tables/ends.py").unlink()
    assert project.jobs(PYTHONPATH=str(source))["report"] == 1


def test_mistakes_are_told_before_anything_is_written(project):
    project.configure(STUDY.replace("r: 0.4", "r: 1.5").replace("small", "other"))
    text = project.snakemake(check=False)
    assert "r: 1.5 is not allowed; allowed: a number from 0 to 0.99999" in text
    assert "Traceback" not in text
    assert not (project.folder / "results/other").exists()


def test_studies_are_not_merged(project):
    """Keys of config/paper.yaml, which runs when no file is given, must not reach another study."""
    assert set(project.runs()["delta"]) == {32}
    assert project.runs()["numerics"].tolist() == ["default", "default"]
    assert project.runs()["cells"].tolist() == [20, 20]


def test_a_sweep_of_numerics_is_charted_and_other_studies_are_not(project):
    cases = "  - {model: radial, cells: [20, 40, 80]}\n  - {model: plane, order: 1, front_flux: hll}\n"
    sweep = f"study: small\nr: 0.4\ncells: 20\nt_end: 0.05\nfigures: [work_precision]\ncases:\n{cases}"
    project.configure(sweep)
    jobs = project.jobs("-n")
    assert jobs["table_work_precision"] == jobs["table_cheapest"] == jobs["figure_work_precision"] == 1
    project.snakemake("--until", "table_cheapest")
    rows = pd.read_csv(project.results / "tables/work_precision.csv")
    assert rows[rows["quantity"] == "L_f"]["method"].tolist() == ["default"] * 3 + ["paper"]
    assert rows["error"].notna().all()
    assert (project.results / "tables/cheapest.csv").exists()
    project.configure(STUDY)
    assert "table_work_precision" not in project.jobs("-n")


def test_the_atlas_and_its_search_run_in_the_study_of_stability_alone(project):
    assert "table_atlas" not in project.jobs("-n", "--forceall")
    project.configure((project.root / "config/stability.yaml").read_text())
    jobs = project.jobs("-n")
    assert jobs["table_atlas"] == jobs["table_cfl"] == jobs["table_runs"] == jobs["table_errors"] == 1
    assert jobs["batch"] >= 7  # one for each set of kernels
    assert sum(name.startswith("figure_stability_") for name in jobs) == 7


@pytest.mark.long
@pytest.mark.parametrize("keep", ["series", "summary"])
def test_a_study_without_profiles_is_whole(project, keep):
    before = (project.results / "tables/runs.csv").read_bytes()
    shutil.rmtree(project.results)
    project.configure(
        f"{STUDY}figures: [fig06_fronts, fig09_surface]\nkeep: {keep}\n".replace("figures: none\n", "")
    )
    project.snakemake()
    assert (project.results / "tables/runs.csv").read_bytes() == before
    assert {path.name for path in (project.results / "figures").glob("*.png")} == {
        "fig06_fronts.png",
        "fig09_surface.png",
    }
