"""The table of claims as a page to read: a row a claim, verdicts in bold, numbers below them."""

from collections.abc import Iterable
from html import escape

from subslide.tables._claims.words import OPEN, REFUTED, SUPPORTED

SHADES = {SUPPORTED: "#d9eedd", REFUTED: "#f6d5cf", OPEN: "#eeeeee", "": "#ffffff"}
STYLE = """body { font: 14px/1.4 sans-serif; margin: 1.5em; } table { border-collapse: collapse; }
th, td { border: 1px solid #bbb; padding: 0.4em 0.6em; text-align: left; vertical-align: top; }
small { color: #333; } p { max-width: 60em; }"""
INTRODUCTION = """What sections 4 and 5 of the source paper say of its results, held against this study. Verdicts
count what differs by more than the bands of discretisation error (±; thrice the range of three grids where these show
no order); a value without a band (±?) decides nothing. The verdict in brackets takes the numbers as they are."""


def html(rows: list[dict], kinds: dict[str, str]) -> str:
    """Return the page (HTML, self-contained) of the table of claims.

    Parameters
    ----------
    rows
        The table's, by column.
    kinds
        Columns of numbers, by the name of their numerics.
    """
    heads = "".join(f"<th>{escape(name)} numerics</th>" for name in kinds)
    lines = "\n".join(_row(row, kinds.values()) for row in rows)
    return f"""<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>The paper's claims</title><style>{STYLE}</style></head>
<body><h1>The paper's claims</h1><p>{INTRODUCTION}</p>
<table><tr><th>claim</th>{heads}</tr>
{lines}
</table></body></html>
"""


def _row(row: dict, columns: Iterable[str]) -> str:
    """Return the line of a claim."""
    words, section, measure = (escape(row[key]) for key in ("claim", "section", "measure"))
    claim = f"<b>{words}</b> (section {section})<br><small>{measure}</small>"
    return f"<tr><td>{claim}</td>{''.join(_cell(row, column) for column in columns)}</tr>"


def _cell(row: dict, column: str) -> str:
    """Return the cell of a claim for one kind of numerics."""
    verdict, computed = row[f"{column}_verdict"], row[f"{column}_as_computed"]
    words = f"<b>{verdict}</b> (as computed: {computed})<br>" if verdict else ""
    return f'<td style="background: {SHADES[verdict]}">{words}<small>{escape(row[column])}</small></td>'
