"""The stability atlas on made-up runs: references, errors, energy, and a reason for each empty entry."""

import numpy as np
import pytest

from subslide import exact
from subslide.__main__ import main
from subslide.keys import names
from subslide.pages import renewal
from subslide.records import energy
from subslide.results import Results
from subslide.study import config
from subslide.tables import atlas

COLUMN = {"model": "radial", "boundary": "wall", "figures": "none"}


@pytest.fixture
def folder(tmp_path, make_run, write_tables, solve_study):
    """Function that makes up a study, each run changed by `change(point)`, and its atlas; returns the table."""

    def finish(change, **values):
        study = config.make_study({"study": "t", **COLUMN, **values})

        def solve(points):
            return [
                make_run(point, **{"energy": falling(point), **unless_open(point), **change(point)})
                for point in points
            ]

        solve_study(study, tmp_path, solve)
        write_tables(tmp_path)
        rows = write_tables(tmp_path, "atlas").atlas
        texts = ["status_detail", "reference", "reason"]
        return rows.assign(**{name: rows[name].astype(object).fillna("") for name in texts})

    return finish


def falling(point, by=0.5, rise=0.0):
    """Energy (21) that starts at that of the volumes 2 and 3 m3 at rest, plus 1, falls and then rises."""
    half = round(4.2553 * point.radius / point.dx) * point.dx
    start = 1 + energy.at_rest(point, "radial", half, 3.0, 2.0)
    return start - by * np.minimum(np.arange(21) / 10, 1) + rise * np.maximum(np.arange(21) / 10 - 1, 0)


def unless_open(point):
    """Changes of a made-up run in a box that no wave leaves, for which the solver knows no time of that."""
    return {} if point.boundary in names.LEAVING else {"wave_free_until": np.nan}


def length(value):
    """Changes of a made-up run whose deposit has this length over R at each threshold."""
    return {"L_f": np.full(3, value * 0.0705)}


def test_errors_are_against_the_finest_run_of_the_default_numerics(folder):
    lengths = {20: 1.8, 80: 2.01, 160: 2.0}
    rows = folder(
        lambda point: length(lengths[point.cells]),
        cases=[{"scheme": ["ifcph", "hll"], "order": [1, 2], "cells": 20}, {"cells": [80, 160]}],
    ).set_index(["scheme", "order", "cells"])
    best = rows.loc[("ifcph", 2, 160)]
    assert set(rows["reference"]) == {best["id"]}
    assert rows.loc[("hll", 1, 20), "L_f_error"] == pytest.approx(0.1)
    assert rows.loc[("ifcph", 2, 80), "L_f_error"] == pytest.approx(0.005)
    assert rows["reference_L_f_change"].tolist() == pytest.approx([0.005] * 6)
    assert np.isnan(best["L_f_error"])
    assert best["reason"] == atlas.REFERENCE


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda p: {"status": "step_collapse"} if p.cells == 160 else {}, "the finest run ended as step_collapse"),
        (lambda p: length({20: 1.8, 80: 1.5, 160: 2.0}[p.cells]), "no reference of L_f: its two finest grids"),
        (lambda p: {"status": "diverged", **length(np.nan)} if p.cells == 20 else {}, "no answer: diverged"),
    ],
)  # fmt: skip
def test_what_has_no_error_has_a_reason(folder, change, words):
    rows = folder(change, cells=[20, 80, 160]).set_index("cells")
    assert np.isnan(rows.loc[20, "L_f_error"])
    assert words in rows.loc[20, "reason"]


def test_a_column_of_one_grid_or_of_grids_too_near_has_no_reference(folder):
    rows = folder(
        lambda _: {}, cases=[{"r": 0.2, "cells": 40}, {"r": 0.4, "scheme": "hll", "cells": [40, 50]}]
    )
    assert rows["L_f_error"].isna().all()
    assert rows["reason"].tolist() == [
        "no reference: it has one grid alone",
        *["no reference: the study has no finer run of this column"] * 2,
    ]


