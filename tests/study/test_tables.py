"""Tables: a row a run in the study's order, tidy series, and nothing that differs between identical runs."""

import csv
import io
import math

import numpy as np
import pandas as pd
import pytest

from subslide import solver, tables
from subslide.results import Results
from subslide.study import cautions, config
from subslide.tables import _write, runs, series


@pytest.fixture
def finished(tmp_path, make_run, write_tables, solve_study):
    """Function that makes up a finished study and returns its folder."""

    def finish(changes=None, **axes):
        study = config.make_study({"study": "t", "model": "radial", "cells": 40, **axes})

        def solve(points):
            return [make_run(p, steps=10 + n, **(changes or {}).get(p.a_H, {})) for n, p in enumerate(points)]

        solve_study(study, tmp_path, solve)
        write_tables(tmp_path)
        return tmp_path

    return finish


def test_runs_are_rows_in_the_order_of_the_study(finished):
    table = Results(finished(a_H=[2, 1, 10])).runs
    assert table["a_H"].tolist() == [2, 1, 10]
    assert list(table.columns) == list(runs.COLUMNS)
    assert table["L_f_1pc_over_R"].tolist() == pytest.approx([2.4] * 3)
    assert table["max_abs_eta_peak_time"].tolist() == pytest.approx([0.5, 0.5, 0.5], abs=0.05)
    assert (table["sediment_volume_error"] == 0).all()


def test_failed_runs_are_rows(finished):
    nothing = {"status": "diverged", "L_f": np.full(3, np.nan), "time_at_rest": np.nan}
    table = Results(finished({2.0: nothing}, a_H=[1, 2])).runs
    assert table["status"].tolist() == ["ok", "diverged"]
    assert table["L_f_1pc"].isna().tolist() == [False, True]


def test_series_are_tidy_and_without_padding(finished):
    results = Results(finished(a_H=[1, 2]))
    assert list(results.series.columns) == ["id", "time", "quantity", "value"]
    assert not results.series.isna().any().any()
    assert set(results.series["quantity"]) == set(series.QUANTITIES)
    counts = results.series.groupby("id", sort=False)["time"].count()
    assert counts.tolist() == [11 * len(series.QUANTITIES), 12 * len(series.QUANTITIES)]


def test_quantities_a_run_lacks_have_no_rows(finished):
    lacking = {"max_abs_eta": np.full(11, np.nan), "water_volume": np.full(11, np.nan)}
    results = Results(finished({1.0: lacking}, a_H=[1]))
    assert not {"max_abs_eta", "water_volume"} & set(results.series["quantity"])
    assert results.runs["max_abs_eta_peak"].isna().all()


def test_timing_is_apart_from_results(finished):
    folder = finished(a_H=[1])
    assert "wall_seconds" not in runs.COLUMNS
    assert pd.read_csv(folder / "tables/timing.csv")["cell_updates_per_second"].tolist() == [20 * 10 / 0.5]


def test_identical_studies_give_identical_tables(finished, write_tables):
    folder = finished(a_H=[1, 2])
    before = [(folder / "tables" / name).read_bytes() for name in ("runs.csv", "series.csv")]
    write_tables(folder)
    assert [(folder / "tables" / name).read_bytes() for name in ("runs.csv", "series.csv")] == before


def test_large_studies_have_parquet(finished, monkeypatch):
    monkeypatch.setattr(series, "MOST_CSV", 1e4)
    folder = finished(a_H=[1, 2])
    assert not (folder / "tables/series.csv").exists()
    assert len(Results(folder).series) == 23 * len(series.QUANTITIES)


def test_series_are_parquet_by_their_size_and_not_by_the_number_of_runs(root):
    """192 resolved runs had 479 MB of CSV, the paper's 30 have 43."""
    axes = {"a_H": [1, 2, 3, 4, 5, 6], "r": [0, 0.2, 0.4, 0.6], "delta": [22, 24, 26, 28, 30, 32, 34, 36]}
    resolved = config.make_study({"study": "t", "numerics": "resolved", **axes})
    assert len(resolved.points) == 192
    assert tables.of_study(resolved)["series"] == ["series.parquet"]
    assert tables.of_study(config.read_study(root / "config/paper.yaml"))["series"] == ["series.csv"]
    coarse = config.make_study({"study": "t", "cells": 20, "a_H": {"linspace": [1, 10, 1500]}})
    assert tables.of_study(coarse)["series"] == ["series.csv"]
    assert series.filename(coarse.points * 100, "summary") == "series.parquet"


