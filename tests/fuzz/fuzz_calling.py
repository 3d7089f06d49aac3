"""Call the command line with one input in a folder of its own, and hold what it says and leaves against what is right.

An input says how it ends by how it was made: BAD (named by the user), FAULT (of a file that a study made), GOOD, KEPT
(noticed, or without effect), LACKING (refused, by either) or ANY; the rest is asked of all of them.
"""

import contextlib
import hashlib
import os
import random
import re
import resource
import shutil
import signal
import stat
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

BAD, FAULT, GOOD, ANY, KEPT, LACKING = "bad", "fault", "good", "any", "kept", "lacking"
STATUSES = {BAD: {2}, FAULT: {1}, GOOD: {0}, ANY: {0, 1, 2}, KEPT: {0, 1}, LACKING: {1, 2}}
LONGEST, SECONDS, MORE_BYTES = 300, 20, 4 << 30
ASIDE = ("subslide: caution, ", "subslide: compiling ")
"""Beginnings of lines that may stand before the one line that says what is wrong; nothing that is refused begins so."""

SAID = re.compile(r"subslide: \S.*")


class TooLong(BaseException):
    """A call that did not end; no handler of errors takes it."""


@dataclass
class Input:
    """One input: what it is, words of the command line, how it ends, and what the message names one of.

    `fill(folder)` makes its files; `makes` are names, or beginnings of names, that a good one may write.
    """

    name: str
    words: list[str]
    ends: str
    names: tuple[str, ...] = ()
    fill: Callable[[Path], object] = lambda folder: None
    makes: tuple[str, ...] = ()
    equal: dict[str, bytes] = field(default_factory=dict)
    """Content of files that a call which ends with 0 leaves: nothing wrong is taken for right."""


@dataclass
class Ended:
    """What a call did: its status or what it raised, its lines on stderr, and what changed in the folder."""

    status: int | str
    lines: list[str]
    printed: str
    changed: dict[str, str]


def snapshot(folder: Path) -> dict[str, tuple]:
    """Type and content of everything in a folder."""
    seen = {}
    for path in sorted(folder.rglob("*")):
        mode = path.lstat().st_mode
        text = b""
        if stat.S_ISREG(mode) and os.access(path, os.R_OK):
            text = hashlib.sha256(path.read_bytes()).digest()
        elif stat.S_ISLNK(mode):
            text = os.readlink(path).encode()
        seen[str(path.relative_to(folder))] = (stat.S_IFMT(mode), text)
    return seen


def changes(before: dict, after: dict) -> dict[str, str]:
    """What came, went or changed, by path."""
    words = {name: "changed" for name in before.keys() & after.keys() if before[name] != after[name]}
    return {
        **words,
        **dict.fromkeys(after.keys() - before.keys(), "new"),
        **dict.fromkeys(before.keys() - after.keys(), "gone"),
    }


@contextlib.contextmanager
def within(seconds: int) -> Iterator[None]:
    """Bound the time and the memory of a block."""

    def late(*_: object) -> None:
        raise TooLong(f"not ended after {seconds} s")

    used = int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()
    limits = resource.getrlimit(resource.RLIMIT_AS)
    before = signal.signal(signal.SIGALRM, late)
    resource.setrlimit(resource.RLIMIT_AS, (used + MORE_BYTES, limits[1]))
    signal.alarm(seconds)
    try:
        yield
    finally:
        signal.alarm(0)
        resource.setrlimit(resource.RLIMIT_AS, limits)
        signal.signal(signal.SIGALRM, before)


@contextlib.contextmanager
def inside(folder: Path) -> Iterator[None]:
    """Work in a folder."""
    before = Path.cwd()
    os.chdir(folder)
    try:
        yield
    finally:
        os.chdir(before)


Call = Callable[[list[str], Path], tuple[int | str, str, str]]
"""Function that calls the command line with words in a folder: its status or what went wrong, stdout and stderr."""


def in_process(captured: Callable) -> Call:
    """Return a function that calls `main` here; `captured` gives what file descriptors got."""
    from subslide.__main__ import main

    def call(words: list[str], folder: Path) -> tuple[int | str, str, str]:
        captured()
        with inside(folder):
            try:
                with within(SECONDS):
                    status: int | str = main(list(words))
            except BaseException as error:  # whatever comes out of main is wrong
                status = f"{type(error).__name__}: {error}"
        return (status, *captured())

    return call


