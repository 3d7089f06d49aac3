"""The naming table: every quantity of a record, its symbol, dimensions, unit and meaning.

Records, tables, figures and documentation take names and units from here and from nowhere else; those of the keys of a
run stand in `subslide.keys.entries`.
"""

from typing import NamedTuple

FRONT_THRESHOLDS = (0.01, 0.03, 0.05)
"""Depths that define the front, as fractions of the column's height H2; the first is the default."""

ARREST = 0.005
"""Share of the length of its deposit within which a front counts as arrested: the last grains stop cell by cell."""

GAUGE = 2.0
"""Place of the wave gauge on the x axis, over R."""


class Name(NamedTuple):
    """One quantity: symbol in text, NetCDF dimensions, unit (UDUNITS) and long name."""

    symbol: str
    dims: tuple[str, ...]
    unit: str
    long_name: str


STEP = ("run", "step")
PROFILE = ("run", "snapshot", "x")
CELLS = ("run", "snapshot", "cell")
"""Dimensions of profiles, and of their positions, in a record whose runs do not lie on one uniform grid."""

SERIES = {
    "x_front": Name(
        "x_front",
        ("run", "front_threshold", "step"),
        "m",
        "distance from the axis to the farthest point on the positive x axis where h2 exceeds the threshold; missing"
        " where there is none",
    ),
    "max_abs_eta": Name(
        "max|η|",
        STEP,
        "m",
        "largest displacement of the water surface within 4.2553 R of the axis along x and y (the paper's box, on every"
        " grid); where waves meet on the axis it has no limit as cells shrink",
    ),
    "max_abs_eta_outside": Name(
        "max|η| (x > R)",
        STEP,
        "m",
        "largest displacement of the water surface beyond R, within 4.2553 R of the axis along x and y",
    ),
    "eta_gauge": Name(
        "η(2 R)",
        STEP,
        "m",
        f"displacement of the water surface at a gauge, {GAUGE:g} R from the axis along x",
    ),
    "sediment_volume": Name("V2", STEP, "m3", "volume of grains in the box, and beyond it on an open sea"),
    "water_volume": Name(
        "V1",
        STEP,
        "m3",
        "volume of water in the box, and on an open sea what is beyond it less the water that is there at rest",
    ),
    "energy": Name(
        "E",
        STEP,
        "m5 s-2",
        "mechanical energy over the density of grains, relative to the bed, of what the volumes count",
    ),
    "nonhyperbolic_cells": Name("n_c", STEP, "1", "cells where the two layers' wave speeds are complex"),
    "hyperbolic_margin": Name(
        "m_c",
        STEP,
        "1",
        "smallest discriminant of the wave speeds over that without shear: 1 at rest, below 0 where they are complex",
    ),
}

PROFILES = {
    "h2": Name("h2", PROFILE, "m", "depth of grains along the x axis"),
    "eta": Name("η", PROFILE, "m", "displacement of the water surface along the x axis"),
    "h2_diagonal": Name("h2", PROFILE, "m", "depth of grains along the diagonal, at distance sqrt(2) x"),
}

FIELDS_2D = {
    "h2_field": Name("h2", ("run", "snapshot", "y", "x"), "m", "depth of grains"),
    "eta_field": Name("η", ("run", "snapshot", "y", "x"), "m", "displacement of the water surface"),
}

AT_GAUGE = ("run", "gauge", "step")
GAUGES = {
    "gauge_eta": Name(
        "η", AT_GAUGE, "m", "displacement of the water surface at each of the gauges asked for"
    ),
    "gauge_h2": Name("h2", AT_GAUGE, "m", "depth of grains there"),
    "gauge_u1": Name("u1", AT_GAUGE, "m s-1", "velocity of water there along x"),
    "gauge_v1": Name("v1", AT_GAUGE, "m s-1", "velocity of water there along y"),
    "gauge_u2": Name("u2", AT_GAUGE, "m s-1", "velocity of grains there along x"),
    "gauge_v2": Name("v2", AT_GAUGE, "m s-1", "velocity of grains there along y"),
}

ARRIVAL = FRONT_THRESHOLDS[0]
"""Depth of grains, and displacement of the surface, over H2, from which on they have arrived in a cell."""

LARGEST = {
    "largest_h2": Name("h2", ("run", "x"), "m", "largest depth of grains in the cell at any step"),
    "largest_abs_eta": Name(
        "|η|",
        ("run", "x"),
        "m",
        "largest displacement of the water surface in the cell, up or down, at any step",
    ),
    "arrival_h2": Name(
        "t",
        ("run", "x"),
        "s",
        f"time of the first step at which h2 of the cell is {100 * ARRIVAL:g} % of H2 or more; missing if it never is",
    ),
    "arrival_eta": Name(
        "t",
        ("run", "x"),
        "s",
        f"time of the first step at which |eta| of the cell is {100 * ARRIVAL:g} % of H2 or more; missing if it never"
        " is",
    ),
}
FOOTPRINTS = LARGEST | {
    f"{name}_field": about._replace(dims=("run", "y", "x")) for name, about in LARGEST.items()
}
"""Footprints of a radius or line, by cell along x, and of the plane, where they are called fields."""

