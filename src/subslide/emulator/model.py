"""The emulator itself: a file of numbers, and predictions that need numpy alone."""

import json
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from subslide.emulator import coordinates
from subslide.emulator import measures as named
from subslide.emulator.group import Group, group_of, packed, told_of, unpacked
from subslide.files import RecordError, write_text
from subslide.keys.schema import ConfigError

FORMAT = "subslide emulator 1"
CHUNK = 80
"""Points that are predicted at once: their kernel, of 1,536 columns at most, stays below a megabyte, in the cache."""

Numbers = float | Sequence[float] | np.ndarray


class Predicted(NamedTuple):
    """Values of a quantity, scaled, and half-widths of their 95 % bands: (n), or (n, times)."""

    value: np.ndarray
    band: np.ndarray


class Emulator:
    """Scaled answers of the converged model, with 95 % bands, in place of runs.

    Parameters
    ----------
    groups
        What was learned, by name, see `measures.LEARNED`.
    peak_band
        Coefficients (12) of the logarithm of the relative band of the peak at the gauge; None without it.
    about
        Where it comes from and how far it erred, as the file states it.
    """

    def __init__(self, groups: dict[str, Group], peak_band: np.ndarray | None, about: dict[str, Any]):
        """Keep the parts."""
        self.groups, self.peak_band, self.about = groups, peak_band, about

    @property
    def range(self) -> dict[str, tuple[float, float]]:
        """Least and greatest value of each of a_H, r and m that it answers for."""
        return {key: (float(low), float(high)) for key, (low, high) in self.about["range"].items()}

    @property
    def quantities(self) -> tuple[str, ...]:
        """Quantities that it predicts."""
        names = dict.fromkeys(
            name.partition("@")[0] for group in self.groups.values() for name in group.names
        )
        return tuple(name for name in names if name not in named.WINDOWS) + (
            (named.PEAK,) if "gauge" in self.groups else ()
        )

    @classmethod
    def load(cls, path: Path | str | None = None) -> "Emulator":
        """Return the emulator of a file, without one that of the package; RecordError if it is none."""
        path = SHIPPED if path is None else Path(path)
        try:
            told = json.loads(path.read_text(encoding="utf-8"))
            if told["format"] != FORMAT:
                raise ValueError(f"its format is {told['format']!r}, not {FORMAT!r}")
            groups = {name: group_of(entry) for name, entry in told["groups"].items()}
            peak = unpacked(told["peak_band"]) if told["peak_band"] else None
            return cls(groups, peak, told["about"])
        except FileNotFoundError:
            raise RecordError(f"{path}: there is no such file") from None
        except (OSError, ValueError, KeyError, TypeError, AttributeError) as error:
            raise RecordError(f"{path} is no file of an emulator ({str(error)[:100]})") from None

    def save(self, path: Path | str) -> None:
        """Write the emulator to a file, whole or not at all."""
        groups = {name: told_of(group) for name, group in self.groups.items()}
        peak = None if self.peak_band is None else packed(self.peak_band)
        told = {"format": FORMAT, "about": self.about, "peak_band": peak, "groups": groups}
        write_text(path, json.dumps(told, indent=1) + "\n")

    def predict(
        self,
        a_H: Numbers,
        r: Numbers,
        m: Numbers | None = None,
        *,
        a_2: Numbers | None = None,
        delta: Numbers | None = None,
        quantities: str | Iterable[str] | None = None,
        times: Numbers = named.TIMES,
    ) -> dict[str, Predicted]:
        """Return values and 95 % bands, which hold the error of the emulator and of the grids that it learned from.

        Parameters
        ----------
        a_H, r
            Depth of water over the column's height, and ratio of densities: numbers or arrays that broadcast.
        m
            Friction number tan(delta)/a_2; in its place
        a_2, delta
            aspect ratio and friction angle (degree).
        quantities
            What to predict, one or several; all `quantities` without it.
        times
            Scaled times, t / sqrt(R / (g a_2)), of x_front; max|eta| is known at `measures.TIMES`.

        Returns
        -------
        dict
            By quantity: arrays (n), of x_front and max|eta| (n, times); n counts the broadcast columns, the last axis
            fastest. Lengths are over R, displacements of the water
            over H2, times over sqrt(R / (g a_2)).

        Raises
        ------
        ConfigError
            If a value lies outside the range, or a quantity is unknown.
        """
        inputs = self.inputs(a_H, r, m, a_2, delta)
        wanted = self.quantities if quantities is None else quantities
        wanted = (wanted,) if isinstance(wanted, str) else tuple(wanted)
        for name in wanted:
            if name not in self.quantities:
                raise ConfigError(
                    f"quantities: {name} is not emulated; allowed: {', '.join(self.quantities)}"
                )
        moments = np.atleast_1d(np.asarray(times, float))
        groups = [
            group if set(group.names) == set(named.WINDOWS) else group.of(wanted)
            for group in self.groups.values()
        ]
        parts = [
            self._chunk(groups, inputs[first : first + CHUNK], wanted, moments)
            for first in range(0, max(1, len(inputs)), CHUNK)
        ]
        return {
            name: Predicted(*(np.concatenate([part[name][k] for part in parts]) for k in (0, 1)))
            for name in wanted
        }

    def inputs(
        self,
        a_H: Numbers,
        r: Numbers,
        m: Numbers | None = None,
        a_2: Numbers | None = None,
        delta: Numbers | None = None,
    ) -> np.ndarray:
        """Return rows (n, 3) of a_H, r and m, all within the range.

        Parameters
        ----------
        a_H, r, m, a_2, delta
            As for `predict`.

        Returns
        -------
        ndarray
            The rows.

        Raises
        ------
        ConfigError
            If a value lies outside the range, or it is not clear what m is.
        """
        if (m is None) == (a_2 is None or delta is None) or (m is not None and (a_2, delta) != (None, None)):
            raise ConfigError("m: is given, or a_2 and delta are; allowed: one of the two")
        if m is None:
            m = np.tan(np.radians(np.asarray(delta, float))) / np.asarray(a_2, float)
        columns = [
            one.ravel() for one in np.broadcast_arrays(*(np.asarray(one, float) for one in (a_H, r, m)))
        ]
        for (key, (low, high)), column in zip(self.range.items(), columns, strict=True):
            outside = ~((column >= low * (1 - EDGE)) & (column <= high * (1 + EDGE)))
            if outside.any():
                said = "m = tan(delta)/a_2" if key == "m" else key
                raise ConfigError(
                    f"{said}: {column[outside][0]:.6g} is outside what the emulator learned; allowed: {low:.6g} to"
                    f" {high:.6g} (a run has no such range)"
                )
        return np.stack(columns, axis=1)

    def _chunk(
        self, groups: Sequence[Group], inputs: np.ndarray, wanted: tuple[str, ...], times: np.ndarray
    ) -> dict[str, Predicted]:
        """Return what is wanted at some points, by groups of what is wanted."""
        answers: dict[str, Predicted] = {}
        for group in groups:
            names = group.names
            is_gauge = set(names) == set(named.WINDOWS)
            if not names or (is_gauge and named.PEAK not in wanted):
                continue
            value, band = group(inputs)
            if is_gauge:
                assert self.peak_band is not None
                peak = value.max(axis=1)
                share = np.exp(coordinates.of_errors(coordinates.of(group.kind, inputs)) @ self.peak_band)
                answers[named.PEAK] = Predicted(peak, share * peak)
                continue
            for name in wanted:
                where = [place for place, key in enumerate(names) if key.partition("@")[0] == name]
                if name in named.FRONTS and where:
                    where.append(names.index(name.replace("x_front", "L_f")))
                    clock = times * np.asarray(named.front_clock(inputs[:, 1], inputs[:, 2]))[:, None]
                    answers[name] = _front(name, clock, value[:, where], band[:, where])
                elif where:
                    columns: Any = where if name == named.SURFACE else where[0]
                    answers[name] = Predicted(value[:, columns], band[:, columns])
        return answers


