"""What the paper says, held against made-up tables: each verdict is known, and turns with the numbers."""

from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest

from subslide.__main__ import main
from subslide.keys.schema import ConfigError
from subslide.laboratory import lube as laboratory
from subslide.points import PAPER_TIMES
from subslide.tables import claims
from subslide.tables._claims.evidence import THRESHOLDS, WAVES, Evidence

DEPTHS, RATIOS = (1.0, 2.0, 10.0), (0.0, 0.2, 0.4, 0.6, 0.8)
RADIUS, A_2 = 0.0705, 0.56
TIME = np.linspace(0, 0.6, 61)
LAW = laboratory.runout(A_2)


def as_said(a_H, r):
    """L_f/R, duration of the spreading (s) and max|eta| (m) of a world in which the paper's section 4 holds."""
    length = LAW - 0.1 * r - 0.001 * np.log(a_H) * (1 + r)
    return length, 0.15 + 0.2 * r, 1e-3 * (1.2 - r) / a_H


def study(world=as_said, band=None, kinds=("paper", "resolved"), depths=DEPTHS, ratios=RATIOS, status="ok"):
    """Tables of a study of a world. band: of all values, as a fraction (NaN: there is none); None: no bands."""
    runs, series, bands = [], [], []
    for kind in kinds:
        for a_H in depths:
            for r in ratios:
                name, (length, duration, wave) = f"{kind}{a_H}{r}", world(a_H, r)
                front = RADIUS * (1 + (length - 1) * np.minimum(TIME / duration, 1))
                waves = np.full(len(TIME), wave)
                arrest = duration * (0.995 * length - 1) / (length - 1)
                row = {"id": name, "numerics": kind, "a_H": a_H, "r": r, "a_2": A_2, "radius": RADIUS}
                row |= {"status": status, "time_of_arrest_1pc": arrest, "eta_gauge_peak": wave}
                runs.append({**row, **{f"L_f_{t}": RADIUS * length for t in THRESHOLDS}})
                values = {"x_front_1pc": front, **dict.fromkeys(WAVES, waves)}
                for quantity, value in values.items():
                    series.append(
                        pd.DataFrame({"id": name, "time": TIME, "quantity": quantity, "value": value})
                    )
                once = [(f"L_f_{t}", np.nan, RADIUS * length) for t in THRESHOLDS]
                once.append(("eta_gauge_peak", np.nan, wave))
                there = [(q, t, np.interp(t, TIME, v)) for q, v in values.items() for t in PAPER_TIMES]
                for quantity, time, value in (*once, *there) if band is not None else ():
                    word = "not converged" if np.isnan(band) else "converging"
                    bands.append((name, quantity, time, value, band * value, word))
    columns = ["id", "quantity", "time", "value", "band", "convergence"]
    return SimpleNamespace(
        folder="made up",
        runs=pd.DataFrame(runs),
        series=pd.concat(series),
        bands=pd.DataFrame(bands, columns=columns),
    )


def judged(results):
    """Table of claims."""
    return pd.DataFrame(claims.table(results), columns=list(claims.COLUMNS))


def verdicts(results, column="resolved_verdict"):
    """Verdict of each claim by its words."""
    table = judged(results)
    return dict(zip(table["claim"], table[column], strict=True))


def test_claims_on_waves_are_left_out_where_no_run_has_any():
    """As on grids that are fitted to the grains."""
    grains = study(band=0.001)
    grains.runs["eta_gauge_peak"] = np.nan
    grains.series = grains.series[grains.series["quantity"] == "x_front_1pc"]
    grains.bands = grains.bands[~grains.bands["quantity"].str.contains("eta")]
    table = judged(grains)
    assert len(table) == 9
    assert not table["measure"].str.contains("eta").any()


