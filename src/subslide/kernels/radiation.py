"""The open edge of the plane: waves leave it as round waves about the axis do.

On water of depth H at rest a round wave that goes out has, to first order in its height e, the speed u = 2 (c -
sqrt(H)) + J at a radius x, with c = sqrt(h) and dJ/dt = e / (2 x). Along the normal of an edge that has the cosine n
to the radius that is u_n = 2 n (c - sqrt(H)) + K, dK/dt = n e / (2 x), with a K for each edge cell. The other condition
on the ghosts is what comes from within, u_n + 2 c, by the parabola through the last three cells. Still water stays so
to the bit. Grains, and speeds along the edge, have no gradient.
"""

import math

from subslide.kernels.arrays import GHOSTS
from subslide.kernels.boundary import OPEN, WALL
from subslide.kernels.jit import inlined

COSINE, DECAY = 4, 5
"""Rows of `rim` beside the K of (left, right, bottom, top): n and n / (2 x), by padded place along an edge."""


@inlined
def beyond(last, before, third, g):
    """Return the value g cells beyond `last` on the parabola through it and the two cells before it."""
    steps = type(last)(g)
    slope = last - before
    return last + steps * slope + type(last)(g * (g + 1) // 2) * (slope - (before - third))


@inlined
def outgoing(surface, u, level, cosine, kept):
    """Return the surface and the outward speed of the ghost that hears `surface` and `u` from within."""
    real = type(level)
    still = math.sqrt(level)
    above = max(real(0), surface)
    rise = (above - level) / (math.sqrt(above) + still)  # of c, exact at rest
    change = max(-still, (u + (rise + rise) - kept) / (real(2) * (real(1) + cosine)))
    return max(real(0), level + change * (still + still + change)), real(2) * cosine * change + kept


@inlined
def ghosts_of_line(h1, u1, h2, first, step, level, cosine, kept):
    """Set the ghosts of a row or column beyond its cell `first`, towards `step`, whose grains are set."""
    a, b, c = first, first - step, first - 2 * step
    for g in range(1, GHOSTS + 1):
        surface = beyond(h1[a] + h2[a], h1[b] + h2[b], h1[c] + h2[c], g)
        speed = step * beyond(u1[a], u1[b], u1[c], g)
        surface, speed = outgoing(surface, speed, level, cosine, kept)
        h1[a + g * step] = max(type(level)(0), surface - h2[a])
        u1[a + g * step] = step * speed


@inlined
def ghosts_of_corner(values, j, step_j, i, step_i):
    """Set the ghosts beyond the corner (j, i), bilinear in its cell and the ghosts beside it."""
    for y in range(1, GHOSTS + 1):
        for x in range(1, GHOSTS + 1):
            b, a = j + y * step_j, i + x * step_i
            values[b, a] = values[b, i] + values[j, a] - values[j, i]


@inlined
def radiate(c, walls, rim, level):
    """Set depths and normal speeds of the water in the ghosts beyond open edges; all ghosts hold copies before."""
    ny, nx = c.h1.shape
    for side in range(2):
        i, step = (GHOSTS, -1) if side == 0 else (nx - GHOSTS - 1, 1)
        if walls[side] == OPEN:
            for j in range(0 if walls[2] == WALL else GHOSTS, ny - GHOSTS):
                ghosts_of_line(c.h1[j], c.u1[j], c.h2[j], i, step, level, rim[COSINE, j], rim[side, j])
    for side in range(2, 4):
        j, step = (GHOSTS, -1) if side == 2 else (ny - GHOSTS - 1, 1)
        if walls[side] == OPEN:
            for i in range(0 if walls[0] == WALL else GHOSTS, nx - GHOSTS):
                ghosts_of_line(
                    c.h1[:, i], c.v1[:, i], c.h2[:, i], j, step, level, rim[COSINE, i], rim[side, i]
                )
            for across in range(2):
                i, step_i = (GHOSTS, -1) if across == 0 else (nx - GHOSTS - 1, 1)
                if walls[across] == OPEN:
                    ghosts_of_corner(c.h1, j, step, i, step_i)
                    ghosts_of_corner(c.u1, j, step, i, step_i)
                    ghosts_of_corner(c.v1, j, step, i, step_i)


@inlined
def decay(c, walls, rim, level, dt):
    """Advance K by the ghosts of the step that was taken."""
    ny, nx = c.h1.shape
    for side in range(2):
        i = GHOSTS - 1 if side == 0 else nx - GHOSTS
        if walls[side] == OPEN:
            for j in range(ny):
                rim[side, j] += dt * rim[DECAY, j] * (c.h1[j, i] + c.h2[j, i] - level)
    for side in range(2, 4):
        j = GHOSTS - 1 if side == 2 else ny - GHOSTS
        if walls[side] == OPEN:
            for i in range(nx):
                rim[side, i] += dt * rim[DECAY, i] * (c.h1[j, i] + c.h2[j, i] - level)
