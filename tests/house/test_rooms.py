"""The rooms of the package in the order of the work: a module imports from its own room and from those before it."""

import ast
import re
import subprocess
import sys
from pathlib import Path

import pytest

import subslide

PACKAGE = Path(subslide.__file__).parent
ROOMS = (
    ("the bottom", ("_early", "_sources", "_cache", "catalogue", "files", "checksums", "naming")),
    ("what may be asked", ("keys",)),
    ("one run's values", ("points",)),
    ("initial states", ("scenes",)),
    ("asked", ("study",)),
    ("the scheme", ("kernels",)),
    ("solved", ("models",)),
    ("one run", ("solver",)),
    ("kept", ("records",)),
    ("opened", ("results",)),
    ("known", ("exact", "laboratory")),
    ("learned", ("sensitivity", "emulator")),
    ("judged", ("tables",)),
    ("drawn", ("figures",)),
    ("told", ("pages",)),
    ("commanded", ("jobs", "commands")),
    ("at hand", ("library",)),
    ("the command line", ("__main__",)),
)
"""What each floor does, and the modules and folders on it, from the ground up."""

FLOOR = {name: floor for floor, (_, names) in enumerate(ROOMS) for name in names}
NARROW = {
    "__init__": {"_early", "_sources", "_cache"},
    "kernels": {"kernels", "naming", "keys.names", "_sources"},
    "scenes": {"scenes", "keys", "points", "catalogue"},
}
"""Modules that import less than those below them: all that they may."""

HEAVY = {
    "numba",
    "xarray",
    "dask",
    "pandas",
    "pyarrow",
    "matplotlib",
    "seaborn",
    "scipy",
    "sklearn",
    "snakemake",
    "jsonschema",
}
SOLVE = {"numba", "netCDF4"}
HEAVY_IN = {
    "kernels": SOLVE,
    "models": SOLVE,
    "solver": SOLVE,
    "records": SOLVE,
    "results": HEAVY,
    "figures": HEAVY,
    "pages": HEAVY,
}
"""Libraries that start slowly which rooms may import at once; any other imports them inside functions."""

MODULES = sorted(PACKAGE.rglob("*.py"))


def name_of(path: Path) -> str:
    """Return the dotted name of a module within the package; of a folder for its __init__."""
    parts = list(path.relative_to(PACKAGE).with_suffix("").parts)
    return ".".join(parts[:-1] if parts[-1] == "__init__" and len(parts) > 1 else parts)


def room_of(name: str) -> str:
    """Return the room of a module."""
    return name.split(".")[0]


def imports(path: Path, inner: bool) -> set[str]:
    """Return the dotted names that a module imports, whole, or without what functions import for themselves."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    names = set()
    for node in ast.walk(tree) if inner else outer(tree):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            assert not node.level, f"{path.name}: imports are absolute"
            names |= {f"{node.module}.{alias.name}" for alias in node.names}
    return names


def outer(tree: ast.Module):
    """Return the statements that run when a module is imported: not those of functions, nor for type checkers alone."""
    waiting = list(tree.body)
    while waiting:
        node = waiting.pop()
        yield node
        for_types = isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING"
        if isinstance(node, (ast.If, ast.Try, ast.With)) and not for_types:
            waiting += [child for child in ast.iter_child_nodes(node) if isinstance(child, ast.stmt)]


def own(names: set[str]) -> set[str]:
    """Return the modules of the package among some names."""
    known = {name_of(path) for path in MODULES}
    found = set()
    for name in names:
        if name == "subslide" or name.startswith("subslide."):
            parts = name.split(".")[1:]
            while parts and ".".join(parts) not in known:
                parts = parts[:-1]
            found.add(".".join(parts) or "__init__")
    return found


@pytest.mark.parametrize("path", MODULES, ids=name_of)
def test_a_module_imports_only_what_comes_before_it(path):
    name = name_of(path)
    room = room_of(name)
    used = own(imports(path, inner=True)) - {"__init__"}
    if room in NARROW:
        allowed = NARROW[room]
        wrong = {other for other in used if not {other, room_of(other)} & allowed}
    else:
        assert room in FLOOR, f"{name} is on no floor: say in ROOMS where it belongs"
        wrong = {other for other in used if FLOOR[room_of(other)] > FLOOR[room]}
    assert not wrong, f"{name} imports {', '.join(sorted(wrong))}, which come after it"


def test_every_room_is_there():
    rooms = {room_of(name_of(path)) for path in MODULES} - {"__init__"}
    assert rooms == set(FLOOR)


def test_the_page_on_rooms_tells_their_order():
    page = (PACKAGE.parents[1] / "docs/design/rooms.md").read_text(encoding="utf-8")
    rows = [line.split("|")[1] for line in page.splitlines() if line.startswith("| `")]
    told = [name for row in rows for name in re.findall(r"`(\w+)/?`", row)]
    assert told == [name for _, names in ROOMS for name in names]


def test_modules_import_each_other_in_no_circle():
    uses = {name_of(path): own(imports(path, inner=True)) for path in MODULES}
    done, under_way = set(), []

    def visit(name):
        if name in done:
            return
        assert name not in under_way, f"a circle: {' -> '.join([*under_way, name])}"
        under_way.append(name)
        for other in uses.get(name, ()):
            if other != name:
                visit(other)
        under_way.pop()
        done.add(name)

    for name in uses:
        visit(name)


@pytest.mark.parametrize("path", MODULES, ids=name_of)
def test_what_starts_slowly_is_imported_late(path):
    room = room_of(name_of(path))
    if room == "tables" and "._" in name_of(path):
        return  # helpers, which tables import within functions: see the next test
    slow = {name.split(".")[0] for name in imports(path, inner=False)} & (HEAVY | SOLVE)
    assert slow <= HEAVY_IN.get(room, set()), f"{name_of(path)} imports {slow} at once"


def test_planning_a_study_imports_nothing_that_starts_slowly():
    script = (
        "import sys; from subslide import catalogue, tables; from subslide.study import batches, config;"
        "[tables.load(name) for name in catalogue.names('tables')];"
        f"print(*({HEAVY} & set(sys.modules)))"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert done.stdout.split() == []


def test_the_top_of_the_package_is_small():
    assert len(list(PACKAGE.glob("*.py"))) <= 12


@pytest.mark.parametrize("path", MODULES, ids=name_of)
def test_files_stay_short(path):
    assert len(path.read_text(encoding="utf-8").splitlines()) <= 310


def parameters(node: ast.FunctionDef) -> int:
    """Return how many parameters a function has, but for self and cls."""
    names = [a.arg for a in (*node.args.posonlyargs, *node.args.args, *node.args.kwonlyargs)]
    return len([name for name in names if name not in ("self", "cls")])


@pytest.mark.parametrize("path", [p for p in MODULES if room_of(name_of(p)) != "kernels"], ids=name_of)
def test_functions_take_at_most_eight_parameters(path):
    tree = ast.parse(path.read_text(encoding="utf-8"))
    many = {
        n.name: parameters(n) for n in ast.walk(tree) if isinstance(n, ast.FunctionDef) and parameters(n) > 8
    }
    assert not many
