"""Tables and figures of sensitivity, on designs of the configuration with answers that are known in closed form."""

import importlib
import math
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest

from subslide import catalogue
from subslide.keys.schema import ConfigError
from subslide.pages import sensitivity
from subslide.results import StudyRun
from subslide.results.listing import Companion
from subslide.study.config import make_study
from subslide.tables import _emulated, effects, indices, indices_in_time, laws

NAMES = [name for name in catalogue.names("figures") if name.startswith("sensitivity_")]
BOX = {"a_H": [0.5, 10], "a_2": [0.3, 1.5], "r": [0, 0.8], "delta": [20, 40]}
SIMILAR = {"a_H": [0.5, 10], "a_2": [0.3, 1.5], "r": [0, 0.8], "m": {"file": "config/sensitivity_m.csv"}}
LAST = 6.01
"""Scaled time at which each made-up run ends."""


def answers(point):
    """Return scaled length, peak of the wave and time of arrest, which follow from a_H, r and m alone."""
    m = point.friction_number
    return 1 + 0.9 / m, 0.05 / point.a_H**0.7 * (1 - point.r) / m**0.3, 1 / math.sqrt(m * (1 - point.r))


class MadeUp:
    """A finished study whose runs have these answers; some runs failed."""

    def __init__(self, folder, bands=True, failed=0, cases=None):
        designs = [{"saltelli": {"points": 8, "seed": 1, "over": over}} for over in (BOX, SIMILAR)]
        given = {
            "study": "made-up", "bands": bands, "cases": cases or [{"design": design} for design in designs],
        }  # fmt: skip
        study = make_study(given)
        self.study, self.folder, self.has_bands, self.designs = study, folder, bands, study.designs
        self.runs_of_study = tuple(StudyRun(point.id, label, point, "0") for label, point in study.runs)
        ids = {run.id: run for run in self.runs_of_study}
        self.companions = tuple(
            Companion(point.id, of.id, role, point, "1") for of, role, point in study.companions
        )
        assert len(ids) == len(self.runs_of_study)
        self.runs = pd.DataFrame(
            [self.row(run, failed and n % failed == 7) for n, run in enumerate(self.runs_of_study)]
        )
        self.tables = {}

    def row(self, run, failed):
        point = run.point
        length, peak, arrest = answers(point)
        values = {
            "L_f_1pc": length * point.radius,
            "eta_gauge_peak": peak * point.column_height,
            "time_of_arrest_1pc": arrest * point.time_scale,
        }
        bands = {f"{name}_band": 0.002 * value for name, value in values.items()}
        bands["time_of_arrest_1pc_band"] = np.nan
        keys = {key: getattr(point, key) for key in ("a_H", "a_2", "r", "delta", "radius")}
        return {
            "id": run.id, **keys, "m": point.friction_number, "status": "diverged" if failed else "ok",
            **(dict.fromkeys(values, np.nan) if failed else values), **(bands if self.has_bands else {}),
            "L_f_1pc_over_R": np.nan if failed else length,
        }  # fmt: skip

    def each(self, *names, among=None):
        for run in self.runs_of_study if among is None else among:
            length, peak, arrest = answers(run.point)
            coarse = 1 + 0.001 * {"cells/2": 1, "cells/4": 2}.get(getattr(run, "role", ""), 0)
            time = np.linspace(0, LAST, 200)
            yield (
                run,
                {
                    "time": time * run.point.time_scale,
                    "x_front": run.point.radius * (1 + (length - 1) * np.tanh(time))[None] * coarse,
                    "max_abs_eta": run.point.column_height * peak * np.exp(-time) * coarse,
                    "time_of_arrest": np.array([arrest * run.point.time_scale * coarse]),
                    "status": "ok",
                },
            )

    def table(self, name):
        if name not in self.tables:
            module = importlib.import_module(f"subslide.tables.{name}")
            rows = pd.DataFrame(module.table(self), columns=list(module.COLUMNS))
            self.tables[name] = rows.replace({"": np.nan, None: np.nan}).infer_objects()
        return self.tables[name]


@pytest.fixture(autouse=True)
def few(monkeypatch):
    """The package's emulator, tried elsewhere, is asked for few columns."""
    monkeypatch.setattr(_emulated, "POINTS", 8)


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    return MadeUp(tmp_path_factory.mktemp("whole"))


@pytest.fixture(scope="module")
def failing(tmp_path_factory):
    return MadeUp(tmp_path_factory.mktemp("failing"), bands=False, failed=300)


def chosen(rows, **values):
    """Return the one row with some values."""
    some = rows[np.logical_and.reduce([rows[key] == value for key, value in values.items()])]
    assert len(some) == 1
    return some.iloc[0]


