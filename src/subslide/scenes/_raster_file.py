"""A file of a raster, read whole: its bytes, their hash, and the arrays in them, whatever a file may hold.

NetCDF's libraries end a process at some damaged files, never end at others, read zeros beyond the end of a file that
was cut short, and fetch names that look like addresses from the network. So a child process reads the bytes in memory,
in limited time, and sends what it finds.
"""

import faulthandler
import functools
import hashlib
import os
import pickle
import re
import select
import signal
import stat
import sys
import time
import warnings
from contextlib import suppress
from typing import TYPE_CHECKING, NamedTuple, NoReturn

import numpy as np

from subslide.keys import words
from subslide.keys.schema import ConfigError

if TYPE_CHECKING:
    import netCDF4

ALLOWED = "the path of a NetCDF file"
MOST_BYTES = 1 << 30
MOST_PIXELS, MOST_ALONG = 25_000_000, 20_000
"""Pixels of a raster, and along one of its axes, at most."""

SECONDS, BYTES_A_SECOND = 10.0, 10e6
"""How long a reader may take: so long, and more for a large file."""

METRES = ("m", "metre", "meter", "metres", "meters")
LONGEST_NAME = 120
NAMES = ("y", "x", "h2")


class Values(NamedTuple):
    """A variable in m (float64), and how far the type it is stored in may have rounded it, in m."""

    values: np.ndarray
    rounding: float


def shown(path: str) -> str:
    """Return a path as messages name it: its end if it is long, without letters that command a terminal."""
    text = "".join(letter if letter.isprintable() else ascii(letter)[1:-1] for letter in path)
    return text if len(text) <= LONGEST_NAME else f"...{text[-LONGEST_NAME:]}"


def content(path: str) -> str:
    """Return the SHA-256 (hex) of a file's content; ConfigError if it is not a regular file that can be read."""
    about = _about(path)
    return _hash(path, about.st_mtime_ns, about.st_size, about.st_ino)


@functools.lru_cache(maxsize=4)
def read(path: str, sha256: str) -> dict[str, Values]:
    """Return `Values` of x, y and h2 of a file with that content, by name; ConfigError if it has none."""
    data = _bytes(path)
    if hashlib.sha256(data).hexdigest() != sha256:
        raise ConfigError(f"scene_options: file: {shown(path)} has changed while it was read")
    answer = _in_child(data)
    if isinstance(answer, str):
        raise ConfigError(f"scene_options: file: {shown(path)}: {answer}")
    return answer


def _about(path: str) -> os.stat_result:
    """Return what the system knows of a file; ConfigError unless it is a regular one."""
    name = f"file: {shown(path)}"
    if re.match(r"\w[\w+.-]*://", path):
        raise ConfigError(f"{name} is an address; allowed: {ALLOWED} on this machine")
    try:
        about = os.stat(path)
    except FileNotFoundError:
        raise ConfigError(f"{name}: there is no such file; allowed: {ALLOWED}") from None
    except (OSError, ValueError) as error:
        why = getattr(error, "strerror", None) or error
        raise ConfigError(f"{name} cannot be read: {why}; allowed: {ALLOWED}") from None
    if not stat.S_ISREG(about.st_mode):
        raise ConfigError(f"{name} is not a regular file; allowed: {ALLOWED}")
    if about.st_size > MOST_BYTES:
        raise ConfigError(f"{name} has {about.st_size} bytes; allowed: at most {MOST_BYTES}")
    return about


def _bytes(path: str) -> bytes:
    """Return the bytes of a file; ConfigError if it is not a regular file that can be read."""
    _about(path)
    try:
        with open(path, "rb") as file:
            return file.read(MOST_BYTES)
    except OSError as error:
        raise ConfigError(f"file: {shown(path)} cannot be read: {error.strerror}") from None


@functools.lru_cache(maxsize=64)
def _hash(path: str, changed: int, size: int, number: int) -> str:
    """Return the hash of a file, anew once its time, size or number has changed."""
    return hashlib.sha256(_bytes(path)).hexdigest()


def _in_child(data: bytes) -> dict[str, Values] | str:
    """Return the variables in the bytes of a file as a child process reads them, or why they cannot be used."""
    import netCDF4  # noqa: F401 - loaded here, so that not every child loads it

    reader, writer = os.pipe()
    sys.stdout.flush()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of threads: the child calls nothing that waits for one
        child = os.fork()
    if not child:
        _answer(data, writer)
    os.close(writer)
    try:
        sent = _received(reader, SECONDS + len(data) / BYTES_A_SECOND)
    finally:
        os.close(reader)
        with suppress(ProcessLookupError):
            os.kill(child, signal.SIGKILL)
        os.waitpid(child, 0)
    if sent is None:
        return f"cannot be read as NetCDF: the reader did not end; allowed: {ALLOWED}"
    try:
        return pickle.loads(sent)
    except (EOFError, pickle.UnpicklingError):
        return f"cannot be read as NetCDF: the reader crashed; allowed: {ALLOWED}"


