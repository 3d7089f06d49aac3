"""Studies in a program: read, planned, run in processes and opened as one data set."""

import atexit
import contextlib
import os
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from subslide.keys import schema
from subslide.keys.schema import ConfigError
from subslide.library import given, processes
from subslide.points import Point
from subslide.study import config, limits, outlook, shown

if TYPE_CHECKING:
    import xarray as xr

MOST_HELD = 1e9
"""Bytes up to which a sweep without a folder is held in memory."""


class Study:
    """Checked study, of which nothing is solved before `run`.

    Parameters
    ----------
    checked
        The study, see `from_yaml`.
    """

    def __init__(self, checked: config.Study):
        """Keep the study."""
        self._checked = checked

    @classmethod
    def from_yaml(cls, path: "os.PathLike[str] | str") -> "Study":
        """Return the study of a YAML file, checked.

        Parameters
        ----------
        path
            The file (config/README.md).

        Returns
        -------
        Study
            The study.

        Raises
        ------
        ConfigError
            If anything is wrong: one line.
        """
        return cls(config.read_study(os.fspath(path)))

    @classmethod
    def from_dict(cls, values: Mapping[str, Any]) -> "Study":
        """Return the study of a mapping such as a YAML file holds, checked.

        Parameters
        ----------
        values
            Values by key; numbers and arrays may be numpy's.

        Returns
        -------
        Study
            The study.

        Raises
        ------
        ConfigError
            If anything is wrong: one line.
        """
        return cls(config.make_study(given.mapping(values, "study")))

    @property
    def name(self) -> str:
        """Name of the study, and of its folder of results."""
        return self._checked.name

    @property
    def points(self) -> tuple[Point, ...]:
        """Points of the runs, in the order of the data set; each has its keys as attributes."""
        return self._checked.points

    def __len__(self) -> int:
        """Return the number of runs."""
        return len(self._checked.runs)

    def __repr__(self) -> str:
        """Return the study in one line."""
        return shown.line(f"Study '{self.name}'", self._checked.runs)

    def _repr_html_(self) -> str:
        """Return the study as a notebook shows it: axes and cost."""
        study = self._checked
        more = len(study.solved) - len(study.runs)
        companions = [f"and {more:,} companions for bands"] * (more > 0)
        cost = limits.estimate(study.solved, study.keep).words()
        return shown.page(f"study '{self.name}'", study.runs, [*companions, f"keep: {study.keep}; {cost}"])

    def plan(self, cores: int | None = None, folder: "os.PathLike[str] | str | None" = None) -> str:
        """Return what `run` would do, in lines: points, batches, seconds, memory and disk; write nothing.

        Parameters
        ----------
        cores
            How many processes work at the same time; all that this one may use without it.
        folder
            Folder of results; `results/NAME` without it.

        Returns
        -------
        str
            Lines.
        """
        return "\n".join(outlook.lines(self._checked, self._folder(folder), cores_of(cores)))

    def run(
        self,
        *,
        cores: int | None = None,
        progress: bool = True,
        folder: "os.PathLike[str] | str | None" = None,
    ) -> "xr.Dataset":
        """Run the study, as far as it has not been, and return it as one data set.

        Batches of runs are solved in processes of their own. When the program is interrupted these end, and what they
        have solved is kept in the folder, so that the next call, or `make study`, solves the rest.

        Parameters
        ----------
        cores
            How many processes work at the same time; all that this one may use without it.
        progress
            Whether a line shows how far it has come.
        folder
            Folder of results; `results/NAME` without it, where `make study` has it too.

        Returns
        -------
        xarray.Dataset
            What `subslide.open_study` gives of the folder, lazy; a run that failed is there with its status.

        Raises
        ------
        ConfigError
            If the folder cannot be one of a study, or somebody else is at work in it.
        BatchError
            If a process ends without the record of its batch.
        """
        from subslide.results.dataset import open_study

        home = self._folder(folder)
        processes.run(self._checked, home, cores_of(cores), processes.stream_of(progress))
        return given.outcome_first(open_study(home))

    def _folder(self, given_folder: "os.PathLike[str] | str | None") -> Path:
        """Return the folder of results."""
        return Path("results", self.name) if given_folder is None else Path(given_folder)


def sweep(
    *,
    cores: int | None = None,
    progress: bool = True,
    folder: "os.PathLike[str] | str | None" = None,
    **keys: Any,
) -> "xr.Dataset":
    """Run every combination of the values of keys, such as `sweep(a_H=[1, 2], r=[0, 0.4])`, and return one data set.

    Keys, units, defaults, ranges and messages are those of a study's file (config/README.md), `design`, `cases`, `keep`
    and `bands` among them. It needs no guard around the main part of a program.

    Parameters
    ----------
    cores
        How many processes work at the same time; all that this one may use without it.
    progress
        Whether a line shows how far it has come.
    folder
        Folder of results, such as `results/mine`, which `make study` carries on and `subslide.open_study` opens.
        Without it nothing is left: the data set is in memory, or, from a gigabyte on, lazy, in a temporary folder that
        lasts as long as the program.
    keys
        A value for each key that is not to have its default, or a list, array, range, or mapping such as
        `{"linspace": [0, 0.8, 5]}`, of values.

    Returns
    -------
    xarray.Dataset
        Runs along the dimension `run`, with their parameters as coordinates, see `subslide.open_study`; a run that
        failed is there with its status.

    Raises
    ------
    ConfigError
        If a key is unknown or a value is not allowed: a ValueError of one line, and nothing is solved. Also if the
        folder cannot be one of a study.
    BatchError
        If a process ends without the record of its batch.
    """
    values = given.mapping(keys, "sweep")
    study = Study.from_dict({"study": _name(folder), **values})
    if folder is not None:
        return study.run(cores=cores, progress=progress, folder=folder)
    home = tempfile.TemporaryDirectory(prefix="subslide-")
    try:
        data = study.run(cores=cores, progress=progress, folder=Path(home.name, "results", study.name))
        if data.nbytes > MOST_HELD:
            atexit.register(home.cleanup)
            return data
        with data:
            held = data.load()
    except BaseException:
        home.cleanup()
        raise
    home.cleanup()
    return held


def _name(folder: "os.PathLike[str] | str | None") -> str:
    """Return the name of the study of a sweep: its folder's, where that can be one."""
    with contextlib.suppress(ConfigError, TypeError):
        return str(schema.checked("study", Path(os.path.abspath(folder or "sweep")).name))
    return "sweep"


def cores_of(cores: int | None) -> int:
    """Return how many processes work at the same time.

    Parameters
    ----------
    cores
        What was given.

    Returns
    -------
    int
        The number; that of the cores which this process may use if nothing was given.

    Raises
    ------
    ConfigError
        If it is no whole number from 1.
    """
    if cores is None:
        return limits.usable_cores()
    whole = given.plain(cores)
    if not isinstance(whole, int) or isinstance(whole, bool) or whole < 1:
        raise ConfigError(f"cores: {whole} is not allowed; allowed: a whole number from 1")
    return whole
