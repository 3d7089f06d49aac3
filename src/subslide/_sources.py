"""Hashes of the package's own sources: they tell when results and compiled kernels are out of date."""

import functools
import hashlib
from pathlib import Path

PACKAGE = Path(__file__).resolve().parent
COMPILED = ("kernels", "fields.py")
"""Rooms whose code is compiled, or is read by code that is."""

JUDGING = ("results.py", "exact", "laboratory", "tables")
"""Rooms after the records, which make tables of them."""

SHOWING = ("figures", "pages", "commands", "__main__.py", "catalogue.py")
"""Rooms that draw, describe or call what the others make: a change here changes no record and no table."""


@functools.cache
def source_hash(part: str = "record", name: str = "") -> str:
    """Return a hash of the sources that can change one part of what the package makes.

    Parameters
    ----------
    part
        `solver`: compiled code. `record`: records. `table`: the table called `name`. `figure`: the figure called
        `name`. Of the other tables or figures a table or figure takes only what it imports.
    name
        Name of the table or figure.

    Returns
    -------
    str
        12 hex digits.
    """
    digest = hashlib.sha256()
    for path in sorted([*PACKAGE.rglob("*.py"), *PACKAGE.rglob("*.json")]):
        source = path.relative_to(PACKAGE)
        if _belongs(source, part, name):
            body = path.read_bytes()
            digest.update(f"{source.as_posix()} {len(body)}\n".encode() + body)
    return digest.hexdigest()[:12]


def _belongs(source: Path, part: str, name: str) -> bool:
    """Return whether a source file, by its path within the package, counts for a part."""
    room = source.parts[0]
    if part == "solver":
        return room in COMPILED
    if room in SHOWING:
        return part == "figure" and room == "figures" and (source.stem.startswith("_") or source.stem == name)
    if part == "record":
        return room not in JUDGING
    if part == "table" and room == "tables":
        return _path(source) in _modules(name)
    return True


def _path(source: Path) -> str:
    """Return the path of a module of a room, without '.py', from its room; a package's is that of its folder."""
    parts = source.with_suffix("").parts[1:]
    return "/".join(parts[:-1] if len(parts) > 1 and parts[-1] == "__init__" else parts)


@functools.cache
def _modules(name: str) -> frozenset[str]:
    """Return the modules of the room of tables that make the table called `name`."""
    from subslide import catalogue  # not at the start of every process: it is needed to plan a study alone

    return catalogue.imported("tables", name) | {"__init__", "_write"}
