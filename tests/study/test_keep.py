"""What a record keeps of a run: all, its series, or a summary that holds their course and every number."""

import importlib

import numpy as np
import pandas as pd
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from subslide import jobs, naming
from subslide.points import Point
from subslide.records import course, netcdf, scalars, thinning
from subslide.results import open_record, trimmed
from subslide.study import config
from subslide.study.config import make_point

COLUMNS = [
    Point(cells=60),
    Point(cells=60, a_H=8.0, a_2=0.4, r=0.7, delta=22.0),
    make_point({"cells": 24, "grid": "fitted", "quantities": "grains", "a_2": 1.2}),
    make_point({"scene": "slab", "cells": 40}),
]

FIGURES = ("fig04_profiles_r0", "fig06_fronts")
NUMBERS = st.floats(-1e3, 1e3).filter(lambda value: value == 0 or abs(value) > 1e-20)
"""Single precision has no smaller ones to the last digit."""


def allowed(values):
    """How far a summary may be from a series: 1e-3 of its range, or the 1e-6 of its size that the format takes."""
    known = values[np.isfinite(values)]
    return max(1e-3 * np.ptp(known), 1e-6 * np.abs(known).max()) if known.size else 0.0


def turns(values, prominence):
    """Places of the local extremes that stand out of a series by more than a prominence."""
    kept, high, low, way = [], 0, 0, 0
    for n, value in enumerate(values):
        high, low = (n if value > values[high] else high), (n if value < values[low] else low)
        if way >= 0 and values[high] - value > prominence:
            kept.append(high)
            low, way = n, -1
        elif way <= 0 and value - values[low] > prominence:
            kept.append(low)
            high, way = n, 1
    return kept


@settings(deadline=None, max_examples=200)
@given(
    st.lists(st.tuples(st.floats(1e-6, 1.0), NUMBERS), min_size=2, max_size=60),
    st.booleans(),
)
def test_lines_between_kept_samples_pass_all_others(samples, smooth):
    steps, values = np.array(samples).T
    time = np.cumsum(steps)
    values = np.cumsum(values * steps) if smooth else values
    kept, short = np.zeros((1, len(time)), bool), values[None].copy()
    course.summarise(short, time, thinning.SHARE, thinning.LEAST, kept)
    stays = kept[0]
    assert stays[[0, -1]].all()
    passed = np.interp(time, time[stays], short[0, stays].astype(np.float32))
    assert np.abs(passed - values).max() <= allowed(values) * (1 + 1e-9)
    assert stays[turns(values, allowed(values))].all()


def test_gaps_and_equal_times_lose_nothing():
    time = np.array([0, 1, 2, 2, 3, 4, 5, 6, 7.0])
    values = np.array([[np.nan, np.nan, 1, 2, 3, 4, 5, np.inf, 7]])
    kept = np.zeros((1, 9), bool)
    course.summarise(values, time, 1e-3, 1e-6, kept)
    assert kept[0].tolist() == [True, True, True, True, False, False, True, True, True]
    back = thinning.filled(time[kept[0]], values[0, kept[0]])
    np.testing.assert_allclose(back, [np.nan, np.nan, 1, 2, 5, np.nan, 7], rtol=1e-3)


@pytest.mark.parametrize("point", COLUMNS, ids=lambda point: point.id)
def test_a_summary_holds_every_sample_and_every_number(point):
    whole, short = (jobs.solved(point, 1, keep=keep) for keep in ("all", "summary"))
    assert short.time[[0, -1]].tolist() == [0, np.float32(whole.time[-1])]
    for name in thinning.SUMMARY:
        for full, kept in zip(
            np.atleast_2d(getattr(whole, name)), np.atleast_2d(getattr(short, name)), strict=True
        ):
            assert kept.dtype == np.float32
            kept = thinning.filled(short.time, kept)
            known = np.isfinite(full)
            if known.any():
                passed = np.interp(whole.time[known], short.time, kept)
                assert np.abs(passed - full[known]).max() <= allowed(full)
    assert {name: value for name, value in scalars.of(short).items() if value == value} == {
        name: value for name, value in scalars.of(whole).items() if value == value
    }
    for name in ("L_f", "time_of_arrest", "snapshot_time", "time_at_rest", "steps", "wave_free_until"):
        np.testing.assert_array_equal(getattr(short, name), getattr(whole, name))
    at = np.searchsorted(whole.time, whole.snapshot_time * (1 - 1e-12))
    there = np.searchsorted(short.time, whole.time[at].astype(np.float32))
    assert (short.time[there] == whole.time[at].astype(np.float32)).all()
    for name in thinning.SUMMARY:  # not rounded, since bands compare them with those of other grids
        kept = thinning.filled(short.time, getattr(short, name))
        np.testing.assert_array_equal(kept[..., there], getattr(whole, name)[..., at].astype(np.float32))


