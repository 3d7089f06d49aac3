"""What the source paper says of its results (sections 4 and 5), held against the tables of a study.

A claim is a function of the `Evidence` of one kind of numerics. It compares numbers, and its verdict follows from them
and their bands alone.
"""

import textwrap
from typing import TYPE_CHECKING

from subslide.keys.schema import ConfigError
from subslide.study.config import Study
from subslide.tables._claims.words import OPEN, REFUTED, SUPPORTED

if TYPE_CHECKING:
    from subslide.results import Results

TITLE = "The paper's claims, held against this study"
CATEGORY = "6 The paper's claims"
READS = ("runs", "series", "bands")
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


def about() -> str:
    """Return what the documentation says of the table: how its verdicts are made."""
    return f"""One row for each thing that sections 4 and 5 of the source paper say of its results, in studies with
both numerics `paper` and `resolved`; `subslide claims results/<study>` writes it, claims.html beside it, and prints the
same. Each is broken down into comparisons, such as L_f at one r against the next. `{SUPPORTED}`: every one
holds by more than the bands of the values compared; `{REFUTED}`: one fails by more than that (or all fail, where
the paper says that something happens somewhere); else `{OPEN}`, also where a value that decides is not
converged. Without bands numbers count as they are. A claim is left out where the study lacks what it needs. Judged are
the runs that differ from the first of their numerics in a_H and r alone. Times have no bands of their own: that of the
front's arrival is what the band of L_f moves it by."""


def needs(study: Study) -> str:
    """Return '' for a study with both kinds of numerics."""
    return "" if set(KINDS) <= {label for label, _ in study.runs} else f"numerics: {' and '.join(KINDS)}"


def table(results: "Results") -> list[dict]:
    """Return the rows, by column; claims that the study cannot judge are left out.

    Raises
    ------
    ConfigError
        If the study can judge none.
    """
    from subslide.tables._claims import grains, surface
    from subslide.tables._claims.evidence import Evidence

    evidence = {column: Evidence(results, kind) for kind, column in KINDS.items()}
    rows = []
    for claim in (*grains.CLAIMS, *surface.CLAIMS):
        row = {"claim": claim.words, "section": claim.section, "measure": claim.measure}
        for column, of_kind in evidence.items():
            finding = claim.judge(of_kind) if len(of_kind.runs) else None
            if finding:
                parts = (finding.stated(), finding.verdict(banded=False), finding.verdict())
                row |= dict(zip((column, f"{column}_as_computed", f"{column}_verdict"), parts, strict=True))
        if len(row) > 3:
            rows.append({name: row.get(name, "") for name in COLUMNS})
    if not rows:
        raise ConfigError(
            f"{results.folder}: it has no runs that a claim speaks of; allowed: a study with numerics"
            f" {' or '.join(KINDS)}"
        )
    return rows


def html(rows: list[dict]) -> str:
    """Return the table as a page (HTML, self-contained)."""
    from subslide.tables._claims import page

    return page.html(rows, KINDS)


def text(results: "Results", width: int = 110) -> str:
    """Return the table as lines to read: each claim, what was computed, numbers and verdicts."""
    lines = []
    for row in results.lines("claims"):
        lines += [f"{row['claim']} [section {row['section']}]", *_hung("measure", row["measure"], width)]
        for kind, column in KINDS.items():
            if row[column]:
                verdict = f"{row[f'{column}_verdict'].upper()} (as computed: {row[f'{column}_as_computed']})"
                lines += _hung(kind, f"{verdict}. {row[column]}", width)
        lines.append("")
    return "\n".join(lines).rstrip()


def _hung(name: str, words: str, width: int) -> list[str]:
    """Return the lines of a paragraph that hangs from its name."""
    return textwrap.wrap(words, width, initial_indent=f"  {name:9s} ", subsequent_indent=" " * 12)
