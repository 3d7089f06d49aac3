"""Designs: what each makes, and that it makes the same again."""

import json
import re

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from subslide.files import RecordError
from subslide.keys import designs as words_of_designs
from subslide.keys.schema import ConfigError
from subslide.results import Results
from subslide.study import config, csv_files, designs, distributions, forms

OVER = {
    "a_H": [0.5, 10],
    "a_2": {"log_uniform": [0.3, 1.5]},
    "r": [0, 0.8],
    "delta": {"truncated_normal": [30, 5, 20, 40]},
}


def study(**values):
    """Return the study of values."""
    return config.make_study({"study": "t", **values})


def values_of(study, *keys):
    """Return the values of keys of each point."""
    return [tuple(getattr(point, key) for key in keys) for point in study.points]


@pytest.mark.parametrize(
    ("form", "numbers"),
    [
        ({"linspace": [0, 0.3, 4]}, [0, 0.1, 0.2, 0.3]),
        ({"linspace": [2, 1, 3]}, [2, 1.5, 1]),
        ({"geomspace": [0.001, 1, 4]}, [0.001, 0.01, 0.1, 1]),
        ({"arange": [0, 0.3, 0.1]}, [0, 0.1, 0.2, 0.3]),
        ({"arange": [1, 0, -0.4]}, [1, 0.6, 0.2]),
        ({"arange": [-0.3, 0.3, 0.1]}, [-0.3, -0.2, -0.1, 0, 0.1, 0.2, 0.3]),
        ({"arange": [1, 1, 1]}, [1]),
    ],
)
def test_forms_give_the_numbers_that_are_meant_to_the_bit(form, numbers):
    assert forms.numbers(form, "a_H") == numbers


def test_forms_are_lists_in_studies_in_cases_in_zips_and_of_options():
    assert study(a_H={"linspace": [0, 1, 3]}).runs == study(a_H=[0, 0.5, 1]).runs
    assert [p.cells for p in study(cells={"geomspace": [100, 400, 3]}).points] == [100, 200, 400]
    assert study(cases=[{"r": {"arange": [0, 0.4, 0.2]}}]).runs == study(r=[0, 0.2, 0.4]).runs
    zipped = study(design={"zip": {"a_H": {"linspace": [1, 2, 2]}, "r": [0, 0.4]}})
    assert values_of(zipped, "a_H", "r") == [(1, 0), (2, 0.4)]
    ellipses = study(scene="ellipse", scene_options={"elongation": {"linspace": [1, 2, 3]}})
    assert [dict(p.scene_options)["elongation"] for p in ellipses.points] == [1, 1.5, 2]
    assert config.make_point({"a_H": {"arange": [3, 3.5, 1]}}).a_H == 3


def test_zipped_lists_and_files_multiply_with_lists_after_which_they_come(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "points.csv").write_text("r, scheme\n0.4,hll\n\n0, ifcp\n")
    assert values_of(study(delta=[25, 30], design={"zip": {"r": [0, 0.4], "a_H": [2, 1]}}), "delta", "a_H", "r") == [
        (25, 2, 0), (25, 1, 0.4), (30, 2, 0), (30, 1, 0.4),
    ]  # fmt: skip
    both = study(design=[{"zip": {"a_H": [1, 2]}}, {"file": "points.csv"}])
    assert values_of(both, "a_H", "r", "scheme") == [
        (1, 0.4, "hll"), (1, 0, "ifcp"), (2, 0.4, "hll"), (2, 0, "ifcp"),
    ]  # fmt: skip
    labels = study(cells=60, design={"zip": {"numerics": ["paper", "default"], "a_H": [1, 2]}})
    assert [(label, p.model, p.cells) for label, p in labels.runs] == [
        ("paper", "quarter", 60),
        ("default", "auto", 60),
    ]


