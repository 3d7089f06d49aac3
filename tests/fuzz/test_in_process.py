"""Bad inputs of every kind, in one process: each ends with one line and the right status, and leaves nothing behind."""

import pytest
from fuzz_calling import in_process, rng_of, run_all
from fuzz_kinds import KINDS

MANY = 4
"""Times as many in the long lane."""


def test_there_are_500():
    assert sum(count for count, _ in KINDS.values()) >= 500


@pytest.mark.parametrize("kind", KINDS)
def test_every_input_ends_as_it_should(kind, seed, finished, captured):
    count, make = KINDS[kind]
    run_all(make(rng_of(seed, kind), count, finished), in_process(captured), seed)


@pytest.mark.long
@pytest.mark.parametrize("kind", KINDS)
def test_2000_inputs_end_as_they_should(kind, seed, finished, captured):
    count, make = KINDS[kind]
    run_all(make(rng_of(seed, f"{kind}, many"), MANY * count, finished), in_process(captured), seed)
