"""Hashes of the package's own sources: they tell when results and compiled kernels are out of date."""

import functools
import hashlib
from pathlib import Path

PACKAGE = Path(__file__).resolve().parent
SOLVER = ("kernels", "naming.py", "keys/names.py")
"""Parts whose code is compiled, or is read by code that is."""

DRAWING = ("figures", "drawing.py", "docs.py", "claims", "laboratory.py", "guard.py", "work_precision")
"""Parts that only draw, judge or describe what is solved: a change here never changes a record or a table."""


@functools.cache
def source_hash(part: str = "results", figure: str = "") -> str:
    """Hash (12 hex digits) of the package's sources.

    part: 'results' (all that can change a record or its tables), 'solver' (the compiled part alone), or 'figure' (all
    but the modules of other figures than `figure`).
    """
    digest = hashlib.sha256()
    for path in sorted([*PACKAGE.rglob("*.py"), *PACKAGE.rglob("*.json")]):
        name = path.relative_to(PACKAGE)
        if _belongs(name, part, figure):
            body = path.read_bytes()
            digest.update(f"{name.as_posix()} {len(body)}\n".encode() + body)
    return digest.hexdigest()[:12]


def _belongs(name: Path, part: str, figure: str) -> bool:
    """True if a source file, by its path within the package, counts for this part."""
    if part == "solver":
        return name.parts[0] in SOLVER or name.as_posix() in SOLVER
    if part == "results":
        return name.parts[0] not in DRAWING
    return name.parts[0] != "figures" or name.stem.startswith("_") or name.stem == figure
