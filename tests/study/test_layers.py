"""Data flow goes one way: what each part of the package may import, read from the sources."""

import ast
from pathlib import Path

import pytest

import subslide

PACKAGE = Path(subslide.__file__).parent
SOLVING = {"kernels", "models", "scenes", "diagnostics", "solver"}
STUDY = {
    "config",
    "reading",
    "bands",
    "ledger",
    "jobs",
    "records",
    "layout",
    "results",
    "tables",
    "drawing",
    "docs",
    "figures",
}
HEAVY = {"xarray", "dask", "pandas", "pyarrow", "matplotlib", "seaborn", "scipy", "snakemake", "jsonschema"}
LIGHT = (
    "__init__",
    "__main__",
    "_cache",
    "_sources",
    "atomic",
    "config",
    "reading",
    "schema",
    "points",
    "jobs",
    "layout",
    "marks",
    "records",
    "work_precision/__init__",
    "work_precision/problems",
    "thinning",
)
FORBIDDEN = {
    "fields": SOLVING | STUDY | HEAVY | {"points", "schema"},
    "kernels": SOLVING - {"kernels", "diagnostics"} | STUDY | HEAVY | {"points", "schema", "netCDF4"},
    "exact": SOLVING | STUDY | HEAVY,
    "diagnostics": {"models", "scenes", "solver"} | STUDY | HEAVY,
    "scenes": {"solver"} | STUDY | HEAVY,
    "models": {"solver"} | STUDY | HEAVY,
    "solver": STUDY | HEAVY,
    "figures": SOLVING,
    "results": SOLVING,
    "bands": SOLVING | HEAVY,
    "convergence": SOLVING | STUDY | HEAVY | {"points", "schema"},
    "tables": SOLVING,
    "errors": SOLVING,
    "atlas": SOLVING,
    "methods": SOLVING,
    "energy": HEAVY | {"solver"},
    "guard": SOLVING | HEAVY,
    "verification": SOLVING,
    "work_precision": SOLVING,
    "ledger": SOLVING | HEAVY,
    **{name: HEAVY for name in LIGHT},
}


def imported(path: Path, inner: bool) -> set[str]:
    """Top names that a module imports, of our package without its name; with `inner`, those inside functions too."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    names = set()
    for node in ast.walk(tree) if inner else tree.body:
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            base = _base(path, node)
            names |= {f"{base}.{alias.name}" for alias in node.names}
    return {n.split(".")[1] if n.startswith("subslide.") else n.split(".")[0] for n in names}


def _base(path: Path, node: ast.ImportFrom) -> str:
    """Full name of the module in 'from module import ...', relative ones resolved."""
    if not node.level:
        return node.module
    package = ["subslide", *path.relative_to(PACKAGE).parent.parts]
    return ".".join([*package[: len(package) - node.level + 1], *([node.module] if node.module else [])])


@pytest.mark.parametrize("part", FORBIDDEN)
def test_no_part_imports_what_comes_after_it(part):
    paths = (
        [PACKAGE / f"{part}.py"]
        if (PACKAGE / f"{part}.py").exists()
        else sorted((PACKAGE / part).rglob("*.py"))
    )
    assert paths
    for path in paths:
        wrong = imported(path, inner=part not in LIGHT) & FORBIDDEN[part]
        assert not wrong, f"{path.name} imports {wrong}"


def test_files_stay_short():
    for path in PACKAGE.rglob("*.py"):
        assert len(path.read_text(encoding="utf-8").splitlines()) <= 320, path.name
