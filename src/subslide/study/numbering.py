"""Numbers of runs: each is given once within a study, whatever becomes of the batch that it was given to.

A batch states the number of its first run, and the ledger of batches so holds all that were given to runs which were
solved. The file `next_run` beside them holds the number that comes next, for those whose batch was removed, or damaged,
or never solved.
"""

from pathlib import Path

from subslide.files import write_text

FILE = "next_run"
"""Name of the file, in the folder of the ledger."""

KEY = "first_run"
"""Key under which a batch states the number of its first run."""

LAST = 2**31 - 1
"""The largest number, which NetCDF's classic model has."""


def is_first(number: object, count: int) -> bool:
    """Return whether a value can be the number of the first of some runs.

    Parameters
    ----------
    number
        The value; 0 where runs belong to no study.
    count
        How many runs there are.

    Returns
    -------
    bool
        False for what is no whole number.
    """
    return isinstance(number, int) and not isinstance(number, bool) and 0 <= number <= LAST - count


def kept(folder: Path) -> int:
    """Return the number that comes next as far as its file tells: 1 if that is missing, or damaged.

    Parameters
    ----------
    folder
        Folder of the study.

    Returns
    -------
    int
        The number.
    """
    try:
        number = int((folder / "batches" / FILE).read_text(encoding="utf-8")[:20])
    except (OSError, ValueError):
        return 1
    return number if is_first(number, 1) and number > 0 else 1


def keep(folder: Path, number: int) -> None:
    """Write the number that comes next, if it is larger than the one that is kept.

    Parameters
    ----------
    folder
        Folder of the study.
    number
        The number.
    """
    if number > kept(folder):
        path = folder / "batches" / FILE
        path.parent.mkdir(parents=True, exist_ok=True)
        write_text(path, f"{number}\n")
