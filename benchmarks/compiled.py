"""C files compiled on the spot and called through ctypes."""

import ctypes
import functools
import os
import shutil
import subprocess
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
FLAGS = ("-O3", "-march=native", "-ffast-math", "-fopenmp-simd")
CTYPES = {"float64": ctypes.c_double, "float32": ctypes.c_float}
NAMES = {"float64": "double", "float32": "float"}


class NoCompilerError(Exception):
    """There is no C compiler, or it cannot compile for this machine."""


def compiler():
    """Return the C compiler's path: $CC, or `cc`; NoCompilerError where there is none."""
    name = os.environ.get("CC", "cc")
    found = shutil.which(name)
    if found is None:
        raise NoCompilerError(
            f"no C compiler: '{name}' is not on the PATH; the C reference needs one (for example gcc; name it in CC)"
        )
    return found


@functools.cache
def library(source, dtype):
    """Return the ctypes library of benchmarks/`source`, compiled with FLAGS for numbers of `dtype`.

    Linked without -ffast-math: gcc would add start-up code that flushes denormal numbers to zero in the whole
    process, so in the runs that are measured too.
    """
    cc = compiler()
    with tempfile.TemporaryDirectory(prefix="subslide-bench-") as folder:
        object_file, shared = Path(folder) / "part.o", Path(folder) / "part.so"
        define = f"-DREAL={NAMES[dtype]}"
        for command in (
            [cc, *FLAGS, "-fPIC", define, "-c", str(HERE / source), "-o", str(object_file)],
            [cc, "-shared", str(object_file), "-o", str(shared), "-lm"],
        ):
            done = subprocess.run(command, capture_output=True, text=True)
            if done.returncode:
                raise NoCompilerError(f"{' '.join(command)} failed: {done.stderr.strip()}")
        return ctypes.CDLL(str(shared))


def pointer(array, dtype):
    """Return the address of a contiguous array as a ctypes pointer to numbers of `dtype`."""
    return array.ctypes.data_as(ctypes.POINTER(CTYPES[dtype]))
