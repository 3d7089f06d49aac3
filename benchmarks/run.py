"""`make bench`: everything measured in one run, as ratios where possible; the table, the targets, two figures."""

import argparse
import json
import os
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
PARTS = ("compile", "edge", "loop", "run", "memory", "threads", "start_up", "roofline")


def main(arguments=None):
    """Return the exit status: 0 done, 1 where something could not be measured, 2 for bad input."""
    parser = argparse.ArgumentParser(prog="benchmarks/run.py", description=__doc__)
    parser.add_argument(
        "--quick", action="store_true", help="fewer repetitions, float64 alone, compiled kernels reused"
    )
    parser.add_argument(
        "--only", nargs="+", choices=PARTS, default=PARTS, metavar="PART", help="of: " + ", ".join(PARTS)
    )
    parser.add_argument("--list", action="store_true", help="list the parts and the targets, measure nothing")
    parser.add_argument(
        "-o", "--output", default="results/bench", metavar="FOLDER", help="default: %(default)s"
    )
    options = parser.parse_args(arguments)
    with tempfile.TemporaryDirectory(prefix="subslide-bench-", ignore_cleanup_errors=True) as cache:
        if "compile" in options.only and not options.quick and not options.list:
            os.environ["NUMBA_CACHE_DIR"] = (
                cache  # an empty one: compiling is measured too, once for each kernel
            )
        from compiled import NoCompilerError

        try:
            return bench(options)
        except NoCompilerError as error:
            print(f"bench: {error}", file=sys.stderr)
            return 2


def bench(options):
    """Return 0 once the parts that were asked for are measured and written, 1 where one failed."""
    import machine
    import table

    if options.list:
        print("parts: " + ", ".join(PARTS))
        print(table.criteria_text([]))
        return 0
    folder = table.folder(options.output)
    about = machine.describe()
    (folder / "machine.json").write_text(json.dumps(about, indent=1) + "\n", encoding="utf-8")
    print(f"{about['cpu']}, {about['cores']} cores, {about['compiler']}, numba {about['numba']}")
    rows, failed = [], []
    started = time.perf_counter()
    for name, part in parts(options.quick).items():
        if name in options.only:
            before = time.perf_counter()
            try:
                rows += part(rows)
            except ValueError as error:  # the other parts are worth having
                failed.append(f"{name}: {error}")
            table.write(folder / "bench.csv", rows)
            print(f"  {name}: {time.perf_counter() - before:.0f} s", flush=True)
    about["load_at_end"] = round(os.getloadavg()[0], 2)  # above 1, others took part of what was measured
    (folder / "machine.json").write_text(json.dumps(about, indent=1) + "\n", encoding="utf-8")
    draw(folder, rows)
    print(f"\n{table.criteria_text(rows)}\n")
    print(f"{folder}/bench.csv: {len(rows)} rows in {time.perf_counter() - started:.0f} s")
    for line in failed:
        print(f"bench: {line}", file=sys.stderr)
    return 1 if failed else 0


def parts(quick):
    """Return {name: function of the rows so far that measures a part and returns its rows}, in order."""
    import reference
    import roofline
    import runs
    import startup

    dtypes = ("float64",) if quick else ("float64", "float32")

    def compiling(_):
        return [] if quick else startup.compile_times(dtypes)

    def edge(_):
        reference.check(dtypes)
        rows = runs.edge_functions(dtypes, 3 if quick else 15)
        return rows + runs.edge_functions(
            dtypes, 3 if quick else 15, cells=24
        )  # 1104 edges stay in the L2 cache

    def loops(_):
        return runs.beside_c(dtypes, 2 if quick else 5)

    def whole_runs(_):
        cases = runs.all_cases(dtypes)
        found = runs.speeds(
            [case for case in cases if case[4] <= 200 or case[0] == "radial"] if quick else cases
        )
        return found + runs.growth(found)

    def kernels(rows):
        limits = roofline.rows_of_limits(dtypes, rounds=3 if quick else 9)
        return limits + roofline.rows_of_kernels(rows + limits)

    return {
        "compile": compiling,
        "edge": edge,
        "loop": loops,
        "run": whole_runs,
        "memory": lambda _: runs.memory(dtypes),
        "threads": lambda _: runs.threads(400, 3) if quick else runs.threads(1600, 5),
        "start_up": lambda _: startup.start_up(3 if quick else 9),
        "roofline": kernels,
    }


def draw(folder, rows):
    """Nothing; the figures that the rows allow are in the folder."""
    import figures

    if any(row.benchmark == "machine" for row in rows):
        figures.save(figures.roofline(rows), folder, "roofline")
    if any(row.benchmark == "loop" for row in rows):
        figures.save(figures.bars(rows), folder, "ratios")


if __name__ == "__main__":
    os.environ["NUMBA_NUM_THREADS"] = (
        "1"  # before numba is loaded; two threads are measured in a process of their own
    )
    sys.exit(main())
