"""Pages of documentation with a table that a study writes anew between two marks."""

from collections.abc import Iterable, Sequence

from subslide.keys.schema import ConfigError

LAST_RUN = ("<!-- table of the last run -->", "<!-- end of the table -->")
"""Marks of a page with one table."""


def marked(text: str, known: Iterable[tuple[str, str]]) -> list[tuple[str, str]]:
    """Return those of some pairs of marks that a page has.

    Parameters
    ----------
    text
        The page.
    known
        Pairs of lines, each of which a table may go between.

    Returns
    -------
    list of tuple
        The pairs.

    Raises
    ------
    ConfigError
        If it has none, or one line of a pair without the other after it.
    """
    lacking = [(start, end) for start, end in known if end not in text.partition(start)[2]]
    pairs = [pair for pair in known if pair not in lacking]
    if not pairs or any(mark in text for pair in lacking for mark in pair):
        wanted = " or ".join(f"'{start}' and '{end}'" for start, end in lacking)
        raise ConfigError(f"--output: the page lacks the lines {wanted}, that its table goes between")
    return pairs


def renewed(text: str, marks: tuple[str, str], rows: Iterable[Sequence[str]]) -> str:
    """Return a page with a table between two of its lines; ConfigError, see `marked`, without them.

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
    """
    ((start, end),) = marked(text, [marks])
    headings, *rest = rows
    lines = [headings, ("---",) * len(headings), *rest]
    table = "\n".join("| " + " | ".join(words) + " |" for words in lines)
    before, after = text.split(start, 1)
    return f"{before}{start}\n\n{table}\n\n{end}{after.split(end, 1)[1]}"
