"""Tables: a row a run in the study's order, tidy series, and nothing that differs between identical runs."""

import numpy as np
import pandas as pd
import pytest

from subslide.records import netcdf as records
from subslide.results import Results
from subslide.study import batches, config
from subslide.study.batches import read_batch
from subslide.tables import runs as tables


@pytest.fixture
def finished(tmp_path, make_run):
    """Function that makes up a finished study and returns its folder."""

    def finish(changes=None, **axes):
        study = config.make_study({"study": "t", "model": "radial", "cells": 40, **axes})
        plan = batches.plan(study, tmp_path, extend=True)
        (tmp_path / "records").mkdir(exist_ok=True)
        for name in plan.batches:
            points = read_batch(tmp_path / "batches" / f"{name}.json")
            runs = [make_run(p, steps=10 + n, **(changes or {}).get(p.a_H, {})) for n, p in enumerate(points)]
            records.write(tmp_path / "records" / f"{name}.nc", runs)
        tables.write(tmp_path)
        return tmp_path

    return finish


def test_runs_are_rows_in_the_order_of_the_study(finished):
    runs = Results(finished(a_H=[2, 1, 10])).runs
    assert runs["a_H"].tolist() == [2, 1, 10]
    assert list(runs.columns) == list(tables.COLUMNS)
    assert runs["L_f_1pc_over_R"].tolist() == pytest.approx([2.4] * 3)
    assert runs["max_abs_eta_peak_time"].tolist() == pytest.approx([0.5, 0.5, 0.5], abs=0.05)
    assert (runs["sediment_volume_error"] == 0).all()


def test_failed_runs_are_rows(finished):
    nothing = {"status": "diverged", "L_f": np.full(3, np.nan), "time_at_rest": np.nan}
    runs = Results(finished({2.0: nothing}, a_H=[1, 2])).runs
    assert runs["status"].tolist() == ["ok", "diverged"]
    assert runs["L_f_1pc"].isna().tolist() == [False, True]


def test_series_are_tidy_and_without_padding(finished):
    results = Results(finished(a_H=[1, 2]))
    assert list(results.series.columns) == ["id", "time", "quantity", "value"]
    assert not results.series.isna().any().any()
    assert set(results.series["quantity"]) == set(tables.QUANTITIES)
    counts = results.series.groupby("id", sort=False)["time"].count()
    assert counts.tolist() == [11 * len(tables.QUANTITIES), 12 * len(tables.QUANTITIES)]


def test_quantities_a_run_lacks_have_no_rows(finished):
    lacking = {"max_abs_eta": np.full(11, np.nan), "water_volume": np.full(11, np.nan)}
    results = Results(finished({1.0: lacking}, a_H=[1]))
    assert not {"max_abs_eta", "water_volume"} & set(results.series["quantity"])
    assert results.runs["max_abs_eta_peak"].isna().all()


def test_timing_is_apart_from_results(finished):
    folder = finished(a_H=[1])
    assert "wall_seconds" not in tables.COLUMNS
    assert pd.read_csv(folder / "tables/timing.csv")["cell_updates_per_second"].tolist() == [20 * 10 / 0.5]


def test_identical_studies_give_identical_tables(finished):
    folder = finished(a_H=[1, 2])
    before = [(folder / "tables" / name).read_bytes() for name in ("runs.csv", "series.csv")]
    tables.write(folder)
    assert [(folder / "tables" / name).read_bytes() for name in ("runs.csv", "series.csv")] == before


def test_large_studies_have_parquet(finished, monkeypatch):
    monkeypatch.setattr(tables, "MOST_RUNS_IN_CSV", 1)
    folder = finished(a_H=[1, 2])
    assert not (folder / "tables/series.csv").exists()
    assert len(Results(folder).series) == 23 * len(tables.QUANTITIES)


def test_selection_by_value(finished):
    results = Results(finished(a_H=[1, 2], r=[0.2, 0.4]))
    assert len(results.select(a_H=2)) == 2
    assert len(results.select(a_H=2, r=0.4, model="radial")) == 1
    assert results.record(results.runs["id"][0])["h2"].dims == ("snapshot", "x")


def test_volume_errors_count_only_what_cannot_have_left(make_run, finished):
    late = np.full(301, 2.0)
    late[-1] = 1.0  # waves left the box
    results = Results(finished({1.0: {"water_volume": late[-11:], "boundary": "open"}}, a_H=[1], cells=12))
    assert results.runs["water_volume_error"].tolist() == [0.0]
