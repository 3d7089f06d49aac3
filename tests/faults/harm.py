"""Faults that are really injected into a running or finished study, by name; each takes a `Victim`.

Those of RUNNING start a study and disturb it; those of FINISHED disturb one that is done. What is random comes from the
victim's own generator, so that a seed tells all.
"""

import contextlib
import os
import resource
import shutil
import signal
import subprocess
import time
from pathlib import Path
from random import Random

STUDY = """study: small
a_H: [0.5, 1, 2, 4, 8, 10]
delta: [25, 32, 40]
r: 0.4
model: radial
cells: [600, 640, 720, 800]
t_end: 0.3
figures: none
"""


class Victim:
    """A copy of the project in a folder, with a study, whose commands are those that a user gives."""

    def __init__(self, root: Path, folder: Path, seed: int):
        self.folder, self.random = folder, Random(seed)
        self.results = folder / "results/small"
        folder.mkdir()
        for name in (
            "Snakefile",
            "workflow",
            "profiles",
            "config",
            "Makefile",
            "requirements.lock",
            "pyproject.toml",
        ):
            copy = shutil.copytree if (root / name).is_dir() else shutil.copy2
            copy(root / name, folder / name)
        for name in ("requirements.lock", "pyproject.toml"):
            os.utime(
                folder / name, (1, 1)
            )  # setting up is not what is tested, and must not touch the true folder
        (folder / ".venv").mkdir()
        (folder / ".venv/bin").symlink_to(root / ".venv/bin")
        (folder / ".venv/.ready").touch()
        (folder / "small.yaml").write_text(STUDY)

    def finished_from(self, other: "Victim") -> None:
        """Take the results of a finished study, and what Snakemake remembers of it, with their times."""
        for name in ("results", ".snakemake"):
            shutil.copytree(other.folder / name, self.folder / name)

    def start(self, *command: str, limit: int = 0) -> subprocess.Popen:
        """Start a command in a process group of its own; `limit`: most bytes of a file that it may write."""

        def limited() -> None:
            if limit:
                signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
                resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))

        return subprocess.Popen(
            command,
            cwd=self.folder,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            start_new_session=True,
            preexec_fn=limited,
        )

    def make(self, limit: int = 0) -> subprocess.Popen:
        """Start `make study`."""
        return self.start("make", "study", "CONFIG=small.yaml", "CORES=2", limit=limit)

    def records(self) -> list[Path]:
        """Records that are there."""
        return sorted((self.results / "records").glob("*.nc"))

    def one_of(self, pattern: str) -> Path:
        """A file of the results that matches a pattern, by chance."""
        return self.random.choice(sorted(self.results.glob(pattern)))

    def processes(self, word: str) -> list[int]:
        """Processes that run in the folder and have a word in their command."""
        numbers = []
        for entry in Path("/proc").glob("[0-9]*"):
            with contextlib.suppress(OSError):
                words = (entry / "cmdline").read_bytes().split(b"\0")
                if (
                    os.readlink(entry / "cwd") == str(self.folder)
                    and word.encode() in words
                    and b"-c" not in words
                ):
                    numbers.append(int(entry.name))
        return numbers

    def wait_for(self, word: str, running: subprocess.Popen) -> int:
        """Wait until a process with a word in its command runs, and return its number; 0 if the study ends before."""
        while running.poll() is None:
            if numbers := self.processes(word):
                time.sleep(self.random.random() * 0.5)
                return numbers[0]
            time.sleep(0.01)
        return 0


def kill_group(victim: Victim) -> None:
    """SIGKILL everything at a random moment."""
    stop_group(victim, signal.SIGKILL)


def interrupt_group(victim: Victim) -> None:
    """Press Ctrl-C at a random moment."""
    stop_group(victim, signal.SIGINT)


def hang_up_group(victim: Victim) -> None:
    """Close the terminal at a random moment."""
    stop_group(victim, signal.SIGHUP)


def terminate_group(victim: Victim) -> None:
    """SIGTERM to all, as a cluster sends it at its wall-time limit."""
    stop_group(victim, signal.SIGTERM)


def stop_group(victim: Victim, number: int) -> None:
    """Send a signal to `make study` and all that it started, at a random moment."""
    running = victim.make()
    time.sleep(0.3 + victim.random.random() * 6)
    with contextlib.suppress(ProcessLookupError):
        os.killpg(running.pid, number)
    running.communicate(timeout=60)


def kill_a_job(victim: Victim) -> None:
    """SIGKILL one job, as the system does that has no memory left."""
    signal_a_job(victim, signal.SIGKILL)


def stop_a_job(victim: Victim) -> None:
    """SIGTERM to one job: what it has solved is kept."""
    signal_a_job(victim, signal.SIGTERM)


def signal_a_job(victim: Victim, number: int) -> None:
    """Send a signal to one job of `make study`, soon after the first one has started."""
    running = victim.make()
    if job := victim.wait_for("batch", running):
        with contextlib.suppress(ProcessLookupError):
            os.kill(job, number)
    running.communicate(timeout=120)


def kill_snakemake_alone(victim: Victim) -> None:
    """SIGKILL Snakemake while its jobs live on."""
    running = victim.make()
    if victim.wait_for("batch", running):
        for number in victim.processes("small.yaml"):
            with contextlib.suppress(ProcessLookupError):
                os.kill(number, signal.SIGKILL)
    running.communicate(timeout=120)


