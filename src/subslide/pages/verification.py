"""What a study of exact solutions shows, line by line, and whether the required orders are reached."""

import json
import math
from pathlib import Path
from typing import NamedTuple

import pandas as pd

from subslide import scenes
from subslide.keys.schema import ConfigError
from subslide.pages import renewal as marks
from subslide.tables import errors

GROUP = ["case", "quantity", "scheme", "order", "front_flux", "wave_speeds", "dtype"]
START, END = "<!-- table of the last run -->", "<!-- end of the table -->"
HEADINGS = ("case", "quantity", "scheme", "order", "cells", "errors", "observed", "expected", "verdict")


class Line(NamedTuple):
    """One line: what was solved, errors at each grid, the order from the coarsest to the finest, and the verdict."""

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
        """Entries as text, by HEADINGS."""
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


def lines(table: pd.DataFrame) -> list[Line]:
    """Lines of a table of errors, in its order: the last time of each run speaks for it.

    The order is that from the coarsest grid to the finest, as the requirements are stated.
    """
    table = table.assign(case=[case(row) for row in table.itertuples()])
    last = table[table["time"] == table.groupby([*GROUP, "cells"])["time"].transform("max")]
    return [line(rows.sort_values("cells")) for _, rows in last.groupby(GROUP, sort=False)]


def line(rows: pd.DataFrame) -> Line:
    """Line of the rows, sorted by cells, of one scheme on several grids."""
    first, last = rows.iloc[0], rows.iloc[-1]
    p = errors.order_between(first, last) if len(rows) > 1 else math.nan
    word = last["verdict"]
    if word in (errors.REACHED, errors.BELOW):
        word = errors.REACHED if p >= last["expected_order"] else errors.BELOW
    if not rows["error"].notna().all():
        word = errors.FAILED
    elif (rows["verdict"] == errors.MOVED).any():
        word = errors.MOVED
    required = any(key in (last["scene"], f"{last['scene']} {last['model']}") for key in errors.REQUIRED)
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
        missed=(required or still) and word not in (errors.REACHED, errors.STILL),
    )


def case(row) -> str:
    """Name of a row's scene, model and options that are not at their defaults."""
    defaults = scenes.defaults(row.scene)
    told = [
        value if isinstance(value, str) else f"{name} {value:g}"
        for name, value in json.loads(row.options).items()
        if isinstance(value, str) or (value != defaults.get(name) and name != "amplitude")
    ]
    return ", ".join([f"{row.scene} ({row.model})", *told])


def report(results_folder: Path) -> tuple[str, list[Line]]:
    """Aligned text of the table of errors of a study, and the lines that miss what is required."""
    found = lines(read(results_folder))
    entries = [HEADINGS, *(line.words() for line in found)]
    widths = [max(map(len, column)) for column in zip(*entries, strict=True)]
    text = "\n".join(
        "  ".join(word.ljust(width) for word, width in zip(words, widths, strict=True)).rstrip()
        for words in entries
    )
    return text, [line for line in found if line.missed]


def read(folder: Path) -> pd.DataFrame:
    """Table of errors of a study's folder; ConfigError unless it has rows."""
    path = folder / "tables/errors.csv"
    if not path.is_file():
        raise ConfigError(
            f"{path}: there is no such file; allowed: the folder of a study with exact solutions"
        )
    table = pd.read_csv(path)
    if table.empty:
        raise ConfigError(f"{path} has no rows: no run has a known answer; allowed: a study such as accuracy")
    return table


def page(text: str, folder: Path) -> str:
    """The page of documentation `text` with the table of a study between its two marks."""
    return marks.renewed(text, START, END, [HEADINGS, *(line.words() for line in lines(read(folder)))])