def test_a_case_has_the_design_beside_the_cases_or_its_own_which_wins_over_lists():
    joined = study(a_H=[5, 6], cases=[{"design": {"zip": {"a_H": [1, 2], "r": [0, 0.1]}}}, {"r": 0.2}])
    assert values_of(joined, "a_H", "r") == [(1, 0), (2, 0.1), (5, 0.2), (6, 0.2)]
    shared = study(design={"zip": {"a_H": [1, 2]}}, cases=[{"r": 0}, {"r": 0.2}])
    assert values_of(shared, "a_H", "r") == [(1, 0), (2, 0), (1, 0.2), (2, 0.2)]


def test_m_sets_delta_or_where_that_is_stated_a_2():
    by_angle = study(a_2=[0.5, 1], design={"sobol": {"points": 8, "over": {"m": [0.5, 1.5]}}})
    assert len(by_angle.points) == 16
    m = [point.friction_number for point in by_angle.points]
    assert m[:8] == pytest.approx(m[8:], rel=1e-11)
    assert all(0.5 <= value <= 1.5 for value in m)
    by_height = study(delta=30, design={"zip": {"m": [0.5, 1.0]}})
    assert [(p.delta, p.a_2) for p in by_height.points] == [(30, 1.15470053838), (30, 0.57735026919)]
    in_design = study(design={"zip": {"m": [0.5, 1.0], "delta": [30, 45]}})
    assert [p.friction_number for p in in_design.points] == pytest.approx([0.5, 1.0], rel=1e-11)


PINNED = {
    "latin_hypercube": ["p0ad4d50041bd", "p0e3b13ac761c"],
    "sobol": ["pf8c0f1c6169e", "p931ca1139d07"],
    "saltelli": ["pf8c0f1c6169e", "p6b6fd5c9cb14"],
}


@pytest.mark.parametrize("kind", PINNED)
def test_ids_of_designs_are_pinned(kind):
    """A changed id makes every finished study of such a design run again: change it only with intent."""
    extra = {"scramblings": 2} if kind == "saltelli" else {}
    points = study(design={kind: {"points": 100, "seed": 3, "over": OVER, **extra}}).points
    assert [points[0].id, points[-1].id] == PINNED[kind]


def test_more_points_of_a_sobol_design_leave_the_first_as_they_are():
    ids = {
        count: [p.id for p in study(design={"sobol": {"points": count, "seed": 1, "over": OVER}}).points]
        for count in (1, 100, 128, 200, 256)
    }
    for count, few in ids.items():
        assert few == ids[256][:count]
    assert len(set(ids[256])) == 256
    other = study(design={"sobol": {"points": 256, "seed": 2, "over": OVER}})
    assert not set(ids[256]) & {p.id for p in other.points}


def test_more_points_and_scramblings_of_a_saltelli_design_leave_the_first_as_they_are():
    def ids(points, scramblings):
        design = {"saltelli": {"points": points, "seed": 1, "scramblings": scramblings, "over": OVER}}
        return np.array(study(design=design).designs[0]["ids"])

    assert (ids(4, 2) == ids(7, 3)[:2, :, :4]).all()


def test_the_order_of_keys_and_how_numbers_are_written_do_not_matter():
    over = {
        "r": [0, 0.8],
        "a_H": [0.5, 10],
        "delta": {"truncated_normal": [30.0, 5, 20.0, 40]},
        "a_2": {"log_uniform": [0.3, 1.5]},
    }
    for kind in ("latin_hypercube", "sobol", "saltelli"):
        one, other = (study(design={kind: {"points": 4, "over": o}}) for o in (OVER, over))
        assert one.runs == other.runs
        assert one.designs == other.designs
    first = study(design={"zip": {"r": [0, 0.4], "a_H": [1, 2]}}, delta=[30, 35])
    second = study(delta=[30.0, 35], design={"zip": {"a_H": [1.0, 2], "r": [0.0, 0.4]}})
    assert [p.id for p in first.points] == [p.id for p in second.points]


def test_widening_an_axis_or_a_design_adds_points_alone():
    few = study(a_H=[1, 2], design={"zip": {"r": [0, 0.4], "delta": [30, 31]}})
    more = study(a_H=[0.5, 2, 1.0], design={"zip": {"delta": [31, 32, 30], "r": [0.4, 0.5, 0]}})
    assert {p.id for p in few.points} < {p.id for p in more.points}


