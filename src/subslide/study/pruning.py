"""Files of a study that hold nothing which is asked for any more: found, and removed only by a verb of their own."""

from pathlib import Path
from typing import NamedTuple

from subslide import checksums
from subslide.study import numbering, plan
from subslide.study.config import Study


class Pruned(NamedTuple):
    """How many batches were removed, and the bytes of their files."""

    batches: int
    bytes: int


def prune(study: Study, folder: Path) -> Pruned:
    """Remove records, with their checksums, and files of the ledger that hold no point which a study asks for.

    Parameters
    ----------
    study
        The study; nobody may be at work on it.
    folder
        Its folder of results.

    Returns
    -------
    Pruned
        What was removed. A batch of which one point is asked for stays whole.
    """
    planned = plan.plan(study, folder)
    held = planned.batches
    records = [path for path in (folder / "records").glob("*.nc") if plan.NAME.fullmatch(path.stem)]
    names = {path.stem for path in (*records, *plan.ledger_files(folder))}
    freed = 0
    idle = sorted(name for name in names if name not in held)
    if idle:
        numbering.keep(folder, planned.next_run)  # those of runs that are removed are never given again
    for name in idle:
        record = plan.record_path(folder, name)
        for path in (folder / "batches" / f"{name}.json", record, checksums.beside(record)):
            if path.is_file() or path.is_symlink():
                freed += path.lstat().st_size
                path.unlink()
    return Pruned(len(idle), freed)
