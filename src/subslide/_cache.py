"""numba's cache of compiled kernels: one folder for each state of the solver's sources.

numba looks at the file of the function it compiles and not at what that file imports, so an edited
module can leave stale machine code behind. A folder named by a hash of all sources cannot.
"""

import contextlib
import os
import shutil
import sys
import tempfile
import time
from pathlib import Path

from subslide._sources import source_hash

KEPT = 6
PREFIX = "kernels-"
DAY = 86400.0


def set_cache_folder() -> Path | None:
    """Set NUMBA_CACHE_DIR to a folder, made if need be, and return it; None if none can be written."""
    for root in _roots():
        folder = root / (PREFIX + source_hash("solver"))
        try:
            if not folder.is_dir():
                folder.mkdir(parents=True, exist_ok=True)
                _prune(root, keep=folder)
        except OSError:
            continue
        if os.access(folder, os.W_OK):
            os.environ["NUMBA_CACHE_DIR"] = str(folder)
            if "numba" in sys.modules:  # it has read the environment, but looks here when a kernel is made
                sys.modules["numba"].config.CACHE_DIR = str(folder)
            return folder
    return None


def _roots() -> list[Path]:
    """Return the folders to try, best first: the one the user set, the user's cache, a private temporary one."""
    given = os.environ.get("NUMBA_CACHE_DIR")
    roots = []
    if given:
        # A child process inherits the folder that its parent has set.
        folder = Path(given)
        roots.append(folder.parent if folder.name.startswith(PREFIX) else folder)
    home = os.environ.get("XDG_CACHE_HOME")
    with contextlib.suppress(RuntimeError):
        roots.append((Path(home) if home else Path.home() / ".cache") / "subslide")
    roots.append(Path(tempfile.gettempdir()) / f"subslide-cache-{os.getuid()}")
    return roots


def _prune(root: Path, keep: Path) -> None:
    """Remove all but the newest folders of older sources, sparing those made within a day."""
    folders = sorted(root.glob(PREFIX + "*"), key=lambda p: p.stat().st_mtime, reverse=True)
    for folder in folders[KEPT:]:
        if folder != keep and time.time() - folder.stat().st_mtime > DAY:
            shutil.rmtree(folder, ignore_errors=True)
