"""The page on stability: its table of methods is that of the last run of a study with an atlas."""

from subslide.pages import renewal
from subslide.results import Results
from subslide.tables import _by_method

MARKS = (renewal.LAST_RUN,)


def page(text: str, results: Results) -> str:
    """Return the page `text` with the table of methods of a study; ConfigError without the marks or the atlas."""
    table = _by_method.methods(results.atlas)
    rows = [list(table.columns), *table.astype(str).to_numpy().tolist()]
    return renewal.renewed(text, renewal.LAST_RUN, rows)
