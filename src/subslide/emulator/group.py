"""A group of quantities with one kernel: what a file holds of it, and its answers."""

import base64
from collections.abc import Iterable
from typing import Any, NamedTuple

import numpy as np

from subslide.emulator import coordinates


class Process(NamedTuple):
    """What a Gaussian process learned: points (n, 3) over its lengths (3), and weights (n, q)."""

    points: np.ndarray
    lengths: np.ndarray
    weights: np.ndarray


class Group(NamedTuple):
    """Quantities (q) with one kernel.

    Attributes
    ----------
    kind
        Coordinates.
    names
        The quantities.
    law, trend
        Coefficients (10, q) of the logarithm of their law, and of their trend over it.
    bands
        Coefficients (12, q) of the logarithm of their band over the law, see `coordinates.of_errors`.
    process
        What is left, over the law.
    """

    kind: str
    names: tuple[str, ...]
    law: np.ndarray
    trend: np.ndarray
    bands: np.ndarray
    process: Process

    def __call__(self, inputs: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return values and bands (n, q) at rows (n, 3) of a_H, r and m."""
        z = coordinates.of(self.kind, inputs)
        basis = coordinates.quadratic(z)
        scale = np.exp(basis @ self.law)
        process = self.process
        value = basis @ self.trend + kernel(z / process.lengths, process.points) @ process.weights
        return value * scale, np.exp(coordinates.of_errors(z) @ self.bands) * scale

    def of(self, quantities: Iterable[str]) -> "Group":
        """Return the group of those names that belong to some quantities; fronts need the length of their deposit."""
        wanted = {*quantities} | {name.replace("x_front", "L_f") for name in quantities}
        columns = [n for n, name in enumerate(self.names) if name.partition("@")[0] in wanted]
        process = self.process._replace(weights=np.ascontiguousarray(self.process.weights[:, columns]))
        law, trend, bands = (part[:, columns] for part in (self.law, self.trend, self.bands))
        return Group(self.kind, tuple(self.names[n] for n in columns), law, trend, bands, process)


def kernel(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Return the covariances (n, k) of points (n, 3) and (k, 3): Matern 5/2 of length 1."""
    left = np.concatenate([a, 5 * (a**2).sum(axis=1)[:, None], np.ones((len(a), 1))], axis=1)
    right = np.concatenate([-10 * b.T, np.ones((1, len(b))), 5 * (b**2).sum(axis=1)[None]])
    covariance = left @ right  # squares of distances: few passes over large arrays are what counts
    np.maximum(covariance, 0, out=covariance)
    d = np.sqrt(covariance)
    covariance *= 1 / 3
    covariance += d
    covariance += 1
    covariance *= np.exp(np.negative(d, out=d), out=d)
    return covariance


def single(numbers: np.ndarray) -> np.ndarray:
    """Return numbers as a file keeps them, of float32, in float64."""
    return numbers.astype(np.float32).astype(float)


def packed(numbers: np.ndarray, kind: str = "float32") -> dict[str, Any]:
    """Return an array as JSON states it.

    Parameters
    ----------
    numbers
        The array.
    kind
        float32 or float64, of which its numbers are kept.

    Returns
    -------
    dict
        Its `shape`, and under the kind its little-endian numbers in base64.
    """
    raw = np.ascontiguousarray(numbers, np.dtype(kind).newbyteorder("<")).tobytes()
    return {"shape": list(numbers.shape), kind: base64.b64encode(raw).decode()}


def unpacked(told: dict[str, Any]) -> np.ndarray:
    """Return the array that `packed` stated; ValueError if it is none."""
    kind = "float64" if "float64" in told else "float32"
    raw = base64.b64decode(told[kind], validate=True)
    numbers = np.frombuffer(raw, np.dtype(kind).newbyteorder("<")).astype(float).reshape(told["shape"])
    if not np.isfinite(numbers).all():
        raise ValueError("numbers that are not finite")
    return numbers


def told_of(group: Group) -> dict[str, Any]:
    """Return a group as JSON states it."""
    parts = {"law": group.law, "trend": group.trend, "bands": group.bands}
    return {
        "coordinates": group.kind,
        "quantities": list(group.names),
        **{name: packed(numbers, "float64") for name, numbers in parts.items()},
        **{name: packed(numbers) for name, numbers in group.process._asdict().items()},
    }


def group_of(told: dict[str, Any]) -> Group:
    """Return the group that `told_of` stated."""
    process = Process(*(unpacked(told[name]) for name in Process._fields))
    law, trend, bands = (unpacked(told[name]) for name in ("law", "trend", "bands"))
    return Group(told["coordinates"], tuple(told["quantities"]), law, trend, bands, process)
