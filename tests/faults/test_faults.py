"""After each fault, `make study` alone gives the tables of an undisturbed run, and leaves nothing behind."""

import os
from pathlib import Path

import harm
import pytest

SEED = int(os.environ.get("SUBSLIDE_FAULTS_SEED", "20261127"))
"""What the moments and places of all faults follow from."""

SHORT = (
    *(harm.kill_snakemake_alone, harm.stop_a_job, harm.fill_the_disk, harm.plan_another_while_it_runs),
    *(harm.flip_bits_of_a_record, harm.shuffle_times),
)
"""Faults that guard a landing; the long lane has them all, those of running studies twice."""

ALL = [(fault, n) for n in (0, 1) for fault in (*harm.RUNNING, *(harm.FINISHED if n == 0 else ()))]
FAULTS = [(fault, 0) for fault in SHORT] + [
    pair for pair in ALL if pair not in [(fault, 0) for fault in SHORT]
]

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def undisturbed(tmp_path_factory):
    """A study that nothing disturbed."""
    root = Path(__file__).resolve().parents[2]
    victim = harm.Victim(root, tmp_path_factory.mktemp("undisturbed") / "project", SEED)
    running = victim.make()
    text, _ = running.communicate(timeout=300)
    assert running.returncode == 0, text
    victim.root = root
    return victim


def tables_of(victim):
    """Bytes of the tables that do not differ between two identical runs."""
    return {name: (victim.results / "tables" / f"{name}.csv").read_bytes() for name in ("runs", "series")}


@pytest.mark.parametrize(
    ("fault", "turn"),
    [
        pytest.param(fault, turn, marks=() if n < len(SHORT) else pytest.mark.long)
        for n, (fault, turn) in enumerate(FAULTS)
    ],
    ids=[f"{fault.__name__}-{turn}" for fault, turn in FAULTS],
)
def test_one_command_mends_every_fault(fault, turn, undisturbed, tmp_path):
    seed = SEED + 1000 * turn + sum(map(ord, fault.__name__))
    print(f"seed {seed} (SUBSLIDE_FAULTS_SEED={SEED})")
    victim = harm.Victim(undisturbed.root, tmp_path / "project", seed)
    if fault in harm.FINISHED:
        victim.finished_from(undisturbed)
    fault(victim)
    running = victim.make()
    text, _ = running.communicate(timeout=300)
    assert running.returncode == 0, text
    assert tables_of(victim) == tables_of(undisturbed), text
    again = victim.make()
    text, _ = again.communicate(timeout=300)
    assert "Nothing to be done" in text, text
    left = [path for path in victim.results.rglob("*") if path.name.endswith((".tmp", ".part", ".probe"))]
    assert left == []
