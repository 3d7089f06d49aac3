"""Bands of a study: what is compared, what a failure does, and that on real runs a finer grid falls inside."""

from pathlib import Path

import numpy as np
import pytest
from fitted import fitted

from subslide.__main__ import main
from subslide.keys.schema import ConfigError
from subslide.study import config
from subslide.tables import _calibration as calibration
from subslide.tables import _fitted_bands as fitted_bands
from subslide.tables import bands
from subslide.tables._convergence import CONVERGING, NO_LIMIT, NOT_CONVERGED, ONE_GRID, estimate

FINAL = 0.14
"""m, limit of the made-up deposits, whose error is the cell size."""


@pytest.fixture
def finish(tmp_path, write_tables, solve_study):
    """Function that finishes a study with runs that `make(point)` gives, and returns its results."""

    def finish(make, **axes):
        study = config.make_study({"study": "t", "model": "radial", "bands": True, "cells": 160, **axes})
        solve_study(study, tmp_path, lambda points: [make(point) for point in points])
        return write_tables(tmp_path)

    return finish


@pytest.fixture
def first_order(make_run):
    """Function that makes up a run whose every quantity errs by a part of the cell size."""

    def make(point, **changes):
        run = make_run(point, steps=round(40 / point.dx**0.5))
        for name in ("x_front", "max_abs_eta", "max_abs_eta_outside", "eta_gauge"):
            setattr(run, name, getattr(run, name) * (1 + 10 * point.dx))
        run.L_f = FINAL - np.array([1, 0.5, 0.1]) * point.dx
        vars(run).update(changes)
        return run

    return make


def test_every_quantity_has_its_row_and_the_limit_is_found(finish, first_order):
    found = finish(first_order, a_H=[1, 2], snapshot_times=[0, 0.5]).bands
    assert list(found.columns) == list(bands.COLUMNS)
    once, timed = found[found["time"].isna()], found[found["time"].notna()]
    assert set(once["quantity"]) == set(bands.ONCE) - set(bands.ARRESTS)
    assert set(timed["quantity"]) == set(bands.QUANTITIES) - set(bands.ONCE)
    assert set(timed["time"]) == {0.5}  # neither the start nor the end, whose time depends on the grid
    assert len(found) == 2 * (len(bands.QUANTITIES) - len(bands.ARRESTS))
    deposits = found[found["quantity"].str.startswith("L_f")]
    assert deposits["order"].to_numpy() == pytest.approx(1, abs=1e-6)
    assert deposits["limit"].to_numpy() == pytest.approx(FINAL, rel=1e-9)
    assert (deposits["band"] > (deposits["limit"] - deposits["value"]).abs()).all()
    assert set(deposits["convergence"]) == {CONVERGING}


def test_an_end_at_a_snapshot_that_was_asked_for_is_compared(finish, first_order):
    rows = finish(first_order, a_H=1, snapshot_times=[0, 0.5, 1]).bands
    assert set(rows["time"].dropna()) == {0.5, 1.0}


def test_the_table_of_runs_repeats_bands_and_holds_no_companion(finish, first_order):
    results = finish(first_order, a_H=[1, 2])
    assert results.runs["cells"].tolist() == [160, 160]
    assert [run.point.cells for run in results.runs_of_study] == [160, 160]
    assert {one.point.cells for one in results.companions} == {80, 40}
    for name in set(bands.ONCE) - set(bands.ARRESTS):
        rows = results.bands[results.bands["quantity"] == name]
        for part in bands.SUMMARY:
            np.testing.assert_array_equal(rows[part], results.runs[f"{name}_{part}"])


def test_a_companion_that_is_asked_for_is_one_point(finish, first_order):
    results = finish(first_order, cells=[160, 80])
    values = results.bands.set_index(["id", "quantity"])
    fine, coarse = results.runs["id"]
    assert (
        values.loc[(fine, "L_f_1pc"), "value_2"].tolist() == values.loc[(coarse, "L_f_1pc"), "value"].tolist()
    )
    ids = [run.id for run in (*results.runs_of_study, *results.companions)]
    assert len(set(ids)) == 4


