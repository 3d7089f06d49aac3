"""Where verbs write: every path that is to be written is checked before anything is solved, drawn or written."""

import os
from collections.abc import Iterable
from pathlib import Path

from subslide import checksums
from subslide.files import RecordError, refuse_irregular
from subslide.keys import plain, words
from subslide.keys.schema import ConfigError

OTHER_FORMATS = frozenset({
    *(".csv", ".tsv", ".txt", ".json", ".yaml", ".yml", ".parquet", ".zarr", ".xlsx"),
    *(".png", ".svg", ".pdf", ".html", ".md", ".py", ".sha256"),
})  # fmt: skip
"""Ends of names that promise something else than a record."""

NETCDF = (b"CDF", b"\x89HDF")
"""First bytes of NetCDF files."""


def check(path: Path | str, inputs: Iterable[Path | str], name: str = "--output", end: str = ".nc") -> None:
    """Raise a ConfigError unless a file can be written.

    Parameters
    ----------
    path
        Where it is to be; a link is written through.
    inputs
        Files that it must not be, whether they are there or not.
    name
        What messages call the option.
    end
        How the name ends; a record's may end otherwise, but not as the name of another format.

    Raises
    ------
    ConfigError
        If the path is a folder, an input, or no regular file, names another format, is that of a file in place of a
        record, or lies in a folder that is missing or cannot be written to.
    """
    path = os.fspath(path)
    name = f"{name}: {words.show(path)}"
    if plain.control(path):
        raise ConfigError(f"{name} has a control character; allowed: the path of a file")
    try:
        target = Path(os.path.realpath(path))
        folder = target.parent
        if target.is_dir() or path.endswith("/"):
            raise ConfigError(f"{name} is a folder; allowed: the path of a file")
        if target.is_symlink():
            raise ConfigError(f"{name} is a link to itself; allowed: the path of a file")
        if target.exists() and not target.is_file():
            raise ConfigError(f"{name} is not a regular file; allowed: the path of a file")
        if not folder.is_dir():
            raise ConfigError(f"{name}: the folder {words.show(str(folder))} does not exist")
        if any(_same(target, other) for other in inputs):
            raise ConfigError(f"{name} is the input or another output; allowed: the path of another file")
        if end != ".nc" and Path(path).suffix.lower() != end:
            raise ConfigError(f"{name} is not allowed; allowed: a name that ends in {end}")
        if end == ".nc" and OTHER_FORMATS & {target.suffix.lower(), Path(path).suffix.lower()}:
            raise ConfigError(f"{name}: a record is a NetCDF file; allowed: a name that ends in .nc")
        if end == ".nc" and "\\" in os.fspath(target):
            raise ConfigError(
                f"{name}: NetCDF takes '\\' for '/'; allowed: a path, and folders, without backslashes"
            )
        if end == ".nc" and target.exists() and not _may_be_record(target):
            raise ConfigError(
                f"{name} is there and is no record; allowed: a new file, or a record to replace"
            )
        probe = folder / f".{target.name}.{os.getpid()}.probe"
        probe.touch(exist_ok=False)
        probe.unlink()
    except OSError as error:
        raise ConfigError(f"{name} cannot be written: {error.strerror}") from None


def check_sealed(path: str, inputs: Iterable[Path | str], end: str = ".nc") -> None:
    """Raise a ConfigError unless the file that `--output` names, and its checksum, can be written.

    Parameters
    ----------
    path, inputs, end
        As for `check`.

    Raises
    ------
    ConfigError
        If one of them cannot.
    """
    inputs = list(inputs)
    check(path, inputs, end=end)
    check(checksums.beside(path), [*inputs, path], "the checksum of --output", ".sha256")


def check_made(paths: Iterable[Path], results: Path) -> None:
    """Raise a RecordError unless files that are made of a study can be written without harm to the rest of it.

    Parameters
    ----------
    paths
        Files that are to be made.
    results
        Folder of the study.

    Raises
    ------
    RecordError
        If one is no regular file, or a link to another file of the study.
    """
    paths = list(paths)
    for path in paths:
        refuse_irregular(path)
        if path.is_symlink() and any(_same(path, other) for other in of_study(results, paths)):
            raise RecordError(
                f"{path}: this is a link to another file of the study; allowed: a file, or nothing"
            )


def of_study(results: Path, but: Iterable[Path] = ()) -> list[Path]:
    """Return the files of a study, which nothing else may replace.

    Parameters
    ----------
    results
        Folder of the study.
    but
        Paths that are left out: what is written anew. A file of the study that such a path links to is not.

    Returns
    -------
    list of Path
        What lies in the folder and in the folders within it.
    """
    left_out = {_entry(path) for path in but}
    files = (path for pattern in ("*", "*/*") for path in results.glob(pattern))
    return [path for path in files if path.is_file() and _entry(path) not in left_out]


def _entry(path: Path) -> Path:
    """Return the path of a name in its folder: links to the folder are followed, one of that name is not."""
    return Path(os.path.realpath(path.parent)) / path.name


def _same(target: Path, other: Path | str) -> bool:
    """Return whether two paths mean one file, be it there or not."""
    if os.path.exists(target) and os.path.exists(other):
        return os.path.samefile(target, other)
    return os.path.realpath(other) == os.path.realpath(target)


def _may_be_record(path: Path) -> bool:
    """Return whether a file begins as NetCDF files do, or holds nothing that could be lost."""
    with open(path, "rb") as file:
        start = file.read(8)
    return not start or start.startswith(NETCDF)
