"""Errors against seconds, on made-up runs: errors, the Pareto front and factors that are known exactly."""

import math

import numpy as np
import pandas as pd
import pytest
from fitted import fitted

from subslide.__main__ import main
from subslide.keys.schema import ConfigError
from subslide.pages import work_precision as page_of
from subslide.points import PAPER_RADIUS, Point
from subslide.study import config
from subslide.tables import _choices as words_of
from subslide.tables import _problems as problems
from subslide.tables import cheapest
from subslide.tables import work_precision as table

SWEEP = {
    "study": "t",
    "t_end": 1.0,
    "a_H": 2,
    "cases": [
        {"model": "radial", "scheme": ["ifcph", "hll"], "order": 2, "cells": [40, 80, 160, 320]},
        {"model": "plane", "order": 1, "front_flux": "hll", "cells": [40, 80, 160]},
    ],
}
LIMIT = 2.0
"""What the made-up final length over R tends to; every other quantity is as far from its limit, relatively."""


def error_of(point: Point) -> float:
    """Relative error of a made-up run: second-order runs have 4, 2, 1, 0.5 %, those in the plane 16, 8 and 4 %."""
    return (1.6 if point.order == 2 else 6.4) / point.cells


def seconds_of(point: Point) -> float:
    """Seconds of a made-up run: on a radius 1, 4, 16, 64 ms, twice that with HLL; in the plane 1, 8 and 64 s."""
    doubled = math.log2(point.cells / 40)
    if point.model == "plane":
        return 8.0**doubled
    return 1e-3 * 4**doubled * (2 if point.scheme == "hll" else 1)


@pytest.fixture
def folder(tmp_path, make_run, write_tables, solve_study):
    """Function that makes up a study whose runs differ from their limit by `error(point)`; None: the run failed."""

    def finish(error=error_of, **values):
        study = config.make_study({**SWEEP, **values})
        solve_study(study, tmp_path, lambda points: [solved(make_run, p, error(p)) for p in points])
        write_tables(tmp_path, "work_precision", "cheapest")
        return tmp_path

    return finish


def solved(make_run, point, error):
    """Made-up run of a point."""
    if error is None:
        nothing = np.full(3, np.nan)
        return make_run(point, status="diverged", L_f=nothing, wall_seconds=1e-6)
    time, factor = np.linspace(0, 1, 21), 1 - error
    height = point.a_2 * point.radius
    run = make_run(
        point,
        time=time,
        x_front=np.outer([1.0, 0.9, 0.8], factor * point.radius * (1 + time)),
        max_abs_eta=factor * height * np.sin(np.pi * time),
        max_abs_eta_outside=factor * height * np.sin(np.pi * time) / 2,
        L_f=factor * LIMIT * point.radius * np.ones(3),
        wall_seconds=seconds_of(point),
    )
    return fitted(run) if point.grid == "fitted" else run


def read(folder, name="work_precision"):
    """A table of a folder."""
    return pd.read_csv(folder / "tables" / f"{name}.csv")


def of(rows, quantity="L_f", **values):
    """Rows of one quantity with the given values, by cells."""
    rows = rows[rows["quantity"] == quantity]
    for key, value in values.items():
        rows = rows[rows[key] == value]
    return rows.sort_values("cells")


def test_errors_of_every_quantity_are_relative_to_the_extrapolated_truth(folder):
    rows = read(folder())
    assert list(rows.columns) == list(table.COLUMNS)
    assert len(rows) == 4 * len(table.QUANTITIES) * 2 + 3 * len(table.QUANTITIES)
    for quantity in table.QUANTITIES:
        known = [0.04, 0.02, 0.01, 0.005]
        assert of(rows, quantity, method="default")["error"].tolist() == pytest.approx(known, rel=1e-6)
        assert of(rows, quantity, method="paper")["error"].tolist() == pytest.approx(
            [0.16, 0.08, 0.04], rel=1e-6
        )
    truth = of(rows, "L_f")["truth"]
    assert truth.to_numpy() == pytest.approx(LIMIT * PAPER_RADIUS, rel=1e-6)
    # the band of values with errors e, 2 e and 4 e at first order: 1.25 e
    assert of(rows)["uncertainty"].to_numpy() == pytest.approx(1.25 * 0.005, rel=1e-6)


def test_no_error_is_surer_than_the_truth(folder):
    default = of(read(folder()), method="default")
    assert default["sure_error"].tolist() == pytest.approx([0.04, 0.02, 0.01, 0.00625], rel=1e-6)
    assert default["above_uncertainty"].tolist() == [True, True, True, False]


def test_a_grid_that_is_right_by_chance_does_not_count(folder):
    lucky = lambda point: 0.0 if (point.scheme, point.cells) == ("hll", 40) else error_of(point)  # noqa: E731
    hll = of(read(folder(lucky)), scheme="hll")
    assert hll["error"].tolist()[:2] == pytest.approx([0, 0.02], abs=1e-9)
    assert hll["sure_error"].tolist()[:2] == pytest.approx([0.02, 0.02])


