"""Hashes of the package's own sources: they tell when results and compiled kernels are out of date."""

import ast
import functools
import hashlib
from pathlib import Path

PACKAGE = Path(__file__).resolve().parent
ROOT = PACKAGE if (PACKAGE / "workflow").is_dir() else PACKAGE.parents[1]
"""Folder of the workflow and its profiles: an installed package has them within, else they are the repository's."""

SNAKEFILE = str(ROOT / "workflow/Snakefile")
"""The workflow, which others can import as a module."""

CAPTIONS = ROOT / "workflow/report"
"""Folder of the captions of tables and figures, ``NAME.rst``."""

COMPILED = ("kernels", "naming.py", "keys/names.py")
"""Rooms whose code is compiled, or is read by code that is."""

JUDGING = ("results", "exact", "laboratory", "sensitivity", "emulator", "tables")
"""Rooms after the records, which make tables of them."""

SHOWING = ("figures", "pages", "commands", "library", "__main__.py", "_early.py", "catalogue.py")
"""Rooms that draw, describe or call what the others make: a change here changes no record and no table."""

WRITERS = frozenset({"__init__", "_write"})
"""Modules of the room of tables that write any of them."""


@functools.cache
def source_hash(part: str = "record", name: str = "") -> str:
    """Return a hash of the sources that can change one part of what the package makes.

    Parameters
    ----------
    part
        `solver`: compiled code. `record`: records. `table`: the table called `name`, so of the tables only what it
        imports. `figure`: the one called `name`, so all but the others and what describes or calls. `page`: that one
        alone, and the captions.
    name
        Name of the table, figure or page.

    Returns
    -------
    str
        12 hex digits.
    """
    digest = hashlib.sha256()
    sources = [(path, path.relative_to(PACKAGE)) for path in sorted(PACKAGE.rglob("*.py"))]
    read = [(path, source) for path, source in sources if _belongs(source, part, name) and is_module(source)]
    if part == "page":
        read += [(path, path.relative_to(ROOT)) for path in sorted(CAPTIONS.glob("*.rst"))]
    for path, source in read:
        body = path.read_bytes()
        digest.update(f"{source.as_posix()} {len(body)}\n".encode() + body)
    return digest.hexdigest()[:12]


def is_module(source: Path) -> bool:
    """Return whether a path within the package can be imported: not what editors and notebooks leave beside modules."""
    names = source.with_suffix("").parts
    return all(name.isidentifier() for name in names) and (PACKAGE / source).is_file()


@functools.cache
def imported(room: str, name: str) -> frozenset[str]:
    """Return the modules of a room that a plug-in is made of: its own, and all that it imports from the room.

    Parameters
    ----------
    room, name
        Folder of the package, and name of a file in it.

    Returns
    -------
    frozenset of str
        Paths without '.py' from the folder, such as `claims`, `_claims/grains`.
    """
    known, new = set(), {name}
    while new:
        known |= new
        new = {other for one in new for other in _imports(room, one)} - known
    return frozenset(known)


def _imports(room: str, name: str) -> set[str]:
    """Return the modules of a room that one of its modules imports itself, wherever it does so."""
    modules = set()
    for node in ast.walk(ast.parse(_module(room, name).read_text(encoding="utf-8"))):
        if not isinstance(node, ast.ImportFrom) or node.module is None:
            continue
        if f"{node.module}.".startswith(f"subslide.{room}."):
            base = node.module.split(".")[2:]
            for parts in (base, *([*base, alias.name] for alias in node.names)):
                path = "/".join(parts)
                if parts and _module(room, path).is_file():
                    modules.add(path)
    return modules


def _module(room: str, name: str) -> Path:
    """Return the path of a module, or of the first file of a package, by its path from a room."""
    path = PACKAGE / room / name
    return path / "__init__.py" if path.is_dir() else path.with_suffix(".py")


def _belongs(source: Path, part: str, name: str) -> bool:
    """Return whether a source file, by its path within the package, counts for a part."""
    room = source.parts[0]
    if part == "solver":
        return room in COMPILED or source.as_posix() in COMPILED
    if room in SHOWING or part == "page":
        return room == f"{part}s" and (source.stem.startswith("_") or source.stem == name)
    if part == "record":
        return room not in JUDGING
    if part == "table" and room == "tables":
        return _path(source) in imported("tables", name) | WRITERS
    return True


def _path(source: Path) -> str:
    """Return the path of a module of a room, without '.py', from its room; a package's is that of its folder."""
    parts = source.with_suffix("").parts[1:]
    return "/".join(parts[:-1] if len(parts) > 1 and parts[-1] == "__init__" else parts)
