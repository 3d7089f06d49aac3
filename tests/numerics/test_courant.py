"""The search for the largest stable Courant number: a wave meets the theoretical limit, each criterion has teeth."""

import numpy as np
import pandas as pd
import pytest

from subslide.points import Point
from subslide.tables import cfl as courant

WAVE = courant.CASES[0]
COLUMN = courant.CASES[4]._replace(cells=40)


@pytest.fixture(scope="module")
def found():
    """Rows of the search for a wave on a line and a column on a radius."""
    rows = courant.search((WAVE, COLUMN), ("ifcph", "hll"), (1, 2))
    return pd.DataFrame(rows, columns=list(courant.COLUMNS))


@pytest.mark.parametrize("order", [1, 2])
@pytest.mark.parametrize("scheme", ["ifcph", "hll"])
def test_a_wave_of_one_speed_meets_the_theoretical_limit(found, scheme, order):
    rows = found[
        (found["scene"] == "standing_wave") & (found["scheme"] == scheme) & (found["order"] == order)
    ]
    (limit,) = rows[rows["limit"]]["cfl"]
    assert limit == pytest.approx(courant.THEORY, abs=0.08)


def test_the_default_is_stable_and_beyond_the_limit_is_not(found):
    for _, rows in found.groupby(["scene", "scheme", "order"]):
        (limit,) = rows[rows["limit"]]["cfl"]
        assert limit >= Point.cfl
        beyond = rows[rows["cfl"] > limit]
        assert not beyond["stable"].any()
        assert beyond["cfl"].min() <= limit + courant.WIDTH + 1e-9
        assert (beyond["why_not"] != "").all()
        assert (rows[rows["stable"]]["why_not"] == "").all()


def test_every_number_tried_is_a_row_with_its_measures(found):
    assert list(found.columns) == list(courant.COLUMNS)
    assert not found.duplicated(["model", "scene", "scheme", "order", "cfl"]).any()
    assert found[found["stable"]].notna().all(axis=None)
    assert (found["volume_drift"] < 1e-12).all()


@pytest.mark.parametrize(
    ("change", "why"),
    [
        (lambda run: setattr(run, "status", "step_collapse"), "status step_collapse"),
        (lambda run: run.sediment_volume.__setitem__(-1, 1.1 * run.sediment_volume[0]), "volume"),
        (lambda run: run.energy.__setitem__(-1, 1.5 * run.energy[0]), "energy"),
        (lambda run: run.h2.__iadd__(0.01 * (-1.0) ** np.arange(len(run.x))), "total variation"),
        (lambda run: run.h2.__iadd__(0.01), "distance"),
    ],
)
def test_each_criterion_has_teeth(change, why):
    judge = courant.resolved(COLUMN)
    run = courant.solve(courant.point(COLUMN, "ifcph", 2, courant.SAFE))
    judge = judge._replace(distance=courant.distance(run, judge.profiles))
    assert courant.tried(run, judge)["stable"]
    change(run)
    row = courant.tried(run, judge)
    assert not row["stable"]
    assert row["why_not"] == why


def test_where_no_number_is_stable_none_is_the_limit(monkeypatch):
    monkeypatch.setattr(courant, "GIVEN_BACK", -1.0)
    rows = courant.limit(COLUMN, "ifcph", 1, courant.resolved(COLUMN))
    assert [row["cfl"] for row in rows] == [courant.SAFE, courant.SAFE / 2, courant.SAFE / 4]
    assert not any(row["limit"] or row["stable"] for row in rows)