def _received(reader: int, seconds: float) -> bytes | None:
    """Return what comes from a pipe until it is closed; None if that takes too long."""
    parts: list[bytes] = []
    give_up = time.monotonic() + seconds
    while select.select([reader], [], [], max(0.0, give_up - time.monotonic()))[0]:
        part = os.read(reader, 1 << 20)
        if not part:
            return b"".join(parts)
        parts.append(part)
    return None


def _answer(data: bytes, writer: int) -> NoReturn:
    """Do the child's work: send the variables in some bytes, or a message, and end."""
    try:
        faulthandler.disable()
        signal.set_wakeup_fd(-1)
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            signal.signal(number, signal.SIG_DFL)
        for stream in (1, 2):  # what the libraries say of damage is for nobody
            os.dup2(os.open(os.devnull, os.O_WRONLY), stream)
        try:
            answer: dict[str, Values] | str = _variables(data)
        except ConfigError as error:
            answer = str(error)
        except Exception:
            answer = f"not a NetCDF file, or not a whole one; allowed: {ALLOWED}"
        with os.fdopen(writer, "wb") as pipe:
            pickle.dump(answer, pipe, protocol=5)
    finally:
        os._exit(0)


def _variables(data: bytes) -> dict[str, Values]:
    """Return y, x and h2 in the bytes of a file; ConfigError if they are not as the scene wants them."""
    import netCDF4

    with netCDF4.Dataset("raster", memory=data) as file:
        for key in NAMES:
            _check(file, key)
        if file["h2"].dimensions != file["y"].dimensions + file["x"].dimensions:
            shape = ", ".join(file["h2"].dimensions)
            raise ConfigError(f"h2({words.show(shape)}) is not allowed; allowed: h2(y, x)")
        return {key: _values(file, key) for key in NAMES}


def _check(file: "netCDF4.Dataset", key: str) -> None:
    """Raise a ConfigError unless a file has a variable of that name, of numbers in m, that is not too large."""
    if key not in file.variables:
        known = words.show(", ".join(file.variables) or "none")
        raise ConfigError(f"there is no variable {key}; allowed: h2(y, x), x and y; it has: {known}")
    variable = file.variables[key]
    unit = getattr(variable, "units", "m")
    if not isinstance(unit, str) or unit.strip() not in METRES:
        shown = words.show(unit.tolist() if isinstance(unit, np.ndarray) else unit)
        raise ConfigError(f"units: {shown} of {key} is not allowed; allowed: m")
    is_numbers = isinstance(variable.datatype, np.dtype) and variable.datatype.kind in "fiu"
    if not is_numbers or variable.ndim != (2 if key == "h2" else 1) or not variable.size:
        raise ConfigError(f"{key} is not an array of numbers; allowed: h2(y, x), x and y")
    if variable.size > MOST_PIXELS or max(variable.shape) > MOST_ALONG:
        shape = " x ".join(map(str, variable.shape))
        raise ConfigError(
            f"{key} has {shape} values; allowed: {MOST_ALONG} along x and y, {MOST_PIXELS} in all"
        )


def _values(file: "netCDF4.Dataset", key: str) -> Values:
    """Return a variable, unpacked, with what its type rounds; ConfigError if a value is missing or not finite."""
    variable = file.variables[key]
    for name in ("scale_factor", "add_offset"):
        packing = np.asarray(getattr(variable, name, 0.0))
        if packing.dtype.kind not in "iuf" or packing.size != 1 or not np.isfinite(packing).all():
            shown_value = words.show(getattr(variable, name))
            raise ConfigError(f"{key} has {name}: {shown_value}; allowed: a finite number")
    values = variable[...]
    rounds_to = getattr(values, "dtype", variable.datatype)
    missing = int(np.ma.count_masked(values))
    values = np.ma.filled(values.astype(float), np.nan)
    if missing or not np.isfinite(values).all():
        count = missing or int(np.count_nonzero(~np.isfinite(values)))
        raise ConfigError(f"{key} has {count} missing or infinite values; allowed: finite numbers")
    stored = variable.datatype if variable.datatype.kind == "f" else rounds_to
    size = float(np.abs(values).max())
    rounding = float(np.finfo(stored).eps) * size if stored.kind == "f" else 0.0
    if variable.datatype.kind in "iu":
        rounding += 0.5 * abs(float(getattr(variable, "scale_factor", 0.0)))
    return Values(values, rounding)
