"""Whole runs: the time loop beside C, for each model, order, scheme and precision, and how its cost grows."""

import itertools
import json
import os
import statistics
import subprocess
import sys

import numpy as np
from reference import PLANE, c_reference, fluxes_like, numba_reference, plane_edges
from table import rows_of
from timing import rate_of, ratio, spread, take_turns

from subslide.keys.names import SCHEMES
from subslide.models.build import build
from subslide.points import Point
from subslide.solver import DRY_DEPTH, solve
from subslide.study import choice

END = 0.54
"""Last time of the paper's figures (s)."""

GRIDS = {
    "one-layer": (100, 200, 400, 800),
    "radial": (100, 200, 400, 800),
    "quarter": (100, 200, 400),
    "plane": (100, 200, 400),
}
EDGES_PER_CELL = {"one-layer": 1, "radial": 1, "quarter": 2, "plane": 2}


def point_of(model, order, dtype="float64", cells=200, scheme="ifcph", t_end=END):
    """Return the paper's column, a_H = 1, for these numerics; the loop does not stop for snapshots on the way."""
    return Point(
        model=model,
        order=order,
        dtype=dtype,
        cells=cells,
        scheme=scheme,
        t_end=t_end,
        snapshot_times=(),
    )


def solved(point, threads=1):
    """Return (steps, seconds of the time loop, cells); ValueError where the run did not end well."""
    run = solve(point, threads=threads)
    if run.status != "ok":
        raise ValueError(f"a benchmark's run failed: {point.model}, order {point.order}: {run.status_detail}")
    return run.steps, run.wall_seconds, run.x.shape[-1] ** (2 if point.model in ("plane", "quarter") else 1)


def edge_rate(point, seconds=0.0):
    """Return a function that runs the point for at least that long and gives edges/s of the whole time loop."""

    def rate():
        edges = wall = 0.0
        while edges == 0 or wall < seconds:
            steps, loop, cells = solved(point)
            edges += steps * cells * EDGES_PER_CELL[point.model]
            wall += loop
        return edges / wall

    return rate


def edge_functions(dtypes, rounds, cells=PLANE):
    """Return rows: million edges/s of the C reference and of the numba edge loop, and their ratio."""
    rows = []
    for dtype in dtypes:
        edges = plane_edges(dtype, cells)
        out = fluxes_like(edges)
        n = len(edges.stuck)
        about = {"scheme": "ifcph", "dtype": dtype, "cells": cells}
        rates = {"c": rate_of(c_reference(edges, out), n), "numba": rate_of(numba_reference(edges, out), n)}
        measured = take_turns(rates, rounds, "c")
        for name in rates:
            rate = spread([value / 1e6 for value in measured[name]])
            rows += rows_of("edge", f"{name}_rate", rate, "1e6 edges/s", **about)
        rows += rows_of("edge", "numba_over_c", spread(measured["numba", "c"]), **about)
    return rows


def beside_c(dtypes, rounds):
    """Return rows: the whole time loop's edges/s over the C reference's, and float32's over float64's.

    Runs go to END: in the first steps most cells are still at rest, which cost nothing, and a short run would flatter.
    """
    rows = []
    edges = plane_edges("float64")
    reference = rate_of(c_reference(edges, fluxes_like(edges)), len(edges.stuck))
    points = {
        ("plane", order, dtype): point_of("plane", order, dtype, PLANE)
        for order in (1, 2)
        for dtype in dtypes
    } | {("radial", order, dtype): point_of("radial", order, dtype) for order in (1, 2) for dtype in dtypes}
    rates = {key: edge_rate(point, 0.1) for key, point in points.items()}
    measured = take_turns({"c": reference} | rates, rounds, "c")
    for (model, order, dtype), point in points.items():
        about = {"model": model, "order": order, "scheme": "ifcph", "dtype": dtype, "cells": point.cells}
        key = (model, order, dtype)
        rate = spread([value / 1e6 for value in measured[key]])
        rows += rows_of("loop", "edge_rate", rate, "1e6 edges/s", **about)
        if dtype == "float64":
            rows += rows_of("loop", "over_c", spread(measured[key, "c"]), **about)
        else:
            rows += rows_of("loop", "over_float64", ratio(measured, key, (model, order, "float64")), **about)
    return rows


def speeds(cases):
    """Return rows of each case (model, order, scheme, dtype, cells): steps, seconds a run, cell updates a second."""
    rows = []
    for model, order, scheme, dtype, cells in cases:
        point = point_of(model, order, dtype, cells, scheme)
        steps, first, count = solved(point)
        seconds = [first]
        while len(seconds) < 9 and sum(seconds) < 0.5:
            seconds.append(solved(point)[1])
        wall = statistics.median(seconds)
        about = {"model": model, "order": order, "scheme": scheme, "dtype": dtype, "cells": cells}
        rows += rows_of("run", "steps", steps, **about)
        rows += rows_of("run", "seconds", wall, "s", **about)
        rows += rows_of("run", "cell_rate", steps * count / wall / 1e6, "1e6 cells/s", **about)
    return rows