def test_points_of_lists_and_designs_that_coincide_are_one():
    joined = study(
        cases=[
            {"a_H": {"linspace": [1, 3, 3]}, "r": [0, 0.4]},
            {"design": {"zip": {"a_H": [2, 2.0, 4], "r": [0.4, 0.4, 0]}}},
        ]
    )
    assert values_of(joined, "a_H", "r")[6:] == [(4, 0)]


def test_saltelli_designs_are_listed_with_the_ids_of_their_runs_by_block():
    listed = study(
        cells=[100, 200],
        a_2=0.5,
        design=[{"saltelli": {"points": 4, "scramblings": 3, "over": {"r": [0, 0.8], "a_H": [1, 2]}}},
                {"zip": {"delta": [25, 30]}}],
    )  # fmt: skip
    by_id = {point.id: point for point in listed.points}
    assert [one["others"] for one in listed.designs] == [
        {"a_2": 0.5, "cells": cells, "delta": delta} for cells in (100, 200) for delta in (25, 30)
    ]
    (made,) = designs.checked(
        {"saltelli": {"points": 4, "scramblings": 3, "over": {"a_H": [1, 2], "r": [0, 0.8]}}}
    )
    again = np.array(made.make()).reshape(3, 6, 4, 2)
    for one in listed.designs:
        assert (one["kind"], one["names"]) == ("saltelli", ["a_H", "r"])
        assert one["spec"] == {
            "points": 4, "seed": 0, "scramblings": 3, "over": {"a_H": {"uniform": [1, 2]}, "r": {"uniform": [0, 0.8]}},
        }  # fmt: skip
        ids = np.array(one["ids"])
        assert ids.shape == (3, 6, 4)
        for place in np.ndindex(ids.shape):
            point = by_id[ids[place]]
            assert (point.a_H, point.r) == tuple(again[place])
            assert {key: getattr(point, key) for key in one["others"]} == one["others"]
    json.dumps(listed.designs, allow_nan=False)


def test_results_have_the_designs_that_points_json_lists(tmp_path, solve_study, make_run):
    made = study(cells=40, model="radial", t_end=1, design=SMALL)
    solve_study(made, tmp_path / "t", lambda points: [make_run(point) for point in points])
    results = Results(tmp_path / "t")
    assert results.designs == made.designs
    assert [run.id for run in results.runs_of_study] == [point.id for point in made.points]
    path = tmp_path / "t/points.json"
    index = json.loads(path.read_text())
    index["designs"][0]["ids"][0][0][0] = "p000000000000"
    path.write_text(json.dumps(index))
    with pytest.raises(RecordError, match="names other runs"):
        Results(tmp_path / "t").designs  # noqa: B018 - it is read when it is asked for


SMALL = {"saltelli": {"points": 2, "scramblings": 1, "over": {"r": [0, 0.8]}}}
RANGES = {
    "a_H": st.tuples(st.floats(0, 1000), st.floats(0, 1000)),
    "r": st.tuples(st.floats(0, 0.9), st.floats(0, 0.9)),
    "t_end": st.tuples(st.floats(1e-3, 10), st.floats(1e-3, 10)),
}


@st.composite
def boxes(draw):
    """Draw a box of some keys."""
    names = draw(st.lists(st.sampled_from(sorted(RANGES)), min_size=1, unique=True))
    box = {name: sorted(draw(RANGES[name])) for name in names}
    return {name: bounds for name, bounds in box.items() if bounds[1] - bounds[0] > 1e-6} or {"g": [9, 10]}


