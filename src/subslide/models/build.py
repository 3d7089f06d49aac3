"""From a point to a model ready to run."""

import math

import numpy as np

from subslide import scenes
from subslide.kernels import boundary, friction, hyperbolicity, printed, viscosity
from subslide.kernels.arrays import GeneralSettings, Settings
from subslide.keys import names
from subslide.models.axial import Axial
from subslide.models.grid import make_grid
from subslide.models.plane import Plane
from subslide.points import Point
from subslide.study import choice


def settings_of(point: Point, layers: int, dx: float, dry_depth: float) -> Settings | GeneralSettings:
    """Return the scaled numbers and choices of a point in its working precision.

    Parameters
    ----------
    point
        The run.
    layers
        1 for grains alone.
    dx, dry_depth
        Cell size over R; depth over H2 below which a layer counts as dry.
    """
    real = np.dtype(point.dtype).type
    mu = math.tan(math.radians(point.delta))
    law = (real(number) for number in friction.numbers(point))
    exact = point.front_flux == "exact" and viscosity.takes_exact_front(point.scheme)
    settings = Settings(
        layers=layers,
        scheme=viscosity.FLAGS[point.scheme],
        order=point.order,
        r=real(point.r),
        m=real(point.friction_number),
        dx=real(dx),
        cfl=real(point.cfl),
        dry_depth=real(dry_depth),
        exact_front=int(exact),
        lanes=64 // real().itemsize,
        speeds=names.flags(names.SPEEDS)[point.wave_speeds],
        law=friction.FLAGS[point.friction],
        **dict(zip(("law_1", "law_2", "law_3"), law, strict=True)),
        treatment=hyperbolicity.FLAGS[point.treatment],
        as_printed=printed.FLAGS[point.as_printed],
        printed_bound=real((1 - point.r) * mu * math.sqrt(point.g / point.column_height)),
        viscous_friction=int(point.friction_in_viscosity),
    )
    return GeneralSettings(*settings, general=1) if choice.of(point).general else settings


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
    settings = settings_of(point, 1 if alone else 2, dx, dry_depth)
    level = real(point.scaled_level)
    axial = grid.geometry in ("radius", "line")
    shape = (len(grid.centres),) * (1 if axial else 2)
    flat = np.ptp(state.h1 + state.h2) == 0
    state = scenes.State(*(np.broadcast_to(np.asarray(values, real), shape) for values in state))
    if flat:  # flat to the bit in the working precision too
        h1, h2 = scenes.level_off(state.h2, level)
        state = state._replace(h1=h1, h2=h2)
    end = boundary.FLAGS[point.boundary]
    watch = {"level": real(1) if alone else level, "watched": watched}
    if axial:
        walls = (boundary.WALL if grid.geometry == "radius" else end, end)
        layers = (0 * state.h1 if alone else state.h1, state.u1, state.h2, state.u2)
        return Axial(model, settings, layers, grid, walls=walls, **watch)
    first = boundary.WALL if grid.geometry == "quarter" else end
    layers = (state.h1, state.u1, state.v1, state.h2, state.u2, state.v2)
    return Plane(model, settings, layers, grid, walls=(first, end, first, end), **watch)