RUNOUT = {
    "runout": Name(
        "L",
        ("run", "front_threshold", "direction"),
        "m",
        "runout of the deposit: distance from the axis to the farthest point in that direction where h2 exceeds the"
        " threshold at the end of the run, bilinear between cell centres; along x it is L_f; missing as L_f is",
    ),
    "runout_max": Name("L_max", ("run", "front_threshold"), "m", "largest of these runouts"),
    "runout_max_direction": Name(
        "", ("run", "front_threshold"), "degree", "direction of the largest, the first from the x axis on"
    ),
    "deposit_area": Name(
        "A", ("run", "front_threshold"), "m2", "area where h2 exceeds the threshold at the end of the run"
    ),
    "deposit_x": Name("x", ("run",), "m", "centroid of the volume of grains at the end of the run, along x"),
    "deposit_y": Name("y", ("run",), "m", "centroid of the volume of grains at the end of the run, along y"),
}

MEASURED = GAUGES | FOOTPRINTS | RUNOUT
"""Quantities of runs that ask for them by keys of their own, see `keys.measured`."""

SCALARS = {
    "L_f": Name(
        "L_f",
        ("run", "front_threshold"),
        "m",
        "length of the deposit along the positive x axis at the end of the run: x_front there; missing where the run"
        " failed, or no grains lie as deep as the threshold",
    ),
    "time_of_arrest": Name(
        "t_arrest",
        ("run", "front_threshold"),
        "s",
        f"time since which x_front has been within {100 * ARREST:g} % of L_f; missing where L_f is 0 or missing, or if"
        " grains move at the end",
    ),
    "time_at_rest": Name(
        "t_rest",
        ("run",),
        "s",
        "time since which no grain has moved (late waves may nudge a few; has no limit as cells shrink)",
    ),
    "box_half_width": Name(
        "L", ("run",), "m", "half-width of the computational box, and of the paper's on an open sea"
    ),
    "wave_free_until": Name(
        "t_w",
        ("run",),
        "s",
        "time when the first wave from the grains can be at an edge of the box that lets it out; then what comes back"
        " has a part in the water, in the plane with `boundary: open` some 1 % of the waves; infinite on an open sea"
        " (a radius or line), which has no edge; missing behind walls, in periodic boxes and without water",
    ),
    "steps": Name("n", ("run",), "1", "number of time steps"),
    "wall_seconds": Name("", ("run",), "s", "wall time of the time loop alone"),
}

COORDINATES = {
    "run": Name(
        "",
        ("run",),
        "1",
        "number of the run, given once within a study, growing with its batches; 0 of a run on its own",
    ),
    "step": Name("", ("step",), "1", "number of the sample, from 0"),
    "snapshot": Name("", ("snapshot",), "1", "number of the snapshot, from 0"),
    "cell": Name("", ("cell",), "1", "number of the cell, from 0, where runs lie on unlike grids"),
    "front_threshold": Name("", ("front_threshold",), "1", "depth that defines the front over H2"),
    "x": Name("x", ("x",), "m", "distance of cell centre from the axis of the column along x"),
    "y": Name("y", ("y",), "m", "distance of cell centre from the axis of the column along y"),
    "cell_width": Name(
        "", CELLS, "m", "width of the cell; only where runs lie on unlike grids, or on one that moves"
    ),
    "time": Name("t", STEP, "s", "elapsed time since release"),
    "snapshot_time": Name("t", ("run", "snapshot"), "s", "elapsed time of the profile"),
    "gauge": Name("", ("gauge",), "1", "number of the gauge, from 0, in the order in which it was asked for"),
    "gauge_x": Name("x", ("run", "gauge"), "m", "place of the gauge along x"),
    "gauge_y": Name("y", ("run", "gauge"), "m", "place of the gauge along y"),
    "direction": Name("", ("direction",), "degree", "direction of runout, anticlockwise from the x axis"),
}

NAMES = {**SERIES, **PROFILES, **FIELDS_2D, **SCALARS, **MEASURED, **COORDINATES}
"""Every quantity of a record by name, but for the keys of its runs, which `subslide.keys` describes."""

FRONT_LABELS = {f"{100 * fraction:g}pc": n for n, fraction in enumerate(FRONT_THRESHOLDS)}
"""Place of each threshold of the front by its label in the names of columns, such as `L_f_1pc`."""

STATUSES = {
    "ok": "the run reached its end",
    "not_at_rest": "the cap in scaled time came before the grains were at rest",
    "left_domain": "the front reached the edge of the largest box",
    "diverged": "a value is not finite",
    "negative_depth": "a depth fell below zero by more than round-off",
    "step_collapse": "the stable time step became too small to finish",
    "hyperbolicity_lost": "wave speeds became complex and the treatment is to stop",
}

FINISHED = ("ok", "not_at_rest")
"""Statuses of runs whose last profile and front mean something."""
