"""One dialect: docstrings begin with one imperative line, and what other rooms call says what it takes and gives."""

import ast
import functools
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

import subslide

PACKAGE = Path(subslide.__file__).parent
MODULES = sorted(PACKAGE.rglob("*.py"))

IMPERATIVES = {
    "Advance", "Bring", "Chart", "Check", "Compile", "Copy", "Do", "Draw", "End", "Fill", "Find",
    "Give", "Grow", "Hold", "Join", "Judge", "Label", "Make", "Print", "Put", "Raise", "Remove", "Return",
    "Run", "Say", "Set", "Solve", "Wait", "Write",
}  # fmt: skip
"""First words of a function's docstring."""

LIBRARY = {
    "points",
    "results",
    "solver",
    "records",
    "study",
    "catalogue",
    "files",
    "keys",
    "models",
    "scenes",
    "exact",
    "library",
}
"""Rooms whose public functions say what they take and give; of the packages below, what their first file has."""

FIRST_FILES = {"tables/__init__", "figures/__init__"}
PLUG_INS = {"scenes", "exact"}
"""Rooms of plug-ins, whose contract their first file states once; the plug-ins keep one line."""

REFUSALS = {"ConfigError", "RecordError", "KeyError"}
VAGUE = {"found", "own"}
"""Names that do not say what is in them."""


def name_of(path: Path) -> str:
    """Return the path of a module within the package, without '.py'."""
    return path.relative_to(PACKAGE).with_suffix("").as_posix()


@functools.cache
def tree_of(path: Path) -> ast.Module:
    """Return the syntax tree of a module."""
    return ast.parse(path.read_text(encoding="utf-8"))


def decorators(function: ast.FunctionDef) -> set[str]:
    """Return the names of a function's decorators, such as 'property', without what they are called with."""
    nodes = [node.func if isinstance(node, ast.Call) else node for node in function.decorator_list]
    return {ast.unparse(node).split(".")[-1] for node in nodes}


def definitions(node: ast.AST) -> Iterator[ast.FunctionDef | ast.ClassDef]:
    """Give the functions, methods and classes of a module or class, also where an `if` stands before them."""
    for child in ast.iter_child_nodes(node):
        if isinstance(child, ast.FunctionDef):
            if "overload" not in decorators(child):
                yield child
        elif isinstance(child, ast.ClassDef):
            yield child
            yield from definitions(child)
        elif isinstance(child, ast.If | ast.Try):
            yield from definitions(child)


def is_property(function: ast.FunctionDef) -> bool:
    """Return whether a method is read as an attribute, which a noun phrase describes."""
    return bool(decorators(function) & {"property", "cached_property"})


def form(node: ast.AST) -> str:
    """Return what is wrong with the first lines of a docstring; '' if nothing is."""
    lines = (ast.get_docstring(node) or "").split("\n")
    if not lines[0]:
        return "no docstring"
    if "TODO" in lines[0]:
        return "it is still to be written"
    if not lines[0].endswith("."):
        return "its first line is no sentence"
    if len(lines) > 1 and lines[1]:
        return "its first line does not stand alone"
    is_called = isinstance(node, ast.FunctionDef) and not node.name.startswith("__") and not is_property(node)
    first = lines[0].split()[0]
    if is_called and first not in IMPERATIVES:
        return f"it begins with {first}"
    return ""


@pytest.mark.parametrize("path", MODULES, ids=name_of)
def test_docstrings_begin_with_one_line_that_orders(path):
    tree = tree_of(path)
    wrong = {getattr(node, "name", "module"): form(node) for node in (tree, *definitions(tree))}
    assert not {name: what for name, what in wrong.items() if what}


def public(path: Path) -> Iterator[ast.FunctionDef]:
    """Give the public functions of a module, and the methods that its public classes state first."""
    from_base = inherited(path)
    for node in tree_of(path).body:
        if isinstance(node, ast.ClassDef) and not node.name.startswith("_"):
            inner = [child for child in definitions(node) if isinstance(child, ast.FunctionDef)]
        else:
            inner = [node] if isinstance(node, ast.FunctionDef) else []
        for function in inner:
            stated = (node.name, function.name) in from_base
            if not (function.name.startswith("_") or is_property(function) or stated):
                yield function


def parameters(function: ast.FunctionDef) -> list[str]:
    """Return the names of a function's parameters, but for self and cls."""
    arguments = function.args
    every = [
        *arguments.posonlyargs,
        *arguments.args,
        arguments.vararg,
        *arguments.kwonlyargs,
        arguments.kwarg,
    ]
    return [a.arg for a in every if a is not None and a.arg not in ("self", "cls")]


