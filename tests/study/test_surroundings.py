"""What surrounds a command - its cache, disk, streams, signals - costs time or one line, and never a result."""

import errno
import fcntl
import os
import resource
import signal
import subprocess
import sys
import textwrap
import threading
import time

import numba
import numpy as np
import pytest

from subslide import _cache, files
from subslide.__main__ import main
from subslide.kernels import cache
from subslide.points import Point
from subslide.records.netcdf import read
from subslide.solver import loop, solve

pytestmark = pytest.mark.usefixtures("signals_of_a_terminal")

SHARED = dict(os.environ)
"""Environment with the cache of kernels that all tests share."""

LONG = ("run", "--cells", "8000", "--model", "radial", "--t-end", "100", "-o", "x.nc")


@pytest.fixture(autouse=True, scope="module")
def compiled():
    """Kernels of a radius in the cache that all tests share, so that no command has to say that it compiles."""
    solve(Point(model="radial", cells=20, t_end=0.01))


@pytest.fixture(autouse=True)
def apart(tmp_path, monkeypatch):
    """An empty folder for each test, within one with kernels of its own."""
    (tmp_path / "here").mkdir()
    monkeypatch.chdir(tmp_path / "here")
    keep_in(monkeypatch, str(tmp_path / "cache"))
    monkeypatch.setattr(cache, "faults", [])
    yield
    cache.release()


def keep_in(monkeypatch, folder):
    """Make numba keep kernels in a folder; it reads the environment anew when that has changed."""
    monkeypatch.setenv("NUMBA_CACHE_DIR", folder)
    monkeypatch.setattr(numba.config, "CACHE_DIR", folder)


def made_anew():
    """A small kernel as a new process has it."""

    def half(x):
        return 0.5 * x

    return cache.kept(numba.njit)(half)


def kept(folder):
    """The files of compiled code."""
    return sorted(folder.rglob("*.nbc"))


def test_a_kernel_is_compiled_once_for_each_signature(tmp_path):
    first = made_anew()
    assert (first(3.0), first(4)) == (1.5, 2.0)
    assert len(kept(tmp_path)) == 2
    second = made_anew()
    assert second(3.0) == 1.5
    assert sum(second.stats.cache_hits.values()) == 1
    assert not cache.faults


@pytest.mark.parametrize(
    "damage", [b"", b"\x80", b"short" * 100, None], ids=["empty", "cut", "foreign", "flipped"]
)
def test_a_damaged_file_is_compiled_anew_and_replaced(tmp_path, damage):
    made_anew()(3.0)
    (path,) = kept(tmp_path)
    whole = path.read_bytes()
    flipped = whole[:200] + bytes([whole[200] ^ 4]) + whole[201:]
    path.write_bytes(flipped if damage is None else damage)
    assert made_anew()(3.0) == 1.5
    again = made_anew()
    assert again(3.0) == 1.5
    assert sum(again.stats.cache_hits.values()) == 1


def test_code_of_another_key_is_not_used(tmp_path):
    made_anew()(3.0)
    (of_float,) = kept(tmp_path)
    body = of_float.read_bytes()
    of_float.unlink()
    made_anew()(4)
    (of_int,) = kept(tmp_path)
    of_int.write_bytes(body)
    other = made_anew()
    assert other(4) == 2.0
    assert not other.stats.cache_hits


@pytest.mark.parametrize("fault", [errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EROFS])
def test_a_full_disk_costs_the_cache_and_not_the_run(tmp_path, monkeypatch, fault):
    def full(*_):
        raise OSError(fault, os.strerror(fault))

    monkeypatch.setattr(cache.KernelFile, "_open_for_write", full)
    assert made_anew()(3.0) == 1.5
    assert cache.faults[0].endswith(os.strerror(fault))
    assert not kept(tmp_path)


def test_a_folder_that_cannot_be_made_or_vanishes(tmp_path, monkeypatch):
    kernel = made_anew()
    for path in (tmp_path / "cache").iterdir():
        path.rmdir()
    assert kernel(3.0) == 1.5
    keep_in(monkeypatch, "/dev/null/none")
    assert made_anew()(3.0) == 1.5
    assert "NUMBA_CACHE_DIR" in cache.faults[0]


