"""Compiled kernels on the disk: each file whole, known by all that it depends on, and made by one process at a time.

numba's files of an index and numbered data end a run where one is damaged or the disk is full, and two processes that
save at once can swap theirs. Here each signature of a kernel has a file of its own, with a digest and its key within.
"""

import contextlib
import fcntl
import hashlib
import os
import pickle
import time
from collections.abc import Callable
from typing import Any

import llvmlite
import numba
from numba.core import config
from numba.core.caching import (
    CompileResultCacheImpl,
    FunctionCache,
    IndexDataCacheFile,
    NullCache,
    UserProvidedCacheLocator,
)
from numba.core.dispatcher import Dispatcher
from numba.core.serialize import dumps

from subslide import _sources

LONGEST_WAIT = 600.0
"""Seconds after which a process compiles for itself what another does not finish."""

LOOK = 0.1
"""Seconds between two looks at a lock."""

FLAGS = (
    *("OPT", "LOOP_VECTORIZE", "SLP_VECTORIZE", "BOUNDSCHECK", "DEBUGINFO_DEFAULT"),
    *("LLVM_REFPRUNE_PASS", "USING_SVML"),
)
"""Settings of numba that change the code that it makes."""

faults: list[str] = []
"""Why compiled kernels were not kept, one line each, until someone says it."""

_locks: dict[str, int] = {}
"""Descriptor of each lock that this process holds, by its path."""

_waits: list[str] = []
"""Lock that this process waits for, if any."""


def waiting() -> bool:
    """Return whether this process waits for another that compiles."""
    return bool(_waits)


def changed() -> bool:
    """Return whether a source of compiled code has changed since this process began, which may have read either."""
    return _sources.source_hash("solver") != _sources.source_hash.__wrapped__("solver")


def release() -> None:
    """End all claims of this process to compile, also where it failed."""
    while _locks:
        os.close(_locks.popitem()[1])


def _claim(path: str) -> bool:
    """Hold the claim to compile what goes to a file; return whether another process had it until now."""
    lock = f"{path}.lock"
    if lock in _locks:
        return False
    try:
        handle = os.open(lock, os.O_RDWR | os.O_CREAT, 0o600)
    except OSError:
        return False
    _waits.append(lock)
    waited, give_up = False, time.monotonic() + LONGEST_WAIT
    try:
        while time.monotonic() < give_up:
            try:
                fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
                break
            except BlockingIOError:
                waited = True
                time.sleep(LOOK)
            except OSError:  # a file system without locks: each process compiles for itself
                break
    finally:
        _locks[lock] = handle
        _waits.remove(lock)
    return waited


class KernelFile(IndexDataCacheFile):
    """The files of one kernel, one for each signature."""

    def path(self, key: object) -> str:
        """Return the path of the file of a key."""
        name = hashlib.sha256(repr(key).encode()).hexdigest()[:16]
        return os.path.join(self._cache_path, self._index_name.removesuffix("nbi") + name + ".nbc")

    def load(self, key: object) -> object:
        """Return what was saved with a key; None if there is nothing, or it is damaged or of another key."""
        with contextlib.suppress(OSError), open(self.path(key), "rb") as file:
            digest, data = file.read(32), file.read()
            if hashlib.sha256(data).digest() == digest:
                stored, code = pickle.loads(data)
                if stored == key:
                    return code
        return None

    def save(self, key: object, data: object) -> None:
        """Write data with a key."""
        content = dumps((key, data))
        with self._open_for_write(self.path(key)) as file:
            file.write(hashlib.sha256(content).digest() + content)

    def flush(self) -> None:
        """Do nothing: a file is replaced when its kernel is compiled anew."""


class InFolder(CompileResultCacheImpl):
    """How numba stores a function: in the folder of NUMBA_CACHE_DIR and in no other."""

    _locator_classes = (UserProvidedCacheLocator,)


class KernelCache(FunctionCache):
    """numba's cache of a kernel, whose faults cost time and never end a run."""

    _impl_class = InFolder

    def __init__(self, function: Callable):
        """Find the folder for a function; RuntimeError if none can be written."""
        super().__init__(function)
        stamp, base = self._cache_file._source_stamp, self._impl.filename_base
        self._cache_file = KernelFile(self._cache_path, base, stamp)

    def load_overload(self, sig: object, target_context: Any) -> object:
        """Return the compiled code of a signature; None, with a claim to compile it, if there is none to be had."""
        code = self._usable(sig, target_context)
        if code is None and _claim(self._path(sig, target_context.codegen())):
            code = self._usable(sig, target_context)
        if code is not None:
            self._end_claim(sig, target_context.codegen())
        return code

    def save_overload(self, sig: object, data: Any) -> None:
        """Write compiled code, unless it may be of other sources than the folder's."""
        try:
            if not changed():
                super().save_overload(sig, data)
        except Exception as error:
            faults.append(f"{self._cache_path}: {getattr(error, 'strerror', None) or error}")
        finally:
            self._end_claim(sig, data.codegen)

    def _usable(self, sig: object, target_context: Any) -> object:
        """Return the compiled code of a signature; None if there is none, or it is of no use."""
        try:
            return super().load_overload(sig, target_context)
        except Exception:
            return None

    def _index_key(self, sig: object, codegen: Any) -> tuple:
        """Return all that compiled code depends on, but for the sources, after which the folder is called."""
        flags = tuple(str(getattr(config, flag, None)) for flag in FLAGS)
        return (*super()._index_key(sig, codegen), numba.__version__, llvmlite.__version__, flags)

    def _path(self, sig: object, codegen: Any) -> str:
        """Return the path of the file of a signature."""
        return self._cache_file.path(self._index_key(sig, codegen))

    def _end_claim(self, sig: object, codegen: Any) -> None:
        """End the claim to compile a signature, if there is one."""
        handle = _locks.pop(f"{self._path(sig, codegen)}.lock", None)
        if handle is not None:
            os.close(handle)


def kept(compiler: Callable[[Callable], Any]) -> Callable[[Callable], Any]:
    """Return a decorator that compiles as another does, and keeps the code where a folder can be written."""

    def decorate(function: Callable) -> Any:
        kernel = compiler(function)
        if isinstance(kernel, Dispatcher):  # not where numba is told not to compile
            try:
                kernel._cache = KernelCache(function)
            except (RuntimeError, OSError):
                kernel._cache = NullCache()
                faults.append("no folder for them can be written; set NUMBA_CACHE_DIR to one")
        return kernel

    return decorate
