"""Long series are thinned without losing an extremum, short ones not at all."""

import numpy as np
import pytest

from subslide import naming
from subslide.points import Point
from subslide.records import netcdf as records
from subslide.records import thinning
from subslide.results import open_record, trimmed


@pytest.fixture
def long_run(make_run):
    """A run of 100,000 steps with a spike of one sample in each series and random noise."""
    count = 100_000
    random = np.random.default_rng(1)
    run = make_run(Point(cells=40), steps=count)
    for k, name in enumerate(naming.SERIES):
        series = getattr(run, name) + 1e-3 * random.random(count + 1)
        series[..., 50_000 + 7 * k] = 100.0 + k
        setattr(run, name, series)
    run.energy[-1] = np.nan
    return run


def test_short_runs_stay_whole(make_run):
    run = make_run(Point(cells=40), steps=thinning.LONGEST - 1)
    assert thinning.thinned(run) is run


def test_every_extremum_stays_at_its_time(long_run):
    short = thinning.thinned(long_run)
    assert thinning.LONGEST / 2 < len(short.time) <= thinning.LONGEST
    np.testing.assert_array_equal(short.time[: thinning.HEAD], long_run.time[: thinning.HEAD])
    assert short.time[-1] == long_run.time[-1]
    assert np.diff(short.time).min() > 0
    for name in naming.SERIES:
        whole, kept = getattr(long_run, name), getattr(short, name)
        assert kept.shape == (*whole.shape[:-1], len(short.time))
        np.testing.assert_array_equal(np.nanmax(kept, axis=-1), np.nanmax(whole, axis=-1))
        np.testing.assert_array_equal(np.nanmin(kept, axis=-1), np.nanmin(whole, axis=-1))
        places = np.nanargmax(whole, axis=-1)
        np.testing.assert_array_equal(short.time[np.nanargmax(kept, axis=-1)], long_run.time[places])


def test_a_record_of_a_long_and_a_short_run_is_small_and_reads_back(long_run, make_run, tmp_path):
    short = make_run(Point(cells=40, r=0.2))
    records.write(tmp_path / "a.nc", [thinning.thinned(long_run), short])
    data = open_record(tmp_path / "a.nc")
    assert data.sizes["step"] <= thinning.LONGEST
    one = trimmed(data, long_run.point.id)
    assert int(one["steps"]) == 100_000
    assert float(one["max_abs_eta"].max()) == np.nanmax(long_run.max_abs_eta)
    assert trimmed(data, short.point.id).sizes["step"] == 21