@pytest.mark.parametrize("failing", [160, 80, 40])
def test_a_grid_that_failed_says_nothing_of_convergence(finish, first_order, failing):
    def make(point):
        return first_order(point, **({"status": "left_domain"} if point.cells == failing else {}))

    results = finish(make, a_H=[1])
    assert set(results.bands["convergence"]) == {NOT_CONVERGED, NO_LIMIT}
    assert results.bands[["order", "limit", "band"]].isna().all(axis=None)
    assert results.runs["L_f_1pc_convergence"].tolist() == [NOT_CONVERGED]


def test_a_run_that_never_rests_has_bands(finish, first_order):
    results = finish(lambda point: first_order(point, status="not_at_rest"), a_H=[1])
    assert results.runs["L_f_1pc_convergence"].tolist() == [CONVERGING]


def test_a_quantity_without_a_limit_says_so_and_has_no_number(finish, first_order):
    rows = finish(first_order, a_H=[1]).bands
    limitless = rows[rows["convergence"] == NO_LIMIT]
    assert set(limitless["quantity"]) == {"max_abs_eta_peak", "max_abs_eta_outside_peak"}
    assert limitless[["order", "limit", "band"]].isna().all(axis=None)


def test_a_front_has_a_band_of_some_cells_where_columns_like_it_were_calibrated(finish, first_order):
    rows = finish(first_order, cells=400, a_H=[1]).bands.set_index("quantity")
    assert rows["calibrated"].all()
    cells = rows["band"] / (0.6 / 400)
    assert cells["L_f_1pc"] == pytest.approx(calibration.CELLS[2, True][0][1])
    assert cells["L_f_5pc"] < cells["L_f_3pc"] < cells["L_f_1pc"]


@pytest.mark.parametrize("unlike", [{"scheme": "hll"}, {"a_2": 2}, {"cells": 160}, {"friction": "voellmy"}])
def test_bands_of_a_run_unlike_those_that_were_calibrated_are_no_less_than_richardsons(
    finish, first_order, unlike
):
    def make(point):
        run = first_order(point)
        run.L_f = FINAL - 20 * np.array([1, 0.5, 0.1]) * point.dx
        return run

    rows = finish(make, **{"cells": 400, **unlike}).bands.set_index("quantity")
    assert not rows["calibrated"].any()
    for name in ("L_f_1pc", "L_f_3pc"):
        f1, f2, f3 = rows.loc[name, ["value", "value_2", "value_4"]]
        assert rows.loc[name, "band"] == pytest.approx(estimate(f1, f2, f3, 1.0).band)


def test_runs_of_the_named_numerics_are_calibrated_but_for_their_coarse_grids():
    alike = {
        (name, cells): calibration.is_calibrated(config.make_point({"numerics": name, "cells": cells}))
        for name in ("default", "paper", "resolved")
        for cells in (100, 200, 1600, 3200)
    }
    assert {key for key, is_alike in alike.items() if not is_alike} == {
        *((name, 100) for name in ("default", "paper", "resolved")),
        ("paper", 3200),
    }


def test_a_wave_has_the_widest_of_three_bands():
    point = config.make_point({"cells": 400})
    share = calibration.WAVES[2]
    assert calibration.wave(point, 1.0, 0.9, 0.9) == pytest.approx(share.last * 0.1)
    assert calibration.wave(point, 1.0, 1.0, 0.0) == pytest.approx(share.before)
    assert calibration.wave(point, 1.0, 1.0, 1.0) == pytest.approx(share.cell * point.scaled_dx)


def test_what_a_run_does_not_have_has_no_row(finish, first_order):
    def make(point):
        run = first_order(point)
        run.max_abs_eta = run.max_abs_eta_outside = run.eta_gauge = np.full(len(run.time), np.nan)
        return run

    results = finish(make, a_H=[1])
    assert not results.bands["quantity"].str.contains("eta").any()
    assert results.runs["max_abs_eta_peak_convergence"].isna().all()


