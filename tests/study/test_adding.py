"""Adding a thing takes one place: each test adds one to a scratch copy of the package and sees it everywhere."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import subslide

RUNS_COLUMNS = "from subslide.tables import runs; print(*runs.COLUMNS)"


class Copy:
    """Copy of the package in a folder of its own, whose files may be edited."""

    def __init__(self, folder: Path):
        self.folder = folder
        self.package = folder / "src/subslide"
        shutil.copytree(
            Path(subslide.__file__).parent, self.package, ignore=shutil.ignore_patterns("__pycache__")
        )

    def insert(self, file: str, before: str, text: str) -> None:
        """Put text before the one place of a file that reads `before`."""
        path = self.package / file
        whole = path.read_text(encoding="utf-8")
        assert whole.count(before) == 1
        path.write_text(whole.replace(before, text + before), encoding="utf-8")

    def python(self, *arguments: str, status: int = 0) -> str:
        """Output of the copy's Python, which must end with this status."""
        done = subprocess.run(
            [sys.executable, *arguments],
            cwd=self.folder,
            env={**os.environ, "PYTHONPATH": str(self.folder / "src")},
            text=True,
            capture_output=True,
        )
        assert done.returncode == status, done.stderr
        return done.stdout + done.stderr

    def subslide(self, *arguments: str, status: int = 0) -> str:
        """Output of the copy's command line."""
        return self.python("-m", "subslide", *arguments, status=status)


@pytest.fixture
def copy(tmp_path):
    """Copy of the package."""
    made = Copy(tmp_path)
    where = made.python("-c", "import subslide; print(subslide.__file__)").strip()
    assert Path(where).is_relative_to(tmp_path)
    return made


def test_a_key_is_one_entry(copy):
    entry = '"foo": number(METHOD, "how much foo there is", 0.25, "m", minimum=0, maximum=3),\n    '
    copy.insert("keys/entries.py", '"order": choice(', entry)
    study = copy.folder / "study.yaml"
    for value, told in (
        ("4", "foo: 4 is not allowed; allowed: a number from 0 to 3 (m)"),
        ("[1, 2]", "2 runs"),
    ):
        study.write_text(f"study: t\nmodel: radial\nfoo: {value}\n", encoding="utf-8")
        assert told in copy.subslide("check", "study.yaml", status=0 if "runs" in told else 2)
    assert "how much foo there is [m]; a number from 0 to 3 [default: 0.25]" in " ".join(
        copy.subslide("run", "--help").split()
    )
    for folder in ("config", "docs"):
        (copy.folder / folder).mkdir()
    copy.subslide("docs")
    page = (copy.folder / "config/README.md").read_text(encoding="utf-8")
    assert "| `foo` | how much foo there is | m | 0.25 | a number from 0 to 3 | yes |" in page
    assert '"foo"' in (copy.folder / "config/study.schema.json").read_text(encoding="utf-8")
    columns = copy.python("-c", RUNS_COLUMNS).split()
    assert columns.index("foo") == columns.index("order") - 1
    value = copy.python("-c", "from subslide.points import from_dict; print(from_dict({'foo': 2}).foo)")
    assert value.strip() == "2.0"


def test_a_value_that_lean_kernels_do_not_know_asks_for_the_general_ones(copy):
    copy.insert("keys/names.py", '"stop": GENERAL', '"mix": GENERAL, ')
    kernels = (
        "from subslide.study import choice, config;"
        "print(*(choice.kernels(config.make_point({'treatment': t})) for t in ('real', 'mix')))"
    )
    assert copy.python("-c", kernels).split() == ["radial:float64", "radial:float64:general"]
    assert "real|hll|friction|mix|stop" in copy.subslide("run", "--help")