def test_the_pareto_front_is_that_of_the_default(folder):
    rows = read(folder())
    front = rows[rows["on_front"]]
    for quantity in table.QUANTITIES:
        assert of(front, quantity)["cells"].tolist() == [40, 80, 160, 320]
        assert set(of(front, quantity)["method"]) == {"default"}


def test_front_and_cheapest_of_rows_that_are_known():
    entries = [(1, 9), (2, 9), (3, 5), (4, 7), (5, 5), (6, 1), (7, math.nan), (0.5, math.nan), (1, 8)]
    rows = [{"seconds": float(s), "sure_error": float(e)} for s, e in entries]
    assert [(row["seconds"], row["sure_error"]) for row in table.pareto(rows)] == [(1, 8), (3, 5), (6, 1)]
    assert table.cheapest(rows, 7)["seconds"] == 3
    assert table.cheapest(rows, 0.5) is None
    assert table.cheapest(rows, math.nan) is None


def test_a_failed_run_stays_without_an_error_and_off_the_front(folder):
    failing = lambda point: None if (point.scheme, point.cells) == ("hll", 160) else error_of(point)  # noqa: E731
    rows = of(read(folder(failing)), scheme="hll")
    assert rows["status"].tolist() == ["ok", "ok", "diverged", "ok"]
    lost = rows[rows["status"] == "diverged"].iloc[0]
    assert lost["seconds"] == pytest.approx(1e-6)  # cheaper than any other
    for column in ("error", "sure_error", "factor"):
        assert math.isnan(lost[column])
    assert not lost["on_front"]


def test_a_run_that_ended_before_its_time_has_no_error_of_series(make_run):
    point = Point(model="radial", t_end=2.0, cells=40)  # made-up runs last 1 s
    found = table.values(point, _as_record(make_run(point)))
    assert np.isnan(found["x_front"]).all()
    assert np.isfinite(found["L_f"]).all()
    assert np.isfinite(found["max_abs_eta"]).all()  # waves are at the edge of the box before


def _as_record(run):
    """Variables of a made-up run, as far as they are read."""
    names = ("time", "x_front", "max_abs_eta", "max_abs_eta_outside", "L_f", "status")
    return {name: getattr(run, name) for name in names}


def test_factors_are_those_at_equal_error(folder):
    found = folder()
    paper = of(read(found), method="paper")
    # 16 and 8 % are worse than any default run, so the cheapest (1 ms) counts; 4 % is just its error
    assert paper["factor"].tolist() == pytest.approx([1 / 1e-3, 8 / 1e-3, 64 / 1e-3])
    assert of(read(found), method="default")["factor"].tolist() == pytest.approx([1] * 4)
    assert of(read(found), scheme="hll")["factor"].tolist() == pytest.approx([2] * 4)
    assert table.reached(of(read(found)))["cells"].tolist() == [40, 80, 160]


def test_the_finest_grid_is_no_surer_than_its_change(folder):
    """No finer grid tells whether its error is small by chance."""
    lucky = lambda point: 0.0 if (point.scheme, point.cells) == ("hll", 320) else error_of(point)  # noqa: E731
    hll = of(read(folder(lucky)), scheme="hll")
    assert hll["sure_error"].tolist() == pytest.approx([0.04, 0.02, 0.01, 0.01], rel=1e-6)


def test_cheapest_choices(folder):
    chosen = of(read(folder(), "cheapest"), numerics="any").set_index("target")
    assert list(chosen.index) == list(cheapest.TARGETS)
    assert chosen["cells"].tolist()[:3] == [40, 80, 160]
    assert chosen["seconds"].tolist()[:3] == pytest.approx([1e-3, 4e-3, 16e-3])
    assert math.isnan(chosen.loc[0.005, "cells"])  # the truth is not known that well
    assert chosen["paper_reaches"].tolist()[:3] == [True, False, False]
    assert chosen["factor"].tolist()[:3] == pytest.approx([64e3, 16e3, 4e3])


FITTED = {"model": "radial", "order": 2, "grid": "fitted", "cells": [16, 48]}


def test_fitted_grids_are_numerics_of_their_own_without_waves(folder):
    """Made-up fitted runs err by 1 and 0.5 %, in less time than any other."""
    error = lambda point: 0.16 / point.cells if point.grid == "fitted" else error_of(point)  # noqa: E731
    found = folder(error, cases=[*SWEEP["cases"], FITTED])
    rows = read(found)
    for quantity in ("L_f", "x_front"):
        some = of(rows, quantity, method="fitted")
        assert some["error"].tolist() == pytest.approx([0.01, 0.16 / 48], rel=1e-6)
        assert some["grid"].tolist() == ["fitted"] * 2
        assert some["on_front"].all()
        assert some["factor"].tolist()[0] == pytest.approx(
            seconds_of(Point(**FITTED | {"cells": 16})) / 16e-3
        )
    waves = rows[(rows["method"] == "fitted") & rows["quantity"].isin(table.WAVES)]
    assert len(waves) == 4
    assert waves[["error", "sure_error", "factor"]].isna().all(axis=None)
    assert not waves["on_front"].any()
    assert set(waves["status"]) == {"ok"}
    chosen = of(read(found, "cheapest"), numerics="any", target=0.01)
    assert chosen[["grid", "cells"]].to_numpy().tolist() == [["fitted", 16]]
    assert of(read(found, "cheapest"), "max_abs_eta", numerics="any", target=0.01)["cells"].tolist() == [160]
    entries = words_of.choices(read(found, "cheapest"))
    assert any("fitted grid, 16 cells" in entry and "(default: 160 cells" in entry for entry in entries[3])


