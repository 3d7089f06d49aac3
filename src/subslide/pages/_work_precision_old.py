"""Speed against accuracy: what each choice of numerics costs for how small an error on the paper's column.

`table` makes the rows, `cheapest` chooses among them, `quotes` sets them as text; docs/work_precision.md says what the
numbers mean. Nothing heavy is imported here: planning a study asks for `problems` alone.
"""

from pathlib import Path

TABLES = ("work_precision.csv", "cheapest.csv")


def write(folder: Path) -> tuple[list[Path], str]:
    """Paths of the tables of the study in `folder`, newly written, and their text; ConfigError without a sweep."""
    from subslide.files import write_text
    from subslide.pages import work_precision as quotes
    from subslide.results import Results
    from subslide.tables import cheapest
    from subslide.tables import work_precision as table

    runs = table.table(Results(folder))
    chosen = cheapest.table(runs)
    paths = [folder / "tables" / name for name in TABLES]
    paths[0].parent.mkdir(exist_ok=True)
    for path, rows in zip(paths, (runs, chosen), strict=True):
        write_text(path, rows.to_csv(index=False, float_format="%.8g", lineterminator="\n"))
    return paths, quotes.text(runs, chosen)


def page(text: str, folder: Path) -> str:
    """The page of documentation `text` with the tables that it has marks for, from the study in `folder`."""
    import pandas as pd

    from subslide.pages import work_precision as quotes

    return quotes.renewed(text, *(pd.read_csv(folder / "tables" / name) for name in TABLES))
