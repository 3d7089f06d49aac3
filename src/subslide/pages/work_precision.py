"""Pages that quote error against seconds: their tables are those of the last run of a study that sweeps numerics."""

from subslide.pages import renewal
from subslide.results import Results
from subslide.tables import _choices

CHOICES = ("<!-- cheapest choices of the last run -->", "<!-- end of the cheapest choices -->")
EQUAL = ("<!-- equal accuracy of the last run -->", "<!-- end of equal accuracy -->")
MARKS = (CHOICES, EQUAL)


def page(text: str, results: Results) -> str:
    """Return the page `text` with those of a study's tables that it has marks for; ConfigError if it has none."""
    rows = {
        CHOICES: _choices.choices(results.table("cheapest")),
        EQUAL: _choices.equal(results.table("work_precision")),
    }
    for marks in renewal.marked(text, MARKS):
        text = renewal.renewed(text, marks, rows[marks])
    return text
