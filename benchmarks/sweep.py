"""What a point of a large sweep costs beside its run: seconds by part, bytes, and the tables of the whole.

    .venv/bin/python benchmarks/sweep.py [--points 1000] [--kinds radial fitted] [--folder FOLDER]

Solves so many columns of the range (a Latin hypercube of a_H, a_2, r and delta, to rest) in this process, as a job
would with `keep: summary`, and writes their tables. `kernels` is the time loop itself; a point is to cost less than
300 us and 3 kB beside it.
"""

import argparse
import functools
import resource
import tempfile
import time
from pathlib import Path

OVER = {"a_H": [0.5, 10], "a_2": [0.3, 1.5], "r": [0, 0.8], "delta": [20, 40]}
KINDS = {"radial": {"cells": 200}, "fitted": {"cells": 48, "grid": "fitted", "quantities": "grains"}}
TABLES = ("runs", "timing", "series")


def clocked(totals: dict, part: str, work):
    """Return what `work()` gives, its seconds added to a part of the totals."""
    started = time.perf_counter()
    value = work()
    totals[part] = totals.get(part, 0.0) + time.perf_counter() - started
    return value


def solved(points, totals):
    """Return the summaries of points."""
    from subslide import solver
    from subslide.records import thinning

    solver.solve(points[0], profiles=False)
    thinning.kept(solver.solve(points[0]), "summary")
    runs = []
    for point in points:
        run = clocked(totals, "beside", functools.partial(solver.solve, point, profiles=False))
        totals["kernels"] = totals.get("kernels", 0.0) + run.wall_seconds
        totals["beside"] -= run.wall_seconds
        runs.append(clocked(totals, "keep", functools.partial(thinning.kept, run, "summary")))
    return runs


def study_of(kind: str, count: int, folder: Path, totals: dict) -> None:
    """Leave a study of so many points in a folder, as its jobs would."""
    from subslide import checksums
    from subslide.files import write_text
    from subslide.jobs import keep_batch
    from subslide.study import config, plan

    design = {"latin_hypercube": {"points": count, "seed": 1, "over": OVER}}
    study = config.make_study({"study": "sweep", "keep": "summary", **KINDS[kind], "design": design})
    planned = clocked(totals, "plan", functools.partial(plan.plan, study, folder))
    for name in ("records", "batches"):
        (folder / name).mkdir(parents=True)
    for name, batch in planned.batches.items():
        runs = solved(list(batch.points), totals)
        record, ledger = plan.record_path(folder, name), folder / "batches" / f"{name}.json"
        clocked(totals, "write", functools.partial(keep_batch, runs, str(record), str(ledger), "summary"))
        totals["bytes"] = totals.get("bytes", 0) + record.stat().st_size
    write_text(folder / "points.json", planned.points_text)
    checksums.seal(folder / "points.json")


def measure(kind: str, count: int, folder: Path) -> None:
    """Print what a kind of point costs, and its tables."""
    from subslide.results import Results
    from subslide.tables import _write

    totals: dict = {}
    study_of(kind, count, folder, totals)
    size = totals.pop("bytes") / count
    beside = totals["beside"] + totals["keep"] + totals["write"]
    parts = ", ".join(f"{part} {1e6 * seconds / count:.0f}" for part, seconds in totals.items())
    print(f"{kind}: us a point: {parts}; beside its run {1e6 * beside / count:.0f} us and {size:.0f} B")
    tables: dict = {}
    for name in TABLES:
        clocked(tables, name, functools.partial(_write.write, name, Results(folder)))
    parts = ", ".join(f"{name} {seconds:.2f} s" for name, seconds in tables.items())
    most = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print(f"{kind}: tables of {count} points: {parts}; {most:.0f} MiB at most so far", flush=True)


def main() -> None:
    """Measure each kind."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--points", type=int, default=1000, metavar="N")
    parser.add_argument("--kinds", nargs="*", choices=KINDS, default=list(KINDS))
    parser.add_argument("--folder", type=Path, help="where the studies stay; a temporary folder without")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        for kind in arguments.kinds:
            measure(kind, arguments.points, (arguments.folder or Path(temporary)) / kind)


if __name__ == "__main__":
    main()
