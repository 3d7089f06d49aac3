"""Same answers: every point of a study solved in two checkouts, each array of each run compared to the bit.

    .venv/bin/python benchmarks/same_answers.py OLD [--config config/coverage.yaml] [--model NAME ...]

OLD is the folder of another checkout of subslide with a .venv of its own (`make setup`). Prints the points whose
answers differ, and exits with 1 if any does. A point that either checkout does not know counts as different.
"""

import argparse
import hashlib
import json
import os
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parents[1]
ASIDE = ("point", "wall_seconds", "model_reason", "grid", "grid_reason")
"""What a run has that is no part of its answer."""


def digest(run) -> str:
    """Return the hash of all that a run gave."""
    import numpy as np

    total = hashlib.sha256()
    values = {name: value for name, value in vars(run).items() if name not in ASIDE}
    values |= values.pop("series", {})
    for name, value in sorted(values.items()):
        if value is not None:
            body = value.tobytes() if isinstance(value, np.ndarray) else repr(value).encode()
            total.update(name.encode() + body)
    return total.hexdigest()[:16]


def work() -> None:
    """Solve the points on standard input, one a line, and print the digest of each answer."""
    from subslide.points import from_dict
    from subslide.solver import solve

    for line in sys.stdin:
        try:
            answer = digest(solve(from_dict(json.loads(line))))
        except Exception as error:
            answer = f"{type(error).__name__}: {error}".replace("\n", " ")
        print(answer, flush=True)


def answers(folder: Path, points: list[dict]) -> list[str]:
    """Return the digests of points solved in a checkout."""
    text = "".join(json.dumps(point) + "\n" for point in points)
    environment = {**os.environ, "NUMBA_NUM_THREADS": "1", "PYTHONPATH": str(folder / "src")}
    command = [folder / ".venv/bin/python", Path(__file__).resolve(), "--work"]
    done = subprocess.run(
        command, cwd=HERE, env=environment, input=text, capture_output=True, text=True, check=True
    )
    return done.stdout.splitlines()


def main() -> int:
    """Compare two checkouts; 1 if any answer differs."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("old", nargs="?", type=Path, help="folder of the other checkout, with its .venv")
    parser.add_argument("--config", type=Path, default=HERE / "config/coverage.yaml")
    parser.add_argument("--model", nargs="*", default=[], help="only points solved by these models")
    parser.add_argument("--work", action="store_true", help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.work:
        return work()
    if arguments.old is None:
        parser.error("the folder of another checkout is needed")
    from subslide.keys.names import LATER
    from subslide.points import to_dict
    from subslide.study import choice
    from subslide.study.config import read_study

    points = [
        {key: value for key, value in to_dict(point).items() if LATER.get(key) != value}
        for point in read_study(arguments.config).points
        if not arguments.model or choice.of(point).model in arguments.model
    ]
    old, new = (answers(folder, points) for folder in (arguments.old.resolve(), HERE))
    different = [
        f"{a} {b} {json.dumps(point)}" for a, b, point in zip(old, new, points, strict=True) if a != b
    ]
    print("\n".join([*different[:5], f"{len(points)} points, {len(different)} answers differ"]))
    return 1 if different else 0


if __name__ == "__main__":
    sys.exit(main())
