"""The page on verification: its table of errors and orders is that of the last run of a study."""

from subslide.pages import renewal
from subslide.results import Results
from subslide.tables import _orders

MARKS = (renewal.LAST_RUN,)


def page(text: str, results: Results) -> str:
    """Return the page `text` with the errors and orders of a study; ConfigError without the marks or the table."""
    lines = _orders.lines(results.errors)
    return renewal.renewed(text, renewal.LAST_RUN, [_orders.HEADINGS, *(line.words() for line in lines)])
