"""Files that are either whole or not there."""

import contextlib
import json
import os
import uuid
from pathlib import Path


class RecordError(Exception):
    """A file that is not a whole record: missing, cut short, damaged, or something else."""


@contextlib.contextmanager
def replacing(path: Path | str):
    """Give a temporary path beside `path`, and move it there once the block has ended well.

    The data are on the disk before the name changes; after an error neither file is left behind.
    """
    path = Path(path)
    temporary = path.with_name(f".{path.name}.{uuid.uuid4().hex[:8]}.tmp")
    try:
        yield temporary
        _sync(temporary)
        os.replace(temporary, path)
        _sync(path.parent)
    finally:
        temporary.unlink(missing_ok=True)


def write_text(path: Path | str, text: str) -> None:
    """Write a text, or leave the file as it was."""
    with replacing(path) as temporary:
        temporary.write_text(text, encoding="utf-8")


def write_json(path: Path | str, value) -> None:
    """Write a value as JSON; a file that holds it already is not touched."""
    text = json.dumps(value, indent=1, allow_nan=False) + "\n"
    with contextlib.suppress(OSError, UnicodeDecodeError):
        if Path(path).read_text(encoding="utf-8") == text:
            return
    write_text(path, text)


def _sync(path: Path) -> None:
    """Wait until a file or folder is on the disk."""
    handle = os.open(path, os.O_RDONLY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)
