"""Files that are either whole or not there, also after a signal, and the hashes of their bytes."""

import contextlib
import hashlib
import os
import uuid
from collections.abc import Iterator
from pathlib import Path


class RecordError(Exception):
    """A file that is not a whole record: missing, cut short, damaged, or something else."""


class Stopped(BaseException):
    """A signal that ends the process, raised in its main thread: SIGTERM or SIGHUP; Ctrl-C is a KeyboardInterrupt.

    Attributes
    ----------
    signal
        Number of the signal.
    said
        The line to end with.
    """

    def __init__(self, signal: int, said: str = "interrupted; nothing was written"):
        """Keep the signal, and what to say."""
        super().__init__(said)
        self.signal, self.said = signal, said


unfinished: set[Path] = set()
"""Temporary files that are being written."""


@contextlib.contextmanager
def replacing(path: Path | str) -> Iterator[Path]:
    """Give a temporary path beside `path` to a block, and move it to `path` once the block has ended well.

    The data are on the disk before the name changes; after an error neither file is left behind. A link is written
    through: it stays, and what it points to is replaced. A RecordError tells of a folder, pipe, socket or device of
    that name, which stays. An OSError names the file, and a full disk where the block raised another error because of
    it.
    """
    given, path = os.fspath(path), Path(os.path.realpath(path))
    refuse_irregular(given)
    temporary = path.with_name(f".{path.name}.{uuid.uuid4().hex[:8]}.tmp")
    unfinished.add(temporary)
    try:
        yield temporary
        _sync(temporary)
        os.replace(temporary, path)
        _sync(path.parent)
    except Exception as error:
        cause = _fault_of_disk(temporary)
        if cause is None and isinstance(error, OSError) and error.filename in (None, str(temporary)):
            cause = error
        if cause is None:
            raise
        raise OSError(cause.errno, f"cannot be written: {cause.strerror or cause}", given) from None
    finally:
        temporary.unlink(missing_ok=True)
        unfinished.discard(temporary)


def refuse_irregular(path: Path | str) -> None:
    """Raise a RecordError if there is something of a path's name that is no regular file, or link to one."""
    if os.path.exists(path) and not os.path.isfile(path):
        raise RecordError(f"{path}: this is no regular file, and is left alone; allowed: a file, or nothing")


def write_text(path: Path | str, text: str) -> None:
    """Write a text to a file, whole or not at all.

    Parameters
    ----------
    path
        The file; its folder is there.
    text
        What it is to hold, written as UTF-8.
    """
    with replacing(path) as temporary:
        temporary.write_text(text, encoding="utf-8")


def file_hash(path: Path | str) -> str:
    """Return the SHA-256 (hex) of a file's bytes, as `sha256sum` prints it."""
    with open(path, "rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def _fault_of_disk(temporary: Path) -> OSError | None:
    """Return why no more can be written to a file that is given up, if so: libraries lose the system's word for it."""
    try:
        with open(temporary, "ab") as file:
            file.write(bytes(1 << 20))
        _sync(temporary)
    except OSError as error:
        return error
    return None


def _sync(path: Path) -> None:
    """Wait until a file, or the names in a folder, are on the disk."""
    handle = os.open(path, os.O_RDONLY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)
