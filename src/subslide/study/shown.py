"""What a program that prints a study sees of it: its axes, as words and as HTML for notebooks."""

import html
from collections.abc import Iterable, Sequence
from typing import Any

from subslide.keys import values, words
from subslide.keys.entries import ENTRIES
from subslide.points import RUN_KEYS, Point

MOST = 12
"""Values of a key that are listed."""

MAIN = ("a_H", "a_2", "r", "delta")
"""Keys that are told also where they do not vary."""


def axes(runs: Iterable[tuple[str, Point]]) -> dict[str, list]:
    """Return the values, in the order of the runs, of each key that varies, and those of MAIN.

    Parameters
    ----------
    runs
        Label of the numerics, and point, of each.

    Returns
    -------
    dict
        Lists by key, as a configuration would state the values.
    """
    runs = list(runs)
    by_key: dict[str, list] = {"numerics": list(dict.fromkeys(label for label, _ in runs))}
    for key in RUN_KEYS:
        held = dict.fromkeys(getattr(point, key) for _, point in runs)
        by_key[key] = [values.stated(key, value) for value in held]
    return {key: listed for key, listed in by_key.items() if len(listed) > 1 or key in MAIN}


def line(name: str, runs: Sequence[tuple[str, Point]]) -> str:
    """Return a study in one line: its name, its runs and what they are over.

    Parameters
    ----------
    name
        What stands first.
    runs
        As for `axes`.

    Returns
    -------
    str
        The line.
    """
    over = "; ".join(f"{key} ({_listed(listed)})" for key, listed in axes(runs).items() if len(listed) > 1)
    return f"{name}: {len(runs):,} run{'s' * (len(runs) != 1)}{f' over {over}' if over else ''}"


def page(name: str, runs: Sequence[tuple[str, Point]], lines: Iterable[str]) -> str:
    """Return a study as HTML: its axes in a table, and lines below.

    Parameters
    ----------
    name
        What stands above.
    runs
        As for `axes`.
    lines
        Text.

    Returns
    -------
    str
        HTML.
    """
    rows = "".join(
        f"<tr><td><code>{key}</code></td><td>{len(listed):,}</td><td style='text-align:left'>"
        f"{html.escape(' '.join([_listed(listed), words.unit(key)]))}</td>"
        f"<td style='text-align:left'>{html.escape(ENTRIES[key]['description'])}</td></tr>"
        for key, listed in axes(runs).items()
    )
    below = "".join(f"<div>{html.escape(text)}</div>" for text in lines)
    head = f"<b>{html.escape(name)}</b>: {len(runs):,} run{'s' * (len(runs) != 1)}"
    return (
        f"<div>{head}<table><tr><th>key</th><th>values</th><th></th><th></th></tr>{rows}</table>{below}</div>"
    )


def _listed(listed: list[Any]) -> str:
    """Return values as words, the middle left out of a long list."""
    told = [f"{value:g}" if isinstance(value, float) else words.show(value) for value in listed]
    return ", ".join(told if len(told) <= MOST else [*told[: MOST - 2], "...", told[-1]])
