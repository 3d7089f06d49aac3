"""Designs: what each makes, that it makes the same again, and that each mistake gives one line."""

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


def one(kind, **options):
    """Return a design with one option replaced."""
    return {kind: {"points": 4, "over": {"a_H": [1, 2]}, **options}}


MISTAKES = {
    "a_H: {linspce: [0, 1, 3]}": ("a_H", "linspce", "linspace", "did you mean 'linspace'?"),
    "a_H: {linspace: [0, 1]}": ("a_H: linspace: [0, 1]", "[first, last, count], three numbers"),
    "a_H: {linspace: [0, 1, 2.5]}": ("a_H: linspace", "2.5", "a whole number from 2 to 200000"),
    "a_H: {linspace: [0, true, 2]}": ("a_H: linspace", "three numbers"),
    "a_H: {linspace: [0, .inf, 2]}": ("a_H: linspace", "three numbers"),
    "a_H: {geomspace: [0, 1, 3]}": ("a_H: geomspace: [0, 1, 3]", "above 0"),
    "a_H: {arange: [0, 1, -1]}": ("a_H: arange", "a step of -1", "from first to last"),
    "a_H: {arange: [0, 1, 1e-300]}": ("a_H: arange", "more than 200000 values"),
    "a_H: {linspace: [-1, 1, 3]}": ("a_H: -1", "from 0 to 1000"),
    "cells: {linspace: [100, 101, 3]}": ("cells: 100.5", "a whole number"),
    "scheme: {linspace: [1, 2, 3]}": ("scheme", "one of"),
    "design: 3": ("design: 3", "a mapping with one of zip, file"),
    "design: {}": ("design: {}", "a mapping with one of zip, file"),
    "design: {zipp: {a_H: [1]}}": ("design", "zipp", "did you mean 'zip'?"),
    "design: [{zip: {a_H: [1]}}, {zip: {a_H: [1], r: [0, 0.1]}}]": (
        "design[1]: zip",
        "a_H has 1 values, r has 2",
    ),
    "design: {zip: {a_H: [1, -2]}}": ("design: zip: a_H: -2", "from 0 to 1000"),
    "design: {zip: {a_H: 1}}": ("design: zip: a_H: 1", "a list of at least one"),
    "design: {zip: {a_h: [1]}}": ("design: zip: a_h", "did you mean 'a_H'?"),
    "design: {zip: {fields: [true]}}": ("design: zip: fields", "no such key here"),
    "design: {sobol: {points: 0, over: {a_H: [1, 2]}}}": ("design: sobol: points: 0", "from 1 to 200000"),
    "design: {sobol: {over: {a_H: [1, 2]}}}": ("design: sobol: points", "missing"),
    "design: {sobol: {points: 4}}": ("design: sobol: over", "missing"),
    "design: {sobol: {points: 4, over: {}}}": ("design: sobol: over: {}", "a mapping from keys"),
    "design: {sobol: {points: 4, sed: 1, over: {a_H: [1, 2]}}}": ("sobol: sed", "did you mean 'seed'?"),
    "design: {sobol: {points: 4, seed: -1, over: {a_H: [1, 2]}}}": ("sobol: seed: -1", "from 0 to"),
    "design: {sobol: {points: 4, over: {cells: [100, 200]}}}": ("over: cells", "no such key here"),
    "design: {sobol: {points: 4, over: {a_H: [2, 1]}}}": ("over: a_H: [2, 1]", "low below high"),
    "design: {sobol: {points: 4, over: {a_H: 1}}}": ("over: a_H: 1", "[low, high]"),
    "design: {sobol: {points: 4, over: {r: [0, 1]}}}": ("over: r: 1", "to 0.99999"),
    "design: {sobol: {points: 4, over: {t_end: [0, 1]}}}": ("over: t_end: 0", "from 1e-09"),
    "design: {sobol: {points: 4, over: {r: {unifrm: [0, 1]}}}}": ("over: r", "did you mean 'uniform'?"),
    "design: {sobol: {points: 4, over: {r: {log_uniform: [0, 0.5]}}}}": (
        "over: r",
        "log_uniform from above 0",
    ),
    "design: {sobol: {points: 4, over: {r: {truncated_normal: [0, 0, 0, 0.5]}}}}": (
        "over: r",
        "deviation above 0",
    ),
    "design: {sobol: {points: 4, over: {r: {truncated_normal: [9, 0.1, 0, 0.5]}}}}": (
        "over: r",
        "between them",
    ),
    "design: {sobol: {points: 4, over: {r: {file: nothing.csv}}}}": (
        "over: r: file: nothing.csv",
        "no such file",
    ),
    "design: {file: nothing.csv}": ("design: file: nothing.csv", "no such file"),
    "design: {saltelli: {points: 200000, over: {a_H: [1, 2]}}}": (
        "design: saltelli",
        "12800000 points",
        "at most",
    ),
    "a_H: 1\ndesign: {zip: {a_H: [1]}}": ("design: zip: a_H", "stands beside it too", "one place"),
    "design: [{zip: {a_H: [1]}}, {zip: {a_H: [1]}}]": ("design[1]: zip: a_H", "is in design[0]: zip too"),
    "a_2: 1\ndelta: 30\ndesign: {zip: {m: [1]}}": ("design: zip: m", "a_2 and delta"),
    "delta: 30\ndesign: {zip: {m: [0]}}": ("m: 0", "delta: 30", "a_2 inf", "from 0.001 to 100"),
    "a_2: 10\ndesign: {zip: {m: [99]}}": ("m: 99", "a_2: 10", "delta 89.9", "from 0 to 89"),
    "cases: [{}, {design: {zip: {a_H: [-1]}}}]": ("cases[1].design: zip: a_H: -1",),
    "a_H: [1, 2]\ndesign: {sobol: {points: 150000, over: {r: [0, 0.1]}}}": (
        "300000 points",
        "at most 200000",
    ),
}