@pytest.mark.parametrize("keep", ["series", "summary"])
def test_records_without_profiles_are_read_like_others(keep, tmp_path):
    runs = [jobs.solved(point, 1, keep=keep) for point in COLUMNS[:3]]
    netcdf.write(tmp_path / "a.nc", runs, keep)
    data = open_record(tmp_path / "a.nc")
    assert data.attrs["keep"] == keep
    assert not {"h2", "eta", "x", "cell_width"} & set(data.variables)
    assert ("energy" in data) == (keep == "series")
    for run in runs:
        one = trimmed(data, run.point.id)
        np.testing.assert_array_equal(one["time"], run.time)
        fronts = run.x_front if keep == "series" else thinning.filled(run.time, run.x_front)
        np.testing.assert_array_equal(one["x_front"], fronts)
        assert one.sizes["snapshot"] == len(run.snapshot_time)
        assert float(one["energy_rise"]) == scalars.of(run)["energy_rise"]


def test_a_summary_is_of_bounded_length_too(make_run):
    """Waves that go to and fro in a box until t_end: all runs of a record are padded to the longest."""
    time = np.linspace(0, 1, 40_001)
    wave = (1 - time / 2) * np.sin(10_000 * np.pi * time)
    series = {name: np.zeros(len(time)) for name in naming.SERIES} | {
        "x_front": np.ones((3, len(time))),
        "eta_gauge": wave,
    }
    run = make_run(Point(cells=40), steps=40_000, **series)
    short, others = (thinning.kept(run, keep) for keep in ("summary", "series"))
    assert 1000 < len(short.time) <= thinning.LONGEST
    passed = np.interp(others.time, short.time, short.eta_gauge)
    assert np.abs(passed - others.eta_gauge).max() <= allowed(wave)


def test_a_summary_takes_less_than_3_kB_a_point(tmp_path):
    random = np.random.default_rng(1)
    runs = [
        jobs.solved(make_point({"cells": 200, "a_H": a_H, "delta": delta}), 1, keep="summary")
        for a_H, delta in zip(random.uniform(0.5, 10, 80), random.uniform(20, 40, 80), strict=True)
    ]
    for count in (40, 80):
        netcdf.write(tmp_path / f"{count}.nc", runs[:count], "summary")
    few, many = ((tmp_path / f"{count}.nc").stat().st_size for count in (40, 80))
    assert (many - few) / 40 < 3000


def test_tables_follow_from_each_form(tmp_path, write_tables, solve_study, monkeypatch):
    monkeypatch.setattr("subslide.tables.series.MOST_CSV", 1)
    tables = {}
    for keep in ("all", "series", "summary"):
        study = config.make_study({"study": "t", "a_H": [1, 3], "r": [0, 0.5], "cells": 60, "keep": keep})
        solve_study(
            study, tmp_path / keep, lambda points, keep=keep: [jobs.solved(p, 1, keep=keep) for p in points]
        )
        tables[keep] = write_tables(tmp_path / keep)
        bare = tmp_path / keep / "tables/runs.csv"
        assert bare.read_bytes() == (tmp_path / "all/tables/runs.csv").read_bytes()
    pd.testing.assert_frame_equal(tables["all"].series, tables["series"].series)
    short = tables["summary"].series
    assert short["quantity"].nunique() == 6
    for (name, quantity), rows in tables["all"].series.groupby(["id", "quantity"]):
        kept = short[(short["id"] == name) & (short["quantity"] == quantity)]
        if quantity.startswith(thinning.SUMMARY):
            passed = np.interp(rows["time"], kept["time"], kept["value"])
            assert np.abs(passed - rows["value"]).max() <= allowed(rows["value"].to_numpy())
        else:
            assert kept.empty
    draws_with_a_word(tables["summary"], monkeypatch)


def draws_with_a_word(results, monkeypatch):
    """A figure of profiles says that there are none; one of series draws what is there, and reads no other rows."""
    assert results.curves("max_abs_eta", []) == {}
    monkeypatch.setattr(type(results), "series", property(lambda self: pytest.fail("all series were read")))
    profiles, fronts = (importlib.import_module(f"subslide.figures.{name}").draw(results) for name in FIGURES)
    assert "did not keep" in profiles.get_suptitle()
    assert len(fronts.axes[0].lines) > 1
