"""Pages that quote indices and laws: their tables are those of the last run of a study with Saltelli designs."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

from subslide.pages import renewal
from subslide.results import Results

if TYPE_CHECKING:
    import pandas as pd

INDICES = ("<!-- indices of the last run -->", "<!-- end of the indices -->")
PAIRS = ("<!-- pairs of the last run -->", "<!-- end of the pairs -->")
LAWS = ("<!-- laws of the last run -->", "<!-- end of the laws -->")
MARKS = (INDICES, PAIRS, LAWS)


def page(text: str, results: Results) -> str:
    """Return the page `text` with those of a study's tables that it has marks for; ConfigError if it has none."""
    rows = {INDICES: indices, PAIRS: pairs, LAWS: laws}
    for marks in renewal.marked(text, MARKS):
        text = renewal.renewed(text, marks, rows[marks](results))
    return text


def indices(results: Results) -> Iterator[tuple[str, ...]]:
    """Give first-order and total indices of each design and output, with their bands, the headings first."""
    yield ("design", "output", "input", "first order", "total", "half-widths for sampling", "for grid error")
    rows = results.table("indices")
    for (design, output), some in rows.groupby(["design", "output"], sort=False):
        first, total = (some[some["kind"] == kind].set_index("input") for kind in ("first", "total"))
        for name in first.index:
            parts = (first.loc[name], total.loc[name])
            sampling, grid = (
                ", ".join(f"{part[column]:.3f}" for part in parts) for column in ("sampling", "grid")
            )
            yield (str(design), f"`{output}`", f"`{name}`", *map(_banded, parts), sampling, grid)


def pairs(results: Results) -> Iterator[tuple[str, ...]]:
    """Give second-order and closed indices of each pair, with their bands, the headings first."""
    yield ("design", "output", "pair", "second order", "closed")
    rows = results.table("indices")
    for (design, output), some in rows.groupby(["design", "output"], sort=False):
        second, closed = (
            some[some["kind"] == kind].set_index(["input", "other"]) for kind in ("second", "closed")
        )
        for pair in second.index:
            named = ", ".join(f"`{name}`" for name in pair)
            yield (str(design), f"`{output}`", named, _banded(second.loc[pair]), _banded(closed.loc[pair]))


def laws(results: Results) -> Iterator[tuple[str, ...]]:
    """Give the power laws of each design, with bands and errors, the headings first."""
    yield (
        "design",
        "law",
        "source",
        "term",
        "value",
        "band",
        "median error",
        "95 % of errors",
        "variance explained",
    )
    for _, row in results.table("laws").iterrows():
        ours = row["low"] == row["low"]
        quality = ("error_median", "error_95", "explained")
        yield (
            str(row["design"]),
            row["law"],
            row["source"],
            f"`{row['term']}`",
            f"{row['value']:.3g}",
            f"{row['low']:.3g} to {row['high']:.3g}" if ours else "",
            *(f"{100 * row[name]:.1f} %" if ours else "" for name in quality),
        )


def _banded(row: "pd.Series") -> str:
    """Return an index and its band."""
    return f"{row['estimate']:.3f} ({row['low']:.3f} to {row['high']:.3f})"
