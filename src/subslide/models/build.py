"""From a point to a model ready to run."""

import math

import numpy as np

from subslide import scenes
from subslide.kernels import boundary, friction, hyperbolicity, printed, viscosity
from subslide.kernels.arrays import GeneralSettings, Settings
from subslide.keys import names
from subslide.models.axial import Axial
from subslide.models.fitted import Fitted, mesh_of
from subslide.models.grid import make_grid
from subslide.models.limits import LARGEST_BOX
from subslide.models.model import Model
from subslide.models.plane import Plane
from subslide.points import Point
from subslide.scenes import Grid
from subslide.study import choice


def settings_of(point: Point, layers: int, dx: float, dry_depth: float) -> Settings:
    """Return the scaled numbers and choices of a point in its working precision, `GeneralSettings` where it needs them.

    Parameters
    ----------
    point
        The run.
    layers
        1 for grains alone.
    dx, dry_depth
        Cell size over R; depth over H2 below which a layer counts as dry.

    Returns
    -------
    Settings
        Reals of the point's dtype, flags and counts integers.
    """
    real = np.dtype(point.dtype).type
    mu = math.tan(math.radians(point.delta))
    law_1, law_2, law_3 = (real(number) for number in friction.numbers(point))
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
        law_1=law_1,
        law_2=law_2,
        law_3=law_3,
        treatment=hyperbolicity.FLAGS[point.treatment],
        as_printed=printed.FLAGS[point.as_printed],
        printed_bound=real((1 - point.r) * mu * math.sqrt(point.g / point.column_height)),
        viscous_friction=int(point.friction_in_viscosity),
    )
    return GeneralSettings(*settings, general=1) if choice.of(point).general else settings


def build(point: Point, box: int, dry_depth: float) -> Model:
    """Return the model of a point in its initial state.

    Parameters
    ----------
    point
        The run; how it is solved follows from it (`study.choice`).
    box
        Cells from the axis to the end of the box; on the open sea of a line or radius to that of the first arrays, or
        of more, where there are grains at their end.
    dry_depth
        Depth over H2 below which a layer counts as dry.

    Returns
    -------
    Model
        An `Axial`, a `Fitted` or a `Plane`.
    """
    if choice.is_fitted(point):
        return build_fitted(point, dry_depth)
    real = np.dtype(point.dtype).type
    model, geometry, *_ = choice.of(point)
    dx = point.scaled_dx
    watched = point.cells / 2
    grid = make_grid(geometry, dx, box)
    state = scenes.load(point.scene).initial(grid, point)
    while choice.at_sea(point) and state.h2[-1] > 0 and box < LARGEST_BOX * watched:
        box = min(2 * box, round(LARGEST_BOX * watched))
        grid = make_grid(geometry, dx, box)
        state = scenes.load(point.scene).initial(grid, point)
    alone = model == "one-layer"
    settings = settings_of(point, 1 if alone else 2, dx, dry_depth)
    level = real(point.scaled_level)
    axial = grid.geometry in ("radius", "line")
    end = boundary.FLAGS[point.boundary]
    surface = real(1) if alone else level
    total = np.asarray(state.h1 + state.h2)
    flat = (total == total.flat[0]).all()
    shape = (len(grid.edges) - 1,) * (1 if axial else 2)
    h1, h2 = (_spread(values, shape, real) for values in state[:2])
    if flat:  # flat to the bit in the working precision too
        h1, h2 = scenes.level_off(h2, level)
    if axial:
        walls = (boundary.WALL if grid.geometry == "radius" else end, end)
        line = (0 * h1 if alone else h1, state.u1, h2, state.u2)
        return Axial(model, settings, line, grid, walls=walls, level=surface, watched=watched)
    u1, v1, u2, v2 = (_spread(values, shape, real) for values in state[2:])
    first = boundary.WALL if grid.geometry == "quarter" else end
    plane = (h1, u1, v1, h2, u2, v2)
    return Plane(model, settings, plane, grid, walls=(first, end, first, end), level=surface, watched=watched)


def build_fitted(point: Point, dry_depth: float) -> Fitted:
    """Return the model of a column on a fitted grid in its initial state.

    Parameters
    ----------
    point
        The run.
    dry_depth
        Depth over H2 below which a layer counts as dry.

    Returns
    -------
    Fitted
        The column at rest.
    """
    real = np.dtype(point.dtype).type
    model, geometry, *_ = choice.of(point)
    mesh, motion, fan = mesh_of(point, geometry == "radius")
    smallest = float((motion.edges[1:] - motion.edges[:-1]).min())
    state = scenes.load(point.scene).initial(Grid(geometry, smallest, motion.edges), point)
    alone = model == "one-layer"
    level = real(point.scaled_level)
    h1, h2 = scenes.level_off(state.h2.astype(real), level)
    settings = settings_of(point, 1 if alone else 2, smallest, dry_depth)
    line = (0 * h1 if alone else h1, 0.0, h2, 0.0)
    return Fitted(model, settings, line, mesh, motion, fan, level=real(1) if alone else level)


def _spread(values: np.ndarray | float, shape: tuple[int, ...], real: type[float]) -> np.ndarray:
    """Return values in a precision, one for each cell of a grid."""
    values = np.asarray(values, real)
    return values if values.shape == shape else np.broadcast_to(values, shape)