def test_options_of_scenes_are_columns(tmp_path, solve_study, make_run, write_tables):
    cases = [
        {"scene": "ellipse", "scene_options": {"elongation": [1.5, 2], "angle": 30}},
        {"scene": "pile"},
        {"scene": "columns", "scene_options": {"x": 0.5}},
        {},
    ]
    study = config.make_study({"study": "t", "cells": 20, "model": "plane", "cases": cases})
    solve_study(study, tmp_path, lambda points: [make_run(point) for point in points])
    table = write_tables(tmp_path, "runs").runs
    scenes = table["scene"].tolist()
    assert scenes == ["ellipse", "ellipse", "pile", "columns", "cylinder"]
    np.testing.assert_array_equal(table["elongation"], [1.5, 2, np.nan, np.nan, np.nan])
    np.testing.assert_array_equal(table["angle"][:2], [30, 30])
    assert table["shape"].fillna("").tolist() == ["", "", "cone", "", ""]
    assert table["option_x"].tolist()[3] == 0.5
    assert list(table.columns)[: len(runs.COLUMNS)] == list(runs.COLUMNS)


def test_what_is_constant_is_said_once(finished):
    folder = finished(a_H=[2, 1], r=[0.1, 0.2])
    whole, few = (pd.read_csv(folder / f"tables/{name}.csv") for name in ("runs", "runs_varied"))
    assert (folder / "tables/runs_varied.csv.sha256").is_file()
    assert list(few.columns[:6]) == ["id", "a_H", "r", "H1", "status", "status_detail"]
    pd.testing.assert_frame_equal(few, whole[few.columns])
    left_out = whole.drop(columns=few.columns)
    assert (left_out.nunique(dropna=False) == 1).all()
    assert left_out[[c for c in left_out if c not in runs.ASKED]].isna().all(axis=None)
    assert {"L_f", "L_f_1pc", "eta_gauge_peak"} <= set(few)
    assert not [name for name in few if name.endswith("_band")]


def test_heights_and_the_front_that_is_meant_are_columns(finished):
    table = Results(finished(a_H=[2, 1], a_2=0.5, radius=0.1)).runs
    assert table["H2"].tolist() == pytest.approx([0.05, 0.05])
    assert table["H1"].tolist() == pytest.approx([0.1, 0.05])
    assert table["L_f"].tolist() == table["L_f_1pc"].tolist()


def test_selection_by_value(finished):
    results = Results(finished(a_H=[1, 2], r=[0.2, 0.4]))
    assert len(results.select(a_H=2)) == 2
    assert len(results.select(a_H=2, r=0.4, model="radial")) == 1
    assert results.record(results.runs["id"][0])["h2"].dims == ("snapshot", "x")


def test_volume_errors_count_only_what_cannot_have_left(make_run, finished):
    late = np.full(301, 2.0)
    late[-1] = 1.0  # waves left the box
    results = Results(finished({1.0: {"water_volume": late[-11:]}}, a_H=[1], cells=12))
    assert results.runs["water_volume_error"].tolist() == [0.0]


def test_a_run_whose_energy_rose_is_known_by_its_column(finished):
    small = np.full(11, 1e-6)  # volumes that hold no energy at rest
    fallen = {"energy": 3 - np.linspace(0, 1, 11), "sediment_volume": small, "water_volume": small}
    risen = {**fallen, "energy": fallen["energy"] + np.where(np.arange(11) == 7, 2.2, 0.0)}
    later = {**risen, "wave_free_until": 0.65}  # what the edge sends back has a part in the rise
    rises = {}
    for a_H, made in enumerate((fallen, risen, later), 1):
        made = {"wave_free_until": np.nan, **made}
        (rises[a_H],) = Results(finished({a_H: made}, a_H=[a_H])).runs["energy_rise"]
    assert rises == pytest.approx({1: 0, 2: 0.7, 3: 0}, abs=1e-4)


