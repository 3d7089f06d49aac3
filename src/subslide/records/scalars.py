"""What a record says of a run in a number each that follows from its samples, whatever else of it is kept.

They are made of all samples of the run, before any are left out.
"""

import math
from typing import TYPE_CHECKING

from subslide.keys import names
from subslide.naming import Name
from subslide.points import PAPER_BOX
from subslide.records import energy, gauge

if TYPE_CHECKING:
    from subslide.solver.run import Run

RUN = ("run",)
NAMES = {
    "max_abs_eta_peak": Name(
        "",
        RUN,
        "m",
        "largest displacement of the water surface, within 4.2553 R along x and y, over all time; where waves meet on"
        " the axis it has no limit as cells shrink",
    ),
    "max_abs_eta_peak_time": Name("", RUN, "s", "time of that peak"),
    "max_abs_eta_outside_peak": Name(
        "",
        RUN,
        "m",
        "the same beyond x = R, where waves are not focused; often the jump at the start, or the sharp head of a wave:"
        " it converges slowly, `eta_gauge_peak` does not",
    ),
    "max_abs_eta_outside_peak_time": Name("", RUN, "s", "time of that peak"),
    "eta_gauge_peak": Name("", RUN, "m", gauge.MEANING),
    "eta_gauge_peak_time": Name("", RUN, "s", "middle of that time"),
    "sediment_volume_error": Name(
        "", RUN, "1", "largest relative change of the volume of grains while nothing can have left the box"
    ),
    "water_volume_error": Name("", RUN, "1", "the same for water"),
    "energy_rise": Name(
        "",
        RUN,
        "1",
        "largest rise of the energy after any moment, over what the start can release (its energy less that of flat"
        f" layers at rest); of an open box until `wave_free_until`. Above {energy.GAINED:g} the answer is wrong in any"
        " status",
    ),
    "nonhyperbolic_cells_max": Name(
        "", RUN, "1", "most cells, at any one time, where the wave speeds are complex"
    ),
    "hyperbolic_margin_min": Name(
        "",
        RUN,
        "1",
        "smallest margin to complex wave speeds at any time, a discriminant: 1 at rest, below 0 where complex",
    ),
    "nonhyperbolic_time": Name("", RUN, "1", "share of the samples in which any wave speed is complex"),
}
"""Unit and meaning by name; those of the table of runs in its order."""


def of(run: "Run") -> dict[str, float]:
    """Return the numbers of a run, in the order of NAMES: those it has, else made of its samples.

    Parameters
    ----------
    run
        Result of `solver.solve`.

    Returns
    -------
    dict
        Numbers by name; NaN where there is none.
    """
    if run.scalars is None:
        run.scalars = dict(zip(NAMES, _values(run), strict=True))
    return run.scalars


def _values(run: "Run") -> tuple[float, ...]:
    """Return the numbers of a run, made of its samples."""
    from subslide.records import reductions

    time, series = run.time, run.all_series()
    inside = samples_inside(run)
    return (
        *reductions.peak(series["max_abs_eta"], time),
        *reductions.peak(series["max_abs_eta_outside"], time),
        *gauge.peak(run.point, time, series["eta_gauge"]),
        reductions.relative_change(series["sediment_volume"][:inside]),
        reductions.relative_change(series["water_volume"][:inside]),
        energy.rise(run.point, run.model, run.box_half_width, series | {"time": time}, run.wave_free_until),
        max(0.0, reductions.extreme(series["nonhyperbolic_cells"], 1.0)),
        reductions.extreme(series["hyperbolic_margin"], -1.0),
        reductions.share_above(series["nonhyperbolic_cells"], 0.0),
    )


def samples_inside(run: "Run") -> int:
    """Return the number of samples up to which nothing can have left the box.

    A step carries a change `order` cells at most. Nothing ever leaves a closed box, a sea or a fitted grid, and every
    sample counts.
    """
    closed = run.point.boundary not in names.LEAVING or run.grid == "fitted"
    if closed or run.wave_free_until == math.inf:
        return len(run.time)
    radius = run.point.radius
    cells = (min(PAPER_BOX * radius, run.box_half_width) - radius) / run.dx
    return max(1, int(cells / run.point.order) - 1)