SECTION_4 = (
    "good agreement with the laboratory at r = 0",
    "deposit reached sooner for smaller r",
    "spreading faster for smaller r",
    "L_f smaller for bigger r",
    "L_f smaller for bigger a_H",
    "L_f differs most from r = 0 at r = 0.8, a_H = 10",
    "wave bigger for smaller r (whole box)",
    "wave bigger for smaller a_H (whole box)",
    "wave bigger for smaller r (beyond R)",
    "wave bigger for smaller a_H (beyond R)",
    "almost no wave at a_H = 10 (whole box)",
    "lighter grains raise a smaller wave (whole box)",
    "wave bigger at a_H = 1 than at 10 (whole box)",
    "wave bigger at a_H = 1 than at 10 (at 2 R)",
    "lighter grains raise a smaller wave (at 2 R)",
    "almost no wave at a_H = 10 (at 2 R)",
)
CONTRARY = ("L_f smaller at a_H = 1 than at 10",)
BETWEEN = ("intermediate depths more complex: L_f", "intermediate depths more complex: wave (beyond R)")


def changed(**parts):
    """A world that is `as_said` but for the parts that are given, functions of (a_H, r)."""

    def world(a_H, r):
        values = dict(zip(("length", "duration", "wave"), as_said(a_H, r), strict=True))
        values |= {key: function(a_H, r) for key, function in parts.items()}
        return tuple(values.values())

    return world


@pytest.mark.parametrize("band", [None, 1e-5])
def test_a_world_as_section_4_has_it(band):
    found = verdicts(study(band=band))
    assert {found[words] for words in SECTION_4} == {"supported"}
    assert {found[words] for words in (*CONTRARY, *BETWEEN)} == {"not supported"}


@pytest.mark.parametrize(
    ("words", "parts"),
    [
        ("good agreement with the laboratory at r = 0", {"length": lambda a_H, r: 1.2 * LAW - 0.1 * r}),
        ("deposit reached sooner for smaller r", {"duration": lambda a_H, r: 0.3 - 0.2 * r}),
        ("spreading faster for smaller r", {"duration": lambda a_H, r: 0.3 - 0.2 * r}),
        ("L_f smaller for bigger r", {"length": lambda a_H, r: LAW + 0.1 * r}),
        ("L_f smaller for bigger a_H", {"length": lambda a_H, r: LAW - 0.1 * r + 0.01 * r * np.log(a_H)}),
        ("L_f differs most from r = 0 at r = 0.8, a_H = 10", {"length": lambda a_H, r: LAW - 0.1 * r / a_H}),
        ("wave bigger for smaller r (whole box)", {"wave": lambda a_H, r: 1e-3 * (1 + r) / a_H}),
        ("wave bigger for smaller a_H (beyond R)", {"wave": lambda a_H, r: 1e-3 * (1.2 - r) * a_H}),
        ("almost no wave at a_H = 10 (whole box)", {"wave": lambda a_H, r: 1e-2 * (1.2 - r) / a_H**0.1}),
        ("lighter grains raise a smaller wave (whole box)", {"wave": lambda a_H, r: 1e-3 * (1 + r)}),
        ("wave bigger at a_H = 1 than at 10 (whole box)", {"wave": lambda a_H, r: 1e-3 * (1.2 - r) * a_H}),
    ],
)
def test_a_verdict_turns_with_the_numbers(words, parts):
    assert verdicts(study(changed(**parts), band=1e-5))[words] == "not supported"


def test_the_conclusion_s_own_reading_of_depth():
    world = changed(length=lambda a_H, r: LAW - 0.1 * r / a_H)
    found = verdicts(study(world, band=1e-5))
    assert found["L_f smaller at a_H = 1 than at 10"] == "supported"
    assert found["front more sensitive to r at a_H = 1 than at 10"] == "supported"
    contrary = changed(length=lambda a_H, r: LAW - 0.01 * r * a_H)
    assert verdicts(study(contrary))["front more sensitive to r at a_H = 1 than at 10"] == "not supported"


def test_something_between_the_ends():
    world = changed(
        length=lambda a_H, r: LAW + 0.1 * r * (a_H == 2), wave=lambda a_H, r: 1e-3 * (1 + (a_H == 2))
    )
    found = verdicts(study(world, band=1e-5))
    assert {found[words] for words in BETWEEN} == {"supported"}


