"""What the package says of itself: every import declared, one version of Snakemake, and lints but for those named."""

import ast
import functools
import re
import subprocess
import sys
import tomllib
from importlib import metadata
from pathlib import Path

import yaml

import subslide

PACKAGE = Path(subslide.__file__).parent
ROOT = Path(__file__).resolve().parents[2]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]

NEVER_IMPORTED = {"dask": "xarray reads records in parts by it"}
"""Dependencies that no module imports, and who does."""

OF_EXTRAS = {"pygments": "snakemake"}
"""What is needed without an import of ours, and the declared package by whose extra it comes."""

LINTS = {
    "Specify a conda environment or container for each rule.": (
        "jobs call the package, so they run in the environment that has it, which is Snakemake's too"
    ),
}
"""Lints that are not followed, and why."""


def declared(*extras: str) -> dict[str, set[str]]:
    """Return the distributions that the package and its extras depend on, each with the extras that it asks for."""
    asked = {}
    for text in sum((PROJECT["optional-dependencies"][extra] for extra in extras), PROJECT["dependencies"]):
        name, of_it = re.match(r"([\w.-]+)(?:\[([\w,-]+)\])?", text).groups()
        asked[normal(name)] = set((of_it or "").split(",")) - {""}
    return asked


def normal(name: str) -> str:
    """Return the name of a distribution as it is compared."""
    return re.sub(r"[-_.]+", "-", name).lower()


@functools.cache
def imported() -> frozenset[str]:
    """Return the first parts of all that modules import, wherever they do so, and the workflow at its lines' start."""
    names = set()
    for path in PACKAGE.rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Import):
                names |= {alias.name for alias in node.names}
            elif isinstance(node, ast.ImportFrom):
                names.add(node.module or "")
    for path in (ROOT / "workflow/Snakefile", *(ROOT / "workflow/rules").glob("*.smk")):
        names |= set(re.findall(r"^(?:from|import) (\S+)", path.read_text(encoding="utf-8"), re.MULTILINE))
    return frozenset(name.split(".")[0] for name in names) - {"subslide"} - sys.stdlib_module_names


@functools.cache
def homes() -> dict[str, set[str]]:
    """Return the distributions that each name which can be imported is of."""
    return {name: set(map(normal, of)) for name, of in metadata.packages_distributions().items()}


def test_every_import_is_of_a_declared_dependency():
    known = set(declared(*(set(PROJECT["optional-dependencies"]) - {"test"})))
    undeclared = {name for name in imported() if not homes().get(name, {normal(name)}) & known}
    assert not undeclared


def test_every_dependency_is_imported():
    used = set().union(*(homes()[name] for name in imported()))
    assert set(declared()) - used == set(NEVER_IMPORTED)


def test_what_snakemakes_report_needs_is_asked_for():
    for name, home in OF_EXTRAS.items():
        extras = declared()[home]
        wanted = [text for text in metadata.requires(home) if normal(re.match(r"[\w.-]+", text)[0]) == name]
        assert any(f'extra == "{extra}"' in text for text in wanted for extra in extras)


def test_the_workflow_and_the_package_ask_for_one_version_of_snakemake():
    (least,) = re.findall(r'^min_version\("(.+)"\)$', (ROOT / "workflow/Snakefile").read_text(), re.MULTILINE)
    (asked,) = (text for text in PROJECT["dependencies"] if text.startswith("snakemake["))
    assert asked.endswith(f">={least}")


def test_classifiers_name_the_least_python_that_is_asked_for():
    versions = re.findall(r"Python :: (3\.\d+)", "\n".join(PROJECT["classifiers"]))
    assert PROJECT["requires-python"] == f">={versions[0]}"


def test_the_package_knows_where_its_workflow_lies():
    assert Path(subslide.SNAKEFILE).is_file()
    assert (Path(subslide.SNAKEFILE).parents[1] / "config/paper.yaml").is_file()
    profiles = Path(subslide.SNAKEFILE).parents[1] / "profiles"
    assert {path.parent.name for path in profiles.glob("*/config.yaml")} >= {"default", "slurm"}


def test_the_catalogue_is_told_how_to_run_the_workflow():
    about = yaml.safe_load((ROOT / ".snakemake-workflow-catalog.yml").read_text(encoding="utf-8"))
    assert about["usage"]["report"] is True
    for path in ("workflow/Snakefile", "config/README.md", "README.md", "LICENSE"):
        assert (ROOT / path).is_file()


def test_snakemakes_lints_are_followed_but_for_those_named_here(tmp_path):
    command = [sys.executable, "-m", "snakemake", "-s", ROOT / "Snakefile", "--lint"]
    done = subprocess.run(
        [*command, "--configfile", ROOT / "config/paper.yaml"], cwd=tmp_path, capture_output=True, text=True
    )
    lints = set(re.findall(r"^    \* (.+):$", done.stdout + done.stderr, re.MULTILINE))
    assert lints == set(LINTS), done.stdout + done.stderr
