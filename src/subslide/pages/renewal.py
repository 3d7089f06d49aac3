"""Pages of documentation with a table that a study writes anew between two marks."""

from collections.abc import Iterable, Sequence

from subslide.keys.schema import ConfigError

LAST_RUN = ("<!-- table of the last run -->", "<!-- end of the table -->")
"""Marks of a page with one table."""


def renewed(text: str, marks: tuple[str, str], rows: Iterable[Sequence[str]]) -> str:
    """Return a page with a table between two of its lines.

    Parameters
    ----------
    text
        The page.
    marks
        The lines between which the table goes.
    rows
        Entries of the table, the headings first.

    Returns
    -------
    str
        The page with the table (Markdown) in place of what was between the marks.

    Raises
    ------
    ConfigError
        If the page lacks one of the marks.
    """
    start, end = marks
    if start not in text or end not in text:
        raise ConfigError(
            f"--output: the page lacks the lines '{start}' and '{end}' that its table goes between"
        )
    headings, *rest = rows
    lines = [headings, ("---",) * len(headings), *rest]
    table = "\n".join("| " + " | ".join(words) + " |" for words in lines)
    before, after = text.split(start, 1)
    return f"{before}{start}\n\n{table}\n\n{end}{after.split(end, 1)[1]}"
