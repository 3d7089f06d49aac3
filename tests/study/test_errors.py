"""The table of errors: norms, observed orders and verdicts, on made-up runs whose errors are known."""

import numpy as np
import pandas as pd
import pytest

from subslide import exact
from subslide.__main__ import main
from subslide.files import RecordError
from subslide.keys.schema import ConfigError
from subslide.pages import renewal, verification
from subslide.records import thinning
from subslide.results import Results
from subslide.study import config
from subslide.tables import _norms, _orders, errors

WAVE = {
    "scene": "standing_wave",
    "scene_options": {"amplitude": 1e-3},
    "boundary": "wall",
    "delta": 0,
    "cells": [40, 80, 160],
}


@pytest.fixture
def folder(tmp_path, make_run, write_tables, solve_study):
    """Function that makes up a study whose profiles are exact but for `shift(point)`, in units of the amplitude."""

    def finish(shift, **values):
        study = config.make_study({"study": "t", "t_end": 0.5, "snapshot_times": [0], **values})
        solve_study(study, tmp_path, lambda points: [solved(make_run, point, shift) for point in points])
        write_tables(tmp_path, "errors")
        return tmp_path

    return finish


def solved(make_run, point, shift):
    """Run of a point: its profiles at the end are exact centre values, moved up by a share of the amplitude."""
    lost = shift(point) is None  # such a run ended early
    shots = np.array([0, 0.2 if lost else 0.5])
    half = -(-point.cells // 2)
    x = (np.arange(-half, half) + 0.5) * point.dx
    answer = getattr(exact.load(point.scene), "solution", lambda *_: {"h2": 0 * x, "eta": 0 * x})
    known = [answer(point, x, time) for time in shots]
    up = (shift(point) or 0.0) * 1e-3 * point.a_2 * point.radius
    return make_run(
        point,
        model="line",
        x=x,
        snapshot_time=shots,
        h2=np.nan_to_num([profile["h2"] for profile in known]) + up,
        eta=np.nan_to_num([profile["eta"] for profile in known]) + up,
        h2_diagonal=None,
        status="diverged" if lost else "ok",
    )


def table(folder):
    """Table of errors of a folder."""
    return pd.read_csv(folder / "tables/errors.csv")


def test_errors_are_relative_to_the_amplitude_and_orders_observed(folder):
    rows = table(folder(lambda point: 40 / point.cells, order=1, **WAVE))
    assert list(rows.columns) == list(errors.COLUMNS)
    h2 = rows[rows["quantity"] == "h2"]
    assert h2["error"].tolist() == pytest.approx([1.0, 0.5, 0.25], rel=2e-3)
    assert h2["observed_order"].iloc[1:].tolist() == pytest.approx([1.0, 1.0], abs=5e-3)
    assert h2["verdict"].tolist() == [errors.FIRST, errors.REACHED, errors.REACHED]
    assert h2["expected_order"].tolist() == [0.9] * 3


def test_an_order_that_is_too_low_is_below_and_fails_verification(folder, capsys):
    found = folder(lambda point: 40 / point.cells, order=2, **WAVE)
    assert table(found)["verdict"].tolist().count(errors.BELOW) == 4
    assert main(["verify", str(found)]) == 1
    said = capsys.readouterr()
    assert "standing_wave" in said.out
    assert "required, but below" in said.err


def test_reached_orders_pass_verification(folder, capsys):
    found = folder(lambda point: (40 / point.cells) ** 2, order=2, **WAVE)
    assert main(["verify", str(found)]) == 0
    assert capsys.readouterr().out.count("reached") == 2


def test_runs_that_differ_in_more_than_cells_are_not_compared(folder):
    rows = table(folder(lambda point: point.order / point.cells, **{**WAVE, "cells": 40, "order": [1, 2]}))
    assert set(rows["verdict"]) == {errors.FIRST}
    assert rows["observed_order"].isna().all()


def test_runs_of_one_grid_that_differ_in_physics_are_lines_of_their_own(folder):
    """As in the study of stability, whose wave is solved at several densities."""
    rows = table(folder(lambda point: (1 + point.r) / point.cells, order=1, **{**WAVE, "r": [0.2, 0.4]}))
    lines = [line for line in _orders.lines(rows) if line.quantity == "h2"]
    assert [line.cells for line in lines] == [[40, 80, 160]] * 2
    assert [round(line.observed, 6) for line in lines] == [1, 1]
    assert _orders.text(_orders.lines(rows))


def test_failed_runs_fail_verification(folder):
    found = folder(lambda point: None if point.cells == 160 else 1 / point.cells, order=1, **WAVE)
    rows = table(found)
    assert rows[rows["cells"] == 160]["verdict"].tolist() == [errors.FAILED] * 2
    assert _orders.lines(rows)[0].verdict == errors.FAILED
    assert main(["verify", str(found)]) == 1


def test_one_value_without_an_answer_has_no_row(folder):
    found = folder(lambda point: 1.0, **{**WAVE, "delta": 20, "cells": 40})
    assert table(found).empty
    assert main(["verify", str(found)]) == 2


def test_a_run_that_was_kept_without_profiles_has_no_row(tmp_path, make_run, solve_study, write_tables):
    """A study that says `keep: summary` no more has its old batches as they are, and is no more than these allow."""
    for cells, keep in ((40, "summary"), ([40, 80], "auto")):
        study = config.make_study({"study": "t", "t_end": 0.5, **WAVE, "cells": cells, "keep": keep})
        word = study.keep
        solve_study(
            study,
            tmp_path,
            lambda points, word=word: [
                thinning.kept(solved(make_run, p, lambda _: 0.1), word) for p in points
            ],
        )
    assert study.keep == "all"
    results = write_tables(tmp_path, "runs", "errors")
    assert set(results.errors["cells"]) == {80}
    ((_, record),) = results.each("h2", among=results.runs_of_study[:1])
    with pytest.raises(
        RecordError, match="no h2: it was made with keep: summary; make the study again with keep: all"
    ):
        record["h2"]


def test_the_front_is_compared_with_the_exact_edge(folder):
    dam = {"scene": "dam_break", "model": "line", "r": 0, "boundary": "wall", "delta": 32, "cells": 40}
    rows = table(folder(lambda point: 0.0, **dam)).set_index("quantity")
    assert list(rows.index) == ["x_front_1pc", "x_front_3pc", "x_front_5pc"]
    edge = 2 * 0.56 * 0.0705 / np.tan(np.radians(32))  # 2 h0 / mu, where it has come to rest
    fronts = np.array([1.2, 1.1, 1.0]) * 0.0705 * 1.5  # the made-up front at half a second
    np.testing.assert_allclose(rows["error"], 1 - fronts / edge, rtol=1e-6)
    assert set(rows["verdict"]) == {errors.NONE}


def test_the_page_keeps_its_text_and_gets_the_table(folder, tmp_path):
    found = folder(lambda point: 40 / point.cells, order=1, **WAVE)
    page = tmp_path / "page.md"
    page.write_text("\n".join(["before", renewal.LAST_RUN[0], "old", renewal.LAST_RUN[1], "after", ""]))
    assert main(["verify", str(found), "-o", str(page)]) == 0
    text = page.read_text()
    assert text.startswith("before\n")
    assert text.endswith("\nafter\n")
    assert "old" not in text
    assert text.count("| reached |") == 2
    with pytest.raises(ConfigError, match="lacks the lines"):
        verification.page("no marks", Results(found))


def test_grains_at_rest_must_be_still(folder, monkeypatch):
    pile = {"scene": "pile", "delta": 30, "cells": 40}
    assert set(table(folder(lambda point: 0.0, **pile))["verdict"]) == {errors.STILL}
    monkeypatch.setattr(_norms, "change", lambda *_: 1e-17)
    found = folder(lambda point: 0.0, **{**pile, "cells": 80})
    assert set(table(found)["verdict"]) == {errors.MOVED}
    assert main(["verify", str(found)]) == 1
    steep = {**pile, "scene_options": {"steepness": 1.05}}
    assert table(folder(lambda point: 0.0, **steep)).empty