def test_without_bands_there_is_no_table(finish, first_order):
    finish(first_order, a_H=[1])
    results = finish(first_order, a_H=[1], bands=False)
    assert main(["tables", str(results.folder)]) == 0
    assert not (results.folder / "tables/bands.csv").exists()
    assert list(results.bands.columns) == list(bands.COLUMNS)
    assert results.bands.empty
    assert (
        results.runs[[f"{name}_{part}" for name, parts in bands.SUMMARIES.items() for part in parts]]
        .isna()
        .all(axis=None)
    )


def test_on_real_runs_the_answer_of_a_finer_grid_lies_in_the_band(finish):
    from subslide.solver import solve

    results = finish(solve, a_H=[1, 10], cells=1600)
    for run in results.runs_of_study:
        finer = solve(config.make_point({"model": "radial", "a_H": run.point.a_H, "cells": 3200}))
        found = results.bands[results.bands["id"] == run.id].set_index("quantity")
        lengths = found.loc[["L_f_1pc", "L_f_3pc", "L_f_5pc"]]
        assert (np.abs(lengths["value"] - finer.L_f) < lengths["band"]).all()
        assert (lengths["band"] < 0.01 * lengths["value"]).all()  # and it is no empty statement


def of_fitted(first_order):
    """Function that makes up runs with times of arrest, on a fitted grid without anything of waves where asked for."""

    def make(point, **changes):
        run = first_order(point, time_of_arrest=np.array([0.3, 0.2, 0.1]), **changes)
        return fitted(run) if point.grid == "fitted" else run

    return make


FITTED = {"grid": "fitted", "cells": 48}


def test_runs_on_fitted_grids_have_bands_and_no_companions(finish, first_order):
    results = finish(of_fitted(first_order), **FITTED, a_H=[1, 2], snapshot_times=[0, 0.5])
    assert results.has_bands
    assert results.companions == ()
    rows = results.bands
    fronts = {name for name in bands.QUANTITIES if "eta" not in name}
    assert set(rows["quantity"]) == fronts
    assert len(rows) == 2 * len(fronts)
    assert rows[["value_2", "value_4", "order", "limit"]].isna().all(axis=None)
    assert set(rows["convergence"]) == {ONE_GRID}
    assert rows["calibrated"].all()
    runs = results.runs.set_index("id")
    for name in ("L_f_1pc", "time_of_arrest_5pc"):
        of_name = rows[rows["quantity"] == name].set_index("id")
        assert of_name["value"].to_dict() == runs[name].to_dict()
        assert of_name["band"].to_dict() == runs[f"{name}_band"].to_dict()
    assert set(runs["L_f_1pc_convergence"]) == {ONE_GRID}


def test_the_band_on_a_fitted_grid_is_a_share_that_grows_where_dense_water_is_shallow(finish, first_order):
    rows = finish(of_fitted(first_order), **FITTED, a_H=1, r=[0, 0.4]).bands.set_index(["quantity", "id"])
    share = rows["band"] / rows["value"]
    alone, dense = share["L_f_3pc"]
    assert alone == pytest.approx(2 * fitted_bands.SHARES["arrived"][1][2])  # a_H = 1
    assert dense == pytest.approx(alone / 2 * (2 + fitted_bands.DENSE * 0.4))
    assert share["time_of_arrest_1pc"].iloc[0] == pytest.approx(2 * fitted_bands.SHARES["arrest"][0][2])


