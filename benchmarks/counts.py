"""Floating-point operations and memory traffic of the plane's step, counted by running the kernels as plain Python.

Numbers that count replace floats, and arrays that note who reads and writes them replace arrays, so the counts follow
the kernels when these change. Counted are +, -, *, /, and square roots, one each; not counted are min, max, abs,
comparisons, choices and changes of sign. Both branches of a conditional expression cost time but one is counted.
Run as a program, which prints JSON, because numba has to be told before it is imported that it shall not compile.
"""

import json
import math
import os
import subprocess
import sys
from collections import Counter
from types import SimpleNamespace

import numpy as np

CHEAP, DIVISION, ROOT = "add_multiply", "division", "square_root"
counted = Counter()


class Number(float):
    """A float whose arithmetic is counted, and gives counting floats."""

    dtype = np.dtype(np.float64)  # what np.finfo takes the type for


def counting(name, kind):
    plain = getattr(float, name)

    def method(self, *others):
        counted[kind] += 1
        return Number(plain(self, *others))

    setattr(Number, name, method)


for name in ("__add__", "__radd__", "__sub__", "__rsub__", "__mul__", "__rmul__"):
    counting(name, CHEAP)
for name in ("__truediv__", "__rtruediv__"):
    counting(name, DIVISION)
Number.__abs__ = lambda self: Number(float.__abs__(self))
Number.__neg__ = lambda self: Number(float.__neg__(self))


def root(x):
    """Return the square root, counted."""
    counted[ROOT] += 1
    return Number(math.sqrt(x))


COUNTING_MATH = SimpleNamespace(
    sqrt=root,
    copysign=lambda x, y: Number(math.copysign(x, y)),
    isfinite=math.isfinite,
    tan=math.tan,
    exp=math.exp,
)


class Traced:
    """An array that notes under its name that it was read or written."""

    def __init__(self, values, name, reads, writes):
        self.values, self.name, self.reads, self.writes = values, name, reads, writes
        self.shape = values.shape

    def __getitem__(self, index):
        if self.values.ndim == 2 and not isinstance(index, tuple):
            return Traced(self.values[index], self.name, self.reads, self.writes)
        self.reads.add(self.name)
        return Number(self.values[index])

    def __setitem__(self, index, value):
        self.writes.add(self.name)
        self.values[index] = value


def traced(kind, shape, prefix, reads, writes, fill):
    """Return a named tuple of `Traced` arrays of that shape, each cell `fill(field)`."""
    return kind(
        *(Traced(np.full(shape, fill(field)), f"{prefix}.{field}", reads, writes) for field in kind._fields)
    )


def settings(order):
    """Return the scaled numbers of the paper's column, those that are not flags counting."""
    from subslide.models.build import build
    from subslide.points import Point

    found = build(Point(model="radial", order=order), 100, 1e-6).settings
    return type(found)(*(Number(value) if isinstance(value, float) else value for value in found))


def edge_counts():
    """Return the operations of one wet edge."""
    from subslide.kernels.edge.roe_matrix import Normal
    from subslide.kernels.edge.two_layers import edge_fluxes

    w_i = [Number(x) for x in (1.2, 0.1, 0.7, 0.3)]
    w_j = [Number(x) for x in (1.3, -0.2, 0.5, 0.1)]
    bounds = Number(-1.6), Number(1.7)
    counted.clear()
    edge_fluxes(settings(1), False, *bounds, Normal(*w_i), Normal(*w_j), Number(-0.1))
    return dict(counted)


