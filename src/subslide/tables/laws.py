"""Power laws of the runout and of the wave in the similarity variables, beside the laboratory's."""

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from subslide.laboratory import lube
from subslide.sensitivity.laws import Law, fit
from subslide.tables import _answers, _saltelli
from subslide.tables._answers import Answer
from subslide.tables._saltelli import Design
from subslide.tables._saltelli import needs as needs

if TYPE_CHECKING:
    from subslide.results import Results

TITLE = "Power laws"
READS = ("records", "runs")
FLOAT_FORMAT = "%.6g"
RUNOUT, PEAK = "runout", "peak"
LAWS = {
    RUNOUT: "L_f/R - 1, the runout (1 % front) beyond the column over R",
    PEAK: "the peak of the wave at the gauge (`eta_gauge_peak`) over H2",
}
OURS, LABORATORY = "these runs", "Lube et al. 2004"
VARIABLES = ("a_H", "m", "1 - r")
COLUMNS = {
    **_saltelli.COLUMNS,
    "law": ("", "what the law is of, see above"),
    "source": ("", f"`{OURS}`, or `{LABORATORY}`: round dry columns of sand and the like, a_2 below 1.7"),
    "term": ("", "C, or the variable that the exponent belongs to"),
    "value": ("", "the factor, or the exponent"),
    "low": ("", "lower end of its 95 % band, a bootstrap over scramblings; empty if there is one alone"),
    "high": ("", "upper end"),
    "error_median": (
        "",
        "median relative error of the law at runs of a scrambling that it was not fitted to",
    ),
    "error_95": ("", "95 % quantile of that error"),
    "explained": ("", "share of the variance of the logarithm that the law explains at such runs"),
    "runs": ("", "runs that the law was fitted to"),
    "left_out": ("", "ids of the runs without a logarithm: failed, or 0"),
}
WORDS = ("inputs", "others", "law", "source", "term", "left_out")


class Fitted(NamedTuple):
    """A law of a design's runs: its name, the runs' values and variables, and the fit."""

    name: str
    values: np.ndarray
    names: list[str]
    law: Law


def about() -> str:
    """Return what the documentation says of the table."""
    laws = "\n".join(f"- `{name}`: {text}" for name, text in LAWS.items())
    return f"""One row for each Saltelli design, law and term: C a_H^p m^q (1 - r)^s, where m = tan(delta)/a_2, least
squares of the logarithm. A variable that does not vary in a design has no term. The laboratory's law is 1.24 a_2: at
one angle, an exponent of -1 of m.

Laws:

{laws}"""


def table(results: "Results") -> Iterator[dict]:
    """Give the rows, by column."""
    listed = _answers.once(results)
    for design in _saltelli.designs(results):
        for fitted in laws(results, design, listed):
            law = fitted.law
            kept = fitted.values > 0
            errors = law.errors[np.isfinite(law.errors)]
            median, most = np.quantile(errors, (0.5, 0.95)) if errors.size else (np.nan, np.nan)
            quality = {
                "error_median": float(median),
                "error_95": float(most),
                "explained": law.explained,
                "runs": int(kept.sum()),
                "left_out": " ".join(dict.fromkeys(by_scrambling(design.ids)[~kept])),
            }
            first = {**design.first, "law": fitted.name}
            for term, *ends in zip(("C", *fitted.names), law.terms, law.low, law.high, strict=True):
                values = dict(zip(("value", "low", "high"), map(float, ends), strict=True))
                yield {**first, "source": OURS, "term": term, **values, **quality}
            if fitted.name == RUNOUT:
                yield {**first, "source": LABORATORY, "term": "C", "value": lube.runout(1.0) - 1}
                yield {**first, "source": LABORATORY, "term": "m", "value": -1.0}


def laws(results: "Results", design: Design, listed: list[Answer]) -> Iterator[Fitted]:
    """Give the laws of a design's runs, without those of answers that none has.

    Parameters
    ----------
    results
        The study.
    design
        One of its designs.
    listed
        Answers of the study's runs.
    """
    points: Any = [run.point for run in results.runs_of_study]
    columns = {
        "a_H": np.array([point.a_H for point in points]),
        "m": np.array([point.friction_number for point in points]),
        "1 - r": np.array([1 - point.r for point in points]),
    }
    for answer in listed:
        values = by_scrambling(design.outputs(answer.values))
        name = {_answers.LENGTH: RUNOUT, _answers.PEAK: PEAK}.get(answer.name)
        if name is None or np.isnan(values).all():
            continue
        values = values - 1 if name == RUNOUT else values
        varied = {key: by_scrambling(column[design.runs]) for key, column in columns.items()}
        varied = {key: column for key, column in varied.items() if np.ptp(np.log(column)) > 1e-9}
        yield Fitted(name, values, list(varied), fit(values, np.stack(list(varied.values()), axis=-1)))


def by_scrambling(values: np.ndarray) -> np.ndarray:
    """Return values of a design's runs as an array (scramblings, runs of each)."""
    return values.reshape(len(values), -1)
