"""Bad inputs of every kind, in one process: each ends with one line and the right status, and leaves nothing behind."""

import fuzz_options
import fuzz_rasters
import fuzz_studies
import fuzz_values
import pytest
from fuzz_calling import rng_of, run_all

KINDS = {
    "config values": (110, lambda rng, count, finished: fuzz_values.config_values(rng, count)),
    "option values": (60, lambda rng, count, finished: fuzz_values.option_values(rng, count)),
    "YAML files": (70, lambda rng, count, finished: fuzz_values.yaml_files(rng, count)),
    "options": (90, lambda rng, count, finished: fuzz_options.options(rng, count, finished)),
    "rasters": (50, lambda rng, count, finished: fuzz_rasters.rasters(rng, count)),
    "records": (45, lambda rng, count, finished: fuzz_studies.records(finished, rng, count)),
    "tables": (45, lambda rng, count, finished: fuzz_studies.tables(finished, rng, count)),
    "points.json": (40, lambda rng, count, finished: fuzz_studies.indices(finished, rng, count)),
    "batches": (40, lambda rng, count, finished: fuzz_studies.specs(finished, rng, count)),
}
"""How many inputs of a kind there are, and what makes them."""

MANY = 4
"""Times as many in the long lane."""

pytestmark = pytest.mark.xdist_group("fuzz")


def test_there_are_500():
    assert sum(count for count, _ in KINDS.values()) >= 500


@pytest.mark.parametrize("kind", KINDS)
def test_every_input_ends_as_it_should(kind, seed, finished, captured):
    count, make = KINDS[kind]
    run_all(make(rng_of(seed, kind), count, finished), captured, seed)


@pytest.mark.long
@pytest.mark.parametrize("kind", KINDS)
def test_2000_inputs_end_as_they_should(kind, seed, finished, captured):
    count, make = KINDS[kind]
    run_all(make(rng_of(seed, f"{kind}, many"), MANY * count, finished), captured, seed)
