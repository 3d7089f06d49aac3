"""Fronts against time, as figures draw them."""

from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from subslide import naming
from subslide.figures import _kinds, _slices, _style, _words
from subslide.naming import FINISHED

QUANTITY = f"x_front_{_words.THRESHOLD_LABEL}"
LENGTH = f"L_f_{_words.THRESHOLD_LABEL}"
CROSS = "× ends its curve"
"""What notes say of the cross where a run failed."""


def convergence(kinds: list[_kinds.Kind]) -> list[str]:
    """Return the notes on how far final lengths are from converged, in numbers of these runs."""
    notes = _kinds.note(kinds, (QUANTITY, LENGTH), "fronts and lengths")
    ratio = _kinds.ratios(kinds, lambda kind: kind.runs.set_index(["a_H", "r"])[LENGTH])
    if ratio:
        short = _kinds.percent(1 - ratio[1], 1 - ratio[0])
        notes.append(f"Final lengths with the paper's numerics are {short} short of the resolved.")
        dry = [_dry(kind) for kind in kinds]
        if all(dry):
            notes.append(
                "At $r=0$, where the water cannot act on the grains, they differ between values of $a_H$ by "
                f"{dry[0]:.2g} % with the paper's numerics and by {dry[1]:.2g} % resolved: error of the scheme."
            )
    elif _slices.first_order(kinds[0].runs):
        notes.append(
            "Not converged: at first order fronts fall short, by an amount that needs a finer answer to tell."
        )
    return notes


def _dry(kind: _kinds.Kind) -> float | None:
    """Return by how much (%) the final lengths at r = 0 differ; None where there are not two."""
    lengths = kind.runs.loc[kind.runs["r"] == 0, LENGTH].dropna()
    return 100 * float(np.ptp(lengths) / lengths.max()) if len(lengths) > 1 else None


def moving_until(curves: dict[str, tuple[np.ndarray, np.ndarray]]) -> float:
    """Return the time (s) by which every front has come within 0.1 % of its farthest point."""
    ends = []
    for time, front in curves.values():
        seen = np.isfinite(front)
        if seen.any():
            far = front[seen].max()
            ends.append(float(time[seen][np.argmax(front[seen] >= far - 1e-3 * abs(far))]))
    return max(ends, default=1.0)


def plot(
    ax: Axes,
    kind: _kinds.Kind,
    runs: pd.DataFrame,
    curves: dict[str, tuple[np.ndarray, np.ndarray]],
    looks: dict[Any, _style.Look],
    key: str,
    units: _words.Units,
) -> None:
    """Draw the front of each run against time, with a cross where a run failed.

    Symbols are values that have bands; without bands they only tell the curves apart.

    Parameters
    ----------
    ax
        Panel to draw in.
    kind
        Kind of numerics of the runs.
    runs
        Rows of the table of runs.
    curves
        Times (s) and fronts (m) of each run by its id.
    looks
        Look of each value of ``key``.
    key
        Key that tells the runs apart.
    units
        Units of time and front on the axes.
    """
    for _, row in runs.iterrows():
        time, front = curves.get(row["id"], (np.array([]), np.array([])))
        seen = np.isfinite(front)
        if not seen.any():
            continue
        time, front = time[seen] * units.time.factor, front[seen] * units.value.factor
        look, options = looks[row[key]], {}
        if kind.banded:
            values = kind.banded_values(row["id"], QUANTITY)
            _kinds.symbols(ax, kind, values, look, values["time"] * units.time.factor, units.value.factor)
        else:
            offset = 0.04 + 0.03 * list(looks).index(row[key])
            options = {"marker": look["marker"], "markevery": (offset, 0.22), "markeredgewidth": 0}
        ax.plot(time, front, **kind.line(look), **options)
        if row["status"] not in naming.FINISHED:
            _style.cross_end(ax, time[-1], front[-1])


def over_radius(ax: Axes, radius: float, unit: _words.Unit) -> None:
    """Draw a second scale on the right of a panel: lengths over R (m)."""
    factor = radius * unit.factor
    side = ax.secondary_yaxis("right", functions=(lambda x: x / factor, lambda ratio: ratio * factor))
    side.set_ylabel(f"{_words.SYMBOLS['x_front']}$/R$")


def lengths(
    ax: Axes, kinds: list[_kinds.Kind], looks: dict[Any, _style.Look], radius: float, columns: int
) -> None:
    """Draw the final length over R against r, with bands, and ringed where grains still moved.

    Parameters
    ----------
    ax
        Panel to draw in.
    kinds
        Kinds of numerics to draw.
    looks
        Look of each a_H.
    radius
        Radius R (m) of the column.
    columns
        Entries in a row of the legend.
    """
    for kind in kinds:
        for a_H, rows in kind.runs.groupby("a_H"):
            look, final = looks[a_H], rows[LENGTH] / radius
            ax.plot(rows["r"], final, **kind.line(look))
            if kind.banded:
                values = [kind.banded_values(name, LENGTH) for name in rows["id"]]
                for r, at_end in zip(rows["r"], values, strict=True):
                    _kinds.symbols(ax, kind, at_end, look, [r] * len(at_end), 1 / radius, 5)
            else:
                ax.plot(
                    rows["r"], final, look["marker"], color=look["color"], markeredgewidth=0, markersize=5
                )
            moving = rows["time_at_rest"].isna()
            ax.plot(
                rows["r"][moving], final[moving], "o", color="black", markerfacecolor="none", markersize=9
            )
    low, high = ax.get_ylim()
    rows = -(-len(looks) // columns)
    ax.set_ylim(low, high + 0.13 * rows * (high - low))
    dashes = not kinds[0].name
    handles, labels = zip(*_style.handles(looks, "a_H", dashes=dashes), strict=True)
    options = {"columnspacing": 1.2, "handlelength": 2.4, "borderaxespad": 0.2}
    ax.legend(handles, labels, ncols=columns, loc="upper center", **options)
    ax.set(xlabel=_words.SYMBOLS["r"], ylabel=f"{_words.SYMBOLS['L_f']}$/R$")
    ax.set_xticks(_slices.evenly(kinds[0].runs["r"].unique(), 6))


def ringed(runs: pd.DataFrame) -> str:
    """Return the sentence on rings, if there are any."""
    moving = (runs["time_at_rest"].isna() & runs["status"].isin(FINISHED)).any()
    return " Rings: grains still moved at the end of the run." if moving else ""
