"""Pages of documentation with a table that a study writes anew between two marks."""

from collections.abc import Iterable, Sequence

from subslide.keys.schema import ConfigError


def renewed(text: str, start: str, end: str, rows: Iterable[Sequence[str]]) -> str:
    """The page `text` with a table (Markdown) between its lines `start` and `end`; ConfigError without these.

    rows: entries of the table, the headings first.
    """
    if start not in text or end not in text:
        raise ConfigError(
            f"--output: the page lacks the lines '{start}' and '{end}' that its table goes between"
        )
    headings, *rest = rows
    lines = [headings, ("---",) * len(headings), *rest]
    table = "\n".join("| " + " | ".join(words) + " |" for words in lines)
    before, after = text.split(start, 1)
    return f"{before}{start}\n\n{table}\n\n{end}{after.split(end, 1)[1]}"
