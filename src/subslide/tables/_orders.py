"""What a table of errors shows, line by line, and whether the required orders are reached."""

import json
import math
from typing import TYPE_CHECKING, Any, NamedTuple

from subslide import scenes
from subslide.tables import _verdicts as verdicts
from subslide.tables._aligned import aligned

if TYPE_CHECKING:
    import pandas as pd

GROUP = ["case", "quantity", *(key for key in verdicts.METHOD if key not in ("model", "cells"))]
"""Columns that tell lines apart: a case names its model, and cells are what a line runs over."""

HEADINGS = ("case", "quantity", "scheme", "order", "cells", "errors", "observed", "expected", "verdict")


class Line(NamedTuple):
    """What was solved, its errors on each grid, the order from the coarsest to the finest, and the verdict."""

    case: str
    quantity: str
    scheme: str
    order: int
    cells: list[int]
    errors: list[float]
    observed: float
    expected: float
    verdict: str
    missed: bool

    def words(self) -> tuple[str, ...]:
        """Return the entries as text, by HEADINGS."""
        return (
            self.case,
            self.quantity,
            self.scheme,
            str(self.order),
            "/".join(map(str, self.cells)),
            " ".join(f"{error:.3g}" for error in self.errors),
            "" if math.isnan(self.observed) else f"{round(self.observed, 2) + 0.0:.2f}",
            "" if math.isnan(self.expected) else f"{self.expected:g}",
            self.verdict,
        )


def lines(table: "pd.DataFrame") -> list[Line]:
    """Return the lines of a table of errors, in its order: the last time of each run speaks for it.

    The order is that from the coarsest grid to the finest, as the requirements are stated.
    """
    table = table.assign(case=[case(row) for row in table.itertuples()])
    last = table[table["time"] == table.groupby([*GROUP, "cells"])["time"].transform("max")]
    turn = (
        last.groupby([*GROUP, "cells"]).cumcount().rename("turn")
    )  # runs that differ in what no column here tells
    return [line(rows.sort_values("cells")) for _, rows in last.groupby([*GROUP, turn], sort=False)]


def line(rows: "pd.DataFrame") -> Line:
    """Return the line of the rows, sorted by cells, of one scheme on several grids."""
    first, last = rows.iloc[0], rows.iloc[-1]
    p = verdicts.order_between(first, last) if len(rows) > 1 else math.nan
    word = last["verdict"]
    if word in (verdicts.REACHED, verdicts.BELOW):
        word = verdicts.REACHED if p >= last["expected_order"] else verdicts.BELOW
    if not rows["error"].notna().all():
        word = verdicts.FAILED
    elif (rows["verdict"] == verdicts.MOVED).any():
        word = verdicts.MOVED
    required = any(key in (last["scene"], f"{last['scene']} {last['model']}") for key in verdicts.REQUIRED)
    still = last["quantity"] == "h2_change"
    return Line(
        case=last["case"],
        quantity=last["quantity"],
        scheme=last["scheme"],
        order=int(last["order"]),
        cells=[int(n) for n in rows["cells"]],
        errors=[float(error) for error in rows["error"]],
        observed=p,
        expected=float(last["expected_order"]),
        verdict=word,
        missed=(required or still) and word not in (verdicts.REACHED, verdicts.STILL),
    )


def case(row: Any) -> str:
    """Return the name of a row's scene, model and options that are not at their defaults."""
    defaults = scenes.defaults(row.scene)
    told = [
        value if isinstance(value, str) else f"{name} {value:g}"
        for name, value in json.loads(row.options).items()
        if isinstance(value, str) or (value != defaults.get(name) and name != "amplitude")
    ]
    return ", ".join([f"{row.scene} ({row.model})", *told])


def text(entries: list[Line]) -> str:
    """Return the lines as aligned text, with their headings."""
    return aligned([HEADINGS, *(line.words() for line in entries)])
