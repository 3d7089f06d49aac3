"""What the source paper says of its results (sections 4 and 5), held against the tables of a study.

A claim is a function of the `Evidence` of one kind of numerics. It compares numbers, and its verdict follows from them
and their bands alone.
"""

import textwrap
from pathlib import Path

import pandas as pd

from subslide.files import write_text
from subslide.keys.schema import ConfigError
from subslide.results import Results
from subslide.tables._claims import grains, page, surface
from subslide.tables._claims.evidence import Evidence
from subslide.tables._claims.verdicts import OPEN, REFUTED, SUPPORTED

CLAIMS = (*grains.CLAIMS, *surface.CLAIMS)
KINDS = {"paper": "paper_numerics", "resolved": "resolved"}
"""Numerics that are judged, and the columns they have."""

COLUMNS = {
    "claim": ("", "what the paper says, in short"),
    "section": ("", "of the paper"),
    "measure": ("", "what was computed; it names the unit of the numbers"),
    **{
        f"{column}{part}": ("", text)
        for kind, column in KINDS.items()
        for part, text in (
            ("", f"numbers with numerics `{kind}`: ± is the band, ±? a value without one"),
            ("_as_computed", "verdict on these numbers as they are"),
            ("_verdict", f"verdict beyond the bands: `{SUPPORTED}`, `{REFUTED}` or `{OPEN}`"),
        )
    },
}


def judged(results: Results) -> pd.DataFrame:
    """Table of claims, by the columns of `COLUMNS`; those that the study cannot judge are left out."""
    evidence = {column: Evidence(results, kind) for kind, column in KINDS.items()}
    rows = []
    for claim in CLAIMS:
        row = {"claim": claim.words, "section": claim.section, "measure": claim.measure}
        for column, given in evidence.items():
            found = claim.judge(given) if len(given.runs) else None
            if found:
                parts = (found.stated(), found.verdict(banded=False), found.verdict())
                row |= dict(zip((column, f"{column}_as_computed", f"{column}_verdict"), parts, strict=True))
        if len(row) > 3:
            rows.append(row)
    return pd.DataFrame(rows, columns=list(COLUMNS), dtype=object).fillna("")


def write(folder: Path) -> tuple[list[Path], str]:
    """Paths of the table of claims of the study in `folder` and of its page, newly written, and the same as text."""
    if not (folder / "tables" / "runs.csv").is_file():
        raise ConfigError(f"{folder}: it has no tables/runs.csv; allowed: the folder of a finished study")
    table = judged(Results(folder))
    if table.empty:
        raise ConfigError(
            f"{folder}: it has no runs that a claim speaks of; allowed: a study with numerics {' or '.join(KINDS)}"
        )
    paths = [folder / "tables" / f"claims.{kind}" for kind in ("csv", "html")]
    write_text(paths[0], table.to_csv(index=False, lineterminator="\n"))
    write_text(paths[1], page.html(table, KINDS))
    return paths, text(table)


def text(table: pd.DataFrame, width: int = 110) -> str:
    """The table of claims as lines to read: each claim, what was computed, numbers and verdicts."""
    lines = []
    for row in table.to_dict("records"):
        lines += [f"{row['claim']} [section {row['section']}]", *_hung("measure", row["measure"], width)]
        for kind, column in KINDS.items():
            if row[column]:
                verdict = f"{row[f'{column}_verdict'].upper()} (as computed: {row[f'{column}_as_computed']})"
                lines += _hung(kind, f"{verdict}. {row[column]}", width)
        lines.append("")
    return "\n".join(lines).rstrip()


def _hung(name: str, words: str, width: int) -> list[str]:
    """Lines of a paragraph that hangs from its name."""
    return textwrap.wrap(words, width, initial_indent=f"  {name:9s} ", subsequent_indent=" " * 12)
