"""Fronts against time, as figures draw them."""

import numpy as np

from subslide.figures import _kinds, _slices, _style, _words

QUANTITY = f"x_front_{100 * _words.THRESHOLD:.0f}pc"
LENGTH = f"L_f_{100 * _words.THRESHOLD:.0f}pc"
MARK = "× ends its curve"


def convergence(found):
    """Return the notes on how far final lengths are from converged, in numbers of these runs."""
    notes = _kinds.note(found, (QUANTITY, LENGTH), "fronts and lengths")
    ratio = _kinds.ratios(found, lambda kind: kind.runs.set_index(["a_H", "r"])[LENGTH])
    if ratio:
        short = _kinds.percent(1 - ratio[1], 1 - ratio[0])
        notes.append(f"Final lengths with the paper's numerics are {short} short of the resolved.")
        dry = [_dry(kind) for kind in found]
        if all(dry):
            notes.append(
                "At $r=0$, where the water cannot act on the grains, they differ between values of $a_H$ by "
                f"{dry[0]:.2g} % with the paper's numerics and by {dry[1]:.2g} % resolved: error of the scheme."
            )
    elif _slices.first_order(found[0].runs):
        notes.append(
            "Not converged: at first order fronts fall short, by an amount that needs a finer answer to tell."
        )
    return notes


def _dry(kind):
    """Return by how much (%) the final lengths at r = 0 differ; None where there are not two."""
    lengths = kind.runs.loc[kind.runs["r"] == 0, LENGTH].dropna()
    return 100 * float(np.ptp(lengths) / lengths.max()) if len(lengths) > 1 else None


def moving_until(curves):
    """Return the time (s) by which every front has come within 0.1 % of its farthest point."""
    ends = []
    for time, front in curves.values():
        seen = np.isfinite(front)
        if seen.any():
            far = front[seen].max()
            ends.append(float(time[seen][np.argmax(front[seen] >= far - 1e-3 * abs(far))]))
    return max(ends, default=1.0)


def plot(ax, kind, runs, curves, looks, key, t_unit, x_unit):
    """Nothing; the front of each run is in `ax`, told apart by `key`, with a cross where a run failed.

    Symbols are values that have bands; without bands they only tell the curves apart.
    """
    for _, row in runs.iterrows():
        time, front = curves.get(row["id"], (np.array([]), np.array([])))
        seen = np.isfinite(front)
        if not seen.any():
            continue
        time, front = time[seen] * t_unit.factor, front[seen] * x_unit.factor
        look, options = looks[row[key]], {}
        if kind.banded:
            marks = kind.marks(row["id"], QUANTITY)
            _kinds.symbols(ax, kind, marks, look, marks["time"] * t_unit.factor, x_unit.factor)
        else:
            offset = 0.04 + 0.03 * list(looks).index(row[key])
            options = {"marker": look["marker"], "markevery": (offset, 0.22), "markeredgewidth": 0}
        ax.plot(time, front, **kind.line(look), **options)
        if row["status"] not in _slices.FINISHED:
            _style.mark_end(ax, time[-1], front[-1])


def over_radius(ax, radius, unit):
    """Nothing; `ax` has a second scale on its right: lengths over R."""
    factor = radius * unit.factor
    side = ax.secondary_yaxis("right", functions=(lambda x: x / factor, lambda ratio: ratio * factor))
    side.set_ylabel(f"{_words.SYMBOLS['x_front']}$/R$")


def lengths(ax, found, looks, radius, columns):
    """Nothing; final length over R against r is in `ax`, with bands, and ringed where grains still moved."""
    for kind in found:
        for a_H, rows in kind.runs.groupby("a_H"):
            look, final = looks[a_H], rows[LENGTH] / radius
            ax.plot(rows["r"], final, **kind.line(look))
            if kind.banded:
                values = [kind.marks(name, LENGTH) for name in rows["id"]]
                for r, marks in zip(rows["r"], values, strict=True):
                    _kinds.symbols(ax, kind, marks, look, [r] * len(marks), 1 / radius, 5)
            else:
                ax.plot(
                    rows["r"], final, look["marker"], color=look["color"], markeredgewidth=0, markersize=5
                )
            moving = rows["status"] == "not_at_rest"
            ax.plot(
                rows["r"][moving], final[moving], "o", color="black", markerfacecolor="none", markersize=9
            )
    low, high = ax.get_ylim()
    rows = -(-len(looks) // columns)
    ax.set_ylim(low, high + 0.13 * rows * (high - low))
    dashes = not found[0].name
    handles, labels = zip(*_style.handles(looks, "a_H", dashes=dashes), strict=True)
    options = {"columnspacing": 1.2, "handlelength": 2.4, "borderaxespad": 0.2}
    ax.legend(handles, labels, ncols=columns, loc="upper center", **options)
    ax.set(xlabel=_words.SYMBOLS["r"], ylabel=f"{_words.SYMBOLS['L_f']}$/R$")
    ax.set_xticks(_slices.evenly(found[0].runs["r"].unique(), 6))


def ringed(runs):
    """Return the sentence on rings, if there are any."""
    moving = (runs["status"] == "not_at_rest").any()
    return " Rings: grains still moved at the end of the run." if moving else ""
