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
from collections.abc import Iterator
from pathlib import Path

from subslide._sources import source_hash

KEPT = 6
PREFIX = "kernels-"
DAY = 86400.0


def set_cache_folder() -> Path | None:
    """Set NUMBA_CACHE_DIR to a folder, made if need be, and return it; None if none can be written."""
    for root in _roots():
        try:
            folder = root.absolute() / (PREFIX + source_hash("solver"))
            if not folder.is_dir():
                folder.mkdir(parents=True, exist_ok=True)
                _prune(root, keep=folder)
            usable = folder.is_dir() and os.access(folder, os.W_OK | os.X_OK)
        except (OSError, ValueError):
            continue
        if usable:
            os.environ["NUMBA_CACHE_DIR"] = str(folder)
            if "numba" in sys.modules:  # it has read the environment, but looks here when a kernel is made
                sys.modules["numba"].config.CACHE_DIR = str(folder)
            return folder
    return None


def _roots() -> Iterator[Path]:
    """Give the folders to try, best first: the one the user set, the user's cache, a private temporary one."""
    given = os.environ.get("NUMBA_CACHE_DIR")
    if given:
        # A child process inherits the folder that its parent has set.
        folder = Path(given)
        yield folder.parent if folder.name.startswith(PREFIX) else folder
    home = os.environ.get("XDG_CACHE_HOME")
    with contextlib.suppress(RuntimeError):
        yield (Path(home) if home else Path.home() / ".cache") / "subslide"
    with contextlib.suppress(OSError):
        private = Path(tempfile.gettempdir()) / f"subslide-cache-{os.getuid()}"
        private.mkdir(mode=0o700, exist_ok=True)
        if private.lstat().st_uid == os.getuid():  # what lies in another's would be run as code
            yield private


def _prune(root: Path, keep: Path) -> None:
    """Remove all but the newest folders of older sources, sparing those made within a day."""
    with contextlib.suppress(OSError):  # another process may remove them as well
        folders = sorted(root.glob(PREFIX + "*"), key=lambda p: p.stat().st_mtime, reverse=True)
        for folder in folders[KEPT:]:
            if folder != keep and time.time() - folder.stat().st_mtime > DAY:
                shutil.rmtree(folder, ignore_errors=True)
