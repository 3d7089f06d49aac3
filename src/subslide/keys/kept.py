"""What records may keep of each run of a study; entries of the keys that say so, and how long a job works."""

WORDS = ("summary", "series", "all")
"""What may be kept, the least first."""

ENTRY = {
    "description": "what records keep of each run: all; series (every sample of the series, no profiles); summary"
    " (numbers, and series thinned to the samples that keep each local extremum and 1e-3 of the curve); or auto (all of"
    " a study of up to 2,000 solved points, else summary, or series if it has gauges)",
    "enum": ["auto", *WORDS],
    "default": "auto",
}
"""Entry of the key `keep`, but for its role."""

LACKING = {"summary": ("fields", "gauges", "footprints"), "series": ("fields", "footprints"), "all": ()}
"""Keys whose quantities a record lacks, by what it keeps."""


def is_less(one: str, other: str) -> bool:
    """Return whether one word keeps less than another.

    Parameters
    ----------
    one, other
        Words; the other may be '', which asks for nothing.

    Returns
    -------
    bool
        Whether it does.
    """
    return bool(other) and WORDS.index(one) < WORDS.index(other)


BATCH_SECONDS = {
    "description": "seconds that a job shall work, as estimated; small studies have less, so that all cores work. No"
    " answer depends on it",
    "type": "number",
    "minimum": 1,
    "maximum": 100_000,
    "default": 30,
    "unit": "s",
}
"""Entry of the key `batch_seconds`, but for its role."""
