"""The machine: its description, and what one of its cores can do at most."""

import ctypes
import os
import platform
import subprocess
import time
from pathlib import Path

import numba
import numpy as np
from compiled import CTYPES, FLAGS, compiler, library, pointer

import subslide


def describe():
    """Return what numbers depend on: processor, cores, caches, memory, compiler, versions."""
    version = subprocess.run([compiler(), "--version"], capture_output=True, text=True, check=True).stdout
    return {
        "cpu": processor(),
        "cores": len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count(),
        "caches": caches(),
        "memory_GB": round(os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") / 1e9, 1),
        "system": f"{platform.system()} {platform.release()} {platform.machine()}",
        "load_at_start": round(os.getloadavg()[0], 2),
        "compiler": version.splitlines()[0],
        "compiler_flags": " ".join(FLAGS),
        "python": platform.python_version(),
        "numba": numba.__version__,
        "numpy": np.__version__,
        "subslide": subslide.__version__,
        "sources": subslide.source_hash("solver"),
    }


def processor():
    """Return the processor's name and model numbers."""
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        return platform.processor() or platform.machine()
    facts = dict(reversed([[part.strip() for part in line.split(":", 1)] for line in lines if ":" in line]))
    numbers = [f"{key} {facts[key]}" for key in ("cpu family", "model", "stepping") if key in facts]
    name = facts.get("model name", platform.machine())
    return f"{name} ({', '.join(numbers)})" if numbers else name


def caches():
    """Return {level and type: size} of the first core's caches; empty where the system does not tell."""
    found = {}
    for index in sorted(Path("/sys/devices/system/cpu/cpu0/cache").glob("index*")):
        level, kind, size = ((index / name).read_text().strip() for name in ("level", "type", "size"))
        found[f"L{level} {kind.lower()}"] = size
    return found


def limits(dtype, megabytes=96, rounds=5):
    """Return bytes/s from memory, and operations/s of multiply-adds (two each), divisions and roots, at best."""
    code = library("machine.c", dtype)
    return {"bandwidth": bandwidth(code, dtype, megabytes, rounds)} | {
        name: operations(code, name, dtype, rounds) * (2 if name == "multiply_adds" else 1)
        for name in ("multiply_adds", "divisions", "square_roots")
    }


def bandwidth(code, dtype, megabytes, rounds):
    """Return bytes/s of a = b + s c on arrays of that size: three streams and the read before a write."""
    real = np.dtype(dtype)
    n = megabytes * 1_000_000 // real.itemsize
    a, b, c = (np.full(n, value, real) for value in (0, 1, 2))
    address = ctypes.POINTER(CTYPES[dtype])
    code.triad.argtypes = [ctypes.c_long, CTYPES[dtype], address, address, address]
    code.triad.restype = None
    return best(
        lambda: code.triad(n, 3, *(pointer(array, dtype) for array in (a, b, c))),
        4 * n * real.itemsize,
        rounds,
    )


def operations(code, name, dtype, rounds, turns=400_000):
    """Return operations/s of one kind, a vector's lanes counted each."""
    function = getattr(code, name)
    function.argtypes = [ctypes.c_long, CTYPES[dtype], CTYPES[dtype]]
    function.restype = CTYPES[dtype]
    return best(lambda: function(turns, 0.5, 1.25), turns * code.operations_each(), rounds)


def best(work, count, rounds):
    """Return the best of some rounds of `count` over the seconds of `work()`: what is possible, not what is usual."""
    work()
    seconds = []
    for _ in range(rounds):
        started = time.perf_counter()
        work()
        seconds.append(time.perf_counter() - started)
    return count / min(seconds)
