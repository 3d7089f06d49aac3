"""What a study's folder says of itself: the runs that points.json lists, and whether a file is as it was written."""

import json
from collections import Counter
from pathlib import Path
from typing import Any, NamedTuple

from subslide import checksums
from subslide.files import RecordError
from subslide.keys import words
from subslide.keys.schema import ConfigError
from subslide.points import Point
from subslide.study.rows import Reader

AGAIN = "make the study again"
"""What mends a file of a study."""

BROKEN = (OSError, ValueError, KeyError, TypeError, AttributeError, ArithmeticError, RecursionError)
"""What reading a file of JSON raises that is damaged, or something else."""


RUN, COMPANION = frozenset(("id", "numerics", "batch")), frozenset(("id", "of", "role", "batch"))
"""Keys of the rows of runs and of companions beside those of their points."""


class StudyRun(NamedTuple):
    """One run of a study: its id, the label of its numerics, its point, and the batch whose record holds it."""

    id: str
    numerics: str
    point: Point
    batch: str


class Companion(NamedTuple):
    """A coarser run of a study with bands: its id, that of the run it belongs to, its role, its point and its batch."""

    id: str
    of: str
    role: str
    point: Point
    batch: str


class Listing(NamedTuple):
    """The runs of a study in the order of the tables, companions, whether it has bands, what was asked, designs, keep."""

    runs: tuple[StudyRun, ...]
    companions: tuple[Companion, ...]
    has_bands: bool
    asked: dict[str, Any]
    designs: tuple[dict[str, Any], ...] = ()
    keep: str = "all"


def listed(folder: Path) -> Listing:
    """Return the runs of a study, and whether they have bands.

    Parameters
    ----------
    folder
        Folder of the study.

    Returns
    -------
    Listing
        What points.json states. Without its checksum, as in folders of the version before, each row is checked.

    Raises
    ------
    ConfigError
        If there is no such file.
    RecordError
        If it is damaged, or was edited.
    """
    path = folder / "points.json"
    if not path.is_file():
        raise ConfigError(f"{path}: there is no such file; allowed: the folder of a study that was run")
    fault = _fault(path)
    try:
        index = json.loads(path.read_text(encoding="utf-8"))
        reader = Reader(index, check=bool(fault))
        runs = tuple(
            StudyRun(row["id"], row["numerics"], reader.point(row, RUN), row["batch"]) for row in index["points"]
        )
        others = tuple(
            Companion(row["id"], row["of"], row["role"], reader.point(row, COMPANION), row["batch"])
            for row in index.get("companions", ())
        )
        asked = dict(index.get("asked", {}))
        if not runs:
            raise ValueError("there are no points")
        designs, keep = tuple(index.get("designs", ())), str(index.get("keep", "all"))
        _check_designs(designs, {run.id for run in runs})
        _once([run.id for run in runs])
        _once([f"{one.role} of {one.of}" for one in others])
    except BROKEN as error:
        what = words.cut(" ".join(str(error).split()) or type(error).__name__)
        raise RecordError(f"{path} is damaged or not of this version ({what}); {AGAIN}") from None
    if fault and checksums.beside(path).exists():
        raise RecordError(f"{fault}; {AGAIN}")
    return Listing(runs, others, "companions" in index, asked, designs, keep)


def verify(path: Path) -> None:
    """Check that a file of a study is as it was written, before it is opened as what it is.

    Parameters
    ----------
    path
        The file.

    Raises
    ------
    RecordError
        If it is not: one line.
    """
    if fault := _fault(path):
        raise RecordError(f"{fault}; {AGAIN}")


def _fault(path: Path) -> str:
    """Return why a file is not as it was written, '' if it is."""
    try:
        checksums.verify(path)
    except RecordError as error:
        return str(error)
    return ""


def _once(names: list[str]) -> None:
    """Raise a ValueError if a name is there twice."""
    if len(set(names)) < len(names):
        raise ValueError(f"{Counter(names).most_common(1)[0][0]} is there twice")


def _check_designs(designs: tuple[dict[str, Any], ...], ids: set[str]) -> None:
    """Raise a ValueError if a design names a run that is none, or is no array of runs in blocks."""
    for design in designs:
        spec, inputs = design["spec"], len(design["names"])
        blocks = [block for scrambling in design["ids"] for block in scrambling]
        if len(blocks) != spec["scramblings"] * (2 + 2 * inputs):
            raise ValueError(f"a design has {len(blocks)} blocks")
        if any(len(block) != spec["points"] or not ids.issuperset(block) for block in blocks):
            raise ValueError("a block of a design names other runs")
