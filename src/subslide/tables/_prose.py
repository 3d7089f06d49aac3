"""What modules of tables say of themselves, as pages of documentation quote it."""

from collections.abc import Mapping


def with_constants(text: str, names: Mapping[str, object]) -> str:
    """Return a text in which names of numbers between backquotes, such as `FINER`, are replaced by the numbers."""
    for name, value in names.items():
        if isinstance(value, int | float):
            text = text.replace(f"`{name}`", f"{value}")
    return text.strip()
