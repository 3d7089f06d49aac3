"""`make bench-peers`: subslide beside GeoClaw's two layers and PyClaw's one, on the paper's column without friction."""

import argparse
import json
import os
import platform
import statistics
import sys
from pathlib import Path

from report import END, TIMES, once, spread, text, write


def main(arguments=None):
    """Return the exit status: 0 done, 1 where a code could not be installed or run, 2 for bad input."""
    parser = argparse.ArgumentParser(prog="benchmarks/peers/run.py", description=__doc__)
    parser.add_argument("--cells", type=int, nargs="+", default=[100, 200], help="default: 100 200")
    parser.add_argument("--rounds", type=int, default=3, help="repetitions, by turns (default: 3)")
    parser.add_argument("--short", action="store_true", help=f"stop at {TIMES[-1]} s instead of {END} s")
    parser.add_argument("-o", "--output", default="results/bench", help="folder (default: %(default)s)")
    options = parser.parse_args(arguments)
    if options.rounds < 1 or any(cells < 20 or cells % 2 for cells in options.cells):
        parser.error("--rounds must be at least 1, --cells even numbers of at least 20")
    import install

    try:
        install.install()
        measure(options)
    except (install.MissingError, RuntimeError) as error:
        print(f"bench-peers: {error}", file=sys.stderr)
        return 1
    return 0


def measure(options):
    """Nothing; every code has run, and the table, the versions and the figure are in the output folder."""
    import codes
    import figure

    folder = Path(options.output)
    folder.mkdir(parents=True, exist_ok=True)
    about = machine()
    times = TIMES if options.short else (*TIMES, END)
    true = {
        "two layers": codes.subslide(2, 1600, times, model="radial"),
        "one layer": codes.subslide(2, 1600, times, model="one-layer", r=0.0),
    }
    rows, profiles = [], {}
    for cells in options.cells:
        rounds = []
        for number in range(options.rounds):
            print(f"  {cells} x {cells} cells, round {number + 1} of {options.rounds}", flush=True)
            rounds.append(take_turns(cells, times))
        rows += rows_of(rounds, true)
        profiles[cells] = {key: results[0] for key, results in rounds[-1].items()}
        write(folder / "peers.csv", rows)
    about["stopped"] = {
        f"{r.code}, {cells} x {cells}": r.stopped
        for cells, p in profiles.items()
        for r in p.values()
        if r.stopped
    }
    (folder / "peers.json").write_text(json.dumps(about, indent=1) + "\n", encoding="utf-8")
    figure.save(figure.draw(profiles, true["two layers"], rows, TIMES), folder)
    print(f"\n{text(rows, about['stopped'])}\n\n{folder}/peers.csv, peers.json, peers.png, peers.svg")


def take_turns(cells, times):
    """Return {(code, order): results} of one round; subslide runs before and after GeoClaw, so that noise is shared."""
    import codes

    def ours():
        for order in (1, 2):
            for until in sorted({TIMES[-1], times[-1]}):
                run = codes.subslide(order, cells, [t for t in times if t <= until])
                found.setdefault(("subslide", order), []).append(run)

    found = {}
    ours()
    found["GeoClaw", 1] = [codes.geoclaw(cells, times)]
    ours()
    found["PyClaw", 1] = [codes.pyclaw(cells, times)]
    return found


def rows_of(rounds, true):
    """Return the rows of one grid: what it took until TIMES[-1] and END, and where the grains were."""
    rows = []
    for key in rounds[0]:
        results = [result for turn in rounds for result in turn[key]]
        about = results[0][:4]
        for time in sorted({t for result in results for t in result.frames}):
            frames = [result.frames[time] for result in results if time in result.frames]
            rows += rows_of_shape(about, time, frames[-1], true[results[0].model].frames[time])
            timed = [frame for frame in frames if frame.seconds > 0]
            if timed:
                rows += rows_of_cost(about, time, timed)
                rows += rows_of_ratios(about, time, rounds, key)
    return rows


def rows_of_shape(about, time, frame, true):
    """Return the rows of a profile: the front, the water's surface, and how far from a fine radial run it is."""
    import codes

    rows = []
    for threshold in (0.01, 0.03, 0.05):
        front = codes.front(frame, threshold)
        if front < frame.x[-1]:  # at the edge, grains have left the box
            rows.append(once(about, time, f"x_front_{100 * threshold:.0f}_percent", front, "m"))
    if time <= TIMES[-1]:
        rows.append(once(about, time, "profile_error", codes.difference(frame, true), "1"))
    if frame.max_abs_eta >= 0:
        rows.append(once(about, time, "max_abs_eta_on_axis", frame.max_abs_eta, "m"))
    return rows


def rows_of_cost(about, time, frames):
    """Return the rows of what a run took until a time."""
    return [
        spread(about, time, "seconds", [frame.seconds for frame in frames], "s"),
        once(about, time, "steps", frames[-1].steps, "1"),
        once(about, time, "cell_updates", frames[-1].updates, "1"),
        spread(about, time, "cell_updates_per_second", [f.updates / f.seconds for f in frames], "s-1"),
    ]


def rows_of_ratios(about, time, rounds, key):
    """Return the rows of a code over GeoClaw, formed within each round, where GeoClaw came so far."""
    updates, seconds = [], []
    for turn in rounds:
        peer = turn["GeoClaw", 1][0].frames.get(time)
        mine = [r.frames[time] for r in turn[key] if time in r.frames and r.frames[time].seconds > 0]
        if peer and mine and key[0] != "GeoClaw":
            speed = statistics.mean(frame.updates / frame.seconds for frame in mine)
            updates.append(speed / (peer.updates / peer.seconds))
            seconds.append(peer.seconds / statistics.mean(frame.seconds for frame in mine))
    if not updates:
        return []
    return [
        spread(about, time, "cell_updates_per_second_over_geoclaw", updates, "1"),
        spread(about, time, "geoclaw_seconds_over_this", seconds, "1"),
    ]


def machine():
    """Return what the numbers depend on: processor, load, compilers, versions, and the values of each case."""
    import codes
    import install
    import numba
    import numpy

    import subslide

    info = Path("/proc/cpuinfo")
    lines = info.read_text(encoding="utf-8").splitlines() if info.exists() else []
    names = [line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")]
    return {
        "cpu": names[0] if names else platform.processor(),
        "cores": os.cpu_count(),
        "load at start": round(os.getloadavg()[0], 2),
        "python": platform.python_version(),
        "subslide": subslide.__version__,
        "sources": subslide.source_hash(),
        "numba": numba.__version__,
        "numpy": numpy.__version__,
        **install.versions(),
        "GeoClaw": codes.CASE | codes.GEOCLAW_CASE,
        "PyClaw": codes.CASE | codes.PYCLAW_CASE,
    }


if __name__ == "__main__":
    os.environ["NUMBA_NUM_THREADS"] = "1"  # before numba is loaded: one core for every code
    sys.exit(main())
