"""Clawpack for `make bench-peers`: fetched and built once in build/peers, which git ignores."""

import hashlib
import json
import os
import shutil
import subprocess
import sys
import tempfile
import venv
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1] / "build" / "peers"
PYTHON = ROOT / "venv" / "bin" / "python"
SOURCES = ROOT / "clawpack"
GEOCLAW = ROOT / "geoclaw" / "xgeoclaw"
READY = ROOT / "ready"
LOG = ROOT / "install.log"
FLAGS = ("-O3", "-march=native", "-DLAPACK_AVAIL")
"""As subslide's kernels, GeoClaw is compiled for this processor; the last flag lets it use LAPACK."""

LIBRARIES = ("-llapack", "-lblas")
PACKAGES = ("gfortran", "liblapack-dev", "libblas-dev")


class MissingError(Exception):
    """Something that the peers need is not here and cannot be fetched."""


def install():
    """Return nothing; the peers are built. Raises MissingError with what to do where they cannot be."""
    if READY.exists() and READY.read_text(encoding="utf-8") == recipe():
        return
    shutil.rmtree(ROOT, ignore_errors=True)
    ROOT.mkdir(parents=True)
    print(f"peers: building Clawpack in {ROOT} (a few minutes, once; log: {LOG})", flush=True)
    need_compiler()
    make_environment()
    build_geoclaw()
    READY.write_text(recipe(), encoding="utf-8")


def recipe():
    """Return a hash of what says what is built, and with which interpreter."""
    files = [HERE / "clawpack.txt", HERE / "requirements.txt", *sorted((HERE / "geoclaw").glob("[Mq]*"))]
    words = [sys.version, *FLAGS, *LIBRARIES]
    return hashlib.sha256(
        b"\0".join([path.read_bytes() for path in files] + [w.encode() for w in words])
    ).hexdigest()


def need_compiler():
    """Nothing; there is make, gfortran, LAPACK and BLAS, installed from the system's packages if they were missing."""
    if shutil.which("make") and links():
        return
    by_hand = (
        f"install make, {', '.join(PACKAGES)}, for instance: sudo apt-get install make {' '.join(PACKAGES)}"
    )
    if not (shutil.which("apt-get") and os.geteuid() == 0):
        raise MissingError(f"GeoClaw needs a Fortran compiler and LAPACK: {by_hand}")
    try:
        logged(["apt-get", "update"])
        logged(["apt-get", "install", "-y", "--no-install-recommends", "make", "gcc", *PACKAGES])
    except MissingError as error:
        raise MissingError(f"GeoClaw needs a Fortran compiler and LAPACK: {by_hand} ({error})") from None
    if not links():
        raise MissingError(f"gfortran does not link LAPACK: {by_hand}")


def links():
    """Return whether gfortran is here and links a program that calls LAPACK."""
    if not shutil.which("gfortran"):
        return False
    with tempfile.TemporaryDirectory() as folder:
        source = Path(folder) / "main.f90"
        source.write_text("external dgeev, dgemm\ncall dgeev()\ncall dgemm()\nend\n", encoding="utf-8")
        command = ["gfortran", str(source), "-o", str(source.with_suffix("")), *LIBRARIES]
        return subprocess.run(command, capture_output=True, check=False).returncode == 0


def make_environment():
    """Nothing; the virtual environment holds PyClaw, and SOURCES the unpacked source package it was built from."""
    venv.create(ROOT / "venv", with_pip=True, clear=True)
    pip = [str(PYTHON), "-m", "pip", "install", "--disable-pip-version-check", "--no-input"]
    scratch = ROOT / "scratch"
    scratch.mkdir()
    path = f"{PYTHON.parent}{os.pathsep}{os.environ['PATH']}"
    logged([*pip, "-r", str(HERE / "requirements.txt")])
    source_only = [
        "--no-deps",
        "--no-binary",
        "clawpack",
        "--no-build-isolation",
        "--no-cache-dir",
        "--no-clean",
    ]
    logged(
        [*pip, *source_only, "--require-hashes", "-r", str(HERE / "clawpack.txt")],
        env=os.environ | {"PATH": path, "TMPDIR": str(scratch)},
    )
    unpacked = [folder.parent for folder in scratch.glob("*/clawpack_*/geoclaw")]
    if len(unpacked) != 1:
        raise MissingError(f"pip left no Clawpack sources in {scratch}")
    unpacked[0].rename(SOURCES)
    shutil.rmtree(scratch)


def build_geoclaw():
    """Nothing; GEOCLAW is GeoClaw's two-layer program with our initial state."""
    folder = GEOCLAW.parent
    folder.mkdir()
    for name in ("Makefile", "qinit.f90"):
        shutil.copy(HERE / "geoclaw" / name, folder)
    settings = {"CLAW": str(SOURCES), "CLAW_PYTHON": str(PYTHON), "FC": "gfortran"}
    logged(
        ["make", ".exe", f"FFLAGS={' '.join(FLAGS)}", f"LFLAGS={' '.join(LIBRARIES)}"],
        cwd=folder,
        env=os.environ | settings,
    )


def logged(command, **options):
    """Nothing; the command ran well, its output is in LOG. Raises MissingError with its last line otherwise."""
    with open(LOG, "ab+") as log:
        log.write(f"$ {' '.join(command)}\n".encode())
        log.flush()
        done = subprocess.run(command, stdout=log, stderr=subprocess.STDOUT, check=False, **options)
    if done.returncode:
        last = [line for line in LOG.read_text(errors="replace").splitlines() if line.strip()][-1]
        raise MissingError(f"{Path(command[0]).name} failed (see {LOG}): {last.strip()}")


def versions():
    """Return what was built, with what: {name: version}."""
    code = "import json, platform, numpy; from importlib.metadata import version\n"
    code += "print(json.dumps({'clawpack': version('clawpack'), 'numpy of the peers': numpy.__version__}))"
    found = json.loads(
        subprocess.run([PYTHON, "-c", code], capture_output=True, text=True, check=True).stdout
    )
    compiler = subprocess.run(["gfortran", "--version"], capture_output=True, text=True, check=True).stdout
    return found | {
        "gfortran": compiler.splitlines()[0],
        "gfortran flags": " ".join(FLAGS),
        "LAPACK": linked_libraries(),
    }


def linked_libraries():
    """Return the files of LAPACK and BLAS that GeoClaw loads: they tell the reference library from a tuned one."""
    if not shutil.which("ldd"):
        return "unknown"
    lines = subprocess.run(["ldd", GEOCLAW], capture_output=True, text=True, check=False).stdout.splitlines()
    paths = [line.split()[2] for line in lines if "lapack" in line or "blas" in line]
    return ", ".join(str(Path(path).resolve()) for path in paths)


if __name__ == "__main__":
    try:
        install()
    except MissingError as error:
        print(f"bench-peers: {error}", file=sys.stderr)
        sys.exit(1)