@pytest.mark.parametrize("text", MISTAKES)
def test_mistake_gives_one_line(text, write_yaml, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    path = write_yaml(f"study: t\n{text}\n")
    with pytest.raises(ConfigError) as caught:
        config.read_study(path)
    assert "\n" not in str(caught.value)
    for part in (str(path), *MISTAKES[text]):
        assert part in str(caught.value)


@pytest.mark.parametrize(
    ("text", "part"),
    [
        ("", "no rows"),
        ("a_H,r\n", "no rows"),
        ("a_H,a_H\n1,2\n", "line 1: a_H is there twice"),
        ("a_H,rr\n1,2\n", "line 1: rr: no column may have this name; did you mean 'r'?"),
        ("a_H;r\n1;2\n", "line 1: a_H;r"),
        ("a_H,r\n1\n", "line 2: 1 values; allowed: 2"),
        ("a_H,r\n1,0\n\n1,x\n", "line 4: r: x is not allowed; allowed: a number from 0 to 0.99999"),
        ("a_H,r\n1,\n", "line 2: r: nothing is not allowed"),
        ("a_H,r\n1,010\n", "line 2: r: 010 may be read in several ways"),
        ('a_H,r\n1,"0"x\n', "line 2"),
        ("a_H,scheme\n1,hlll\n", "line 2: scheme: hlll is not allowed", ),
        ("a_H,cells\n1,20.5\n", "line 2: cells: 20.5 is not allowed"),
    ],
)  # fmt: skip
def test_mistake_in_a_file_is_named_by_line_and_column(text, part, tmp_path):
    path = tmp_path / "points.csv"
    path.write_text(text)
    with pytest.raises(ConfigError, match=re.escape(part)) as caught:
        study(design={"file": str(path)})
    assert str(caught.value).startswith(f"design: file: {path}")


def test_a_column_that_a_distribution_needs_is_missed_by_name(tmp_path):
    path = tmp_path / "samples.csv"
    path.write_text("a_h,b\n1,2\n")
    with pytest.raises(ConfigError, match=r"over: a_H: file: .*no column a_H.*did you mean 'a_h'"):
        study(design=one("sobol", over={"a_H": {"file": str(path)}}))


def test_one_run_takes_no_design_and_no_more_than_one_value():
    with pytest.raises(ConfigError, match=r"design: .*is not allowed for one run; allowed: only in a study"):
        config.make_point({"design": one("sobol")})
    with pytest.raises(ConfigError, match=r"a_H: .* has 3 values; allowed: one for one run"):
        config.make_point({"a_H": {"linspace": [0, 1, 3]}})


WORDS = [
    "points",
    "over",
    "scramblings",
    "uniform",
    "file",
    "a_H",
    "r",
    "m",
    "linspace",
    "hll",
    "x.csv",
    "/",
    "",
]
LEAVES = st.none() | st.booleans() | st.integers() | st.floats() | st.sampled_from(WORDS)
ANYTHING = st.recursive(
    LEAVES, lambda c: st.lists(c, max_size=3) | st.dictionaries(st.sampled_from(WORDS), c, max_size=3)
)
SHAPED = st.fixed_dictionaries(
    {"points": st.integers(1, 4), "over": st.dictionaries(st.sampled_from(WORDS), ANYTHING, max_size=2)}
)
KINDS = st.sampled_from(list(words_of_designs.DESIGNS))


@settings(deadline=None, max_examples=150)
@given(ANYTHING | st.dictionaries(KINDS, ANYTHING | SHAPED, min_size=1, max_size=1))
def test_whatever_stands_for_a_design_is_one_or_gives_one_line(value):
    try:
        assert study(design=value).runs
    except ConfigError as error:
        (line,) = str(error).split("\n")
        if not re.match(r"design|m: ", line):
            raise


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
