"""The arrays that kernels work on. All are padded by GHOSTS cells on each side and scaled: depths by H2, lengths by R,
speeds by sqrt(g H2), time by R / sqrt(g H2), so that g = 1 and every threshold is a plain number.
Deviation from section 4 of the paper, which scales both layers by H1.
"""

from typing import NamedTuple

import numpy as np

from subslide.kernels.jit import inlined

GHOSTS = 2
"""The slope in the first ghost cell needs the second."""


class Scene(NamedTuple):
    """Scaled numbers of a run, all of the working precision (flags and counts are integers).

    The kernels compiled for it are lean: they leave out what the fields from `speeds` on choose.
    """

    layers: int
    scheme: int
    order: int
    r: float
    friction: float  # tan(delta) R / H2
    dx: float
    cfl: float
    dry_depth: float
    exact_front: int  # 1: grains run onto a dry bed with the exact flux of grains alone
    lanes: int  # numbers in 64 bytes: a vector
    speeds: int = 0  # see `waves.SPEEDS`
    law: int = 0  # see `friction.LAWS`
    turbulence: float = 0.0  # g / (xi a_2)
    friction_rise: float = 0.0  # (tan(delta_2) - tan(delta)) R / H2
    depths: float = 0.0  # H2 / pouliquen_length
    treatment: int = 0  # see `interlayer.TREATMENTS`
    as_printed: int = 0  # see `printed.AS_PRINTED`
    printed_bound: float = 0.0  # (1-r) tan(delta) g / sqrt(g H2), numbers in SI units: see `printed.braking`
    viscous_friction: int = 1  # 0: the viscosity does not see what friction holds


GeneralScene = NamedTuple("GeneralScene", [*Scene.__annotations__.items(), ("general", int)])
"""A Scene for which kernels with every choice are compiled; see `is_general`."""


@inlined
def is_general(s):
    """Return whether the kernels are compiled with every choice, known by the type so that lean ones drop the rest."""
    return len(s) > LEAN_FIELDS


LEAN_FIELDS = len(Scene._fields)


class Cells(NamedTuple):
    """State of each cell (velocities, not momenta) and what a step derives from it first."""

    h1: np.ndarray
    u1: np.ndarray
    v1: np.ndarray
    h2: np.ndarray
    u2: np.ndarray
    v2: np.ndarray
    eta: np.ndarray  # h1 + h2
    head2: np.ndarray  # r h1 + h2, whose slope drives the grains
    square2: np.ndarray  # |u2|^2
    slow_x: np.ndarray
    fast_x: np.ndarray
    slow_y: np.ndarray
    fast_y: np.ndarray
    pace: np.ndarray  # fastest wave along x plus fastest along y
    ratio: np.ndarray  # scratch of `row_hyperbolicity`


class Side(NamedTuple):
    """State at one side of an edge."""

    eta: np.ndarray
    h1: np.ndarray
    u1: np.ndarray
    v1: np.ndarray
    h2: np.ndarray
    u2: np.ndarray
    v2: np.ndarray


class Fluxes(NamedTuple):
    """Through each edge: mass, normal momentum, tangential momentum and pressure product of both layers."""

    f1: np.ndarray
    m1: np.ndarray
    t1: np.ndarray
    p1: np.ndarray
    f2: np.ndarray
    m2: np.ndarray
    t2: np.ndarray
    p2: np.ndarray
    stuck: np.ndarray  # 1 where friction holds the grains on both sides at rest, else 0


class Marks(NamedTuple):
    """What a cell's neighbours decide before it may be updated."""

    keep1: np.ndarray  # fraction of the mass flux out of the cell that its water can feed
    keep2: np.ndarray  # the same for grains
    held: np.ndarray  # 1 where friction stops the grains in this step, else 0
    inner_p1x: np.ndarray  # pressure products across the cell (0 at first order)
    inner_p2x: np.ndarray
    inner_p1y: np.ndarray
    inner_p2y: np.ndarray


def allocate(kind, shape, dtype):
    """Return `kind` with one zeroed array of `shape` each, their addresses spread over the 4 KiB page.

    Arrays that share their offset modulo 4 KiB evict each other: half the speed.
    """
    arrays = []
    size = int(np.prod(shape))
    itemsize = np.dtype(dtype).itemsize
    for k in range(len(kind._fields)):
        shift = (k * 5 % 31) * 128 // itemsize
        buffer = np.zeros(size + shift, dtype=dtype)
        arrays.append(buffer[shift:].reshape(shape))
    return kind(*arrays)
