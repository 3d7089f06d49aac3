"""The figure of `make bench-peers`: the grains along x in each code, and the seconds a run took."""

import matplotlib as mpl
from codes import H2, HALF_WIDTH
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, NullLocator, StrMethodFormatter

RC = {"font.size": 8, "axes.spines.top": False, "axes.spines.right": False, "legend.frameon": False}
LOOKS = {
    ("subslide", 1): {"color": "#31688e", "linestyle": (0, (5, 1.5))},
    ("subslide", 2): {"color": "#440154", "linestyle": "-"},
    ("GeoClaw", 1): {"color": "#d95f0e", "linestyle": (0, (4, 1.2, 1, 1.2))},
    ("PyClaw", 1): {"color": "0.6", "linestyle": "-"},
}
ORDERS = {1: "first order", 2: "second order"}


def save(figure, folder):
    """Nothing; the figure is in the folder as peers.png and peers.svg."""
    for kind in ("png", "svg"):
        figure.savefig(folder / f"peers.{kind}", dpi=200, metadata={"Date": None} if kind == "svg" else None)


@mpl.rc_context(RC)
def draw(profiles, true, rows, times):
    """Return the figure: a panel for each time on the finest grid, and bars of seconds until the last of them."""
    figure = Figure(figsize=(7.2, 5.4), layout="constrained")
    upper, lower = figure.subfigures(2, 1, height_ratios=(1, 0.9))
    panels = upper.subplots(1, len(times), sharex=True, sharey=True)
    for ax, time in zip(panels, times, strict=True):
        draw_profiles(ax, profiles[max(profiles)], true, time)
        ax.set_title(f"{1000 * time:.0f} ms", fontsize=8)
    panels[0].set_ylabel("depth of the grains, $h_2$ / $H_2$ (1)")
    names, labels = panels[0].get_legend_handles_labels()
    upper.legend(names, labels, loc="outside lower center", ncols=len(labels), fontsize=7)
    draw_seconds(lower.subplots(), rows, times[-1])
    n = max(profiles)
    figure.suptitle(
        f"The paper's column without friction, two layers, {n} x {n} cells of {2000 * HALF_WIDTH / n:g} mm",
        fontsize=8.5,
    )
    return figure


def draw_profiles(ax, finest, true, time):
    """Nothing; the panel has the profiles of two layers at a time, over that of a fine radial run."""
    frame = true.frames[time]
    ax.fill_between(1000 * frame.x, frame.h2 / H2, color="0.88", lw=0, label="radial, 1600 cells")
    for key, look in LOOKS.items():
        result = finest[key]
        if result.model == "two layers" and time in result.frames:
            frame = result.frames[time]
            ax.plot(1000 * frame.x, frame.h2 / H2, lw=1.3, label=f"{key[0]}, {ORDERS[key[1]]}", **look)
    ax.set_xlim(0, 1000 * HALF_WIDTH)
    ax.set_ylim(0, 1.08)
    ax.set_xlabel("x (mm)")


def draw_seconds(ax, rows, until):
    """Nothing; the panel has a bar for each code and grid, from the rows, with the spread of the repetitions."""
    found = [row for row in rows if row.quantity == "seconds" and row.time == until]
    found.sort(key=lambda row: (row.cells, list(LOOKS).index((row.code, row.order))))
    low = 0.5 * min(row.low for row in found)
    for k, row in enumerate(found):
        look = LOOKS[row.code, row.order]
        ax.barh(k, row.value - low, left=low, color=look["color"], height=0.7)
        ax.plot([row.low, row.high], [k, k], color="black", lw=0.8)
        ax.annotate(f"{row.value:.3g} s", (row.high, k), (4, 0), textcoords="offset points", va="center")
    label = "{0.code}, {0.model}, {1}, {0.cells} x {0.cells}"
    ax.set_yticks(range(len(found)), [label.format(row, ORDERS[row.order]) for row in found])
    ax.invert_yaxis()
    ax.set_xscale("log")
    ax.set_xlim(low, 3 * max(row.high for row in found))
    ax.xaxis.set_major_locator(LogLocator(10))
    ax.xaxis.set_major_formatter(StrMethodFormatter("{x:g}"))
    ax.xaxis.set_minor_locator(NullLocator())
    ax.set_xlabel(f"wall seconds for {1000 * until:.0f} ms on one core (median; line: least to greatest)")
