"""What a study will cost, from the plan that its run would have: told in words, nothing is written."""

import collections
import heapq
from collections.abc import Iterable
from pathlib import Path

from subslide.study import choice, limits, pace, plan, staging
from subslide.study.batches import PROCESS, Sharing
from subslide.study.config import Study


def lines(study: Study, folder: Path, cores: int) -> list[str]:
    """Return what a study holds, and what is left to do of it, in lines.

    Parameters
    ----------
    study
        The study.
    folder
        Its folder of results, which may be missing.
    cores
        How many jobs work at the same time.

    Returns
    -------
    list of str
        Points by what becomes of them and by kernels; batches, seconds and disk; faults of what is there.
    """
    planned = plan.plan(study, folder, cores)
    sharing = Sharing(study.keep, study.batch_seconds, cores, pace.known())
    to_solve = [batch for batch in planned.batches.values() if batch.text]
    new = [point for batch in to_solve for point in batch.points]
    kept = len(study.solved) - len(new)
    companions = len(study.solved) - len(study.runs)
    more = f" and {companions:,} companions for bands" if companions else ""
    told = [f"study '{study.name}': {len(study.runs):,} runs{more}: {len(new):,} to solve, {kept:,} kept"]
    kinds = collections.Counter(map(choice.kernels, new))
    told += [f"  {count:,} with kernels {kind}" for kind, count in kinds.most_common()]
    if to_solve:
        seconds = [sum(map(sharing.cost, batch.points)) for batch in to_solve]
        most = max(staging.needs_of(batch, study.keep).mem_mb for batch in to_solve)
        count = f"{len(to_solve):,} batch{'es' if len(to_solve) > 1 else ''}"
        told.append(
            f"  {count} (keep: {study.keep}), about {_rounded(sum(seconds))} core-seconds, or"
            f" {_rounded(wall(seconds, cores))} s on {cores} cores beside tables and figures; jobs ask for up to"
            f" {most:,} MB"
        )
    disk = limits.estimate(study.solved, study.keep).disk
    told.append(f"  about {_rounded(disk / 1e6)} MB of records and tables in all")
    return [*told, *planned.faults]


def wall(seconds: Iterable[float], cores: int) -> float:
    """Return how long jobs take that start in order, each on the core that is free first.

    Parameters
    ----------
    seconds
        Of the runs of each job; each takes `batches.PROCESS` more.
    cores
        How many jobs work at the same time.

    Returns
    -------
    float
        Seconds until the last has ended.
    """
    busy = [0.0] * cores
    for each in seconds:
        heapq.heappush(busy, heapq.heappop(busy) + each + PROCESS)
    return max(busy)


def _rounded(number: float) -> str:
    """Return a number to two digits, but not less than 0.1."""
    return f"{float(f'{max(number, 0.1):.2g}'):,g}"
