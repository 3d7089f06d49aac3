"""Checksums beside files that a study makes: `NAME.sha256`, as `sha256sum -c` reads it, with notes as comments.

The line names the file, so that files which were swapped with their checksums are noticed; the notes say what the file
was made from.
"""

import hashlib
from pathlib import Path

from subslide.files import RecordError, file_hash, write_text

LONGEST = 10_000
"""Bytes of the largest checksum file that is read."""


def beside(path: Path | str) -> Path:
    """Return the path of the checksum of a file."""
    return Path(f"{path}.sha256")


def text_hash(text: str) -> str:
    """Return 16 hex digits of the SHA-256 of a text, as UTF-8."""
    return hashlib.sha256(text.encode()).hexdigest()[:16]


def seal(path: Path | str, **notes: str) -> None:
    """Write the checksum of a file beside it.

    Parameters
    ----------
    path
        The file.
    notes
        What it was made from, by name: words without spaces.
    """
    lines = [f"{file_hash(path)}  {Path(path).name}", *(f"# {name} {value}" for name, value in notes.items())]
    write_text(beside(path), "\n".join(lines) + "\n")


def verify(path: Path | str) -> dict[str, str]:
    """Return the notes of a file that is as it was written.

    Parameters
    ----------
    path
        The file; it is read, but not opened as what it is.

    Returns
    -------
    dict
        Notes by name.

    Raises
    ------
    RecordError
        If the file or its checksum is missing, or they do not belong to each other: one line.
    """
    path, stated = Path(path), beside(path)
    if not path.is_file():
        raise RecordError(f"{path}: there is no such file")
    if stated.exists() and not stated.is_file():
        raise RecordError(f"{stated}: the checksum is no regular file")
    try:
        text = stated.read_bytes()[:LONGEST].decode()
        (digest, name), *notes = (line.split(maxsplit=1) for line in text.splitlines())
        told = dict(words.split(maxsplit=1) for mark, words in notes if mark == "#")
    except FileNotFoundError:
        raise RecordError(f"{path}: its checksum {stated.name} is missing") from None
    except (OSError, ValueError):
        raise RecordError(f"{stated}: the checksum is damaged") from None
    if name != path.name or digest != file_hash(path):
        raise RecordError(f"{path} does not match its checksum {stated.name}")
    return told
