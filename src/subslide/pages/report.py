"""The report of a study: one page that tells what was asked and found, with its figures, for a browser offline."""

import base64
import html
import re
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

import subslide
from subslide import catalogue, points, tables
from subslide.naming import FINISHED, STATUSES
from subslide.study.yaml_files import read_text

if TYPE_CHECKING:
    import pandas as pd

    from subslide.results import Results

MOST_ROWS = 200
"""Rows of a table that the page shows."""

MOST_SHOWN = 1_000_000
"""Bytes of the largest table whose rows it shows."""

SHOWN = (
    *("status", "L_f_1pc", "L_f_1pc_over_R", "time_of_arrest_1pc", "time_at_rest"),
    *("max_abs_eta_peak", "max_abs_eta_outside_peak", "eta_gauge_peak"),
)
"""Columns of the table of runs that the page shows, after the keys that vary."""

STYLE = """
body { font: 1rem/1.5 system-ui, sans-serif; color: #1a1a1a; max-width: 62rem; margin: auto; padding: 1rem }
h1, h2, h3 { line-height: 1.2 } h2 { margin-top: 2.5rem; border-bottom: 1px solid #aaa }
figure { margin: 1.5rem 0; break-inside: avoid } img { max-width: 100%; height: auto }
figcaption, .note { color: #444; font-size: .9rem; max-width: 46rem }
.scroll { overflow-x: auto } details { margin: .6rem 0 }
iframe { width: 100%; height: 36rem; border: 1px solid #ddd }
 table { border-collapse: collapse; font-size: .85rem }
th, td { padding: .15rem .6rem; text-align: right; border-bottom: 1px solid #ddd; white-space: nowrap }
"""


def text(results: "Results", captions: Path) -> str:
    """Return the page.

    Parameters
    ----------
    results
        The study, with its tables; those of its figures that are there are shown.
    captions
        Folder of texts for figures, `NAME.rst`.

    Returns
    -------
    str
        HTML that needs no other file, but links to the tables beside it.
    """
    name = results.folder.resolve().name
    runs = results.runs
    parts = [
        f"<h1>{_safe(name)}</h1>",
        _asked(runs),
        _outcome(runs),
        *_figures(results.folder / "figures", captions),
        "<h2>Runs</h2>",
        _rows(runs),
        "<h2>Tables</h2>",
        *_tables(results, captions),
        "<h2>Provenance</h2>",
        f"<p>Made by subslide {subslide.__version__}, sources {subslide.source_hash()}. Each record states the versions"
        " it was made with and its whole configuration.</p>",
    ]
    head = (
        '<!doctype html>\n<html lang="en">\n<meta charset="utf-8">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        f"<title>{_safe(name)}: report</title>\n<style>{STYLE}</style>\n"
    )
    return head + "\n".join(parts) + "\n</html>\n"


def varied(runs: "pd.DataFrame") -> list[str]:
    """Return the keys of a run, in order, that have more than one value in a table of runs."""
    return [
        key for key in ("numerics", *points.RUN_KEYS) if key in runs and runs[key].nunique(dropna=False) > 1
    ]


def _asked(runs: "pd.DataFrame") -> str:
    """Return a paragraph on what was asked."""
    axes = [f"{key} ({_listed(runs[key].dropna().sort_values().unique().tolist())})" for key in varied(runs)]
    sweep = f"over {'; '.join(axes)}" if axes else "of one set of values"
    return f"<p>{len(runs)} run{'s' * (len(runs) != 1)} {_safe(sweep)}.</p>"


def _outcome(runs: "pd.DataFrame") -> str:
    """Return paragraphs on how the runs ended, and on the ranges of deposit and wave."""
    counts = runs["status"].value_counts()
    ends = ", ".join(f"{count} {name} ({STATUSES[name]})" for name, count in counts.items())
    lines = [f"How they ended: {ends}."]
    ended = runs[runs["status"].isin(FINISHED)]
    for column, words in (
        ("L_f_1pc_over_R", "Final length L_f over R (1 % front)"),
        ("eta_gauge_peak", "Largest wave at 2 R (m)"),
    ):
        values = ended[column].dropna()
        if len(values):
            lines.append(f"{words}: {values.min():.4g} to {values.max():.4g}.")
    return "".join(f"<p>{_safe(line)}</p>" for line in lines)


