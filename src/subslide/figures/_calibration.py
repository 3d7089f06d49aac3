"""Figure of a calibration: the data beside the best fit, and the profile of each parameter."""

from pathlib import Path

import numpy as np

from subslide.emulator.calibration import RISE, Calibration
from subslide.emulator.observed import OF_95
from subslide.files import replacing

LABELS = {"a_H": "$a_H$", "r": "$r$", "delta": r"$\delta$ (°)"}
TIMES = 121


def save(answer: Calibration, path: str) -> None:
    """Write the figure of a calibration as PNG.

    Parameters
    ----------
    answer
        The calibration.
    path
        The file.
    """
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    from subslide.figures import _style

    model, data = answer.model, answer.model.data
    best = model.unit({key: one.best for key, one in answer.parameters.items()})
    rest = np.isnan(data.time)
    last = 1.25 * max(np.nanmax(data.time, initial=0.0), 3 * model.column.time_scale)
    time = np.append(np.linspace(0, last, TIMES), np.nan)
    curve = model._replace(data=data._replace(time=time, place=np.ones(len(time)), error=np.zeros(len(time))))
    place, deviation = (part[0] for part in curve.fronts(best))
    with plt.rc_context(_style.RC):
        size = (_style.WIDTH, 2.6)
        wide = {"width_ratios": [1.4, *(1 for _ in model.free)]}
        figure, axes = plt.subplots(
            1, 1 + len(model.free), figsize=size, layout="constrained", gridspec_kw=wide
        )
        first, *others = axes
        band = OF_95 * deviation[:-1]
        first.fill_between(time[:-1], place[:-1] - band, place[:-1] + band, color="0.8", lw=0)
        first.plot(time[:-1], place[:-1], "k-", lw=1, label="best fit")
        at = np.where(rest, last, data.time)
        first.errorbar(at, data.place, OF_95 * data.error, fmt="o", ms=3, color="0.35", label="data, 95 %")
        if answer.solver is not None:
            first.plot(at, answer.solver, "x", color="k", ms=4, label="solver")
        first.set(xlabel="time (s); deposits at the end", ylabel=f"{100 * data.threshold:g} % front (m)")
        first.legend(frameon=False)
        for ax, (key, one) in zip(others, answer.parameters.items(), strict=True):
            ax.plot(*one.profile, "k-", lw=1)
            ax.axhline(RISE, color="0.6", lw=0.8, ls=":")
            ax.axvspan(one.low, one.high, color="0.9", lw=0)
            ax.set(xlabel=LABELS[key], ylim=(0, 4 * RISE), title=one.verdict.replace(", ", ",\n"))
            if key == "a_H":  # its prior is even in the logarithm
                ax.set_xscale("log")
                ax.set_xticks([0.5, 1, 2, 5, 10], ["0.5", "1", "2", "5", "10"], minor=False)
                ax.minorticks_off()
        others[0].set_ylabel(r"rise of $-2\,\ln L$")
        with replacing(Path(path)) as temporary:
            figure.savefig(temporary, format="png", dpi=200, metadata={"Software": None})
        plt.close(figure)
