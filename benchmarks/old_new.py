"""Old against new: every kernel's time in two checkouts, in turn, as the ratio new over old.

    .venv/bin/python benchmarks/old_new.py OLD [--new FOLDER] [--rounds N] [--only TEXT]

OLD is the folder of another checkout of subslide with a .venv of its own (`make setup`). Each round starts one process
in each checkout, so that where arrays lie in memory differs from round to round; the two then solve each case in turn,
old first in one round and new first in the next. What is compared is the least `wall_seconds` (the time loop alone) of
a few runs of a turn, and printed the median of the rounds' ratios with the interval that holds it in 95 of 100 cases
(by the binomial distribution of the ranks).
"""

import argparse
import json
import math
import os
import statistics
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parents[1]
CASES = {
    "radial, order 2": {"model": "radial", "cells": 1600},
    "radial, order 2, 200 cells": {"model": "radial", "cells": 200},
    "radial, order 1": {"model": "radial", "cells": 1600, "order": 1},
    "radial, order 2, float32": {"model": "radial", "cells": 1600, "dtype": "float32"},
    "radial, order 2, hll": {"model": "radial", "cells": 1600, "scheme": "hll"},
    "radial, order 2, ifcp": {"model": "radial", "cells": 800, "scheme": "ifcp"},
    "radial, order 2, rusanov": {"model": "radial", "cells": 800, "scheme": "rusanov"},
    "radial, order 2, roe": {"model": "radial", "cells": 800, "scheme": "roe"},
    "radial, order 1, roe": {"model": "radial", "cells": 800, "scheme": "roe", "order": 1},
    "radial, order 2, voellmy": {"model": "radial", "cells": 800, "friction": "voellmy"},
    "radial, order 2, pouliquen": {"model": "radial", "cells": 800, "friction": "pouliquen"},
    "radial, order 2, hll where complex": {"model": "radial", "cells": 800, "treatment": "hll"},
    "radial, order 2, approximate speeds": {"model": "radial", "cells": 800, "wave_speeds": "approximate"},
    "one layer, order 2": {"model": "one-layer", "r": 0.0, "cells": 3200},
    "one layer, order 1": {"model": "one-layer", "r": 0.0, "cells": 3200, "order": 1},
    "line, order 2": {
        "model": "line",
        "cells": 800,
        "scene": "dam_break",
        "boundary": "wall",
        "scene_options": {"downstream": 0.2},
    },
    "quarter, order 2": {"model": "quarter", "cells": 200},
    "quarter, order 1": {"model": "quarter", "cells": 200, "order": 1},
    "quarter, order 2, float32": {"model": "quarter", "cells": 200, "dtype": "float32"},
    "plane, order 2": {"model": "plane", "cells": 160},
    "plane, order 1": {"model": "plane", "cells": 160, "order": 1},
    "plane, order 2, roe": {"model": "plane", "cells": 80, "scheme": "roe"},
    "plane, order 1, rusanov": {"model": "plane", "cells": 120, "order": 1, "scheme": "rusanov"},
}
ENDS = {"radial": 0.15, "one-layer": 0.15, "line": 0.15, "quarter": 0.08, "plane": 0.06}
"""Time (s) that a case's column is followed: grains run over most of it."""
TURN = 0.15
"""Seconds that a turn takes at least, however short its runs."""


def work() -> None:
    """Solve the cases named on standard input, one a line, and answer each with the least seconds of its time loop."""
    from subslide.points import from_dict
    from subslide.solver import solve

    for line in sys.stdin:
        values = json.loads(line)
        point = from_dict({**values, "t_end": ENDS[values["model"]], "snapshot_times": []})
        solve(point)
        seconds = []
        while len(seconds) < 2 or (sum(seconds) < TURN and len(seconds) < 60):
            seconds.append(solve(point).wall_seconds)
        print(min(seconds), flush=True)


class Checkout:
    """A process in a checkout that solves cases when asked."""

    def __init__(self, folder: Path):
        python = folder / ".venv/bin/python"
        environment = {**os.environ, "NUMBA_NUM_THREADS": "1", "PYTHONPATH": str(folder / "src")}
        self.process = subprocess.Popen(
            [python, Path(__file__).resolve(), "--work"],
            cwd=folder,
            env=environment,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )

    def seconds(self, case: dict) -> float:
        """Return the least seconds of a case's time loop."""
        self.process.stdin.write(json.dumps(case) + "\n")
        self.process.stdin.flush()
        return float(self.process.stdout.readline())

    def close(self) -> None:
        """End the process."""
        self.process.stdin.close()
        self.process.wait()


def interval(ratios: list[float], level: float = 0.95) -> tuple[float, float]:
    """Return the ordered ratios between which their median lies with at least this probability."""
    n, ordered = len(ratios), sorted(ratios)
    rank = 0
    while sum(math.comb(n, k) for k in range(rank + 1)) / 2**n <= (1 - level) / 2:
        rank += 1
    rank = max(rank - 1, 0)
    return ordered[rank], ordered[n - 1 - rank]


def compare(old: Path, new: Path, rounds: int, cases: dict) -> dict[str, list[float]]:
    """Return the ratio new over old of each round, by case."""
    ratios = {name: [] for name in cases}
    for n in range(rounds):
        checkouts = {"old": Checkout(old), "new": Checkout(new)}
        for name, case in cases.items():
            seconds = {}
            for which in ("old", "new") if n % 2 == 0 else ("new", "old"):
                seconds[which] = checkouts[which].seconds(case)
            ratios[name].append(seconds["new"] / seconds["old"])
        for checkout in checkouts.values():
            checkout.close()
        print(f"round {n + 1} of {rounds}", file=sys.stderr, flush=True)
    return ratios


def main() -> None:
    """Compare two checkouts and print a line for each case."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("old", nargs="?", type=Path, help="folder of the other checkout, with its .venv")
    parser.add_argument("--new", type=Path, default=HERE, help="folder of the checkout that is judged")
    parser.add_argument("--rounds", type=int, default=20)
    parser.add_argument("--only", default="", help="cases whose name holds this text")
    parser.add_argument("--work", action="store_true", help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.work:
        return work()
    if arguments.old is None:
        parser.error("the folder of another checkout is needed")
    cases = {name: case for name, case in CASES.items() if arguments.only in name}
    ratios = compare(arguments.old.resolve(), arguments.new.resolve(), arguments.rounds, cases)
    print(f"seconds of the time loop, new over old: median of {arguments.rounds} rounds [95 % interval]")
    for name, values in ratios.items():
        low, high = interval(values)
        print(f"{name:36s} {statistics.median(values):.3f} [{low:.3f}, {high:.3f}]")


if __name__ == "__main__":
    main()
