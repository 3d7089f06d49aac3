"""What Snakemake was asked for: values of a study from one file and `--config`, read as strictly as by `check`."""

import os
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from subslide.keys.schema import ConfigError
from subslide.study.yaml_files import read_overrides, read_yaml

KEY = "subslide_plan"
"""Word by which Snakemake tells the jobs that it starts elsewhere the file of the plan that they belong to."""


def values(files: Iterable[Path], arguments: Iterable[str], default: Path) -> dict[str, Any]:
    """Return the values of a study by key.

    Parameters
    ----------
    files
        Configuration files that were given; only one is allowed, and the default stands for none.
    arguments
        Texts ``KEY=VALUE``, which win over the file.
    default
        The file that is read if none is given.

    Returns
    -------
    dict
        Values as the file and the texts state them, unchecked but for their form.

    Raises
    ------
    ConfigError
        If there are several files, or anything cannot be read: one line.
    """
    paths = [Path(os.path.relpath(path)) for path in files] or [default]
    if len(paths) > 1:
        names = ", ".join(path.name for path in paths)
        raise ConfigError(f"--configfile: {names}: allowed: one file, for files are never merged")
    return {**read_yaml(paths[0]), **read_overrides([text for text in arguments if not _names_plan(text)])}


def plan_file(arguments: Iterable[str]) -> Path:
    """Return the file of the plan that a job was started with, from its arguments."""
    return Path("".join([text.partition("=")[2] for text in arguments if _names_plan(text)][-1:]))


def _names_plan(text: str) -> bool:
    """Return whether an argument states the plan of a job."""
    return text.startswith(f"{KEY}=")