def as_command(words: list[str], folder: Path) -> tuple[int | str, str, str]:
    """Call the command line as a process of its own."""
    command = [sys.executable, "-m", "subslide", *words]
    limit = (2 * MORE_BYTES, 2 * MORE_BYTES)
    try:
        done = subprocess.run(
            command,
            cwd=folder,
            capture_output=True,
            timeout=SECONDS,
            stdin=subprocess.DEVNULL,
            preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, limit),
        )
    except subprocess.TimeoutExpired as late:
        return f"TooLong: {late}", "", ""
    return done.returncode, done.stdout.decode(errors="replace"), done.stderr.decode(errors="replace")


def ended(one: Input, call: Call, folder: Path) -> Ended:
    """Call the command line with an input in a folder, and return what came of it."""
    one.fill(folder)
    before = snapshot(folder)
    status, out, err = call(one.words, folder)
    return Ended(status, err.splitlines(), out, changes(before, snapshot(folder)))


def faults(one: Input, done: Ended, folder: Path) -> list[str]:
    """What is wrong with how an input ended, in words; nothing if all is right."""
    wrong = []
    text = "\n".join([done.printed, *done.lines])
    if "Traceback" in text:
        wrong.append("traceback")
    if not isinstance(done.status, int):
        wrong.append(f"raised {str(done.status).split(':')[0]}")
    elif done.status not in STATUSES[one.ends]:
        wrong.append(f"exit {done.status}")
    lines = [line for line in done.lines if not line.startswith(ASIDE)]
    if done.status == 0 or not isinstance(done.status, int):
        wrong += ["speaks on stderr"] if lines and done.status == 0 else []
    elif len(lines) != 1 or not SAID.fullmatch(lines[0]):
        wrong.append(f"{len(lines)} lines" if len(lines) != 1 else "no line of subslide's")
    else:
        (line,) = lines
        wrong += ["longer than 300"] if len(line) > LONGEST else []
        wrong += ["unprintable"] if not line.isprintable() else []
        wrong += [] if any(name in line for name in one.names) or not one.names else ["names nothing"]
    allowed = one.makes if done.status == 0 else ()
    stray = {name: how for name, how in done.changed.items() if not name.startswith(allowed or ("\0",))}
    if stray:
        wrong.append(
            "leaves "
            + ", ".join(sorted({f"{how} {Path(name).suffix or name}" for name, how in stray.items()}))
        )
    if done.status == 0:
        for name, content in one.equal.items():
            path = folder / name
            wrong += [] if path.is_file() and path.read_bytes() == content else [f"wrong {Path(name).name}"]
    return wrong


def report(failed: list[tuple[Input, Ended, list[str]]], seed: str, of: int) -> str:
    """Failures by kind, each with the shortest input that shows it."""
    groups: dict[str, list] = {}
    for one, done, wrong in failed:
        groups.setdefault(f"{one.ends}: {'; '.join(wrong)}", []).append((one, done))
    text = [f"{len(failed)} of {of} inputs ended wrong (SUBSLIDE_FUZZ_SEED={seed})"]
    for wrong, members in sorted(groups.items(), key=lambda group: -len(group[1])):
        text.append(f"\n{len(members)} x {wrong}")
        for one, done in sorted(members, key=lambda member: len(member[0].name))[:3]:
            said = (done.lines or [""])[-1]
            status = done.status if isinstance(done.status, int) else done.status[:150]
            text.append(f"   {one.name[:120]!r}: {' '.join(one.words)[:120]!r} -> {status}: {said[:200]!r}")
    return "\n".join(text)


def run_all(inputs: list[Input], call: Call, seed: str) -> None:
    """Call every input and fail with a report if any ended wrong."""
    failed = []
    for one in inputs:
        folder = Path(tempfile.mkdtemp(prefix="fuzz-"))
        done = ended(one, call, folder)
        wrong = faults(one, done, folder)
        if wrong:
            failed.append((one, done, wrong))
        shutil.rmtree(folder, ignore_errors=True)
    assert not failed, report(failed, seed, len(inputs))


def rng_of(seed: str, kind: str) -> random.Random:
    """Generator of random numbers of a kind of input."""
    return random.Random(f"{seed} {kind}")
