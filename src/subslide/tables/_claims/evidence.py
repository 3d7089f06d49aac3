"""What a study's tables say of one kind of numerics: quantities over a_H and r, each with its band."""

import functools
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import pandas as pd

from subslide.naming import ARREST, FRONT_LABELS
from subslide.points import RUN_KEYS, paper_times

if TYPE_CHECKING:
    from subslide.results import Results

THRESHOLDS = tuple(FRONT_LABELS)
FRONT = f"x_front_{THRESHOLDS[0]}"
GAUGE = "eta_gauge"
WAVES = {"max_abs_eta": "whole box", "max_abs_eta_outside": "beyond R"}


SHALLOW, DEEP = 1.0, 10.0
"""Depths a_H between which the paper draws its contrasts."""


class Field(NamedTuple):
    """A quantity over a_H (rows) and r (columns), and the half-width of its band, of the same unit.

    The band is 0 in a study without bands, and NaN where a value has none (a companion failed).
    """

    value: pd.DataFrame
    band: pd.DataFrame

    def at(self, a_H: float, r: float) -> tuple[float, float]:
        """Return value and band of one run."""
        return float(self.value.loc[a_H, r]), float(self.band.loc[a_H, r])

    def ends(self) -> "Field | None":
        """Return a_H = 1 and 10 alone; None where the study lacks one."""
        if not {SHALLOW, DEEP} <= set(self.value.index):
            return None
        return Field(self.value.loc[[SHALLOW, DEEP]], self.band.loc[[SHALLOW, DEEP]])

    def submerged(self) -> "Field":
        """Return r > 0 alone: at r = 0 the water cannot act on the grains."""
        keep = [r for r in self.value.columns if r > 0]
        return Field(self.value[keep], self.band[keep])


class Evidence:
    """Tables of the runs of one kind of numerics that differ in a_H and r alone: those like the first of them."""

    def __init__(self, results: "Results", numerics: str):
        """Take the tables' rows of the runs with these numerics."""
        runs = results.runs[results.runs["numerics"] == numerics]
        for key in RUN_KEYS:
            if key in runs and key not in ("a_H", "r", "snapshot_times") and len(runs):
                runs = runs[runs[key].astype(str) == str(runs[key].iloc[0])]
        self.runs = runs.drop_duplicates(["a_H", "r"])
        self.depths = sorted(self.runs["a_H"].unique())
        self.ratios = sorted(self.runs["r"].unique())
        self.radius = float(runs["radius"].iloc[0]) if len(runs) else np.nan
        self.a_2 = float(runs["a_2"].iloc[0]) if len(runs) else np.nan
        self.height = self.a_2 * self.radius
        self.times = paper_times(self.radius)
        ids, bands, series = self.runs["id"], results.bands, results.series
        bands = bands[bands["id"].isin(ids)]
        self.banded = not bands.empty
        self._bands = dict(iter(bands.groupby("quantity")))
        wanted = series["id"].isin(ids) & series["quantity"].isin([FRONT, *WAVES])
        self._series = {
            key: (rows["time"].to_numpy(), rows["value"].to_numpy())
            for key, rows in series[wanted].groupby(["quantity", "id"])
        }

    @functools.cache  # noqa: B019 - an Evidence lives as long as its table
    def length(self, threshold: str = THRESHOLDS[0]) -> Field:
        """Return the final length L_f (m); empty where grains still moved at the end of the run."""
        name = f"L_f_{threshold}"
        values = self.runs.set_index("id")[name].where(self.runs.set_index("id")["status"] == "ok")
        return self._field(values, self._band_of(name))

    @functools.cache  # noqa: B019
    def at_time(self, quantity: str, time: float) -> Field:
        """Return a quantity of the series at a time (s)."""
        values = {
            name: np.interp(time * (1 - 1e-9), *self._series[quantity, name], right=np.nan)
            for name in self.runs["id"]
            if (quantity, name) in self._series
        }
        return self._field(pd.Series(values, dtype=float), self._band_of(quantity, time))

    @functools.cache  # noqa: B019
    def wave(self, quantity: str) -> Field:
        """Return the largest max|eta| (m) among the paper's times, with the band of that one; or the peak at the gauge.

        The maximum of max|eta| over all time is no measure: at release the water beside the column leaps at once, and
        waves that meet on the axis have no limit that a grid would reach.
        """
        if quantity == GAUGE:
            name = f"{GAUGE}_peak"
            return self._field(self.runs.set_index("id")[name], self._band_of(name))
        fields = [self.at_time(quantity, time) for time in self.times]
        values, bands = (np.array([field[n].to_numpy(float) for field in fields]) for n in (0, 1))
        place = np.where(np.isnan(values), -np.inf, values).argmax(axis=0)[None]
        like = {"index": self.depths, "columns": self.ratios}
        return Field(*(pd.DataFrame(np.take_along_axis(x, place, 0)[0], **like) for x in (values, bands)))

    def arrival(self) -> Field:
        """Return the time of arrest (s) of the front, and what the band of L_f moves it by."""
        length = self.length()
        values, bands = {}, {}
        for _, run in self.runs.iterrows():
            name = run["id"]
            if (FRONT, name) not in self._series:
                continue
            time, front = self._series[FRONT, name]
            front = np.maximum.accumulate(front)
            final, band = length.at(run["a_H"], run["r"])
            there, early, late = (
                _first(time, front, (1 - ARREST) * level) for level in (final, final - band, final + band)
            )
            values[name] = run[f"time_of_arrest_{THRESHOLDS[0]}"]
            bands[name] = max(late - there, there - early) if self.banded else 0.0
        return self._field(pd.Series(values, dtype=float), pd.Series(bands, dtype=float))

    def _band_of(self, quantity: str, time: float | None = None) -> pd.Series:
        """Return the band of a quantity by id of the run: 0 in a study without bands, NaN where there is none."""
        ids = self.runs["id"]
        if not self.banded:
            return pd.Series(0.0, ids)
        rows = self._bands.get(quantity)
        if rows is None:
            return pd.Series(np.nan, ids)
        if time is not None:
            rows = rows[np.isclose(rows["time"].astype(float), time, rtol=1e-6)]
        return rows.set_index("id")["band"].astype(float).reindex(ids)

    def _field(self, values: pd.Series, bands: pd.Series) -> Field:
        """Return values and bands by id of the run, over a_H and r."""
        keys = self.runs.set_index("id")[["a_H", "r"]]
        table = keys.assign(value=values.reindex(keys.index), band=bands.reindex(keys.index))
        shape = {"index": self.depths, "columns": self.ratios}
        tables = (table.pivot(index="a_H", columns="r", values=name) for name in ("value", "band"))
        return Field(*(one.reindex(**shape).astype(float) for one in tables))


def _first(time: np.ndarray, rising: np.ndarray, level: float) -> float:
    """Return the time at which a rising series first reaches a level, between samples; NaN if the level is none.

    A level above all of the series is reached, as far as is known, at the time of its greatest value.
    """
    if not np.isfinite(level) or not np.isfinite(rising).any():
        return np.nan
    place = int(np.argmax(rising >= min(level, np.nanmax(rising))))
    if place == 0 or rising[place] == rising[place - 1]:
        return float(time[place])
    part = (min(level, rising[place]) - rising[place - 1]) / (rising[place] - rising[place - 1])
    return float(time[place - 1] + part * (time[place] - time[place - 1]))
