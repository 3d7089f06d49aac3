"""Regions of parameters and numerics that the stability atlas found unsafe: a run in one says so once, on stderr.

Each region is earned: tests/study/test_cautions.py solves its `example` and shows that it fails, gains energy or misses
the answer, where the same run with what the region suggests does not. Imports no kernels.
"""

from collections.abc import Callable, Iterable
from typing import NamedTuple

from subslide import scenes
from subslide.points import Point
from subslide.study import choice


class Region(NamedTuple):
    """Region of unsafe points.

    Attributes
    ----------
    name
        What it is called.
    holds
        Function that tells whether a point lies in it.
    reason, advice
        Why it is unsafe, and what to choose instead.
    example, instead
        Keys of a run in it that shows the harm, and keys that mend that run.
    seen
        Study, and its part, where that was seen; '' if only its example shows it.
    """

    name: str
    holds: Callable[[Point], bool]
    reason: str
    advice: str
    example: dict
    instead: dict
    seen: str


LEAST_FRICTION = 0.08
"""tan(delta)/a_2 below which grains run further than the largest box reaches."""
FLOATING = 0.995
"""Density ratio above which waves between the layers are so slow and lasting that errors pile up."""
LARGEST_CFL = 1.0


def _far(point: Point) -> bool:
    """Return whether grains run out of the largest box, or for ever."""
    slides = point.friction == "coulomb" and point.friction_number < LEAST_FRICTION
    ends = choice.is_fitted(point) and point.delta > 0  # a fitted grid goes as far as they do
    return point.t_end is None and slides and not ends


def _floating(point: Point) -> bool:
    """Return whether grains nearly float, in a solver that resolves the waves between the layers."""
    return point.r > FLOATING and point.model != "one-layer" and point.scheme in ("ifcph", "ifcp", "roe")


def _standing_jump(point: Point) -> bool:
    """Return whether a dam breaks over a dry bed in a solver that may keep a jump there."""
    if point.scene != "dam_break" or point.order != 1 or point.scheme not in ("ifcp", "roe"):
        return False
    return scenes.options(point)["downstream"] == 0


def _sliding(point: Point) -> bool:
    """Return whether layers slide so fast over each other that their waves grow without end."""
    if point.treatment not in ("real", "hll"):
        return False
    if point.scene == "slide" and point.r > 0 and point.a_H > 0:
        limit = scenes.load("shear").critical_shear(point.a_H, 1.0, point.r)
        return scenes.options(point)["speed"] > limit
    return point.scene == "shear" and scenes.options(point)["shear"] > 1


REGIONS = (
    Region(
        "Courant number",
        lambda point: point.cfl > LARGEST_CFL,
        "above a Courant number of 1 waves grow by every scheme, and from 1.1 on columns that collapse blow up too",
        "cfl of 0.9 or less",
        {"cfl": 1.5, "delta": 0, "boundary": "wall", "t_end": 0.6, "cells": 100, "order": 1},
        {"cfl": 0.9},
        "stability, table of Courant numbers",
    ),
    Region(
        "little friction",
        _far,
        f"with tan(delta)/a_2 below {LEAST_FRICTION:g} grains run beyond the largest box, or never rest: the run ends"
        " as left_domain, or at the cap in time",
        "a number for t_end, more friction or a lower column",
        {"delta": 0, "cells": 40},
        {"t_end": 0.2},
        "stability, map of a_2 by delta",
    ),
    Region(
        "floating grains",
        _floating,
        f"above r = {FLOATING:g} solvers that resolve waves between the layers gain energy from them; some runs end as"
        " step_collapse",
        "scheme: hll or rusanov, or a t_end before waves come back from the box's ends",
        {"r": 0.999, "a_2": 1, "delta": 5.71, "boundary": "wall", "cells": 100},
        {"scheme": "hll"},
        "stability, grains that nearly float",
    ),
    Region(
        "printed formula",
        lambda point: point.as_printed != "none",
        "the paper's printed test of rest compares a speed with an acceleration and stops no grains; its printed"
        " upwinding takes velocities from the wrong side",
        "as_printed: none",
        {"as_printed": "friction", "cells": 40},
        {"as_printed": "none"},
        "stability, printed formulas",
    ),
    Region(
        "creeping",
        lambda point: not point.friction_in_viscosity,
        "without friction in the viscosity grains that friction holds creep for ever, fastest at first order",
        "friction_in_viscosity: true",
        {
            "friction_in_viscosity": False,
            "scene": "pile",
            "scene_options": {"steepness": 0.95},
            "order": 1,
            "cells": 40,
            "t_end": 2,
        },
        {"friction_in_viscosity": True},
        "stability, piles",
    ),
    Region(
        "standing jump",
        _standing_jump,
        "at first order this solver keeps a standing jump where a wave speed passes zero on a dry bed, on any grid",
        "scheme: ifcph, or order: 2",
        {
            "scene": "dam_break",
            "scene_options": {"layer": "water"},
            "a_H": 0,
            "scheme": "ifcp",
            "order": 1,
            "delta": 0,
            "cells": 200,
            "t_end": 0.17,
        },
        {"scheme": "ifcph"},
        "accuracy, dam breaks",
    ),
    Region(
        "stairs",
        lambda point: point.scene == "raster" and scenes.load("raster").has_stairs(point),
        "cells finer than the raster's pixels see these as stairs, whose steps slump and make waves, also where the"
        " slope is at rest",
        "scene_options: method: bilinear, or fewer cells",
        {
            "scene": "raster",
            "scene_options": {"file": "cone.nc"},
            "cells": 240,
            "t_end": 0.3,
            "snapshot_times": [0],
        },
        {"scene_options": {"file": "cone.nc", "method": "bilinear"}},
        "",
    ),
    Region(
        "sliding layers",
        _sliding,
        "above the limit of hyperbolicity finer waves grow faster: answers do not converge as cells shrink",
        "treatment: friction, or stop, or less shear",
        {
            "scene": "shear",
            "scene_options": {"shear": 1.5, "amplitude": 1e-3},
            "boundary": "periodic",
            "delta": 0,
            "cells": 100,
            "t_end": 1.5,
        },
        {"treatment": "friction"},
        "stability, layers that slide",
    ),
)


def regions_of(point: Point) -> list[Region]:
    """Return the regions that a point lies in."""
    return [region for region in REGIONS if region.holds(point)]


def cautions(points: Iterable[Point]) -> list[str]:
    """Return the lines to say of points, one for each region that any lies in, with how many do out of several."""
    points = list(points)
    lines = []
    for region in REGIONS:
        count = sum(map(region.holds, points))
        if count:
            who = f"{count} of {len(points)} runs" if len(points) > 1 else "this run"
            lines.append(
                f"caution, {region.name} ({who}): {region.reason}. Choose {region.advice}."
                " See docs/stability.md."
            )
    return lines
