"""Distributions of a key in a design: their quantiles, to 12 digits and within the key's range."""

from typing import TYPE_CHECKING, Any, NamedTuple

from subslide.files import file_hash
from subslide.keys import schema, words
from subslide.keys.designs import DISTRIBUTIONS, PATH
from subslide.keys.schema import ConfigError, Entry, refused
from subslide.study import csv_files, forms

if TYPE_CHECKING:
    import numpy as np


SMALLEST_SHARE = 1e-6
"""Share of a normal distribution that must lie between its bounds: of less its quantiles lose their digits."""


class Distribution(NamedTuple):
    """Distribution of a number.

    Attributes
    ----------
    kind
        One of `subslide.keys.designs.DISTRIBUTIONS`.
    numbers
        What describes it, in the order given there; of a file the values of its column.
    spec
        It as a configuration states it, and the SHA-256 of a file.
    """

    kind: str
    numbers: tuple[float, ...]
    spec: dict[str, Any]

    def quantiles(self, shares: "np.ndarray") -> list[float]:
        """Return the values below which given shares of the distribution lie.

        Parameters
        ----------
        shares
            Shares (n) from 0 to 1.

        Returns
        -------
        list of float
            Values (n) to 12 digits, within the distribution's bounds.
        """
        import numpy as np

        low, high = min(self.numbers), max(self.numbers)
        if self.kind != "file":
            low, high = self.numbers[-2:]
        if self.kind == "uniform":
            values = low + (high - low) * shares
        elif self.kind == "log_uniform":
            values = low * (high / low) ** shares
        elif self.kind == "truncated_normal":
            values = _truncated_normal(shares, *self.numbers)
        else:
            values = np.quantile(self.numbers, shares)
        size = max(abs(low), abs(high))
        return [min(max(forms.rounded(value, size), low), high) for value in values.tolist()]


def checked(key: str, given: Any, about: Entry, name: str) -> Distribution:
    """Return a distribution as a configuration states it.

    Parameters
    ----------
    key
        Key whose values are distributed, the name of a file's column.
    given
        [low, high], or a mapping with one of `DISTRIBUTIONS`.
    about
        Entry of the key.
    name
        What messages call it.

    Returns
    -------
    Distribution
        The distribution, all of whose values the key takes.

    Raises
    ------
    ConfigError
        If it is none, or leaves the key's range: one line.
    """
    kind: Any = "uniform"
    numbers: Any = given
    if isinstance(given, dict) and len(given) == 1:
        kind, numbers = next(iter(given.items()))
    if kind not in DISTRIBUTIONS or not isinstance(numbers, str if kind == "file" else list):
        hint = words.closest(kind, DISTRIBUTIONS) if kind not in DISTRIBUTIONS else ""
        raise refused(name, given, f"{_allowed()}{hint}")
    if kind == "file":
        path = schema.conform(PATH, numbers, f"{name}: file")
        with schema.placed(f"{name}: file: "):
            samples = _samples(path, key, about)
        return Distribution(kind, tuple(samples), {"file": path, "sha256": file_hash(path)})
    parts = DISTRIBUTIONS[kind]
    if not forms.are_numbers(numbers, len(parts)):
        raise refused(name, given, f"{kind}: [{', '.join(parts)}], {len(parts)} numbers")
    values = tuple(map(float, numbers))
    low, high = (float(schema.conform(about, value, name)) for value in values[-2:])
    if not low < high:
        raise refused(name, given, "low below high")
    if kind == "log_uniform" and low <= 0:
        raise refused(name, given, "log_uniform from above 0")
    if kind == "truncated_normal":
        if values[1] <= 0:
            raise refused(name, given, "a standard deviation above 0")
        if not share_within(*values) > SMALLEST_SHARE:
            raise refused(name, given, f"bounds with more than {SMALLEST_SHARE:g} of all values between them")
    return Distribution(kind, values, {kind: list(values)})


def _allowed() -> str:
    """Return words for the distributions that there are."""
    named = ", ".join(
        f"{{{kind}: {'PATH' if kind == 'file' else '[' + ', '.join(parts) + ']'}}}"
        for kind, parts in DISTRIBUTIONS.items()
    )
    return f"[low, high], {named}"


def _samples(path: str, key: str, about: Entry) -> list[float]:
    """Return the numbers in a file's column of a key's name; ConfigError if one is not allowed."""
    table = csv_files.read(path)
    if key not in table.columns:
        hint = words.closest(key, table.columns)
        listed = words.cut(", ".join(table.columns))
        raise ConfigError(
            f"{table.path}: there is no column {key}; allowed: one of that name (it has: {listed}){hint}"
        )
    return [float(value) for value in table.values(key, about)]


def _truncated_normal(shares: "np.ndarray", mean: float, sd: float, low: float, high: float) -> "np.ndarray":
    """Return the quantiles of a normal distribution between two bounds."""
    from scipy.special import ndtr, ndtri

    first, last = (low - mean) / sd, (high - mean) / sd
    sign = (
        -1.0 if first > 0 else 1.0
    )  # above the mean counted from the upper end, where shares keep their digits
    return mean + sign * sd * ndtri(ndtr(sign * first) * (1 - shares) + ndtr(sign * last) * shares)


def share_within(mean: float, sd: float, low: float, high: float) -> float:
    """Return the share of a normal distribution between two bounds.

    Parameters
    ----------
    mean, sd
        Its mean and standard deviation.
    low, high
        The bounds.

    Returns
    -------
    float
        Share from 0 to 1.
    """
    from scipy.special import ndtr

    first, last = (low - mean) / sd, (high - mean) / sd
    return float(ndtr(-first) - ndtr(-last) if first > 0 else ndtr(last) - ndtr(first))
