"""docs/equations.md names what is there: functions, tests, every equation of the paper and every deviation from it."""

import ast
import re
from collections import Counter
from importlib import import_module
from pathlib import Path

import pytest

import subslide

ROOT = Path(__file__).resolve().parents[2]
PACKAGE = Path(subslide.__file__).parent
PAGE = (ROOT / "docs/equations.md").read_text(encoding="utf-8")
HEADER = "| place in the paper | printed | used here | reason | function | test |"
TITLE = "Modelling, numerical method and analysis of the collapse of cylindrical submarines granular mass"
ROOMS = "|".join(sorted(path.stem for path in PACKAGE.iterdir() if not path.name.startswith("_")))
NAMES = sorted(set(re.findall(rf"`((?:{ROOMS})(?:\.\w+)+)`", PAGE)))


def docstrings():
    """Return the docstrings of the package, in one line each, by the dotted names of what they describe."""
    texts = {}
    for path in sorted(PACKAGE.rglob("*.py")):
        *parents, stem = path.relative_to(PACKAGE).with_suffix("").parts
        module = (*parents, *(() if stem == "__init__" else (stem,)))
        collect(ast.parse(path.read_text(encoding="utf-8")), module, texts)
    return texts


def collect(node, name, texts):
    """Add to `texts` the docstring of a module, class or function, and those of what it holds."""
    texts[".".join(name)] = " ".join((ast.get_docstring(node) or "").split())
    for inner in node.body:
        if isinstance(inner, ast.FunctionDef | ast.ClassDef):
            collect(inner, (*name, inner.name), texts)


def deviations():
    """Return the rows of the table as lists of their cells."""
    lines = PAGE[PAGE.index(HEADER) :].splitlines()[2:]
    return [line.strip("| ").split(" | ") for line in lines if line.startswith("|")]


def place_of(name):
    """Return what a dotted name, relative to the package, stands for."""
    parts = name.split(".")
    for length in range(len(parts), 0, -1):
        try:
            thing = import_module(".".join(["subslide", *parts[:length]]))
        except ModuleNotFoundError:
            continue
        for attribute in parts[length:]:
            thing = getattr(thing, attribute)
        return thing
    raise ModuleNotFoundError(name)


@pytest.mark.parametrize("name", NAMES)
def test_every_name_is_in_the_package(name):
    assert place_of(name)


def test_a_name_that_is_not_there_is_noticed():
    for name in ("kernels.edge.nothing.at_all", "kernels.edge.two_layers.nothing", "nothing.at_all"):
        with pytest.raises((AttributeError, ModuleNotFoundError)):
            place_of(name)


def test_every_equation_of_the_paper_is_on_the_page():
    numbers = {int(number) for number in re.findall(r"\((\d+)\)", PAGE)}
    assert numbers >= set(range(1, 14))


def test_what_holds_an_equation_is_on_the_page():
    holders = {
        name
        for name, text in docstrings().items()
        if name.startswith("kernels") and re.search(r"Eqs?\. ", text)
    }
    functions = {name for name in holders if callable(place_of(name))}
    assert len(functions) > 10
    assert functions <= set(NAMES)


def test_deviations_are_those_of_the_docstrings():
    told = Counter()
    for name, text in docstrings().items():
        places = re.findall(r"Deviation from ([^:]+): ", text)
        assert len(places) == text.count("Deviation"), f"{name}: write `Deviation from <place>: `"
        told.update((place, name) for place in places)
    rows = Counter((row[0], row[4].strip("`")) for row in deviations())
    assert told == rows


def test_no_deviation_is_told_in_a_comment():
    for path in PACKAGE.rglob("*.py"):
        assert not re.search(
            r"#.*[Dd]eviat.* from (Eq|the (print|paper))", path.read_text(encoding="utf-8")
        ), path


def test_every_deviation_names_a_test_that_is_there():
    for row in deviations():
        assert len(row) == 6, row
        path, name = row[5].split("::")
        tree = ast.parse((ROOT / path).read_text(encoding="utf-8"))
        assert name in {node.name for node in tree.body if isinstance(node, ast.FunctionDef)}, row[5]


@pytest.mark.parametrize(
    "path", ["README.md", "CITATION.cff", "workflow/report/workflow.rst", "docs/equations.md"]
)
def test_the_paper_is_named_by_its_title(path):
    assert TITLE in " ".join((ROOT / path).read_text(encoding="utf-8").split())
