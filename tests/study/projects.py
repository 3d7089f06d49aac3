"""Copies of the workflow, each in a folder of its own with one small study, and what Snakemake does in them."""

import os
import re
import shutil
import subprocess
import sys

import pandas as pd
import yaml

from subslide import catalogue, tables
from subslide.study.config import make_study

STUDY = "study: small\na_H: [1, 2]\nr: 0.4\nmodel: radial\ncells: 20\nt_end: 0.05\nfigures: none\n"
TABLES = {
    f"table_{name}": 1
    for name in catalogue.names("tables")
    if not tables.load(name).needs(make_study(yaml.safe_load(STUDY)))
}
"""Jobs of the tables that every study has, one each."""


class Project:
    """A copy of the workflow in a folder of its own, with one study."""

    def __init__(self, root, folder):
        self.root, self.folder = root, folder
        for name in ("Snakefile", "workflow", "profiles", "config"):
            copy = shutil.copytree if (root / name).is_dir() else shutil.copy
            copy(root / name, folder / name)
        self.results = folder / "results/small"
        self.configure(STUDY)

    def configure(self, text):
        (self.folder / "small.yaml").write_text(text)

    def snakemake(self, *arguments, check=True, configured=True, **environment):
        """Text that Snakemake prints."""
        command = [
            sys.executable,
            "-m",
            "snakemake",
            *(("--configfile", "small.yaml") if configured else ()),
            "--cores",
            "2",
            *arguments,
        ]
        done = subprocess.run(
            command, cwd=self.folder, capture_output=True, text=True, env={**os.environ, **environment}
        )
        assert not check or done.returncode == 0, done.stdout + done.stderr
        return done.stdout + done.stderr

    def jobs(self, *arguments, **environment):
        """Number of jobs of each rule that a run of Snakemake started, or would start."""
        text = self.snakemake(*arguments, **environment)
        table = re.search(r"^job +count\n-+ +-+\n((?:\w+ +\d+\n)+)", text, re.MULTILINE)
        if not table:
            assert "Nothing to be done" in text, text
            return {}
        rows = (line.split() for line in table[1].splitlines())
        return {rule: int(count) for rule, count in rows if rule not in ("all", "total")}

    def runs(self):
        return pd.read_csv(self.results / "tables/runs.csv")

    def copy(self, folder):
        """A copy of the project with its study, with times of files kept."""
        shutil.copytree(self.folder, folder, symlinks=True)
        copied = object.__new__(Project)
        copied.root, copied.folder, copied.results = self.root, folder, folder / "results/small"
        return copied