def inherited(path: Path) -> set[tuple[str, str]]:
    """Return class and name of the methods whose contract a base class of the same room states."""
    classes = [
        node
        for other in path.parent.glob("*.py")
        for node in tree_of(other).body
        if isinstance(node, ast.ClassDef)
    ]
    methods = {
        node.name: {child.name for child in node.body if isinstance(child, ast.FunctionDef)}
        for node in classes
    }
    return {
        (node.name, name)
        for node in classes
        for base in node.bases
        for name in methods.get(ast.unparse(base), ())
    }


def section(docstring: str, title: str) -> str | None:
    """Return the text of a numpydoc section; None without it."""
    match = re.search(rf"^{title}\n-+\n(.*?)(?=^\w[\w ]*\n-+$|\Z)", docstring, re.M | re.S)
    return match and match[1]


def described(text: str) -> set[str]:
    """Return the names that a section describes, several on a line where they share their words."""
    return {name.strip().lstrip("*") for line in re.findall(r"^\S.*", text, re.M) for name in line.split(",")}


def refusals(function: ast.FunctionDef) -> set[str]:
    """Return the errors about input that a function's own statements raise."""
    raised = [node.exc for node in ast.walk(function) if isinstance(node, ast.Raise) and node.exc]
    called = [exc.func if isinstance(exc, ast.Call) else exc for exc in raised]
    return {ast.unparse(node) for node in called} & REFUSALS


def gives(function: ast.FunctionDef) -> bool:
    """Return whether a function returns or yields anything."""
    return function.returns is not None and ast.unparse(function.returns) != "None"


def lacking(function: ast.FunctionDef) -> list[str]:
    """Return what a docstring does not say of what its function takes, gives and raises.

    A function of at most one parameter may say it all in its first line.
    """
    docstring = ast.get_docstring(function) or ""
    names, listed = parameters(function), section(docstring, "Parameters")
    lacks = []
    if listed is not None or len(names) > 1:
        lacks += [f"parameter {name}" for name in names if name not in described(listed or "")]
    results = section(docstring, "Returns") or section(docstring, "Yields")
    if len(names) > 1 and gives(function) and not results:
        lacks.append("what it returns")
    errors = section(docstring, "Raises") or ("" if len(names) > 1 else docstring.split("\n")[0])
    return lacks + [error for error in sorted(refusals(function)) if error not in errors]


def dotted(path: Path) -> str:
    """Return the name by which a module is imported, without that of the package."""
    return ".".join(name_of(path).removesuffix("/__init__").split("/"))


@functools.cache
def called_by_others() -> frozenset[tuple[str, str]]:
    """Return module and name of what modules of other rooms import, or call through the module."""
    known = {dotted(path) for path in MODULES}
    uses = set()
    for path in MODULES:
        nodes, modules = list(ast.walk(tree_of(path))), {}
        for node in nodes:
            if not (isinstance(node, ast.ImportFrom) and f"{node.module}.".startswith("subslide.")):
                continue
            home = node.module.removeprefix("subslide").removeprefix(".")
            for alias in node.names:
                module = f"{home}.{alias.name}".removeprefix(".")
                if module in known:
                    modules[alias.asname or alias.name] = module
                else:
                    uses.add((path, home, alias.name))
        for node in nodes:
            if (
                isinstance(node, ast.Attribute)
                and isinstance(node.value, ast.Name)
                and node.value.id in modules
            ):
                uses.add((path, modules[node.value.id], node.attr))
    return frozenset(
        (module, name) for path, module, name in uses if module.split(".")[0] != dotted(path).split(".")[0]
    )


def is_library(name: str) -> bool:
    """Return whether all public functions of a module are for users and other rooms."""
    room, _, rest = name.partition("/")
    if name in FIRST_FILES:
        return True
    return room in LIBRARY and not (room in PLUG_INS and rest != "__init__")


NOT_COMPILED = [path for path in MODULES if not name_of(path).startswith("kernels/")]


@pytest.mark.parametrize("path", NOT_COMPILED, ids=name_of)
def test_what_others_call_says_what_it_takes_and_gives(path):
    every = is_library(name_of(path))
    functions = [f for f in public(path) if every or (dotted(path), f.name) in called_by_others()]
    lacks = {function.name: lacking(function) for function in functions}
    assert not {name: what for name, what in lacks.items() if what}


def test_what_others_call_is_seen():
    assert {("jobs", "run"), ("naming", "FINISHED"), ("scenes.shear", "mode")} <= called_by_others()


@pytest.mark.parametrize("path", MODULES, ids=name_of)
def test_names_say_what_is_in_them(path):
    names = set()
    for node in ast.walk(tree_of(path)):
        if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            names.add(node.id)
        elif isinstance(node, ast.arg):
            names.add(node.arg)
    assert not names & VAGUE


@pytest.mark.parametrize("path", MODULES, ids=name_of)
def test_types_are_written_as_they_are(path):
    """No `from __future__ import annotations`: what is not imported at run time stands in quotes."""
    assert "from __future__" not in path.read_text(encoding="utf-8")
