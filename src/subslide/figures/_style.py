"""The look of every figure: size of print, colours with line styles and markers, legends, notes."""

import functools
import re
from collections.abc import Callable, Collection, Sequence
from typing import TYPE_CHECKING, Any

import matplotlib as mpl
import matplotlib.pyplot as plt
import numpy as np
import seaborn as sns
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from subslide.figures import _words
from subslide.results import NotKeptError

if TYPE_CHECKING:
    from subslide.results import Results

Look = dict[str, Any]
"""Colour, dashes (`linestyle`) and marker of one value, as options of a line."""
Entry = tuple[Any, str]
"""Handle and label of an entry of a legend."""

WIDTH = 7.2
"""Width of a figure on a printed page (inch)."""
GREY = "0.45"
DASHES = ("-", (0, (5, 1.5)), (0, (4, 1.2, 1, 1.2)), (0, (1.2, 1)), (0, (9, 2)), (0, (3, 1, 1, 1, 1, 1)))
MARKERS = "os^DvPX<>"
RC = {
    "font.size": 8,
    "axes.titlesize": 8.5,
    "axes.labelsize": 8.5,
    "legend.fontsize": 8,
    "xtick.labelsize": 7.5,
    "ytick.labelsize": 7.5,
    "figure.titlesize": 10,
    "axes.linewidth": 0.7,
    "grid.linewidth": 0.4,
    "grid.color": "0.88",
    "lines.linewidth": 1.4,
    "lines.markersize": 4,
    "legend.frameon": False,
    "legend.handlelength": 3.2,
    "xtick.major.width": 0.7,
    "ytick.major.width": 0.7,
    "mathtext.fontset": "dejavusans",
}


class NoRunsError(Exception):
    """The study has no run that a figure could show."""


def styled(draw: Callable[["Results"], Figure]) -> Callable[["Results"], Figure]:
    """Return `draw` so that its figure is made in the style of all figures; an empty one if it has no run.

    Parameters
    ----------
    draw
        Function of a figure's module (see `subslide.figures`).
    """

    @functools.wraps(draw)
    def wrapped(results: "Results") -> Figure:
        with sns.axes_style("ticks", {"axes.grid": True}), mpl.rc_context(RC):
            try:
                return draw(results)
            except (NoRunsError, NotKeptError) as error:
                figure = plt.figure(figsize=(WIDTH, 1.0))
                figure.suptitle(f"{draw.__globals__['TITLE']}: no such run ({error})", wrap=True)
                return figure

    return wrapped


def panels(count: int, columns: int, height: float, **options: Any) -> tuple[Figure, list[Axes]]:
    """Return a figure and its panels, row by row.

    A panel with none below it has the numbers of its x axis, even where panels share that axis.

    Parameters
    ----------
    count
        Number of panels.
    columns
        Panels in a row.
    height
        Height of a row (inch).
    **options
        Options of `matplotlib.pyplot.subplots`.
    """
    rows = -(-count // columns)
    figure, grid = plt.subplots(
        rows, columns, figsize=(WIDTH, rows * height + 0.9), layout="constrained", squeeze=False, **options
    )
    axes = list(grid.flat)
    for unused in axes[count:]:
        unused.remove()
    for k, ax in enumerate(axes[:count]):
        sns.despine(ax=ax)
        if k + columns >= count:
            ax.tick_params(labelbottom=True)
    return figure, axes[:count]


def looks_of(
    values: Collection, palette: str = "viridis", dark: float = 0.0, light: float = 0.82
) -> dict[Any, Look]:
    """Return the look of each value: shade, dashes and marker, told apart in grey and by eyes that see few colours.

    Parameters
    ----------
    values
        Values to tell apart.
    palette
        Name of a colour map.
    dark, light
        Places on the map, from 0 to 1, of the first and the last value.
    """
    shades = mpl.colormaps[palette](np.linspace(dark, light, max(len(values), 2)))
    return {
        value: {
            "color": tuple(shades[k]),
            "linestyle": DASHES[k % len(DASHES)],
            "marker": MARKERS[k % len(MARKERS)],
        }
        for k, value in enumerate(sorted(values))
    }


def line(look: Look) -> Look:
    """Return the options of a line without markers."""
    return {key: look[key] for key in ("color", "linestyle")}


def handles(looks: dict[Any, Look], key: str, markers: bool = True, dashes: bool = True) -> list[Entry]:
    """Return the entries of a legend, one for each value of a key.

    Parameters
    ----------
    looks
        Look of each value.
    key
        Key that has the values.
    markers, dashes
        Whether curves have markers and dashes of their own.
    """
    options: Look = {"markeredgewidth": 0} if markers else {"marker": ""}
    if not dashes:
        options["linestyle"] = "-"
    return [
        (Line2D([], [], **{**look, **options}), _words.equation(key, value)) for value, look in looks.items()
    ]


def cross_end(ax: Axes, x: float, y: float) -> None:
    """Draw a cross where a curve ends before its run should have."""
    ax.plot(x, y, "x", color="black", markersize=6, markeredgewidth=1.4, zorder=5, clip_on=False)


def bottom_row(axes: list[Axes], columns: int) -> list[Axes]:
    """Return the panels that have none below them."""
    return axes[max(len(axes) - columns, 0) :]


def finish(
    figure: Figure,
    title: str,
    about: str,
    notes: Sequence[str] = (),
    entries: Sequence[Entry] = (),
    columns: int = 5,
    more: Sequence[Entry] = (),
) -> Figure:
    """Return the figure with its title, what all its runs share, a legend below and notes below that.

    Parameters
    ----------
    figure
        Figure whose panels are drawn.
    title
        Its title.
    about
        What all its runs share.
    notes
        Paragraphs below the figure; '' leaves an empty line.
    entries
        Entries of the legend, in rows of ``columns``.
    columns
        Entries in a row.
    more
        Further entries, in rows of two below.
    """
    inch = 1 / figure.get_figheight()
    figure.suptitle(title, y=1 - 0.05 * inch, va="top", fontweight="bold")
    figure.text(0.5, 1 - 0.25 * inch, about, ha="center", va="top", fontsize=8, color="0.3")
    below = 0.0
    for part, across in ((more, 2), (entries, columns)):
        if not part:
            continue
        across = min(across, len(part))
        frame = {
            "bbox_to_anchor": (0, below * inch, 1, 1),
            "bbox_transform": figure.transFigure,
        }  # unlike the default, the same place when saved "tight"
        figure.legend(*zip(*part, strict=True), loc="lower center", ncols=across, borderaxespad=0, **frame)
        below += 0.17 * -(-len(part) // across) + 0.02
    below += 0.08 if below else 0.0
    figure.get_layout_engine().set(rect=(0, below * inch, 1, 1 - (below + 0.45) * inch))
    text = "\n".join(line for note in notes for line in _wrapped(note, 138))
    figure.text(0.01, -0.05 * inch, text, ha="left", va="top", fontsize=7, color="0.25", linespacing=1.35)
    return figure


def _wrapped(text: str, width: int) -> list[str]:
    """Return lines of up to `width` characters as they are seen: marks of mathematics take no room."""
    lines: list[list[str]] = [[]]
    room = width
    for word in text.split():
        seen = len(re.sub(r"[$_{}]|\\[a-z]*", "", word)) + 1
        if seen > room:
            lines.append([])
            room = width
        lines[-1].append(word)
        room -= seen
    return [" ".join(line) for line in lines]
