"""From a point to a model ready to run."""

import math

import numpy as np

from subslide import scenes
from subslide.kernels.arrays import GeneralScene, Scene
from subslide.kernels.boundary import BOUNDARIES, WALL
from subslide.kernels.friction import LAWS
from subslide.kernels.hyperbolicity import TREATMENTS
from subslide.kernels.printed import AS_PRINTED
from subslide.kernels.viscosity import SCHEMES
from subslide.kernels.waves import SPEEDS
from subslide.models.axial import Axial
from subslide.models.grid import make_grid
from subslide.models.plane import Plane
from subslide.points import Point
from subslide.study import choice


def scaled(point: Point, layers: int, dx: float, dry_depth: float) -> Scene | GeneralScene:
    """Return the scaled numbers of a point (`kernels.arrays.Scene`) in its working precision."""
    real = np.dtype(point.dtype).type
    mu = math.tan(math.radians(point.delta))
    scene = Scene(
        layers=layers,
        scheme=SCHEMES[point.scheme],
        order=point.order,
        r=real(point.r),
        friction=real(point.friction_number),
        dx=real(dx),
        cfl=real(point.cfl),
        dry_depth=real(dry_depth),
        exact_front=int(point.front_flux == "exact" and point.scheme in ("ifcph", "roe")),
        lanes=64 // real().itemsize,
        speeds=SPEEDS[point.wave_speeds],
        law=LAWS[point.friction],
        turbulence=real(point.turbulence),
        friction_rise=real((math.tan(math.radians(point.delta_2)) - mu) / point.a_2),
        depths=real(point.column_height / point.pouliquen_length),
        treatment=TREATMENTS[point.treatment],
        as_printed=AS_PRINTED[point.as_printed],
        printed_bound=real((1 - point.r) * mu * math.sqrt(point.g / point.column_height)),
        viscous_friction=int(point.friction_in_viscosity),
    )
    return GeneralScene(*scene, general=1) if choice.of(point).general else scene


def build(point: Point, box: int, watched: int, dry_depth: float) -> Axial | Plane:
    """Return the model of a point in its initial state.

    Parameters
    ----------
    point
        The run; how it is solved follows from it (`study.choice`).
    box, watched
        Cells from the axis to the end of the box, and of the region where the surface is watched.
    dry_depth
        Depth over H2 below which a layer counts as dry.
    """
    real = np.dtype(point.dtype).type
    model, geometry, *_ = choice.of(point)
    dx = point.scaled_dx
    grid = make_grid(geometry, dx, box)
    state = scenes.load(point.scene).initial(grid, point)
    alone = model == "one-layer"
    scene = scaled(point, 1 if alone else 2, dx, dry_depth)
    level = real(point.scaled_level)
    axial = grid.geometry in ("radius", "line")
    shape = (len(grid.centres),) * (1 if axial else 2)
    flat = np.ptp(state.h1 + state.h2) == 0
    state = scenes.State(*(np.broadcast_to(np.asarray(values, real), shape) for values in state))
    if flat:  # flat to the bit in the working precision too
        h1, h2 = scenes.level_off(state.h2, level)
        state = state._replace(h1=h1, h2=h2)
    end = BOUNDARIES[point.boundary]
    if axial:
        round_scene = grid.geometry == "radius"
        return Axial(
            model,
            scene,
            (0 * state.h1 if alone else state.h1, state.u1, state.h2, state.u2),
            grid,
            radial=round_scene,
            walls=(WALL if round_scene else end, end),
            level=real(1) if alone else level,
            watched=watched,
        )
    first = WALL if grid.geometry == "quarter" else end
    return Plane(
        model,
        scene,
        (state.h1, state.u1, state.v1, state.h2, state.u2, state.v2),
        grid,
        walls=(first, end, first, end),
        level=level,
        watched=watched,
    )