def test_the_film_of_the_caution_shows_its_rise(tmp_path, write_tables, solve_study):
    film = cautions.REGIONS[0]
    study = config.make_study({"study": "t", **film.example})
    solve_study(study, tmp_path, lambda points: [solver.solve(point) for point in points])
    (row,) = write_tables(tmp_path).runs.to_dict("records")
    assert row["status"] == "ok"
    assert row["energy_rise"] > 10


def test_runs_have_their_points_and_variables_without_padding(finished):
    results = Results(finished(a_H=[1, 2]))
    (first, short), (second, long) = results.each("time", "x_front", "h2", "x", "status", "absent")
    assert (first.point.a_H, second.point.a_H) == (1, 2)
    assert first.point.id == first.id
    assert [len(record["time"]) for record in (short, long)] == [11, 12]
    assert short["x_front"].shape == (3, 11)
    assert short["h2"].shape == (3, len(short["x"]))
    assert short["status"] == "ok"
    assert "absent" not in short


def test_a_large_study_is_read_in_parts_with_the_same_result(finished, monkeypatch):
    folder = finished(a_H=[1, 2, 3, 4, 5])
    whole = [(run.id, record["time"].tolist()) for run, record in Results(folder).each("time")]
    monkeypatch.setattr("subslide.results.MOST_BYTES", 1.0)  # one run at a time
    assert [(run.id, record["time"].tolist()) for run, record in Results(folder).each("time")] == whole


@pytest.mark.parametrize("float_format", ["", "%.10g"])
def test_rows_are_written_as_pandas_would(float_format):
    rows = [
        {"a": 1, "b": 1, "c": "x, y", "d": True, "e": 1e-5, "f": None, "g": "rest", "h": np.nan},
        {
            "a": 2,
            "b": np.nan,
            "c": 'a "b"',
            "d": False,
            "e": np.float64(1) / 3,
            "f": "z",
            "g": 0.05,
            "h": None,
        },
        {"a": np.int32(3), "b": 2.5, "c": "", "e": np.inf, "g": 1.0 / 3},
    ]
    made = _write.csv_text("abcdefgh", rows, float_format)
    frame = pd.DataFrame(rows, columns=list("abcdefgh"))
    assert made == frame.to_csv(index=False, lineterminator="\n", float_format=float_format or None)


def test_entries_are_written_as_the_library_would():
    columns = {
        "text": ["plain", "a, b", 'say "so"', "two\nlines", "return\r", "", " "],
        "number": [0.0, -0.0, 0.1, math.nan, math.inf, 0.1, 1e300],
        "array": np.array([1 / 3, math.nan, -0.0, 0.0, 5e-324, 2.0, -1.0]),
        "words": np.array(["a,b", "c", "", "d", "e", "f", "g"], object),
        "whole": [1, -2, 3, 4, 5, 6, 7],
        "some": [None, 2, 3, math.nan, 5, 6, 7.5],
        "mixed": [True, "a,b", 3, None, 0.5, math.nan, "x"],
        "none": [None] * 7,
    }
    texts = {
        **columns,
        "number": ["0.0", "-0.0", "0.1", "", "inf", "0.1", "1e+300"],
        "array": [repr(1 / 3), "", "-0.0", "0.0", "5e-324", "2.0", "-1.0"],
        "some": ["", "2.0", "3.0", "", "5.0", "6.0", "7.5"],
        "mixed": ["True", "a,b", "3", "", "0.5", "", "x"],
        "none": [""] * 7,
    }
    expected = io.StringIO()
    writer = csv.writer(expected, lineterminator="\n")
    writer.writerows([columns, *zip(*texts.values(), strict=True)])
    assert "".join(part for (part,) in _write.csv_parts(columns, [list(columns)])) == expected.getvalue()
