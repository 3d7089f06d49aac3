"""Verbs that draw figures and write the pages of documentation that follow from the code."""

from pathlib import Path

import click

from subslide.commands import cli
from subslide.keys.schema import ConfigError


@cli.command()
@click.argument("name")
@click.option(
    "--results", required=True, metavar="FOLDER", help="folder of a study with its tables and records"
)
@click.option("-o", "--output", required=True, metavar="FOLDER", help="folder for NAME.png and NAME.svg")
def figure(name: str, results: str, output: str) -> None:
    """Draw one figure, NAME, of a study as PNG and SVG."""
    from subslide.figures import _save

    for path in _save.save(name, Path(results), Path(output)):
        click.echo(str(path))


@cli.command()
def docs() -> None:
    """Write the pages of documentation that follow from the code, in the repository that is the current folder."""
    from subslide import pages
    from subslide.files import write_text
    from subslide.study import outputs

    texts = pages.generated()
    for path in texts:
        if not Path(path).parent.is_dir():
            raise ConfigError(f"{path}: there is no such folder here; allowed: the root of the repository")
        outputs.check(path, (), "docs", Path(path).suffix)
    for path, text in texts.items():
        write_text(path, text)
        click.echo(path)
