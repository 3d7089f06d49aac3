"""Models built from arrays, for states that no scene makes."""

import math

import numpy as np

from subslide.kernels import clock as k
from subslide.kernels import samples, viscosity
from subslide.kernels.arrays import GeneralSettings, Settings, Track
from subslide.keys.names import SPEEDS, flags
from subslide.models.axial import Axial
from subslide.models.plane import Plane
from subslide.scenes import Grid

THRESHOLDS = (0.01, 0.03, 0.05)


def settings(
    dx,
    layers=2,
    scheme="ifcph",
    order=1,
    r=0.4,
    m=1.0,
    cfl=0.9,
    exact_front=True,
    speeds="exact",
    **law,
):
    """Return the settings of a run in double precision; `law` holds those that lean kernels leave out."""
    real = np.float64
    lean = Settings(
        layers=layers,
        scheme=viscosity.FLAGS[scheme],
        order=order,
        r=real(r),
        m=real(m),
        dx=real(dx),
        cfl=real(cfl),
        dry_depth=real(1e-6),
        exact_front=int(exact_front),
        lanes=8,
        speeds=flags(SPEEDS)[speeds],
    )
    lean = lean._replace(**law)
    return GeneralSettings(*lean, general=1) if scheme == "roe" or speeds != "exact" or law else lean


def axial(edges, h1, u1, h2, u2, *, level, radial=False, walls=(True, True), **options):
    """Model of one dimension on cells between `edges`."""
    dx = edges[1] - edges[0]
    state = tuple(
        np.broadcast_to(np.asarray(values, float), (len(edges) - 1,)) for values in (h1, u1, h2, u2)
    )
    grid = Grid("radius" if radial else "line", dx, edges)
    return Axial("test", settings(dx, **options), state, grid, walls=walls, level=level, watched=len(edges))


def plane(edges, h1, h2, *, level, u1=0.0, v1=0.0, u2=0.0, v2=0.0, walls=(True,) * 4, **options):
    """Model of the plane on square cells between `edges` on both axes."""
    dx = edges[1] - edges[0]
    shape = (len(edges) - 1,) * 2
    state = tuple(np.broadcast_to(np.asarray(values, float), shape) for values in (h1, u1, v1, h2, u2, v2))
    grid = Grid("test", dx, edges)
    return Plane("test", settings(dx, **options), state, grid, walls=walls, level=level, watched=len(edges))


def advance(model, stop=math.inf, steps=None, thresholds=THRESHOLDS):
    """Samples of the time loop up to the scaled time `stop`, or of `steps` steps."""
    clock = k.started(stop if math.isfinite(stop) else 1e9)
    chunks = []
    while True:
        size = 513 if steps is None else steps + 1
        track = Track(clock, np.empty((size, samples.COLUMNS)), np.zeros(2, np.int64))
        model.advance(thresholds, track)
        chunks.append(track.samples[: track.counters[k.SAMPLES]])
        if track.counters[k.OUTCOME] != k.FULL or steps is not None:
            return np.concatenate(chunks), int(track.counters[k.OUTCOME])


def inner(model, name):
    """Return an array of the state without its ghost cells; `model` may be its `CellTerms`."""
    array = getattr(getattr(model, "cells", model), name)
    return array[(slice(2, -2),) * array.ndim]