@pytest.mark.parametrize("band", [20.0, np.nan])
def test_differences_within_the_bands_decide_nothing(band):
    results = study(band=band)
    assert set(verdicts(results).values()) == {"not decided"}
    bare = verdicts(study(), "resolved_as_computed")
    assert verdicts(results, "resolved_as_computed") == bare
    assert set(bare.values()) == {"supported", "not supported"}


def test_one_comparison_beyond_its_band_refutes_and_none_unknown_supports():
    results = study(changed(length=lambda a_H, r: LAW - 0.1 * r + 0.05 * (r == 0.8)), band=1e-5)
    lost = (results.bands["id"] == "resolved1.00.2") & (results.bands["quantity"] == "L_f_1pc")
    results.bands.loc[lost, ["band", "convergence"]] = [np.nan, "not converged"]
    assert verdicts(results)["L_f smaller for bigger r"] == "not supported"
    results = study(band=1e-5)
    results.bands.loc[lost, ["band", "convergence"]] = [np.nan, "not converged"]
    assert verdicts(results)["L_f smaller for bigger r"] == "not decided"
    assert verdicts(results, "paper_numerics_verdict")["L_f smaller for bigger r"] == "supported"


def test_numbers_are_those_of_the_tables():
    table = judged(study(band=0.01)).set_index("claim")
    length = as_said(1.0, 0.8)[0]
    row = table.loc["L_f smaller for bigger r"]
    assert f"{length:.4g}±{0.01 * length:.1g} (a_H = 1)" in row["resolved"]
    assert "beyond the bands" in row["resolved"]


def test_what_a_study_lacks_is_left_out():
    few = verdicts(study(depths=(1.0,), ratios=(0.2, 0.4)))
    assert "L_f smaller for bigger r" in few
    assert "L_f smaller for bigger a_H" not in few
    assert "good agreement with the laboratory at r = 0" not in few
    with pytest.raises(ConfigError, match="no runs that a claim speaks of"):
        claims.table(study(kinds=("default",)))
    one = judged(study(kinds=("resolved",)))
    assert set(one["paper_numerics_verdict"]) == {""}
    assert judged(study(ratios=(0.0,)))["claim"].str.startswith("wave").sum() == 0


def test_a_deposit_that_still_moves_has_no_length():
    assert Evidence(study(status="not_at_rest"), "paper").length().value.isna().all(axis=None)
    assert verdicts(study(status="not_at_rest"))["L_f smaller for bigger r"] == "not decided"


def test_the_arrival_of_the_front_has_the_band_of_its_length():
    evidence = Evidence(study(band=1e-3), "resolved")
    arrival = evidence.arrival().at(1.0, 0.4)
    length, duration, _ = as_said(1.0, 0.4)
    assert arrival[0] == pytest.approx(duration * (0.995 * length - 1) / (length - 1))
    assert arrival[1] == pytest.approx(duration * 0.995e-3 * length / (length - 1), rel=0.02)


def test_the_verb_refuses_what_is_no_study(tmp_path, capsys):
    assert main(["claims", str(tmp_path)]) == 2
    assert "points.json: there is no such file" in capsys.readouterr().err


def test_the_text_holds_every_claim_and_verdict():
    table = judged(study(band=1e-5))
    text = claims.text(SimpleNamespace(lines=lambda _: table.to_dict("records")))
    assert all(words in text for words in table["claim"])
    assert text.count("SUPPORTED (as computed") == 2 * len(table)
    assert max(map(len, text.splitlines())) <= 110


def test_the_page_holds_every_claim_and_escapes_what_it_shows():
    table = judged(study(band=1e-5))
    text = claims.html(table.to_dict("records"))
    assert text.count("<tr>") == len(table) + 1
    assert text.count("<b>supported</b>") == (table.filter(like="_verdict") == "supported").sum().sum()
    assert "r &gt; 0" in text
