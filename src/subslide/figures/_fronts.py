"""Fronts against time, as figures draw them."""

import numpy as np

from subslide.figures import _slices, _style, _words

QUANTITY = f"x_front_{100 * _words.THRESHOLD:.0f}pc"
LENGTH = f"L_f_{100 * _words.THRESHOLD:.0f}pc"
MARK = "× ends its curve"
NOT_CONVERGED = (
    "Not converged: at first order with cells of 3 mm the paper's columns end 12 to 15 % short, more so in deep "
    "water; at $r$ = 0, where the water cannot act on the grains, a difference between values of $a_H$ is error of "
    "the scheme."
)


def open_symbols(runs):
    """Return the sentence on open symbols, if there are any."""
    moving = (runs["status"] == "not_at_rest").any()
    return " Open symbols: grains still moved at the end of the run." if moving else ""


def moving_until(curves):
    """Return the time (s) by which every front has come within 0.1 % of its farthest point."""
    ends = []
    for time, front in curves.values():
        seen = np.isfinite(front)
        if seen.any():
            far = front[seen].max()
            ends.append(float(time[seen][np.argmax(front[seen] >= far - 1e-3 * abs(far))]))
    return max(ends, default=1.0)


def plot(ax, runs, curves, looks, key, t_unit, x_unit):
    """Nothing; the front of each run is in `ax`, told apart by `key`, with a cross where a run failed."""
    for _, row in runs.iterrows():
        time, front = curves.get(row["id"], (np.array([]), np.array([])))
        seen = np.isfinite(front)
        if not seen.any():
            continue
        time, front = time[seen] * t_unit.factor, front[seen] * x_unit.factor
        look = looks[row[key]]
        offset = 0.04 + 0.03 * list(looks).index(row[key])
        ax.plot(time, front, **look, markevery=(offset, 0.22), markeredgewidth=0)
        if row["status"] not in _slices.FINISHED:
            _style.mark_end(ax, time[-1], front[-1])


def over_radius(ax, radius, unit):
    """Nothing; `ax` has a second scale on its right: lengths over R."""
    factor = radius * unit.factor
    side = ax.secondary_yaxis("right", functions=(lambda x: x / factor, lambda ratio: ratio * factor))
    side.set_ylabel(f"{_words.SYMBOLS['x_front']}$/R$")


def lengths(ax, runs, looks, radius, columns):
    """Nothing; final length over R against r is in `ax`, open where grains still moved."""
    for a_H, rows in runs.groupby("a_H"):
        look = looks[a_H]
        final = rows[LENGTH] / radius
        ax.plot(rows["r"], final, **look, label=_words.equation("a_H", a_H), markersize=5)
        moving = rows["status"] == "not_at_rest"
        ax.plot(
            rows["r"][moving],
            final[moving],
            look["marker"],
            color=look["color"],
            markerfacecolor="white",
            zorder=4,
        )
    low, high = ax.get_ylim()
    rows = -(-runs["a_H"].nunique() // columns)
    ax.set_ylim(low, high + 0.13 * rows * (high - low))
    ax.legend(ncols=columns, loc="upper center", columnspacing=1.2, handlelength=2.4, borderaxespad=0.2)
    ax.set(xlabel=_words.SYMBOLS["r"], ylabel=f"{_words.SYMBOLS['L_f']}$/R$")
    ax.set_xticks(_slices.evenly(runs["r"].unique(), 6))
