"""The C reference and the solver's edge function on the same edges: that they agree, and how fast each is."""

import ctypes
from typing import NamedTuple

import numpy as np
from compiled import CTYPES, library, pointer
from edge_loop import edge_loop

from subslide.kernels.arrays import allocate
from subslide.models.build import build
from subslide.points import Point
from subslide.solver import DRY_DEPTH

PLANE = 400
"""Cells along each side of the plane whose edges are the reference's work."""

TOLERANCE = {"float64": 1e-10, "float32": 1e-4}


class Edges(NamedTuple):
    """What the fluxes of each edge follow from, each (n), scaled; the order is that of reference.c."""

    h1_i: np.ndarray
    u1_i: np.ndarray
    h2_i: np.ndarray
    u2_i: np.ndarray
    h1_j: np.ndarray
    u1_j: np.ndarray
    h2_j: np.ndarray
    u2_j: np.ndarray
    slowest: np.ndarray
    fastest: np.ndarray
    d_eta: np.ndarray
    stuck: np.ndarray


class EdgeFluxes(NamedTuple):
    """The fluxes of each edge, each (n); the order is that of reference.c."""

    f1: np.ndarray
    m1: np.ndarray
    p1: np.ndarray
    f2: np.ndarray
    m2: np.ndarray
    p2: np.ndarray


def edges_between(before, after, stuck, dtype):
    """Return the `Edges` between states (h1, u1, h2, u2), each (n), in arrays spread over the 4 KiB page."""
    edges = allocate(Edges, (len(stuck),), np.dtype(dtype).type)
    for target, values in zip(edges, (*before, *after), strict=False):
        target[:] = values
    root_i = np.sqrt(edges.h1_i + edges.h2_i)
    root_j = np.sqrt(edges.h1_j + edges.h2_j)
    edges.slowest[:] = np.minimum(
        np.minimum(edges.u1_i, edges.u2_i) - root_i, np.minimum(edges.u1_j, edges.u2_j) - root_j
    )
    edges.fastest[:] = np.maximum(
        np.maximum(edges.u1_i, edges.u2_i) + root_i, np.maximum(edges.u1_j, edges.u2_j) + root_j
    )
    edges.d_eta[:] = (edges.h1_j + edges.h2_j) - (edges.h1_i + edges.h2_i)
    edges.stuck[:] = stuck
    return edges


def random_edges(n, dtype, seed=0):
    """Return `Edges` of random states: a quarter of the sides dry, a third of the edges stuck, fast and slow flow."""
    rng = np.random.default_rng(seed)

    def side():
        h1, h2 = rng.uniform(0.01, 2.0, (2, n))
        h1[rng.random(n) < 0.05] = 0.0
        h2[rng.random(n) < 0.2] = 0.0
        u1, u2 = rng.normal(0.0, 0.7, (2, n))
        return h1, u1, h2, u2

    return edges_between(side(), side(), rng.random(n) < 1 / 3, dtype)


def plane_edges(dtype, cells=PLANE):
    """Return the `Edges` of a plane of cells x cells, about two a cell, in a made-up state within a collapse."""
    x = (np.arange(cells) + 0.5) / cells * 8.5 - 4.25
    distance = np.hypot(x[:, None], x[None, :])
    h2 = np.maximum(0.0, 0.6 - 0.2 * distance**2)
    h1 = 2.0 - h2 + 0.05 * np.cos(4.0 * distance) * np.exp(-(distance**2) / 8)
    unit = x[None, :] / distance
    u1, u2 = -0.1 * unit * np.exp(-distance), np.where(h2 > 0, 0.3 * unit * distance, 0.0)
    u2[distance < 0.5] = 0.0
    state = (h1, u1, h2, u2)

    def pairs(first, last):
        """Return the states before (or after) each edge along x, then along y: the same by symmetry."""
        along_x = [values[:, first:last].ravel() for values in state]
        return [np.concatenate([values, values]) for values in along_x]

    before, after = pairs(0, cells - 1), pairs(1, cells)
    return edges_between(before, after, (before[3] == 0) & (after[3] == 0), dtype)


def fluxes_like(edges):
    """Return `EdgeFluxes` for these edges, to be filled."""
    return allocate(EdgeFluxes, edges.stuck.shape, edges.stuck.dtype.type)


def settings_of(edges):
    """Return the scaled numbers of the paper's column in the precision of the edges."""
    return build(Point(model="radial", dtype=edges.stuck.dtype.name), 100, DRY_DEPTH).settings


def c_reference(edges, out):
    """Return a function that fills `out` by the C reference."""
    settings = settings_of(edges)
    dtype = edges.stuck.dtype.name
    real, address = CTYPES[dtype], ctypes.POINTER(CTYPES[dtype])
    function = library("reference.c", dtype).edge_fluxes
    function.argtypes = [
        ctypes.c_long,
        real,
        real,
        ctypes.c_int,
        ctypes.POINTER(address),
        ctypes.POINTER(address),
    ]
    function.restype = None
    inputs = (address * len(edges))(*(pointer(array, dtype) for array in edges))
    outputs = (address * len(out))(*(pointer(array, dtype) for array in out))

    def fill(edges=edges, out=out):  # holds the arrays
        function(len(edges.stuck), settings.r, settings.dry_depth, settings.exact_front, inputs, outputs)

    return fill


def numba_reference(edges, out):
    """Return a function that fills `out` by the solver's edge function."""
    settings = settings_of(edges)
    return lambda: edge_loop(settings, edges, out)


def disagreement(dtype, n=20_000, seed=0):
    """Return the largest difference of a flux between C and numba on random edges, over the edge's largest flux."""
    edges = random_edges(n, dtype, seed)
    ours, theirs = fluxes_like(edges), fluxes_like(edges)
    for array in (*ours, *theirs):
        array[:] = np.nan
    numba_reference(edges, ours)()
    c_reference(edges, theirs)()
    ours, theirs = np.array(ours, np.float64), np.array(theirs, np.float64)
    scale = np.abs(ours).max(axis=0)
    return float((np.abs(ours - theirs).max(axis=0) / np.where(scale > 0, scale, 1)).max())


def check(dtypes=tuple(TOLERANCE)):
    """Nothing; ValueError where the C reference does not compute what the solver computes."""
    for dtype in dtypes:
        tolerance = TOLERANCE[dtype]
        error = disagreement(dtype)
        if not error <= tolerance:
            raise ValueError(
                f"reference.c and edge_fluxes differ by {error:.1e} of the flux in {dtype}, more than {tolerance:.0e}: "
                "the kernels have changed, so must reference.c"
            )