def test_no_folder_for_kernels_is_no_fault(monkeypatch):
    for name in ("NUMBA_CACHE_DIR", "XDG_CACHE_HOME", "HOME", "TMPDIR"):
        monkeypatch.setenv(name, "/dev/null/none")
    monkeypatch.setattr(_cache.tempfile, "tempdir", "/dev/null/none")
    assert _cache.set_cache_folder() is None


def test_a_second_process_waits_and_loads(tmp_path):
    made_anew()(3.0)
    (path,) = kept(tmp_path)
    aside = path.rename(tmp_path / "aside")
    second, answers = made_anew(), []
    with open(f"{path}.lock", "w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        thread = threading.Thread(target=lambda: answers.append(second(3.0)))
        thread.start()
        until(cache.waiting)
        aside.rename(path)
    thread.join(10)
    assert answers == [1.5]
    assert sum(second.stats.cache_hits.values()) == 1
    assert not cache.waiting()


def test_code_of_sources_that_have_changed_is_not_kept(tmp_path, monkeypatch):
    monkeypatch.setattr(cache, "changed", lambda: True)
    assert made_anew()(3.0) == 1.5
    assert not kept(tmp_path)


QUICK = f"{sys.executable} -m subslide run --model radial --cells 60 --t-end 0.01 -o x.nc"


@pytest.mark.parametrize(
    ("command", "status", "said"),
    [
        (f"{QUICK} >&-", 0, ""),
        (f"{QUICK} <&- >&- 2>&-", 0, ""),
        (f"{QUICK} >/dev/full", 1, "subslide: standard output: No space left on device\n"),
        (f"{QUICK} --cfl 1.5 >/dev/null 2>/dev/full", 0, ""),
        (f"set -o pipefail; {QUICK} | true", 0, ""),
    ],
)
def test_closed_and_full_streams_leave_the_record_whole(command, status, said):
    done = subprocess.run(["bash", "-c", command], capture_output=True, text=True, env=SHARED)
    assert (done.returncode, done.stdout, done.stderr) == (status, "", said)
    assert "x_front" in read("x.nc")[0]


def test_a_full_disk_gets_one_line_and_leaves_the_file_from_before(capsys):
    command = QUICK.split()[3:]
    assert main(command) == 0
    before = os.stat("x.nc")
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    for most in (0, 100, 5000):
        capsys.readouterr()
        resource.setrlimit(resource.RLIMIT_FSIZE, (most, hard))
        try:
            assert main(command) == 1
        finally:
            resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))
        assert capsys.readouterr() == ("", "subslide: x.nc: cannot be written: File too large\n")
        assert os.listdir() == ["x.nc"]
        assert os.stat("x.nc") == before


def test_an_error_in_a_file_that_the_disk_did_not_make_is_its_own():
    with pytest.raises(ValueError, match="mine"), files.replacing("x"):
        raise ValueError("mine")
    with pytest.raises(FileNotFoundError, match="absent"), files.replacing("x"):
        os.stat("absent")
    assert os.listdir() == []


def test_a_layer_of_threads_that_is_none_gets_one_line():
    environment = {**SHARED, "NUMBA_THREADING_LAYER": "nope"}
    done = subprocess.run(QUICK.split(), capture_output=True, text=True, env=environment)
    assert done.returncode == 2
    assert done.stderr.startswith("subslide: NUMBA_THREADING_LAYER: nope cannot be used")
    assert done.stderr.count("\n") == 1


def until(true, seconds=10.0):
    """Wait until something holds."""
    give_up = time.monotonic() + seconds
    while not true():
        assert time.monotonic() < give_up
        time.sleep(0.01)


