"""How fast this machine is: seconds that runs have taken over those estimated, kept in the user's cache by kind of run.

Batches are shared out by it. Answers do not depend on it, so a file that is missing or damaged counts as none.
"""

import contextlib
import json
from pathlib import Path

from subslide import _cache
from subslide.files import write_text
from subslide.points import Point
from subslide.study import choice

LEAST_SECONDS = 0.5
"""Estimated seconds below which a job tells nothing: clocks and caches tell more than the machine."""

BOUNDS = (0.1, 10.0)
"""Ratios that are believed."""

NEWEST = 0.4
"""Weight of the newest ratio beside what was known."""


def kind(point: Point, keep: str) -> str:
    """Return the kind of run that a point is: what has one pace.

    Parameters
    ----------
    point
        The run.
    keep
        What a record keeps of it.

    Returns
    -------
    str
        Name of the kind.
    """
    return f"{choice.kernels(point)} {keep}"


def known() -> dict[str, float]:
    """Return the ratios that were learnt, by kind of run; none where there is no file that can be read."""
    with contextlib.suppress(OSError, ValueError, TypeError, AttributeError, RecursionError):
        ratios = json.loads(_path().read_text(encoding="utf-8"))
        return {
            name: float(ratio)
            for name, ratio in ratios.items()
            if isinstance(ratio, int | float) and BOUNDS[0] <= ratio <= BOUNDS[1]
        }
    return {}


def learn(name: str, measured: float, estimated: float) -> None:
    """Write what a job has measured; where nothing can be written, nothing is kept.

    Parameters
    ----------
    name
        Kind of its runs.
    measured, estimated
        Seconds of a core for them.
    """
    if estimated < LEAST_SECONDS:
        return
    ratio = min(max(measured / estimated, BOUNDS[0]), BOUNDS[1])
    ratios = known()
    ratios[name] = round(NEWEST * ratio + (1 - NEWEST) * ratios.get(name, ratio), 4)
    with contextlib.suppress(OSError):
        write_text(_path(), json.dumps(ratios, indent=1, sort_keys=True) + "\n")


def _path() -> Path:
    """Return the path of the file, beside the folders of compiled kernels."""
    folder = _cache.set_cache_folder()
    if folder is None:
        raise OSError("there is no folder for a cache")
    return folder.parent / "pace.json"