def test_energy_is_watched_behind_walls_and_over_what_can_be_released(folder):
    rows = folder(
        lambda point: {"energy": falling(point, by=0.5, rise=0.2 if point.r == 0.4 else 0.0)},
        cases=[{"r": [0.2, 0.4], "cells": 40}, {"r": 0.4, "cells": 40, "boundary": "open"}],
    )
    assert rows["energy_rise"].tolist()[:2] == pytest.approx([0.0, 0.2])
    assert np.isnan(rows["energy_rise"].iloc[2])
    assert "energy passes the open ends" in rows["reason"].iloc[2]


def test_lost_hyperbolicity_is_an_extent_and_a_share_of_steps(folder):
    lost = np.where(np.arange(21) < 7, 4.0, 0.0)
    (row,) = folder(lambda _: {"nonhyperbolic_cells": lost}, cells=40).to_dict("records")
    assert row["nonhyperbolic_length"] == pytest.approx(4 * 0.6 / 40 / 0.0705)
    assert row["nonhyperbolic_time"] == pytest.approx(7 / 21)


def test_no_entry_is_empty_without_a_reason_and_no_run_is_missing(folder):
    rows = folder(
        lambda point: {"status": "diverged", **length(np.nan)} if point.order == 1 else {},
        cases=[
            {"scheme": ["hll", "roe"], "order": [1, 2], "cells": 20},
            {"cells": [80, 160], "boundary": "open"},
        ],
    )
    assert list(rows.columns) == list(atlas.COLUMNS)
    assert len(rows) == 6
    empty = rows[["L_f_error", "max_abs_eta_error", "energy_rise"]].isna().any(axis=1)
    assert (rows.loc[empty, "reason"] != "").all()


def test_the_wave_of_the_scene_shear_has_its_growth_rate(folder):
    values = {
        "scene": "shear", "boundary": "periodic", "model": "line", "delta": 0, "cells": 40, "t_end": 0.1,
        "scene_options": {"shear": 1.5}, "snapshot_times": [0, 0.05],
    }  # fmt: skip

    def exactly(point):
        answer, half = exact.load("shear"), -(-point.cells // 2)
        x = (np.arange(-half, half) + 0.5) * point.dx
        shots = np.array([0, 0.05, 0.1])
        h2 = np.array([answer.solution(point, x, time)["h2"] for time in shots])
        shape = {"model": "line", "x": x, "h2": h2, "eta": 0 * h2, "h2_diagonal": None}
        return {**shape, "snapshot_time": shots, "energy": 3 - np.linspace(0, 1, 21)}

    (row,) = folder(exactly, **values).to_dict("records")
    assert row["growth_rate_theory"] > 0.5
    assert row["growth_rate"] == pytest.approx(row["growth_rate_theory"], rel=1e-6)
    assert "judged by its growth rate" in row["reason"]


def test_methods_are_counted_and_the_page_gets_their_table(folder, tmp_path, capsys, monkeypatch):
    monkeypatch.setattr(atlas, "needs", lambda study: "")  # a few runs stand for a study of stability
    rows = folder(
        lambda point: {"status": "step_collapse", **length(np.nan)} if point.scheme == "hll" else {},
        cases=[
            {"scheme": ["ifcph", "hll"], "cells": 20, "r": [0.2, 0.4]},
            {"cells": [80, 160], "r": [0.2, 0.4]},
        ],
    )
    page = tmp_path / "page.md"
    page.write_text("\n".join(["before", renewal.LAST_RUN[0], "old", renewal.LAST_RUN[1], "after", ""]))
    assert main(["atlas", str(tmp_path), "-o", str(page)]) == 0
    said = capsys.readouterr().out
    assert "8 runs; ok: 6, step_collapse: 2" in said
    failed = rows[rows["status"] == "step_collapse"]["id"]
    assert (
        f"2 runs failed or gained energy outside every region that `subslide check` cautions of: {' '.join(failed)}"
        in said
    )
    text = page.read_text()
    assert "| HLL, order 2 | 2 | 2 | 0 | 0 | 0 |" in text
    assert "| IFCPH, order 2 | 2 | 0 | 0 | 0 | 2 | 0.0% |" in text
    assert text.startswith("before")
    assert "old" not in text


def test_a_study_without_an_atlas_is_told(tmp_path):
    (tmp_path / "tables").mkdir()
    with pytest.raises(config.ConfigError, match="there is no such file"):
        Results(tmp_path).table("atlas")