def test_a_grid_counts_by_what_is_solved():
    point = Point(grid="auto", quantities="grains")
    assert problems.NAMES[problems.method(point)] == "fitted"
    assert problems.NAMES[problems.method(point.with_values(quantities="all"))] == "default"


def test_problems_need_the_plane_and_three_grids_on_a_radius():
    def count(**values):
        return len(problems.problems(config.make_study({**SWEEP, **values}).points))

    radial, plane = SWEEP["cases"]
    assert count() == 1
    assert count(a_H=[1, 2]) == 2
    assert count(cases=[radial]) == 0
    assert count(cases=[plane]) == 0
    assert count(cases=[{**radial, "cells": [40, 80, 200]}, plane]) == 0
    assert count(cases=[{**radial, "order": 1}, plane]) == 0
    assert count(cases=[{**radial, "model": "auto"}, {**plane, "model": "quarter"}]) == 1
    found = problems.problems(config.make_study({**SWEEP}).points)[0]
    assert [point.cells for point in found.truth] == [320, 160, 80]
    assert {problems.NAMES.get(problems.method(point)) for point in found.points} == {
        "default",
        "paper",
        None,
    }


def test_the_papers_study_is_no_sweep(root):
    assert problems.problems(config.read_study(root / "config/paper.yaml").points) == []
    assert len(problems.problems(config.read_study(root / "config/accuracy.yaml").points)) == 2


def test_waves_are_compared_until_the_edge():
    assert problems.edge_time(Point(a_H=1)) == pytest.approx(0.2607, abs=1e-3)
    assert problems.edge_time(Point(a_H=10)) == pytest.approx(0.1112, abs=1e-3)
    assert problems.edge_time(Point(a_H=1, t_end=0.1)) == 0.1
    assert problems.end_time(Point()) == 0.54


def test_the_verb_prints_and_renews_pages(folder, tmp_path, capsys):
    found = folder()
    page = tmp_path / "page.md"
    page.write_text("a\n" + "\nb\n".join((*page_of.CHOICES, *page_of.EQUAL)) + "\nc\n")
    assert main(["work-precision", str(found), "-o", str(page)]) == 0
    assert "64,000" in capsys.readouterr().out
    text = page.read_text()
    assert text.startswith("a\n")
    assert text.endswith("\nc\n")
    assert "| 2 | 160 | 64 s | 4 % | 40 | 1 ms | 4 % | 64,000 |" in text
    assert "| 5 % | 2 | 40 cells, 1 ms |" in text
    assert "160 cells, 64 s: 64,000 times as long" in text
    assert "not with 160 cells, 64 s: over 16,000 times as long" in text
    assert "| none known |" in text
    assert main(["work-precision", str(found), "-o", str(page)]) == 0
    assert page.read_text() == text
    page.write_text("no marks")
    assert main(["work-precision", str(found), "-o", str(page)]) == 2


def test_a_study_without_a_sweep_is_refused(folder):
    with pytest.raises(ConfigError, match="has no sweep of numerics"):
        folder(cases=[SWEEP["cases"][0]])


@pytest.mark.parametrize(
    ("value", "text"),
    [(1.234e-4, "0.12 ms"), (0.4821, "480 ms"), (0.999, "1 s"), (9.96, "10 s"), (643.0, "640 s")],
)
def test_seconds_in_words(value, text):
    assert words_of.seconds(value) == text


def test_other_numerics_are_named_and_the_default_stands_beside():
    row = {
        **dict(zip(problems.METHOD, problems.DEFAULT, strict=True)),
        "id": "p",
        "cells": 80,
        "seconds": 0.004,
    }
    default = pd.Series(row)
    assert words_of.choice(default, default) == "80 cells, 4 ms"
    other = {
        "scheme": "hll",
        "order": 1,
        "dtype": "float32",
        "wave_speeds": "approximate",
        "model": "quarter",
    }
    best = pd.Series({**row, **other, "id": "q", "seconds": 0.003})
    words = "quarter, HLL, approximate wave speeds, order 1, float32, 80 cells, 3 ms"
    assert words_of.choice(best, default) == f"{words} (default: 80 cells, 4 ms)"
    nothing = pd.Series({**row, "id": math.nan})
    assert words_of.choice(best, nothing) == f"{words} (default: none known)"
    assert words_of.choice(nothing, nothing) == "none known"
