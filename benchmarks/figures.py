"""Two figures of the table: the roofline, and the ratios beside their targets."""

import matplotlib as mpl
import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, NullLocator, StrMethodFormatter
from roofline import KERNELS
from table import verdicts

RC = {"font.size": 8, "axes.spines.top": False, "axes.spines.right": False, "legend.frameon": False}
COLOURS = dict(zip(KERNELS, mpl.colormaps["viridis"](np.linspace(0, 0.85, len(KERNELS))), strict=True))
NEAR, FAR = 0.3, 20
"""Ends of the roofline's axis (flop/B)."""
MARKERS = dict(zip(KERNELS, "os^D", strict=True))


def save(figure, folder, name):
    """Return the paths of the figure as PNG and SVG."""
    paths = [folder / f"{name}.{kind}" for kind in ("png", "svg")]
    for path in paths:
        figure.savefig(path, dpi=200, metadata={"Date": None} if path.suffix == ".svg" else None)
    return paths


@mpl.rc_context(RC)
def roofline(rows):
    """Return the roofline, a panel for each precision."""
    dtypes = list(dict.fromkeys(row.dtype for row in rows if row.benchmark == "machine"))
    figure = Figure(figsize=(7.2, 4.0), layout="constrained")
    panels = figure.subplots(1, len(dtypes), sharex=True, sharey=True, squeeze=False)[0]
    x = np.geomspace(NEAR, FAR, 200)
    for ax, dtype in zip(panels, dtypes, strict=True):
        can = {row.quantity: row.value for row in rows if row.benchmark == "machine" and row.dtype == dtype}
        peak = can["multiply_adds"]
        ax.loglog(x, np.minimum(can["bandwidth"] * x, peak), color="black", lw=1.2)
        ax.loglog(x, np.minimum(can["bandwidth"] * x, peak / 2), color="black", lw=0.7, ls=":")
        ax.annotate(f"multiply-adds: {peak:.0f} Gflop/s", (FAR, peak), ha="right", va="bottom")
        ax.annotate(f"single operations: {peak / 2:.0f}", (FAR, peak / 2), ha="right", va="bottom")
        ax.text(
            NEAR * 1.1,
            can["bandwidth"] * NEAR * 1.25,
            f"memory: {can['bandwidth']:.0f} GB/s",
            rotation=np.degrees(np.arctan(can["bandwidth"])),  # the line's, before the logarithms
            rotation_mode="anchor",
            transform_rotates_text=True,
        )
        for kernel in KERNELS:
            values = {
                row.quantity: row.value
                for row in rows
                if row.benchmark == f"roofline: {kernel}" and row.dtype == dtype
            }
            if values:
                at = values["flops_per_byte"]
                ax.plot(at, values["flop_rate"], MARKERS[kernel], color=COLOURS[kernel], label=kernel, ms=6)
                roof = min(can["bandwidth"] * at, peak)
                if values["ceiling"] < roof:
                    ax.plot(at, values["ceiling"], "_", color=COLOURS[kernel], ms=14, mew=1.6)
        for axis in (ax.xaxis, ax.yaxis):
            axis.set_major_locator(LogLocator(10, (1, 2, 5)))
            axis.set_major_formatter(StrMethodFormatter("{x:g}"))
            axis.set_minor_locator(NullLocator())
        ax.set_title(f"{dtype}, one core")
        ax.set_xlabel("operations a byte from memory (flop/B)")
    panels[0].set_ylabel("operations a second (Gflop/s)")
    panels[0].set_ylim(5, 1.6 * max(row.value for row in rows if row.quantity == "multiply_adds"))
    names, labels = panels[0].get_legend_handles_labels()
    figure.legend(names, labels, loc="outside lower center", ncols=len(KERNELS))
    figure.suptitle(
        "Kernels (symbols) under what the core can do; a dash is the ceiling set by a kernel's divisions and roots\n"
        "+, -, x, / and roots count as one operation each; min, max, abs and choices as none",
        fontsize=8,
    )
    return figure


@mpl.rc_context(RC)
def bars(rows):
    """Return the measured ratios as bars, from the lowest to the highest repetition, with their targets."""
    found = [
        (criterion, value) for criterion, value in verdicts(rows) if value is not None and criterion.at_least
    ]
    figure = Figure(figsize=(7.2, 0.6 + 0.42 * max(len(found), 1)), layout="constrained")
    ax = figure.subplots()
    for place, (criterion, value) in enumerate(found):
        reached = value.median >= criterion.target
        error = [[value.median - value.low], [value.high - value.median]]
        ax.barh(place, value.median, 0.6, xerr=error, color="#3b7a8c" if reached else "#c98a3b", capsize=2)
        ax.plot([criterion.target] * 2, [place - 0.42, place + 0.42], color="black", lw=1.6)
        ax.annotate(
            f"{value.median:.2f}",
            (0, place),
            (4, 0),
            textcoords="offset points",
            va="center",
            color="white",
            fontweight="bold",
        )
    ax.set_yticks(range(len(found)), [criterion.text.replace(": ", ":\n") for criterion, _ in found])
    ax.invert_yaxis()
    ax.set_xlim(left=0)
    ax.set_xlabel("ratio: median, lowest and highest; black: the target (bar blue: reached)")
    return figure