def test_a_2_and_delta_act_through_one_number(whole):
    rows = whole.table("indices")
    for output in rows["output"].unique():
        alone = chosen(rows, design=2, output=output, kind="total", input="a_2")
        assert abs(alone["estimate"]) < 1e-12
        m = chosen(rows, design=2, output=output, kind="first", input="m")
        both = chosen(rows, design=1, output=output, kind="closed", input="a_2", other="delta")
        assert abs(m["estimate"] - both["estimate"]) < 1.5 * math.hypot(m["sampling"], both["sampling"])
    assert chosen(rows, design=1, output="L_f_1pc", kind="total", input="r")["estimate"] == pytest.approx(
        0, abs=1e-12
    )


class Emulator:
    """An emulator that gives the made-up answers exactly."""

    quantities = ("L_f_1pc",)

    def predict(self, a_H, r, m=None, a_2=None, delta=None, quantities=()):
        m = np.tan(np.radians(delta)) / a_2 if m is None else m
        if np.min(a_H) < 0.5:
            raise ConfigError("a_H: outside")
        return {"L_f_1pc": SimpleNamespace(value=1 + 0.9 / m)}


def test_the_emulator_gives_the_same_indices(whole, monkeypatch):
    monkeypatch.setattr(_emulated, "Emulator", SimpleNamespace(load=Emulator))
    monkeypatch.setattr(_emulated, "SHIPPED", Path(__file__))
    monkeypatch.setattr(_emulated, "POINTS", 512)
    rows = pd.DataFrame(indices.table(whole))
    of_length = rows[rows["output"] == "L_f_1pc"]
    apart = (of_length["emulated"] - of_length["estimate"]).abs()
    assert np.mean(apart <= 1.5 * of_length["sampling"] + 1e-9) > 0.9
    assert rows[rows["output"] != "L_f_1pc"]["emulated"].isna().all()


def test_the_emulator_takes_distributions_not_what_a_small_design_drew(tmp_path, monkeypatch):
    monkeypatch.setattr(_emulated, "Emulator", SimpleNamespace(load=Emulator))
    monkeypatch.setattr(_emulated, "SHIPPED", Path(__file__))

    def emulated(points, **over):
        design = {"saltelli": {"points": points, "seed": 1, "scramblings": 2, "over": {**BOX, **over}}}
        study = MadeUp(tmp_path, bands=False, cases=[{"design": design}])
        return pd.DataFrame(indices.table(study)).get("emulated")

    np.testing.assert_allclose(emulated(1), emulated(8), atol=1e-12)
    assert emulated(1, a_H=[0.1, 10]) is None  # some columns lie beyond what the emulator knows


def test_indices_state_their_size_and_parts(whole):
    rows = whole.table("indices")
    first = rows[rows["design"] == 1]
    assert set(first["scramblings"]) == {16}
    assert set(first["points"]) == {8}
    assert set(first["runs"]) == {16 * 10 * 8}
    assert set(rows["output"]) == {"L_f_1pc", "eta_gauge_peak", "time_of_arrest_1pc"}
    assert len(rows) == 2 * 3 * (4 + 4 + 6 + 6)
    np.testing.assert_allclose(rows["high"] - rows["most"], rows["sampling"] + rows["grid"], atol=1e-12)
    assert (rows["grid"] > 0).all()
    assert rows["failed"].isna().all()
    assert set(rows[rows["high"] - rows["low"] <= 2 * indices.CONVERGED]["converged"]) == {"yes"}


def test_failed_runs_are_listed_and_bound_the_indices(whole, failing):
    rows, others = failing.table("indices"), whole.table("indices")
    names = {name for text in rows["failed"].dropna() for name in text.split()}
    assert names == set(failing.runs["id"][7::300])
    bounded = rows[rows["design"] == 1]
    assert not bounded[["estimate", "low", "high"]].isna().any(axis=None)
    assert rows["grid"].isna().all()  # no bands, no grid error
    true = others[others["design"] == 1]["estimate"].to_numpy()
    assert np.all((bounded["least"] <= true + 1e-12) & (true <= bounded["most"] + 1e-12))
    assert np.all(bounded["most"] >= bounded["least"])
    assert np.mean(bounded["most"] > bounded["least"]) > 0.7


def test_series_have_indices_to_the_end_of_the_waves(whole):
    rows = whole.table("indices_in_time")
    wave, front = (rows[rows["output"] == name] for name in ("max_abs_eta", "x_front_1pc"))
    assert wave["time"].max() == pytest.approx(6)
    assert front["time"].max() == pytest.approx(8)  # what is at rest stays
    once = whole.table("indices")
    late = chosen(front[front["time"] == 8], design=1, kind="first", input="a_2")
    rest = chosen(once, design=1, output="L_f_1pc", kind="first", input="a_2")
    assert late["estimate"] == pytest.approx(rest["estimate"], abs=1e-4)
    assert (rows["variance"] > 0).all()


