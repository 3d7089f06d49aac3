"""A study of 2,000 points through a real SLURM of one node, in which a job and the node's daemon are killed once.

Started by `make test-slurm`. Its tables must be those of the same study run without SLURM, to the bit. SLURM is this
script's own, and gone when it ends.
"""

import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
NODE = ROOT / "tests/slurm/node.sh"

STUDY = """
study: cluster
a_H: [0.5, 1, 1.5, 2, 3, 4, 5, 6, 8, 10]
a_2: [0.3, 0.4, 0.56, 0.8, 1.2]
r: [0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.8]
delta: [20, 25, 30, 35, 40]
model: radial
cells: 40
figures: none
batch_seconds: 1
"""
POINTS = 10 * 5 * 8 * 5

PATIENCE = 600.0
"""Seconds in which the study must be solved by SLURM."""

DOWN = 20.0
"""Seconds for which the node's daemon is dead: SLURM takes the node for lost after 10."""


def main() -> None:
    """Run the study in both ways and compare; end with what is wrong."""
    with tempfile.TemporaryDirectory(prefix="subslide-slurm-") as folder:
        home = Path(folder)
        home.chmod(0o755)  # munged is another user
        local, cluster = project(home / "local"), project(home / "cluster")
        say("the study without SLURM")
        make(local, "CORES=2").wait()
        try:
            started = subprocess.run([NODE, "start", home / "slurm"])
            if started.returncode:
                sys.exit(started.returncode)
            say("the study through SLURM")
            through_slurm(cluster, home / "slurm")
        finally:
            subprocess.run([NODE, "stop", home / "slurm"], check=True)
        compare(local / "results/cluster", cluster / "results/cluster")
    say(f"{POINTS} points through SLURM, with a job and a daemon killed: the tables are the same bits")


def project(folder: Path) -> Path:
    """Return a copy of the workflow with the study, which uses this environment."""
    folder.mkdir()
    for name in (
        "Snakefile",
        "Makefile",
        "requirements.lock",
        "pyproject.toml",
        "workflow",
        "profiles",
        "config",
    ):
        copy = shutil.copytree if (ROOT / name).is_dir() else shutil.copy2
        copy(ROOT / name, folder / name)
    (folder / ".venv").symlink_to(ROOT / ".venv")
    (folder / "cluster.yaml").write_text(STUDY)
    return folder


def make(folder: Path, *options: str) -> subprocess.Popen:
    """Return the process of `make study` in a folder; its output is in `log` there."""
    command = ["make", "--no-print-directory", "study", "CONFIG=cluster.yaml", *options]
    with open(folder / "log", "w") as log:
        return subprocess.Popen(command, cwd=folder, stdout=log, stderr=log, start_new_session=True)


def through_slurm(folder: Path, slurm: Path) -> None:
    """Run the study through SLURM; kill its first job, and the daemon of the node while another runs."""
    running = make(folder, "PROFILE=slurm")
    try:
        first = wait(folder, running, lambda: jobs("RUNNING"))[0]
        subprocess.run(["scancel", first], check=True)
        say(f"job {first} is killed")
        other = wait(folder, running, lambda: [job for job in jobs("RUNNING") if job != first])[0]
        os.kill(int((slurm / "slurmd.pid").read_text()), signal.SIGKILL)
        say(f"the node's daemon is killed while job {other} runs")
        time.sleep(DOWN)
        subprocess.run([NODE, "node", slurm], check=True)
        say("the node's daemon is there again")
        wait(folder, running, lambda: running.poll() is not None)
    finally:
        if running.poll() is None:
            os.killpg(running.pid, signal.SIGTERM)
            running.wait(60)
    if running.returncode:
        fail(folder, f"make study PROFILE=slurm ended with {running.returncode}")
    if "Trying to restart job" not in (folder / "log").read_text():
        fail(folder, "no job was tried again")


def jobs(state: str) -> list[str]:
    """Return the numbers of SLURM's jobs in a state."""
    command = ["squeue", "--noheader", "--format=%i", f"--states={state}"]
    return subprocess.run(command, capture_output=True, text=True).stdout.split()


def wait(folder: Path, running: subprocess.Popen, ready):
    """Return what `ready` gives as soon as it is not empty."""
    until = time.monotonic() + PATIENCE
    while not (value := ready()):
        if time.monotonic() > until or running.poll() is not None:
            fail(folder, "the study ended too soon, or takes too long")
        time.sleep(0.2)
    return value


def compare(local: Path, cluster: Path) -> None:
    """Raise SystemExit where a table of one study differs from that of the other."""
    files, there = (sorted(path.name for path in (home / "tables").iterdir()) for home in (local, cluster))
    if "runs.csv" not in files or files != there:
        sys.exit(f"test-slurm: the studies have other tables: {files}, {there}")
    for name in files:
        same = (local / "tables" / name).read_bytes() == (cluster / "tables" / name).read_bytes()
        if not (same or name.startswith("timing.")):
            sys.exit(f"test-slurm: {name} differs")
    rows = (cluster / "tables/runs.csv").read_text().count("\n") - 1
    if rows != POINTS:
        sys.exit(f"test-slurm: runs.csv has {rows} rows for {POINTS} points")
    if (batches := len(list((cluster / "records").glob("*.nc")))) < 4:
        sys.exit(f"test-slurm: {batches} jobs were too few to be killed")


def say(line: str) -> None:
    """Print a line at once."""
    print(f"test-slurm: {line}", flush=True)


def fail(folder: Path, why: str) -> None:
    """Raise SystemExit with what the study said last."""
    print(*(folder / "log").read_text().splitlines()[-25:], sep="\n", file=sys.stderr)
    sys.exit(f"test-slurm: {why}")


if __name__ == "__main__":
    main()