def started(script):
    """A process of a script with the signals of a command; it has printed its first line."""
    head = "import os, signal, hashlib\nfrom subslide.commands import interrupts\ninterrupts.listen()\n"
    process = subprocess.Popen(
        [sys.executable, "-c", head + textwrap.dedent(script)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    process.stdout.readline()
    return process


@pytest.mark.parametrize(("number", "status"), [("SIGINT", 130), ("SIGTERM", 143), ("SIGHUP", 129)])
def test_a_signal_ends_a_run_soon_with_one_line(number, status):
    command = [sys.executable, "-m", "subslide", *LONG]
    process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True, env=SHARED)
    time.sleep(1.5)
    process.send_signal(getattr(signal, number))
    sent = time.monotonic()
    _, said = process.communicate(timeout=20)
    assert time.monotonic() - sent < 3
    assert process.returncode == status
    assert said == "subslide: interrupted; nothing was written\n"
    assert os.listdir() == []


def test_a_signal_ends_native_code_and_removes_what_is_half_written():
    process = started("""
        from subslide import files
        with files.replacing("x.nc") as path:
            path.write_text("half")
            print("here", flush=True)
            hashlib.pbkdf2_hmac("sha256", b"", b"", 10**9)
    """)
    time.sleep(0.5)  # it has printed, and must reach the native code
    assert len(os.listdir()) == 1
    process.send_signal(signal.SIGTERM)
    _, said = process.communicate(timeout=5)
    assert process.returncode == 143
    assert said == "subslide: interrupted; nothing was written\n"
    assert os.listdir() == []


def test_a_signal_is_an_exception_that_a_callback_does_not_lose():
    process = started("""
        import time
        from subslide.files import Stopped
        class Late:
            def __del__(self):
                os.kill(os.getpid(), signal.SIGTERM)
                time.sleep(0.1)
        print("here", flush=True)
        try:
            Late()
            time.sleep(9)
        except Stopped as stopped:
            print("saved after", stopped.signal, flush=True)
    """)
    out, said = process.communicate(timeout=5)
    assert (out, said) == ("saved after 15\n", "")


def test_a_signal_that_is_ignored_stays_so():
    process = subprocess.run(
        ["nohup", sys.executable, "-c", "from subslide.commands import interrupts as i; i.listen();"
         "import os, signal; os.kill(os.getpid(), signal.SIGHUP); print('on')"],
        capture_output=True, text=True,
    )  # fmt: skip
    assert process.stdout == "on\n"


def test_short_launches_change_no_bit_and_tell_the_time_reached(monkeypatch):
    point, times = Point(model="radial", cells=40, t_end=0.1), []
    whole = solve(point)
    monkeypatch.setattr(loop, "CHUNK", 8)
    parts = solve(point, progress=times.append)
    assert len(times) > 1
    assert times == sorted(times)
    assert times[-1] == pytest.approx(point.t_end)
    assert parts.steps == whole.steps
    for name in ("time", "h2", "eta", "L_f"):
        np.testing.assert_array_equal(getattr(parts, name), getattr(whole, name))
    for name, series in whole.series.items():
        np.testing.assert_array_equal(parts.series[name], series)


def loading(name, doing):
    """What a program called `name` says and returns that gets a signal while the package loads."""
    code = (
        f"import os, signal, sys; sys.argv = ['{name}']; {doing}\n"
        "import subslide._early, importlib.abc\n"
        "for name in [name for name in sys.modules if name.startswith('subslide')]: del sys.modules[name]\n"
        "class Late(importlib.abc.MetaPathFinder):\n"
        "    def find_spec(self, name, path, target=None):\n"
        "        if name.startswith('subslide._cache'): os.kill(os.getpid(), number)\n"
        "sys.meta_path.insert(0, Late())\n"
        "import subslide\n"
        "print('on')"
    )
    return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)


@pytest.mark.parametrize(("name", "status"), [("SIGINT", 130), ("SIGTERM", 143), ("SIGHUP", 129)])
def test_a_signal_while_a_command_loads_ends_it_with_one_line(name, status):
    done = loading("/bin/subslide", f"number = signal.{name}")
    assert done.returncode == status
    assert (done.stdout, done.stderr) == ("", "subslide: interrupted; nothing was written\n")


def test_a_program_that_imports_the_package_keeps_its_signals():
    done = loading("notebook.py", "number = signal.SIGINT")
    assert "KeyboardInterrupt" in done.stderr


def test_a_signal_that_is_ignored_stays_so_while_a_command_loads():
    done = loading("subslide", "number = signal.SIGHUP; signal.signal(number, signal.SIG_IGN)")
    assert (done.stdout, done.stderr) == ("on\n", "")
