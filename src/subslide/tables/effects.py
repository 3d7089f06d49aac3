"""Main effects: the mean of each answer along each input, over all others."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

from subslide.sensitivity.effects import BINS, effect
from subslide.tables import _answers, _saltelli
from subslide.tables._saltelli import needs as needs

if TYPE_CHECKING:
    from subslide.results import Results

TITLE = "Main effects"
READS = ("records", "runs")
FLOAT_FORMAT = "%.6g"
ABOUT = f"""One row for each Saltelli design, output of indices.csv, input and one of {BINS} parts of equal probability
of the input's range: means over all other inputs. The variance of these means is what the first-order index is a share
of."""
COLUMNS = {
    **_saltelli.COLUMNS,
    "output": ("", "answer, see indices.csv"),
    "input": ("", "input"),
    "value": ("", "mean of the input in the part (an angle in degrees)"),
    "mean": ("", "mean of the output there"),
    "low": ("", "lower end of the 95 % band: of sampling, grid error and failed runs"),
    "high": ("", "upper end"),
    "sampling": ("", "half-width for sampling alone"),
    "grid": ("", "half-width for grid error alone; empty in a study without bands"),
}
WORDS = ("inputs", "others", "output", "input")


def table(results: "Results") -> Iterator[dict]:
    """Give the rows, by column."""
    listed = _answers.once(results)
    for design in _saltelli.designs(results):
        for answer in _saltelli.answers(design, listed):
            for n, name in enumerate(design.names):
                result = effect(answer.values, design.inputs[..., n], answer.half_widths)
                columns = ("value", "mean", "low", "high", "sampling", "grid")
                for values in zip(*(getattr(result, column) for column in columns), strict=True):
                    row = dict(zip(columns, map(float, values), strict=True))
                    yield {**design.first, "output": answer.name, "input": name, **row}
