"""Kinds of bad input, how many there are of each, and what makes them."""

import fuzz_options
import fuzz_rasters
import fuzz_studies
import fuzz_values

KINDS = {
    "config values": (110, lambda rng, count, finished: fuzz_values.config_values(rng, count)),
    "option values": (60, lambda rng, count, finished: fuzz_values.option_values(rng, count)),
    "YAML files": (70, lambda rng, count, finished: fuzz_values.yaml_files(rng, count)),
    "options": (110, lambda rng, count, finished: fuzz_options.options(rng, count, finished)),
    "rasters": (50, lambda rng, count, finished: fuzz_rasters.rasters(rng, count)),
    "records": (45, lambda rng, count, finished: fuzz_studies.records(finished, rng, count)),
    "tables": (45, lambda rng, count, finished: fuzz_studies.tables(finished, rng, count)),
    "points.json": (40, lambda rng, count, finished: fuzz_studies.indices(finished, rng, count)),
    "batches": (40, lambda rng, count, finished: fuzz_studies.specs(finished, rng, count)),
}
"""How many inputs of a kind there are, and what makes them."""
