"""A study with a Saltelli design from its file to indices, laws, figures and the verb that prints them."""

import pandas as pd
import pytest
from projects import Project

from subslide.__main__ import main

STUDY = """study: small
cells: 40
bands: true
snapshot_times: [0.1]
figures: auto
design: {saltelli: {points: 4, scramblings: 4, seed: 1, over: {a_H: [1, 8], m: [0.5, 2]}}}
"""


def test_a_study_without_such_a_design_is_refused(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main(["sensitivity", "nothing"]) == 2
    assert "no such file" in capsys.readouterr().err


@pytest.mark.long
def test_a_study_has_indices_laws_and_figures(pytestconfig, tmp_path, monkeypatch, capsys):
    project = Project(pytestconfig.rootpath, tmp_path)
    project.configure(STUDY)
    project.snakemake()
    tables = project.results / "tables"
    indices = pd.read_csv(tables / "indices.csv")
    assert set(indices["runs"]) == {4 * 6 * 4}
    of_length = indices[(indices["output"] == "L_f_1pc") & (indices["kind"] == "first")].set_index("input")
    assert of_length.loc["m", "estimate"] > 0.8
    assert abs(of_length.loc["a_H", "estimate"]) < 0.1
    assert {"effects.csv", "laws.csv", "indices_in_time.csv"} <= {path.name for path in tables.iterdir()}
    assert len(list((project.results / "figures").glob("sensitivity_*.svg"))) == 5
    assert "sensitivity_pairs" in (project.results / "report.html").read_text(encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    assert main(["sensitivity", "results/small"]) == 0
    assert "design 1 (a_H m), L_f_1pc" in capsys.readouterr().out