def test_bands_on_fitted_grids_between_those_that_were_calibrated_lie_between_theirs():
    def band(cells, value=1.0, quantity="x_front_1pc"):
        point = config.make_point({"grid": "fitted", "cells": cells, "r": 0})
        return fitted_bands.half_width(point, quantity, value, 1.0) / fitted_bands.factor(point)

    assert band(34) > band(40) > band(48) > band(50)
    middle = np.log(40 / 34) / np.log(48 / 34)
    assert band(40) == pytest.approx(band(34) ** (1 - middle) * band(48) ** middle)
    assert band(24, 0.5) / 0.5 == pytest.approx(fitted_bands.SHARES["moving"][0][0])  # on its way
    assert band(24, 0.95) / 0.95 == pytest.approx(fitted_bands.SHARES["arrived"][0][0])


@pytest.mark.parametrize(
    ("unlike", "wider"),
    [
        ({"a_H": 20}, 4),
        ({"scheme": "hll"}, 4),
        ({"friction": "voellmy"}, 4),
        ({"scene": "slab"}, 4),
        ({"order": 1}, 16),
        ({"cells": 220}, 4),
        ({"cells": 12}, 16),
        ({"a_2": 3, "delta": 20}, 4 * (0.24 * 3 / np.tan(np.radians(20))) ** 3),
        ({"delta": 0, "t_end": 1}, 4 * 2.4**3),
    ],
)
def test_bands_of_fitted_runs_unlike_those_that_were_calibrated_are_wider(unlike, wider):
    point = config.make_point({**FITTED, **unlike})
    assert not fitted_bands.is_calibrated(point)
    shares = fitted_bands.SHARES["arrived"][0]
    share = {48: shares[2], 220: shares[-1], 12: shares[0]}[point.cells] * fitted_bands.factor(point)
    assert fitted_bands.half_width(point, "L_f_1pc", 1.0, 1.0) == pytest.approx(wider * share)


def test_a_fitted_run_that_failed_has_no_band(finish, first_order):
    results = finish(of_fitted(lambda point, **kw: first_order(point, status="diverged", **kw)), **FITTED)
    assert set(results.bands["convergence"]) == {NOT_CONVERGED, NO_LIMIT}
    assert results.bands["band"].isna().all()


def test_runs_on_both_grids_stand_in_one_study(finish, first_order):
    results = finish(of_fitted(first_order), grid=["uniform", "fitted"], cells=160)
    assert {one.of for one in results.companions} == {results.runs["id"][0]}
    of_length = results.bands[results.bands["quantity"] == "L_f_1pc"].set_index("id").loc[results.runs["id"]]
    assert of_length["convergence"].tolist() == [CONVERGING, ONE_GRID]
    assert of_length["value_2"].notna().tolist() == [True, False]
    arrests = results.bands[results.bands["quantity"].isin(bands.ARRESTS)]
    assert set(arrests["id"]) == {results.runs["id"][1]}


def test_cells_of_a_fitted_grid_need_not_halve():
    assert config.make_study({"study": "t", "bands": True, "grid": "fitted", "cells": 34}).companions == ()
    with pytest.raises(ConfigError, match="a multiple of 4 from 40"):
        config.make_study({"study": "t", "bands": True, "grid": ["fitted", "uniform"], "cells": 34})


def test_on_real_fitted_runs_a_converged_answer_lies_in_the_band(finish):
    from subslide.solver import solve

    results = finish(solve, **FITTED, a_H=[0.5, 1, 10], r=[0.1, 0.7])
    values = results.bands.set_index(["id", "quantity"])
    for run in results.runs_of_study:
        finer = solve(run.point.with_values(grid="uniform", cells=3200))
        rows = values.loc[run.id]
        for names, answer, most in (
            (["L_f_1pc", "L_f_3pc", "L_f_5pc"], finer.L_f, 0.03),
            (list(bands.ARRESTS), finer.time_of_arrest, 0.35),
        ):
            some = rows.loc[names]
            assert (np.abs(some["value"] - answer) < some["band"]).all()
            assert (some["band"] < most * some["value"]).all()  # and it is no empty statement


def test_pages_of_columns_name_every_quantity():
    page = Path(__file__).resolve().parents[2] / "docs/tables.md"
    assert all(f"- `{name}`" in page.read_text(encoding="utf-8") for name in bands.QUANTITIES)
