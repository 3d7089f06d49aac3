"""Files of figures: the module of a figure is found, its figure of a finished study drawn and saved."""

import importlib
import logging
import os
from pathlib import Path

from subslide import catalogue, checksums, source_hash
from subslide.files import replacing
from subslide.keys import plain, words
from subslide.keys.schema import ConfigError
from subslide.results import Results
from subslide.study import whole_study


def save(name: str, results: Path, output: Path) -> list[Path]:
    """Write a figure as PNG and SVG, the same bytes for the same results.

    Parameters
    ----------
    name
        Name of the figure: one of the modules of this folder.
    results
        Folder of a finished study.
    output
        Folder of the files; it is made if it is not there.

    Returns
    -------
    list of Path
        The two files.

    Raises
    ------
    ConfigError
        If there is no such figure, or the study has no table of runs, or not the runs that it needs.
    """
    known = catalogue.names("figures")
    if name not in known:
        raise ConfigError(
            f"figure: {name} is not allowed; allowed: {', '.join(known) or 'none'}{words.closest(name, known)}"
        )
    if not (results / "tables" / "runs.csv").is_file():
        raise ConfigError(
            f"--results: {results} has no tables/runs.csv; allowed: the folder of a finished study"
        )
    if plain.control(str(output)) or (output.exists() and not output.is_dir()):
        raise ConfigError(f"--output: {output} is no folder; allowed: a folder, made if it is not there")
    study = Results(results)
    kinds = {one["kind"] for one in study.designs}
    if lack := whole_study.lacking(name, [run.point for run in study.runs_of_study], kinds):
        raise ConfigError(
            f"--results: {results}: {name} needs runs with {lack}, which this study does not have"
        )
    logging.getLogger("matplotlib").setLevel(logging.ERROR)  # it warns of a folder of settings that it lacks
    os.environ["MPLBACKEND"] = "Agg"  # a notebook names one that need not be here, and importing would fail
    import matplotlib

    matplotlib.use("Agg")
    matplotlib.rcdefaults()  # whatever the user's matplotlibrc says
    matplotlib.rcParams["svg.hashsalt"] = "subslide"
    from subslide.study import outputs

    paths = [output / f"{name}.{suffix}" for suffix in ("png", "svg")]
    outputs.check_made([*paths, *map(checksums.beside, paths)], results)
    drawn = importlib.import_module(f"subslide.figures.{name}").draw(study)
    output.mkdir(parents=True, exist_ok=True)
    for path, metadata in zip(paths, ({"Software": None}, {"Date": None}), strict=True):
        with replacing(path) as temporary:
            drawn.savefig(temporary, format=path.suffix[1:], dpi=200, bbox_inches="tight", metadata=metadata)
        checksums.seal(path, sources=source_hash("figure", name))
    return paths