def step_counts(order, n=6):
    """Return for each part of the plane's step its operations a cell, and the arrays it reads and writes.

    The cell is the general one: two layers, wet, moving, under no film. The solver spends less on one without grains
    (its water alone) and nothing on one at rest (outside the spans). At first order the states at faces are the cells'
    own; at second order they are not among the arrays: rows are worked on in blocks so that these stay in a core's
    cache.
    """
    from subslide.kernels import planar, planar_faces
    from subslide.kernels.active import LAST, SPANS, WET_LAST
    from subslide.kernels.advance_planar import row_fluxes
    from subslide.kernels.arrays import (
        BEFORE,
        GHOSTS,
        Cells,
        CellTerms,
        Fluxes,
        Side,
        flux_row,
        row_of,
        side_row,
        side_row_turned,
    )

    reads, writes = set(), set()
    values = {
        "h1": 1.2,
        "h2": 0.7,
        "eta": 1.9,
        "slow_x": -1.4,
        "slow_y": -1.4,
        "fast_x": 1.5,
        "fast_y": 1.5,
        "keep1": 1,
        "keep2": 1,
    }

    def arrays(kind, shape, prefix):
        return traced(kind, shape, prefix, reads, writes, lambda field: values.get(field, 0.1))

    padded = (n + 2 * GHOSTS,) * 2
    s = settings(order)
    c, terms = arrays(Cells, padded, "cell"), arrays(CellTerms, padded, "term")
    fx, fy = arrays(Fluxes, (n, n + 1), "x"), arrays(Fluxes, (n + 1, n), "y")
    spans = np.zeros((padded[0], SPANS), np.int64)
    spans[:, [LAST, WET_LAST]] = padded[1]  # every cell moves and has grains
    dt, j, row = Number(0.01), n // 2, n // 2 + GHOSTS
    if order == 1:
        left = right = lower = upper = Side(*(getattr(c, field) for field in Side._fields))
        old, now = row - 1, row
    else:
        left, right, lower, upper = (arrays(Side, (2, padded[1]), "cache") for _ in range(4))
        old, now = 1, 0
    whole, film = (0, n), False  # water so deep is not looked at for steps that overtop it

    def fluxes():
        if order != 1:
            planar_faces.faces(s, c, terms, row, (left, right, lower, upper), now, now, 0, n, dt)
        planar.fill_stuck(s, c, fx.stuck[j], (row, row), BEFORE, 1, 0, n, dt)
        slow, fast = (c.slow_x[row],) * 2, (c.fast_x[row],) * 2
        before, after = side_row(right, now), side_row(left, now)
        row_fluxes(s, flux_row(fx, j), slow, fast, before, after, BEFORE, 1, whole, whole, film)
        planar.fill_stuck(s, c, fy.stuck[j], (row - 1, row), GHOSTS, 0, 0, n, dt)
        slow, fast = (c.slow_y[row - 1], c.slow_y[row]), (c.fast_y[row - 1], c.fast_y[row])
        before, after = side_row_turned(upper, old), side_row_turned(lower, now)
        row_fluxes(s, flux_row(fy, j), slow, fast, before, after, GHOSTS, 0, whole, whole, film)

    parts = {
        "survey": lambda: planar.cell_speeds(s, row_of(c, row), 0, n),
        "fluxes": fluxes,
        "terms": lambda: planar.fill_terms(s, c, fx, fy, terms, spans, j, dt),
        "update": lambda: planar.update(s, c, fx, fy, terms, spans, j, dt, dt),
    }
    found = {}
    for name, work in parts.items():
        reads.clear(), writes.clear(), counted.clear()
        work()
        streams = {
            name: sorted(x for x in group if not x.startswith("cache"))
            for name, group in (("reads", reads), ("writes", writes))
        }
        found[name] = {"operations": {kind: count / n for kind, count in counted.items()}, **streams}
    return found


def numbers_moved(part):
    """Return how many numbers a cell come from or go to memory: written lines are read first."""
    return len(set(part["reads"]) | set(part["writes"])) + len(part["writes"])


def count():
    """Return {"edge": operations, "plane": {order: {"operations": a cell, "numbers": a cell, "parts": ...}}}."""
    done = subprocess.run(
        [sys.executable, __file__],
        env=os.environ | {"NUMBA_DISABLE_JIT": "1"},
        capture_output=True,
        text=True,
        check=False,
    )
    if done.returncode:
        raise ValueError(f"counting operations failed: {done.stderr.strip().splitlines()[-1:]}")
    found = json.loads(done.stdout)
    for order, parts in found["plane"].items():
        total = sum((Counter(part["operations"]) for part in parts.values()), Counter())
        found["plane"][order] = {
            "operations": dict(total),
            "numbers": sum(numbers_moved(part) for part in parts.values()),
            "parts": parts,
        }
    return found


def main():
    """Nothing; the counts are printed."""
    import subslide.kernels.planar  # noqa: F401

    for name, module in list(sys.modules.items()):
        if name.startswith("subslide.kernels") and hasattr(module, "math"):
            module.math = COUNTING_MATH
    print(json.dumps({"edge": edge_counts(), "plane": {order: step_counts(order) for order in (1, 2)}}))


if __name__ == "__main__":
    main()
