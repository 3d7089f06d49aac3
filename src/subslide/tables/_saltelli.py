"""Saltelli designs of a study: which run stands where in their blocks, with what inputs."""

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from subslide.keys import words
from subslide.keys.schema import ConfigError
from subslide.study.config import Study
from subslide.tables._answers import Answer

if TYPE_CHECKING:
    from subslide.results import Results

FRICTION = "m"
"""Name of tan(delta)/a_2 among inputs; the others are keys."""

LACKING = "a saltelli design"
COLUMNS = {
    "design": ("", "number of the design in the study, from 1"),
    "inputs": ("", "what the design is over"),
    "others": ("", "values of the axes beside it in which the study's designs differ"),
}
"""First columns of tables that have rows for each design."""


class Design(NamedTuple):
    """A Saltelli design.

    Attributes
    ----------
    number
        Its place in the study, from 1.
    names
        Its inputs.
    others
        Values, in words, of the axes beside it in which the study's designs differ.
    ids
        Ids of the runs, shape (scramblings, 2 + 2 inputs, points).
    runs
        Places of the runs among those of the study, of the same shape.
    inputs
        Inputs of the runs, shape (scramblings, 2 + 2 inputs, points, inputs).
    over
        Distribution of each input, as points.json states it.
    """

    number: int
    names: list[str]
    others: str
    ids: np.ndarray
    runs: np.ndarray
    inputs: np.ndarray
    over: dict[str, dict[str, Any]]

    @property
    def first(self) -> dict[str, object]:
        """First columns of its rows."""
        return {"design": self.number, "inputs": " ".join(self.names), "others": self.others}

    def outputs(self, values: np.ndarray) -> np.ndarray:
        """Return values (runs, ...) in the places of the design: (scramblings, blocks, points, ...)."""
        return values[self.runs]


def needs(study: Study) -> str:
    """Return '' for a study with a Saltelli design."""
    return "" if any(one["kind"] == "saltelli" for one in study.designs) else LACKING


def designs(results: "Results") -> list[Design]:
    """Return the Saltelli designs of a finished study; ConfigError if it has none."""
    listed = [one for one in results.designs if one["kind"] == "saltelli"]
    if not listed:
        raise ConfigError(f"{results.folder} has no indices; allowed: a study with {LACKING}")
    places = {run.id: n for n, run in enumerate(results.runs_of_study)}
    points = [run.point for run in results.runs_of_study]
    differing = [
        key
        for key in dict.fromkeys(key for one in listed for key in one["others"])
        if any(one["others"].get(key) != listed[0]["others"].get(key) for one in listed)
    ]
    made = []
    for number, one in enumerate(listed, 1):
        ids = np.array(one["ids"])
        runs = np.vectorize(places.__getitem__, otypes=[int])(ids)
        attributes = ["friction_number" if name == FRICTION else name for name in one["names"]]
        columns = [np.array([float(getattr(point, key)) for point in points]) for key in attributes]
        others = {key: one["others"][key] for key in differing if key in one["others"]}
        told = ", ".join(f"{key}: {words.show(value)}" for key, value in others.items())
        inputs = np.stack(columns, axis=-1)[runs]
        made.append(Design(number, one["names"], told, ids, runs, inputs, one["spec"]["over"]))
    return made


def answers(design: Design, listed: list[Answer]) -> Iterator[Answer]:
    """Give the answers of a design's runs, in the places of its blocks, without those that none of them has."""
    for answer in listed:
        values = design.outputs(answer.values)
        if not np.isnan(values).all():
            half_widths = None if answer.half_widths is None else design.outputs(answer.half_widths)
            yield Answer(answer.name, values, half_widths)