SHIPPED = Path(__file__).with_name("emulator.json")
"""The emulator that the package has: of config/emulator.yaml, by `make emulator`."""

EDGE = 1e-9
"""Share of a bound by which a value may miss it: tan and ln round."""

REST = 2.6
"""Clock of FRONT_NODES at which any front is at rest."""

INTERPOLATED = {
    "x_front_1pc": (2, 2, 4, 8, 5, 6, 6, 7, 5, 3, 15, 37, 14, 0),
    "x_front_3pc": (3, 2, 5, 8, 5, 7, 7, 9, 7, 4, 14, 30, 6, 0),
    "x_front_5pc": (3, 2, 6, 10, 6, 8, 11, 23, 22, 19, 15, 26, 4, 0),
}
"""Half-widths, in 1e-4 of a front's place, of what the cubic errs by midway between nodes: 95 % of 400 columns."""


def _front(name: str, clock: np.ndarray, places: np.ndarray, bands: np.ndarray) -> Predicted:
    """Return fronts at clock times (n, times) from their places, and bands, at the nodes and at rest (n, nodes + 1)."""
    nodes = np.array([0.0, *named.FRONT_NODES, REST])
    start = np.ones((len(places), 1))
    value = monotone(nodes, np.concatenate([start, places], axis=1), clock)
    band = np.concatenate([bands[:, :1], bands], axis=1)
    k = np.clip(np.searchsorted(nodes, clock, side="right") - 1, 0, len(nodes) - 2)
    share = np.clip((clock - nodes[k]) / (nodes[k + 1] - nodes[k]), 0, 1)
    row = np.arange(len(band))[:, None]
    of_nodes = (1 - share) * band[row, k] + share * band[row, k + 1]
    between = 4 * share * (1 - share) * 1e-4 * np.array(INTERPOLATED[name])[k] * value
    return Predicted(value, np.hypot(of_nodes, between))


def monotone(nodes: np.ndarray, values: np.ndarray, at: np.ndarray) -> np.ndarray:
    """Return cubics through values that overshoot nowhere, constant beyond the ends.

    F. N. Fritsch and J. Butland, SIAM J. Sci. Stat. Comput. 5, 300 (1984).

    Parameters
    ----------
    nodes
        Where values are known (k), in order.
    values
        Values (n, k).
    at
        Where they are asked for (n, t).

    Returns
    -------
    ndarray
        Values (n, t).
    """
    h = np.diff(nodes)
    steep = np.diff(values, axis=1) / h
    left, right = steep[:, :-1], steep[:, 1:]
    a, b = 2 * h[1:] + h[:-1], h[1:] + 2 * h[:-1]
    with np.errstate(divide="ignore", invalid="ignore"):
        inner = np.where(left * right > 0, (a + b) / (a / left + b / right), 0.0)
    slopes = np.concatenate([steep[:, :1], inner, np.zeros((len(values), 1))], axis=1)
    k = np.clip(np.searchsorted(nodes, at, side="right") - 1, 0, len(h) - 1)
    row = np.arange(len(values))[:, None]
    s = np.clip((at - nodes[k]) / h[k], 0, 1)
    y0, y1, d0, d1 = values[row, k], values[row, k + 1], slopes[row, k] * h[k], slopes[row, k + 1] * h[k]
    return y0 + s * (d0 + s * (3 * (y1 - y0) - 2 * d0 - d1 + s * (d0 + d1 - 2 * (y1 - y0))))