def fill_the_disk(victim: Victim) -> None:
    """Let no file grow beyond a few kilobytes."""
    victim.make(limit=victim.random.choice([4_000, 20_000, 60_000, 150_000])).communicate(timeout=120)


def plan_another_while_it_runs(victim: Victim) -> None:
    """Dry runs of other configurations, and one of the edited file, while the study runs."""
    running = victim.make()
    time.sleep(0.5 + victim.random.random() * 2)
    other = ("-n", "--configfile", "small.yaml", "--cores", "1", "--config")
    victim.start(".venv/bin/snakemake", *other, "a_H=[3,4,5]").communicate(timeout=60)
    victim.start(".venv/bin/snakemake", *other, f"delta={list(range(10, 60))}".replace(" ", "")).communicate(
        timeout=60
    )
    running.communicate(timeout=120)


def run_twice_at_once(victim: Victim) -> None:
    """Start the same study twice."""
    running = [victim.make()]
    time.sleep(victim.random.random() * 2)
    running.append(victim.make())
    for one in running:
        one.communicate(timeout=120)
    assert 0 in [one.returncode for one in running]


def truncate_a_record(victim: Victim) -> None:
    """Cut a record short, its time kept."""
    path = victim.one_of("records/*.nc")
    rewrite(path, path.read_bytes()[: victim.random.randrange(path.stat().st_size)])


def flip_bits_of_a_record(victim: Victim) -> None:
    """Flip some bits of a record, its time kept."""
    path = victim.one_of("records/*.nc")
    content = bytearray(path.read_bytes())
    for _ in range(victim.random.choice([1, 10, 1000])):
        content[victim.random.randrange(len(content))] ^= 1 << victim.random.randrange(8)
    rewrite(path, bytes(content))


def delete_records(victim: Victim) -> None:
    """Delete some records."""
    for path in victim.random.sample(victim.records(), 2):
        path.unlink()


def delete_the_ledger(victim: Victim) -> None:
    """Delete the ledger, or one file of it."""
    if victim.random.random() < 0.5:
        shutil.rmtree(victim.results / "batches")
    else:
        victim.one_of("batches/*.json").unlink()


def delete_a_checksum(victim: Victim) -> None:
    """Delete a checksum of a record, a table or points.json."""
    victim.one_of(victim.random.choice(["records/*.sha256", "tables/*.sha256", "*.sha256"])).unlink()


def damage_a_checksum(victim: Victim) -> None:
    """Write other bytes into a checksum."""
    path = victim.one_of(victim.random.choice(["records/*.sha256", "tables/*.sha256", "*.sha256"]))
    rewrite(path, victim.random.randbytes(victim.random.randrange(100)))


def delete_the_points(victim: Victim) -> None:
    """Delete points.json."""
    (victim.results / "points.json").unlink()


def edit_the_points(victim: Victim) -> None:
    """Edit points.json, its time kept."""
    path = victim.results / "points.json"
    rewrite(path, path.read_bytes().replace(b'"r": 0.4', b'"r": 0.5', victim.random.choice([1, 5])))


def edit_a_table(victim: Victim) -> None:
    """Edit, cut or empty a table, its time kept."""
    path = victim.one_of("tables/*.csv")
    content = path.read_bytes()
    part = content[: victim.random.randrange(len(content))]
    rewrite(path, victim.random.choice([content.replace(b"1", b"2"), part, b""]))


def delete_tables(victim: Victim) -> None:
    """Delete the tables."""
    shutil.rmtree(victim.results / "tables")


def swap_two_records(victim: Victim) -> None:
    """Swap two records with their checksums."""
    one, two = victim.random.sample(victim.records(), 2)
    aside = one.with_name("aside")
    for end in ("", ".sha256"):
        first, second = Path(f"{one}{end}"), Path(f"{two}{end}")
        first.rename(aside)
        second.rename(first)
        aside.rename(second)


def move_the_results(victim: Victim) -> None:
    """Move the results away and back without what Snakemake remembers, as into another clone."""
    shutil.move(victim.results, victim.folder / "moved")
    shutil.rmtree(victim.folder / ".snakemake")
    shutil.move(victim.folder / "moved", victim.results)


def shuffle_times(victim: Victim) -> None:
    """Give every file a random time, past or future, as copies and clocks that are set back have."""
    for path in victim.results.rglob("*"):
        os.utime(path, (time.time() + victim.random.uniform(-1e6, 1e6),) * 2)


def forget_in_snakemake(victim: Victim) -> None:
    """Damage what Snakemake remembers, and what was staged for jobs."""
    for path in (victim.folder / ".snakemake").rglob("*"):
        if path.is_file() and victim.random.random() < 0.5:
            path.write_bytes(b"" if victim.random.random() < 0.5 else victim.random.randbytes(20))


def rewrite(path: Path, content: bytes) -> None:
    """Give a file other bytes and leave its time as it was."""
    times = path.stat()
    path.write_bytes(content)
    os.utime(path, ns=(times.st_atime_ns, times.st_mtime_ns))


RUNNING = (
    *(kill_group, kill_a_job, kill_snakemake_alone, stop_a_job, terminate_group, hang_up_group),
    *(interrupt_group, fill_the_disk, plan_another_while_it_runs, run_twice_at_once),
)
FINISHED = (
    *(truncate_a_record, flip_bits_of_a_record, delete_records, delete_the_ledger, delete_a_checksum),
    *(damage_a_checksum, delete_the_points, edit_the_points, edit_a_table, delete_tables, swap_two_records),
    *(move_the_results, shuffle_times, forget_in_snakemake),
)
