"""Benchmarks, untimed: that the C reference computes what the solver computes, and that the table is written."""

import csv
import importlib
import json
import sys

import pytest


@pytest.fixture
def bench(root, monkeypatch):
    """Function that imports a module of the folder benchmarks."""
    monkeypatch.syspath_prepend(str(root / "benchmarks"))
    before = set(sys.modules)
    yield importlib.import_module
    for name in set(sys.modules) - before:  # names as short as theirs are not left behind
        if (
            getattr(sys.modules[name], "__file__", None)
            and str(root / "benchmarks") in sys.modules[name].__file__
        ):
            del sys.modules[name]


@pytest.fixture
def compiler(bench):
    """The C compiler's path; the test is skipped where there is none."""
    compiled = bench("compiled")
    try:
        return compiled.compiler()
    except compiled.NoCompilerError as error:
        pytest.skip(str(error))


@pytest.mark.parametrize("dtype", ["float64", "float32"])
def test_c_reference_computes_the_fluxes_of_the_solver(bench, compiler, dtype):
    reference = bench("reference")
    assert reference.disagreement(dtype, seed=1) <= reference.TOLERANCE[dtype]


def test_compiled_c_leaves_denormal_numbers_alone(bench, compiler):
    import numpy as np

    bench("compiled").library("reference.c", "float64")
    assert np.float64(1e-310) * 0.5 > 0


def test_a_missing_compiler_is_named(bench, monkeypatch):
    compiled = bench("compiled")
    monkeypatch.setenv("CC", "no-such-compiler")
    with pytest.raises(compiled.NoCompilerError, match="'no-such-compiler' is not on the PATH"):
        compiled.compiler()


def test_a_part_writes_the_table_and_the_machine(bench, compiler, tmp_path, capsys):
    assert bench("run").main(["--quick", "--only", "memory", "-o", str(tmp_path)]) == 0
    with open(tmp_path / "bench.csv", newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert {row["model"] for row in rows} == {"one-layer", "radial", "quarter", "plane"}
    assert all(100 < float(row["value"]) < 1000 and row["unit"] == "B" for row in rows)
    assert json.loads((tmp_path / "machine.json").read_text())["compiler_flags"].startswith("-O3")
    assert "not measured" in capsys.readouterr().out


def test_targets_are_judged_by_the_row_they_are_about(bench):
    table, timing = bench("table"), bench("timing")
    about = {"model": "plane", "scheme": "ifcph", "dtype": "float64", "cells": 400}
    rows = table.rows_of("loop", "over_c", timing.Spread(0.7, 0.6, 0.8), order=1, **about)
    rows += table.rows_of("loop", "over_c", timing.Spread(0.2, 0.1, 0.25), order=2, **about)
    first, second, *others = table.criteria_text(rows).splitlines()[1:]
    assert first.endswith("reached")
    assert "0.7 (0.6 to 0.8)" in first
    assert second.endswith("MISSED")
    assert all("not measured" in line for line in others)


def test_operations_are_counted_in_the_kernels(bench, compiler):
    counts = bench("counts").count()
    edge, cell = sum(counts["edge"].values()), sum(counts["plane"]["1"]["operations"].values())
    assert counts["edge"]["division"] >= 8
    assert 2 * edge < cell < 6 * edge
    assert counts["plane"]["2"]["numbers"] > counts["plane"]["1"]["numbers"]