@settings(deadline=None, max_examples=25)
@given(
    box=boxes(),
    kind=st.sampled_from(["latin_hypercube", "sobol", "saltelli"]),
    points=st.integers(1, 20),
    seed=st.integers(0, 2**32 - 1),
)
def test_every_point_lies_in_its_box_and_each_design_is_what_it_is_called(box, kind, points, seed):
    extra = {"scramblings": 2} if kind == "saltelli" else {}
    (design,) = designs.checked({kind: {"points": points, "seed": seed, "over": box, **extra}})
    rows = np.array(design.make())
    low, high = np.array([box[name] for name in design.names]).T
    assert len(rows) == design.size
    assert ((rows >= low) & (rows <= high)).all()
    shares = (rows - low) / (high - low)
    if kind == "latin_hypercube":
        strata = np.sort(shares, axis=0) * points - np.arange(points)[:, None]
        assert ((strata > -1e-3) & (strata < 1 + 1e-3)).all()
    if kind == "saltelli":
        inputs = len(box)
        blocks = rows.reshape(2, 2 + 2 * inputs, points, inputs)
        a, b = blocks[:, 0], blocks[:, 1]
        for n in range(inputs):
            others = [m for m in range(inputs) if m != n]
            for block, base, other in ((2 + n, a, b), (2 + inputs + n, b, a)):
                assert (blocks[:, block][..., others] == base[..., others]).all()
                assert (blocks[:, block][..., n] == other[..., n]).all()
        assert (a != b).any()


SHARES = np.linspace(0, 1, 101)


def distribution(given, key="a_H"):
    """Return a checked distribution of a key."""
    return distributions.checked(key, given, designs.entry_of(key), key)


@settings(deadline=None, max_examples=50)
@given(
    low=st.floats(1e-3, 10), factor=st.floats(1.001, 100), mean=st.floats(-5, 2000), sd=st.floats(0.01, 1000)
)
def test_distributions_agree_with_their_quantiles(low, factor, mean, sd):
    from scipy.stats import truncnorm

    high = low * factor
    values = distribution({"log_uniform": [low, high]}).quantiles(SHARES)
    assert np.log(np.array(values) / low) / np.log(high / low) == pytest.approx(SHARES, abs=1e-7)
    a, b = (low - mean) / sd, (high - mean) / sd
    given = {"truncated_normal": [mean, sd, low, high]}
    if not distributions.share_within(mean, sd, low, high) > distributions.SMALLEST_SHARE:
        with pytest.raises(ConfigError, match="between them"):
            distribution(given)
        return
    values = np.array(distribution(given).quantiles(SHARES))
    assert values == pytest.approx(truncnorm.ppf(SHARES, a, b, mean, sd), rel=1e-6, abs=1e-6)
    assert (np.diff(values) >= 0).all()


def test_a_distribution_from_a_file_has_the_quantiles_of_its_column(tmp_path):
    samples = np.random.default_rng(1).gamma(2.0, size=500)
    path = tmp_path / "samples.csv"
    path.write_text("note,a_H\n" + "".join(f"x,{value!r}\n" for value in samples.tolist()))
    values = distribution({"file": str(path)}).quantiles(SHARES)
    assert values == pytest.approx(np.quantile(samples, SHARES), rel=1e-11)
    assert distribution({"file": str(path)}).spec["sha256"]


EXAMPLES = {
    "spaced": 125,
    "pairs": 4,
    "measured": 2,
    "sampled": 64,
    "similar": 40,
    "indices": 1280,
    "both": 32,
}


def test_each_example_of_the_page_is_a_study(root, tmp_path, monkeypatch):
    page = (root / "docs/designs.md").read_text(encoding="utf-8")
    (rows,) = re.findall(r"```csv\n(.*?)```", page, re.DOTALL)
    (tmp_path / "points.csv").write_text(rows)
    monkeypatch.chdir(tmp_path)
    counts = {}
    for number, text in enumerate(re.findall(r"```yaml\n(.*?)```", page, re.DOTALL)):
        path = tmp_path / f"{number}.yaml"
        path.write_text(text)
        made = config.read_study(path)
        counts[made.name] = len(made.points)
    assert counts == EXAMPLES


def test_a_file_may_hold_as_many_rows_as_a_study_points():
    assert csv_files.MOST_ROWS >= words_of_designs.MOST_POINTS