def test_main_effects_have_the_first_order_index_as_their_variance(whole):
    rows = whole.table("effects")
    some = rows[(rows["design"] == 2) & (rows["output"] == "L_f_1pc") & (rows["input"] == "m")]
    np.testing.assert_allclose(some["mean"], 1 + 0.9 / some["value"], rtol=0.06)
    assert np.all(np.diff(some["mean"]) < 0)
    assert np.all((some["low"] < some["mean"]) & (some["mean"] < some["high"]))


def test_power_laws_are_recovered(whole, failing):
    rows = whole.table("laws")
    of_runout = rows[
        (rows["design"] == 1) & (rows["law"] == "runout") & (rows["source"] == laws.OURS)
    ].set_index("term")
    np.testing.assert_allclose(of_runout["value"][["C", "a_H", "m", "1 - r"]], [0.9, 0, -1, 0], atol=1e-9)
    of_peak = rows[(rows["design"] == 2) & (rows["law"] == "peak")].set_index("term")
    np.testing.assert_allclose(of_peak["value"][["C", "a_H", "m", "1 - r"]], [0.05, -0.7, -0.3, 1], atol=1e-9)
    assert (of_peak["error_95"] < 1e-9).all()
    assert (rows[rows["source"] == laws.LABORATORY]["term"] == ["C", "m"] * 2).all()
    left_out = failing.table("laws")["left_out"].dropna()
    assert {name for text in left_out for name in text.split()} == set(failing.runs["id"][7::300])


@pytest.mark.parametrize("module", [effects, indices, indices_in_time, laws])
def test_studies_without_a_saltelli_design_have_none(module):
    study = make_study({"study": "plain", "a_H": [1, 2]})
    assert module.needs(study) == "a saltelli design"
    with pytest.raises(ConfigError, match="a study with a saltelli design"):
        list(module.table(SimpleNamespace(designs=(), folder="x", runs_of_study=(), has_bands=False,
             runs=pd.DataFrame(columns=["status", "L_f_1pc", "eta_gauge_peak", "time_of_arrest_1pc"]),
             each=lambda *names: iter(()))))  # fmt: skip


def words(figure):
    """Return all text of a figure."""
    return " ".join([figure.get_suptitle(), *(text.get_text() for text in figure.texts)]).replace("\n", " ")


@pytest.mark.parametrize("name", NAMES)
def test_figures_draw(name, failing):
    module = importlib.import_module(f"subslide.figures.{name}")
    figure = module.draw(failing)
    panels = [ax for ax in figure.axes if ax.get_visible() and ax.has_data()]
    assert len(panels) >= 4
    assert module.TITLE in words(figure)
    if name in ("sensitivity_indices", "sensitivity_pairs"):
        assert "16 scramblings, N = 8" in words(figure)
        assert "9 runs lack an answer" in words(figure)
    if name == "sensitivity_laws":
        assert "4 runs have no logarithm" in words(figure)


def test_the_page_quotes_indices_and_laws(whole):
    text = Path("docs/sensitivity.md").read_text(encoding="utf-8")
    page = sensitivity.page(text, whole)
    for start, end in sensitivity.MARKS:
        lines = page.split(start)[1].split(end)[0].strip().splitlines()
        assert len(lines) > 10
        assert len({line.count("|") for line in lines}) == 1
    assert sensitivity.page(page, whole) == page
    row = chosen(whole.table("indices"), design=2, output="L_f_1pc", kind="first", input="m")
    assert f"{row['estimate']:.3f} ({row['low']:.3f} to {row['high']:.3f})" in page
    with pytest.raises(ConfigError, match="the page lacks the lines"):
        sensitivity.page("nothing", whole)


def test_indices_in_words(whole):
    text = indices.text(whole)
    assert "design 2 (a_H a_2 r m), L_f_1pc" in text
    assert len(text.splitlines()) == 6 * 10 - 1


def test_studies_with_a_saltelli_design_get_these_figures(whole):
    assert set(NAMES) <= set(whole.study.figures)
    assert not set(NAMES) & set(make_study({"study": "plain", "a_H": [1, 2]}).figures)


def test_m_of_the_configuration_is_distributed_as_in_the_box():
    samples = np.loadtxt("config/sensitivity_m.csv", skiprows=1)
    random = np.random.default_rng(1)
    m = np.tan(np.radians(random.uniform(20, 40, 400_000))) / random.uniform(0.3, 1.5, 400_000)
    shares = np.linspace(0.01, 0.99, 50)
    np.testing.assert_allclose(np.quantile(samples, shares), np.quantile(m, shares), rtol=0.01)