def all_cases(dtypes):
    """Return all models, orders, precisions and grids for the paper's scheme, and other schemes on one grid."""
    grids = [(model, cells) for model, sizes in GRIDS.items() for cells in sizes]
    cases = [
        (model, order, "ifcph", dtype, cells)
        for (model, cells), order, dtype in itertools.product(grids, (1, 2), dtypes)
    ]
    others = [(model, 2, scheme, "float64", 200) for model in ("radial", "plane") for scheme in SCHEMES]
    return cases + [case for case in others if case[2] != "ifcph" and (case[0] == "radial" or is_lean(case))]


def is_lean(case):
    """Return whether a case needs no kernels but those that the paper's scheme needs: others take long to compile."""
    model, order, scheme, dtype, cells = case
    return not choice.of(point_of(model, order, dtype, cells, scheme)).general


def growth(rows):
    """Return rows: the exponent p of seconds ~ cells^p, fitted to the three finest grids of each model and order."""
    found = {}
    for row in rows:
        if (row.benchmark, row.quantity, row.scheme) == ("run", "seconds", "ifcph"):
            found.setdefault((row.model, row.order, row.dtype), []).append((row.cells, row.value))
    fits = []
    for (model, order, dtype), pairs in found.items():
        finest = sorted(pairs)[-3:]
        if len(finest) > 1:
            cells, seconds = np.log(np.array(finest)).T
            about = {"model": model, "order": order, "scheme": "ifcph", "dtype": dtype}
            fits += rows_of("growth", "exponent", np.polyfit(cells, seconds, 1)[0], **about)
    return fits


def memory(dtypes):
    """Return rows: bytes a cell of all arrays that a model holds."""
    rows = []
    for model, dtype in itertools.product(EDGES_PER_CELL, dtypes):
        point = point_of(model, 2, dtype)
        half = -(-point.cells // 2)
        held = build(point, half, DRY_DEPTH)
        cells = len(held.x) ** held.dimensions if model in ("plane", "quarter") else len(held.x)
        blocks = {id(block): block.nbytes for block in map(block_of, arrays_in(vars(held)))}
        total = sum(blocks.values())
        rows += rows_of(
            "memory", "bytes_per_cell", total / cells, "B", model=model, dtype=dtype, cells=point.cells
        )
    return rows


def arrays_in(value):
    """Return the arrays within nested dictionaries and tuples."""
    if isinstance(value, np.ndarray):
        return [value]
    parts = value.values() if isinstance(value, dict) else value if isinstance(value, tuple) else ()
    return [array for part in parts for array in arrays_in(part)]


def block_of(array):
    """Return the array that holds the memory of another, or itself."""
    while isinstance(array.base, np.ndarray):
        array = array.base
    return array


def threads(cells, rounds, order=2, many=2):
    """Return rows: how many times faster `many` threads are than one, on a plane for about a hundred steps."""
    command = [sys.executable, __file__, str(cells), str(rounds), str(order), str(many)]
    environment = os.environ | {"NUMBA_NUM_THREADS": str(many)}
    done = subprocess.run(command, capture_output=True, text=True, env=environment, check=False)
    if done.returncode:
        raise ValueError(f"{' '.join(command)} failed: {done.stderr.strip()}")
    values = json.loads(done.stdout)
    about = {"model": "plane", "order": order, "scheme": "ifcph", "dtype": "float64", "cells": cells}
    speed_up = spread([b / a for a, b in zip(values["1"], values[str(many)], strict=True)])
    rows = rows_of("threads", "speed_up", speed_up, **about, threads=many)
    for count, rates in values.items():
        rate = spread([value / 1e6 for value in rates])
        rows += rows_of("threads", "cell_rate", rate, "1e6 cells/s", **about, threads=int(count))
    return rows


def threads_here(cells, rounds, order, many):
    """Return {threads: [cell updates/s]} of this process, whose numba may use `many` threads; they take turns."""
    point = point_of("plane", order, cells=cells, t_end=32 / cells)
    rates = {}
    for count in (1, many):

        def rate(count=count):
            steps, wall, total = solved(point, count)
            return steps * total / wall

        rates[str(count)] = rate
    return take_turns(rates, rounds)


if __name__ == "__main__":
    arguments = [int(text) for text in sys.argv[1:]]
    print(json.dumps(threads_here(*arguments)))
