"""Rows of Markdown tables."""


def row(*entries: str) -> str:
    """Return a row of a table, of entries in whose text a bar, as in |eta|, begins no new entry.

    Parameters
    ----------
    entries
        Texts of the entries.

    Returns
    -------
    str
        The row.
    """
    return "| " + " | ".join(entry.replace("|", "\\|") for entry in entries) + " |"