def _figures(folder: Path, captions: Path) -> Iterable[str]:
    """Give the figures that are there, under their headings, with captions."""
    present = [name for name in catalogue.names("figures") if (folder / f"{name}.png").is_file()]
    heading = ""
    for name in sorted(present, key=lambda name: (catalogue.figure(name).category, name)):
        about = catalogue.figure(name)
        if about.category != heading:
            heading = about.category
            yield f"<h2>{_safe(re.sub(r'^[0-9]+ ', '', heading))}</h2>"
        image = base64.b64encode((folder / f"{name}.png").read_bytes()).decode()
        yield (
            f'<figure><img alt="{_safe(about.title)}" src="data:image/png;base64,{image}">'
            f"<figcaption><b>{_safe(about.title)}.</b> {_caption(captions, name)}"
            f' <a href="figures/{name}.svg">SVG</a></figcaption></figure>'
        )


def _caption(captions: Path, name: str) -> str:
    """Return the text of a caption, '' without one."""
    path = captions / f"{name}.rst"
    if not path.is_file():
        return ""
    return re.sub("``(.*?)``", r"<code>\1</code>", _safe(" ".join(read_text(path, MOST_SHOWN).split())))


def _rows(runs: "pd.DataFrame") -> str:
    """Return the first rows of the table of runs: the keys that vary, and what was found."""
    columns = ["id", *varied(runs), *(name for name in SHOWN if runs[name].notna().any())]
    shown = runs[columns].head(MOST_ROWS)
    table = shown.to_html(index=False, border=0, na_rep="", float_format=lambda value: f"{value:.6g}")
    return f'<div class="scroll">{table}</div>{_rest(len(runs), "runs.csv")}'


def _tables(results: "Results", captions: Path) -> Iterable[str]:
    """Give each table: what it is, its page or its first rows, and a link to its file."""
    for name in catalogue.names("tables"):
        files = [
            path for path in sorted((results.folder / "tables").glob(f"{name}.*")) if path.suffix != ".sha256"
        ]
        if not files:
            continue
        beside = (results.folder / "tables" / file for file in getattr(tables.load(name), "BESIDE", ()))
        files += [path for path in beside if path.is_file()]
        links = " ".join(f'<a href="tables/{path.name}">{path.name}</a>' for path in files)
        yield (
            f"<details><summary>{_safe(catalogue.table(name).title)}</summary><p>{_caption(captions, name)}"
            f" {links}</p>{_content(results, name, files)}</details>"
        )


def _content(results: "Results", name: str, files: list[Path]) -> str:
    """Return what the page shows of a table: its own page, its first rows, or nothing of one that is large."""
    page = next((path for path in files if path.suffix == ".html"), None)
    if page:
        return f'<iframe title="{name}" srcdoc="{_safe(page.read_text(encoding="utf-8"))}"></iframe>'
    if files[0].suffix != ".csv" or files[0].stat().st_size > MOST_SHOWN or name == "runs":
        return ""
    lines = results.lines(name)
    head = "".join(f"<th>{_safe(column)}</th>" for column in lines[0]) if lines else ""
    rows = (
        "<tr>" + "".join(f"<td>{_safe(entry)}</td>" for entry in line.values()) + "</tr>"
        for line in lines[:MOST_ROWS]
    )
    table = f"<table><tr>{head}</tr>{''.join(rows)}</table>"
    return f'<div class="scroll">{table}</div>{_rest(len(lines), files[0].name)}'


def _rest(rows: int, file: str) -> str:
    """Return a note on rows that are not shown, '' if all are."""
    rest = rows - MOST_ROWS
    return f'<p class="note">{rest} more rows stand in tables/{file}.</p>' if rest > 0 else ""


def _listed(values: list, most: int = 12) -> str:
    """Return values as words, the middle left out of a long list."""
    words = [f"{value:g}" if isinstance(value, float) else str(value) for value in values]
    return ", ".join(words if len(words) <= most else [*words[: most - 2], "...", words[-1]])


def _safe(words: str) -> str:
    """Return words as HTML shows them."""
    return html.escape(str(words))
