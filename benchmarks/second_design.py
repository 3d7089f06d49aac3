"""A second, independent design: how many indices agree with a finished study's within the band of the difference.

    .venv/bin/python benchmarks/second_design.py results/sensitivity [--config config/sensitivity.yaml] [--seed 1001]

Runs the study's configuration with other seeds, without bands, as the study NAME-second, and compares every index of
both tables. Only sampling differs between them (both have one grid's errors), so the band of a difference is made of
the half-widths for sampling alone: the root of the sum of their squares. Exits with 1 if fewer than 90 % agree.
"""

import argparse
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
import yaml

from subslide.results import Results

REQUIRED = 0.9
KEYS = ["design", "output", "kind", "input", "other"]
BIN = Path(sys.executable).parent


def seeded(value, seed: int):
    """Return a configuration with other seeds of its Saltelli designs."""
    if isinstance(value, list):
        return [seeded(one, seed) for one in value]
    if isinstance(value, dict):
        return {
            key: {**one, "seed": one.get("seed", 0) + seed} if key == "saltelli" else seeded(one, seed)
            for key, one in value.items()
        }
    return value


def run(config: Path, seed: int) -> Path:
    """Run the second design, and return the folder of its results."""
    values = seeded(yaml.safe_load(config.read_text(encoding="utf-8")), seed)
    values |= {"study": f"{values['study']}-second", "bands": False, "figures": "none"}
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "second.yaml"
        path.write_text(yaml.safe_dump(values), encoding="utf-8")
        command = [str(BIN / "snakemake"), "--configfile", str(path), "--cores", "all"]
        subprocess.run(command, check=True)
    return Path("results") / values["study"]


def compare(name: str, first: Results, second: Results) -> tuple[int, int]:
    """Print the share of a table's indices that agree, by output; return how many do, of how many."""
    keys = KEYS if name == "indices" else [*KEYS, "time"]
    both = first.table(name).merge(second.table(name), on=keys, suffixes=("", "_second"), validate="1:1")
    band = np.hypot(both["sampling"], both["sampling_second"])
    agree = (
        both["estimate"] - both["estimate_second"]
    ).abs() <= band + 1e-9  # round-off of an index that is 0
    for (design, output), some in agree.groupby([both["design"], both["output"]]):
        print(f"{name}, design {design}, {output}: {some.sum()} of {len(some)} agree ({some.mean():.1%})")
    return int(agree.sum()), len(agree)


def main() -> int:
    """Compare two designs, and return the exit status."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("results", help="folder of the finished study")
    parser.add_argument("--config", default="config/sensitivity.yaml", type=Path)
    parser.add_argument("--seed", default=1000, type=int, help="added to the seeds")
    parser.add_argument("--second", help="folder of a second study that was run already")
    given = parser.parse_args()
    second = Results(given.second or run(given.config, given.seed))
    counts = [compare(name, Results(given.results), second) for name in ("indices", "indices_in_time")]
    agree, count = map(sum, zip(*counts, strict=True))
    print(f"{agree} of {count} indices agree within the band of the difference ({agree / count:.1%})")
    return 0 if agree >= REQUIRED * count else 1


if __name__ == "__main__":
    sys.exit(main())
