"""Cells of unequal sizes whose edges move as known functions of time (see `models.fan`), and what a step takes of them.

Functions of `Motion` take None too, for cells of one size at rest: then they are compiled to nothing.
"""

import numpy as np

from subslide.kernels.arrays import GHOSTS
from subslide.kernels.jit import inlined, part
from subslide.kernels.waves import grain_speeds


@inlined
def past(drift, k, u):
    """Return a velocity as edge k sees it."""
    if drift is None:
        return u
    return u - drift[k]


@inlined
def carried_past(drift, k, m, f):
    """Return the flux of momentum through edge k from the one that moves with it."""
    if drift is None:
        return m
    return m + drift[k] * f


@inlined
def central(motion, i, left, right):
    """Return the slope in padded cell i of the parabola through three means, from its differences to its neighbours."""
    if motion is None:
        return type(left)(0.5) * (left + right)
    return motion.before[i] * left + motion.after[i] * right


@inlined
def width_at(motion, i, dx):
    """Return the width of padded cell i."""
    if motion is None:
        return dx
    return motion.width[i]


@inlined
def share_of_width(motion, i, dt, dx):
    """Return a time over the width of padded cell i."""
    if motion is None:
        return dt / dx
    return dt * motion.inverse_width[i]


@inlined
def gap_at(motion, k, dx):
    """Return the distance of the centres beside edge k."""
    if motion is None:
        return dx
    return motion.gap[k]


@inlined
def centre_drift(motion, i, zero):
    """Return the velocity of the centre of padded cell i."""
    if motion is None:
        return zero
    return type(zero)(0.5) * (motion.drift[i - GHOSTS] + motion.drift[i - GHOSTS + 1])


@inlined
def grown(motion, k, h):
    """Return what the depth of cell k becomes in a step by its growth alone."""
    if motion is None:
        return h
    return h + motion.growth[k] * h


@inlined
def gained(motion, k, amount, change):
    """Return what cell k gains per volume in a step: a change, and by its growth a part of the amount that it has.

    Where water is still the two cancel. Added first, they leave its depth alone; one by one each rounds it.
    """
    if motion is None:
        return change
    return motion.growth[k] * amount + change


@inlined
def normal(motion, depth):
    """Return a depth, of cells that move 0 where it is subnormal: there rounding can take more than is left."""
    if motion is None:
        return depth
    real = type(depth)
    return real(0) if abs(depth) < np.finfo(real).tiny else depth


@inlined
def over_width(motion, k, dt, dx):
    """Return what a step does by forces on the sides of cell k, over the difference of their pressures."""
    if motion is None:
        return dt / dx
    return dt * motion.lever[k]


@inlined
def ends(fan, time):
    """Return where the left and the right end of the fan are.

    The right end is slowed down evenly until it stands; the left one goes with the first wave into the column, until
    all cells up to the right end have one mean width.
    """
    t = min(time, fan.braked)
    right = 1.0 + fan.lead + t * (fan.front - 0.5 * fan.brake * t)
    falling = 1.0 - fan.slack - fan.wave * time
    return (max(falling, fan.evenly * right) if time < fan.stop else fan.evenly * right), right


@inlined
def end_speeds(fan, time):
    """Return the velocities of both ends."""
    _, right = ends(fan, time)
    fast = fan.front - fan.brake * time if time < fan.braked else 0.0
    falls = 1.0 - fan.slack - fan.wave * time > fan.evenly * right and time < fan.stop
    return (-fan.wave if falls else fan.evenly * fast), fast


@inlined
def place(mesh, motion):
    """Fill what follows from where the edges are now."""
    real = type(mesh.source[0])
    x, width = motion.edges, motion.width
    half = real(0.5)
    flat = 1.0 - motion.radial
    first, count = part(0, x.shape[0] - 1)
    for m in range(count):
        k = m + first
        size = x[k + 1] - x[k]
        centre = 0.5 * (x[k + 1] + x[k])
        width[k + GHOSTS] = size
        motion.inverse_width[k + GHOSTS] = 1.0 / size
        mesh.source[k + GHOSTS] = -0.5 * motion.radial / centre
        mesh.weight[k + GHOSTS] = motion.turn * size * (flat + motion.radial * centre)
    for g in range(GHOSTS):
        width[g] = width[GHOSTS]
        width[count + GHOSTS + g] = width[count + GHOSTS - 1]
    for m in range(count):
        k = m + first
        size = width[k + GHOSTS]
        left = width[k + GHOSTS - 1] + size
        right = width[k + GHOSTS + 1] + size
        scale = (size + size) / (left * right * (left + right))
        motion.before[k + GHOSTS] = right * right * scale
        motion.after[k + GHOSTS] = left * left * scale
        motion.gap[k] = half * left
    motion.gap[count] = width[count + GHOSTS]


@inlined
def sweep(mesh, motion, fan, now, dt):
    """Fill where the edges will be after a step, and what the step takes of their way."""
    x, ahead = motion.edges, motion.ahead
    left, right = ends(fan, now + dt)
    often = 1.0 / dt
    flat = 1.0 - motion.radial
    first, count = part(0, x.shape[0] - 1)
    for m in range(count):
        k = m + first + 1
        ahead[k] = motion.base[k] + motion.near[k] * left + motion.far[k] * right
        motion.drift[k] = (ahead[k] - x[k]) * often
        mesh.area[k] = flat + motion.radial * 0.5 * (ahead[k] + x[k])
    for m in range(count):
        k = m + first
        centre = 0.5 * (ahead[k + 1] + ahead[k])
        then = (ahead[k + 1] - ahead[k]) * (flat + motion.radial * centre)
        before = (x[k + 1] - x[k]) * (flat + motion.radial * 0.5 * (x[k + 1] + x[k]))
        inverse = 1.0 / then
        mesh.inverse_volume[k] = inverse
        motion.growth[k] = (before - then) * inverse
        motion.lever[k] = (
            flat + motion.radial * 0.25 * (ahead[k + 1] + ahead[k] + x[k + 1] + x[k])
        ) * inverse


@inlined
def arrive(mesh, motion):
    """Put the edges where the step has taken them."""
    first, count = part(0, motion.edges.shape[0])
    for m in range(count):
        motion.edges[m + first] = motion.ahead[m + first]
    place(mesh, motion)


@inlined
def relative_pace(s, c, motion, fan, now):
    """Fill `pace` anew: how fast waves from one edge of a cell near the other, over its width in units of `s.dx`."""
    near, far = end_speeds(fan, now) if now < fan.stop else (0.0, 0.0)
    real = type(s.r)
    left, right = real(near), real(far)
    first, count = part(0, motion.edges.shape[0] - 1)
    for m in range(count):
        k = m + first
        i = k + GHOSTS
        before = motion.near[k] * left + motion.far[k] * right
        after = motion.near[k + 1] * left + motion.far[k + 1] * right
        slow, fast = c.slow_x[i], c.fast_x[i]
        if s.layers == 1:
            slow, fast = grain_speeds(c.h2[i], c.u2[i])
        c.pace[i] = max(fast - after, before - slow) * (s.dx * motion.inverse_width[i])
