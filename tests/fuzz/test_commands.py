"""Forty commands as a shell would start them: each ends as it does within one process."""

import pytest
from fuzz_calling import as_command, rng_of, run_all
from fuzz_kinds import KINDS

OF_EACH = {
    "config values": 6, "option values": 5, "YAML files": 6, "options": 9, "rasters": 5, "records": 3, "tables": 2,
    "points.json": 2, "batches": 2,
}  # fmt: skip
"""Commands of each kind."""

pytestmark = pytest.mark.slow


def test_there_are_40():
    assert sum(OF_EACH.values()) == 40


@pytest.mark.parametrize("kind", KINDS)
def test_every_command_ends_as_it_should(kind, seed, finished):
    rng = rng_of(seed, f"{kind}, commands")
    count, make = KINDS[kind]
    possible = [one for one in make(rng, count, finished) if "\0" not in "".join(one.words)]
    run_all(rng.sample(possible, OF_EACH[kind]), as_command, seed)
