"""CSV files that a configuration names, read as strictly as the configuration itself."""

import csv
from collections.abc import Collection
from pathlib import Path
from typing import Any, NamedTuple

from subslide.keys import plain, schema, words
from subslide.keys.schema import ConfigError
from subslide.study.yaml_files import read_text

MOST_BYTES = 100_000_000
MOST_ROWS = 1_000_000


class Table(NamedTuple):
    """A CSV file: the names of its columns, and the line and texts of each row."""

    path: str
    columns: list[str]
    rows: list[tuple[int, list[str]]]

    def values(self, column: str, about: schema.Entry) -> list[Any]:
        """Return the values of a column.

        Parameters
        ----------
        column
            Its name.
        about
            Entry of what stands in it.

        Returns
        -------
        list
            A value for each row, in their order.

        Raises
        ------
        ConfigError
            If a value is not allowed: one line with file, line and column.
        """
        place = self.columns.index(column)
        return [self._value(line, row[place], column, about) for line, row in self.rows]

    def _value(self, line: int, text: str, column: str, about: schema.Entry) -> Any:
        """Return the value of one text; ConfigError if it is not allowed."""
        name = f"{self.path}, line {line}: {column}"
        try:
            value = plain.value_of(text) if text else None
        except ValueError as error:
            raise ConfigError(f"{name}: {words.cut(text)} {error}") from None
        return schema.conform(about, value, name)


def read(path: str, known: Collection[str] = ()) -> Table:
    """Return a CSV file with a line of names and one row at least.

    Parameters
    ----------
    path
        A regular file in UTF-8, parted by commas.
    known
        Names that columns may have; any if there are none.

    Returns
    -------
    Table
        Its columns and rows; empty lines are left out.

    Raises
    ------
    ConfigError
        If it cannot be read as one: one line, with the file and the line in it.
    """
    shown = words.printable(str(Path(path)))
    lines = read_text(path, MOST_BYTES).splitlines()
    reader, rows = csv.reader(lines, strict=True), []
    try:
        for row in reader:
            if any(text.strip() for text in row):
                rows.append((reader.line_num, [text.strip() for text in row]))
    except csv.Error as error:
        raise ConfigError(
            f"{shown}, line {reader.line_num}: {error}; allowed: values parted by commas"
        ) from None
    if len(rows) < 2:
        raise ConfigError(
            f"{shown}: there are no rows; allowed: a line of names, and a row of values at least"
        )
    if len(rows) > MOST_ROWS:
        raise ConfigError(f"{shown}: {len(rows)} rows; allowed: at most {MOST_ROWS}")
    first, columns = rows[0]
    for column in columns:
        if columns.count(column) > 1:
            raise ConfigError(
                f"{shown}, line {first}: {words.show(column)} is there twice; allowed: each name once"
            )
        if known and column not in known:
            hint = words.closest(column, known) or f"; allowed: {', '.join(known)}"
            raise ConfigError(
                f"{shown}, line {first}: {words.show(column)}: no column may have this name{hint}"
            )
    for line, row in rows[1:]:
        if len(row) != len(columns):
            raise ConfigError(
                f"{shown}, line {line}: {len(row)} values; allowed: {len(columns)}, one for each name"
            )
    return Table(shown, columns, rows[1:])
