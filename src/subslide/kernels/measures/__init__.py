"""What is measured of a state at every step: a file a measure, found by listing this folder, compiled into the loops.

A measure has `SERIES`, {name of `naming.SERIES`: `Series`}, and a kernel function `measure(s, c, mesh, watch, span)`
that returns their values for one row as a tuple of float64: of the whole state on a radius or line, of each row in the
plane, where the values of rows join as `Series` says. `c` are the row's `Cells`, `mesh` its sizes, `span` a `RowSpan`.
"""

from importlib import import_module
from pathlib import Path
from typing import NamedTuple

from subslide.kernels.jit import inlined
from subslide.kernels.measures._series import LARGEST, SMALLEST, SUM, Scales, Series  # noqa: F401

NAMES = sorted(path.stem for path in Path(__file__).parent.glob("[a-z]*.py"))
MODULES = {name: import_module(f"{__name__}.{name}") for name in NAMES}
SERIES: dict[str, Series] = {name: series for m in MODULES.values() for name, series in m.SERIES.items()}
"""Every series that is measured on rows, in the order of the values."""

COUNT = len(SERIES)
JOINS = tuple(series.join for series in SERIES.values())
STARTS = tuple(float(series.start) for series in SERIES.values())
PLACE = {name: place for place, name in enumerate(SERIES)}
"""Place of each series among the values of a row."""


class RowSpan(NamedTuple):
    """Columns of a row: [low, high) not still, and [wet_low, wet_high) with grains.

    The surface is watched in [start, stop), of which [inside_start, inside_stop) are within R.
    """

    low: int
    high: int
    wet_low: int
    wet_high: int
    start: int
    inside_start: int
    inside_stop: int
    stop: int


def _then(before, module, first):
    """Return a function that fills what `before` fills, and then the values of a module from the place `first` on."""
    measure = module.measure

    @inlined
    def fill(s, c, mesh, watch, span, values, offset):
        before(s, c, mesh, watch, span, values, offset)
        measured = measure(s, c, mesh, watch, span)
        for n in range(len(measured)):
            values[offset + first + n] = measured[n]

    return fill


@inlined
def _nothing(s, c, mesh, watch, span, values, offset):
    """Fill nothing."""


def _all():
    """Return a kernel function that fills values[offset:] with every measure of a row, in the order of SERIES."""
    fill, first = _nothing, 0
    for module in MODULES.values():
        fill = _then(fill, module, first)
        first += len(module.SERIES)
    return fill


fill = _all()


@inlined
def start_joining(values, offset):
    """Set values[offset:] to what the values of rows are joined to."""
    for n in range(COUNT):
        values[offset + n] = STARTS[n]


@inlined
def join(values, offset, row, row_offset):
    """Join the values of a row, row[row_offset:], to values[offset:]."""
    for n in range(COUNT):
        value = row[row_offset + n]
        if JOINS[n] == SUM:
            values[offset + n] += value
        elif JOINS[n] == LARGEST:
            values[offset + n] = max(values[offset + n], value)
        else:
            values[offset + n] = min(values[offset + n], value)
