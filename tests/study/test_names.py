"""Names: their integers are those of compiled code, and what is not lean asks for the general kernels."""

import pytest

from subslide.keys import names, schema
from subslide.points import RUN_KEYS, Point
from subslide.study import choice

FLAGS = {
    "SCHEMES": {"rusanov": 0, "hll": 1, "ifcp": 2, "ifcph": 3, "roe": 4},
    "LAWS": {"coulomb": 0, "voellmy": 1, "pouliquen": 2},
    "TREATMENTS": {"real": 0, "hll": 1, "friction": 2, "stop": 3},
    "SPEEDS": {"exact": 0, "approximate": 1},
    "AS_PRINTED": {"none": 0, "friction": 1, "upwinding": 2},
    "BOUNDARIES": {"open": 0, "wall": 1, "periodic": 2, "paper": 3},
}
KEYS = {
    "scheme": names.SCHEMES,
    "friction": names.LAWS,
    "treatment": names.TREATMENTS,
    "front_flux": names.FRONT_FLUXES,
    "wave_speeds": names.SPEEDS,
    "as_printed": names.AS_PRINTED,
    "boundary": names.BOUNDARIES,
}
GENERAL = {("friction_in_viscosity", False)} | {
    (key, name) for key, mapping in KEYS.items() for name, lean in mapping.items() if not lean
}


@pytest.mark.parametrize("name", FLAGS)
def test_a_name_keeps_its_integer(name):
    """New names come after those of before."""
    flags = names.flags(getattr(names, name))
    assert list(flags.items())[: len(FLAGS[name])] == list(FLAGS[name].items())


@pytest.mark.parametrize("key", KEYS)
def test_a_key_allows_the_names_and_its_default_is_lean(key):
    about = schema.properties()[key]
    assert sorted(about["enum"]) == sorted(KEYS[key])
    assert KEYS[key][about["default"]] == names.LEAN


def test_solvers_are_told_best_first():
    assert names.best_first(names.SCHEMES)[:5] == ("ifcph", "ifcp", "hll", "rusanov", "roe")


def test_general_kernels_are_for_what_lean_ones_leave_out_alone():
    assert not choice.of(Point()).general
    for key in RUN_KEYS:
        about = schema.properties()[key]
        values = [True, False] if about.get("type") == "boolean" else about.get("enum", ())
        for value in values:
            if key not in ("scene", "model"):
                assert choice.of(Point().with_values(**{key: value})).general == ((key, value) in GENERAL)


def test_a_choice_is_made_once():
    point = Point(r=0.123)
    assert choice.of(point) is choice.of(Point(r=0.123))
    assert choice.of(point) == ("radial", "radius", "auto: round scene", "uniform", "asked for", False)
    assert choice.kernels(point.with_values(scheme="roe", dtype="float32")) == "radial:float32:general"
