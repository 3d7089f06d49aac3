"""From numbers with bands to a verdict, and to the words that state them."""

import itertools
from collections.abc import Callable, Iterable
from typing import NamedTuple

import numpy as np

from subslide.tables._claims.evidence import Evidence, Field
from subslide.tables._claims.words import OPEN, REFUTED, SUPPORTED

MOST_NAMED = 3
"""Failing comparisons that are named, the clearest first."""


class Comparison(NamedTuple):
    """By how much a comparison holds (negative where it fails), the half-width of its band, and where it was made.

    The band is NaN where a value has none.
    """

    margin: float
    band: float
    where: str = ""


class Finding(NamedTuple):
    """Numbers in words, and the comparisons behind them; whether some of them must hold, or all."""

    numbers: str
    comparisons: tuple[Comparison, ...]
    some: bool = False

    def verdict(self, banded: bool = True) -> str:
        """Return the verdict on what holds or fails by more than its band; not `banded`, on the numbers as computed."""
        margins, bands = self._arrays(banded)
        holds = margins > bands
        fails = (margins < -bands) | ((margins == 0) & (bands == 0))
        enough, against = (holds.any(), fails.all()) if self.some else (holds.all(), fails.any())
        if against:
            return REFUTED
        return SUPPORTED if enough else OPEN

    def stated(self) -> str:
        """Return the numbers, how many comparisons hold and how many are decided, and where the claim fails."""
        (margins, bands), total = self._arrays(True), len(self.comparisons)
        sure, wrong, unknown = (int(n.sum()) for n in (margins > bands, margins < -bands, np.isnan(bands)))
        words = [self.numbers, f"holds in {int((margins > 0).sum())} of {total}"]
        if sure + wrong < total:
            words[-1] += f" (beyond the bands {sure} hold, {wrong} fail; {unknown} have none)"
        failed = sorted(
            (one for one in self.comparisons if one.margin < 0),
            key=lambda one: (not one.margin < -one.band, one.margin),
        )
        if failed and failed[0].where and not self.some:
            more = ", ..." if len(failed) > MOST_NAMED else ""
            words.append(f"fails at {', '.join(one.where for one in failed[:MOST_NAMED])}{more}")
        return "; ".join(words)

    def _arrays(self, banded: bool) -> tuple[np.ndarray, np.ndarray]:
        """Return margins and bands as arrays; bands are 0 with `banded` false."""
        margins = np.array([one.margin for one in self.comparisons], float)
        bands = np.array([one.band for one in self.comparisons], float)
        return margins, bands if banded else np.zeros_like(bands)


class Claim(NamedTuple):
    """Short words, section of the paper, what is computed, and the function that judges it.

    The function returns None where the study lacks what the claim needs.
    """

    words: str
    section: str
    measure: str
    judge: Callable[[Evidence], Finding | None]


def finding(comparisons: Iterable[Comparison], numbers: str, some: bool = False) -> Finding | None:
    """Return the `Finding` of some comparisons; None if there are none."""
    comparisons = tuple(comparisons)
    return Finding(numbers, comparisons, some) if comparisons else None


def falls(field: Field, along: str, when: str = "") -> list[Comparison]:
    """Return comparisons of 'falls' from each value of `along` ('r' or 'a_H') to the next; `when` leads the words."""
    tables = field if along == "r" else Field(*(table.T for table in field))
    other = "a_H" if along == "r" else "r"
    steps = tables.value.columns
    return [
        Comparison(
            tables.value.loc[line, first] - tables.value.loc[line, then],
            tables.band.loc[line, first] + tables.band.loc[line, then],
            f"{when}{other} = {line:g} from {along} = {first:g} to {then:g}",
        )
        for line in tables.value.index
        for first, then in itertools.pairwise(steps)
    ]


def rises(field: Field, along: str) -> list[Comparison]:
    """Return the comparisons of 'rises' from each value of `along` to the next."""
    return [one._replace(margin=-one.margin) for one in falls(field, along)]


def outside(field: Field) -> list[Comparison]:
    """Return comparisons of 'lies outside the values at the least and greatest a_H', at each a_H between and r."""
    comparisons = []
    for r in field.value.columns:
        (low, low_band), (high, high_band) = sorted(field.at(field.value.index[k], r) for k in (0, -1))
        for value, band in (field.at(a, r) for a in field.value.index[1:-1]):
            comparisons.append(
                max(Comparison(value - high, band + high_band), Comparison(low - value, band + low_band))
            )
    return comparisons


def number(value: float, band: float, unit: float, digits: int = 3) -> str:
    """Return a value and its band in units of `unit`: '2.13±0.006'; '±?' where there is no band."""
    text = f"{value / unit:#.{digits}g}".rstrip(".")
    if np.isnan(band):
        return f"{text}±?"
    band /= unit
    return f"{text}±{band:{'.0f' if band >= 10 else '.1g'}}" if band > 0 else text


def over_r(field: Field, unit: float, digits: int = 3) -> str:
    """Return the values at the least and at the greatest r, for each a_H."""
    if field.value.columns.empty:
        return ""
    first, last = field.value.columns[[0, -1]]
    words = (
        f"{number(*field.at(a, first), unit, digits)} to {number(*field.at(a, last), unit, digits)} (a_H = {a:g})"
        for a in field.value.index
    )
    return f"r = {first:g} to {last:g}: {', '.join(words)}"


def over_depth(field: Field, unit: float, digits: int = 3) -> str:
    """Return the values at each a_H, for each r."""
    words = (
        " / ".join(number(*field.at(a, r), unit, digits) for a in field.value.index) + f" (r = {r:g})"
        for r in field.value.columns
    )
    return f"a_H = {' / '.join(f'{a:g}' for a in field.value.index)}: {', '.join(words)}"
