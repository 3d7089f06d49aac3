"""The roofline: operations a second of each kernel against its operations a byte, under what the core can do."""

from counts import CHEAP, DIVISION, ROOT, count
from machine import limits
from table import rows_of

BYTES = {"float64": 8, "float32": 4}
EDGE_NUMBERS = 12 + 2 * 6
"""An edge's twelve arrays are read, its six fluxes written, and a written line is read first."""

KERNELS = ("C edge loop", "numba edge loop", "plane, first order", "plane, second order")


def rows_of_limits(dtypes, **sizes):
    """Return rows: bandwidth and rates of operations that one core reaches."""
    rows = []
    for dtype in dtypes:
        for name, value in limits(dtype, **sizes).items():
            rows += rows_of(
                "machine", name, value / 1e9, "1e9 B/s" if name == "bandwidth" else "1e9 flop/s", dtype=dtype
            )
    return rows


def rows_of_kernels(rows):
    """Return rows for each kernel that `rows` timed: operations and bytes of an edge or a cell, operations a second.

    The ceiling is the rate at which a core could do nothing but the kernel's divisions and roots, all else for free. In
    the plane every cell counts as a general one (see `step_counts`), which the solver need not do: its rate is that of
    the work asked for, not done, and may lie above its ceiling.
    """
    counts = count()
    found = []
    for dtype in dict.fromkeys(row.dtype for row in rows if row.benchmark == "machine"):
        can = {row.quantity: row.value for row in rows if row.benchmark == "machine" and row.dtype == dtype}
        for kernel, (operations, numbers, rate) in timed(rows, dtype, counts).items():
            total = sum(operations.values())
            slow = operations[DIVISION] / can["divisions"] + operations[ROOT] / can["square_roots"]
            per = "edge" if "edge" in kernel else "cell"
            values = {
                f"flops_per_{per}": (total, "1"),
                f"divisions_and_roots_per_{per}": (total - operations[CHEAP], "1"),
                f"bytes_per_{per}": (numbers * BYTES[dtype], "B"),
                "flops_per_byte": (total / (numbers * BYTES[dtype]), "1/B"),
                "flop_rate": (total * rate / 1e3, "1e9 flop/s"),
                "ceiling": (total / slow, "1e9 flop/s"),
            }
            for quantity, (value, unit) in values.items():
                found += rows_of(f"roofline: {kernel}", quantity, value, unit, scheme="ifcph", dtype=dtype)
    return found


def timed(rows, dtype, counts):
    """Return {kernel: (operations, numbers moved, million edges or cells a second)} of those that were timed."""
    found = {}
    for row in rows:
        key = (row.benchmark, row.quantity, row.model, row.order)
        if row.dtype != dtype:
            continue
        if key == ("edge", "c_rate", "", ""):
            found[KERNELS[0]] = counts["edge"], EDGE_NUMBERS, row.value
        elif key == ("edge", "numba_rate", "", ""):
            found[KERNELS[1]] = counts["edge"], EDGE_NUMBERS, row.value
        elif key[:3] == ("loop", "edge_rate", "plane"):
            step = counts["plane"][str(row.order)]
            found[KERNELS[1 + row.order]] = step["operations"], step["numbers"], row.value / 2
    return found
