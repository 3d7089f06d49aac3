"""Time: the next step, and why a loop of steps ended."""

import math

import numpy as np

from subslide.kernels.jit import inlined
from subslide.keys.names import SCHEMES, flags

RUNNING, REACHED, AT_REST, FRONT_AT_EDGE, NOT_FINITE, NEGATIVE, COLLAPSED, FULL, SHEARED, NO_ROOM = range(10)

# Indices into the float64 array `clock`.
NOW, STOP, REST_FROM, REST_SINCE, AHEAD, UNMEASURED, LATER = range(7)
"""From LATER on: stops to which a loop may go on from STOP, which then is the last that it has come to, in order."""

# Indices into the int64 array `counters`.
SAMPLES, OUTCOME = range(2)

IFCP = flags(SCHEMES)["ifcp"]

SMALLEST_STEP = 1e-6
"""In units of dx / sqrt(g H2): no wave of a run that can finish is a million times faster than sqrt(g H2)."""


def started(stop=0.0, later=()):
    """Return the `clock` of a run that starts now and does not end at rest."""
    return np.array([0.0, stop, math.inf, -1.0, 0.0, 0.0, *later])


@inlined
def goes_on(clock, counters):
    """Return whether a loop has come to its stop and another is left, which then is its stop.

    A launch for each takes as long as ten steps. The loop begins as if launched anew, so no bits tell the difference.
    """
    if counters[OUTCOME] == REACHED:
        for n in range(LATER, clock.shape[0]):
            if clock[n] > clock[STOP]:
                clock[STOP] = clock[n]
                return True
    return False


@inlined
def friction_is_even(s, clock):
    """Return whether friction has acted as long as transport, at second order: so it is to be put ahead."""
    return s.order != 1 and clock[AHEAD] == 0.0


@inlined
def ahead(clock, step):
    """Return half a step, by which friction is from now on ahead of transport, and note it.

    Transport of second order in a step needs velocities of its middle (Strang 1968).
    """
    clock[AHEAD] = 0.5 * step
    return clock[AHEAD]


@inlined
def friction_time(s, clock, step):
    """Return for how long friction acts at the end of a step: until it is ahead by half a step, or even at STOP."""
    if s.order == 1:
        return step
    wanted = 0.0 if clock[NOW] + step >= clock[STOP] else 0.5 * step
    acts = max(0.0, step + wanted - clock[AHEAD])
    clock[AHEAD] += acts - step
    if wanted == 0.0:
        clock[AHEAD] = 0.0
    return acts


@inlined
def next_step(now, stop, stable):
    """Return the step to take: `stable`, less when `stop` is near, so that no step before it is tiny."""
    left = stop - now
    if left <= stable:
        return left
    return min(stable, 0.5 * left) if left < 2.0 * stable else stable


@inlined
def starting_pace(s, clock, film, pace):
    """Return the pace of waves, at the start under a film no less than that of a front of depth H2.

    Cells at rest do not know that speed, 2 sqrt(g (1-r) H2): a first step as long as theirs takes the front beyond the
    next cell, and the second gives back up to 1.1 % of the energy that can be released. HLL spreads fronts as fast as
    the water's waves, and needs no less.
    """
    real = type(pace)
    front = real(2) * math.sqrt(real(1) - s.r)
    quick = s.exact_front or s.scheme == IFCP
    starts = film and quick and s.layers == 2 and clock[NOW] == 0.0
    return max(pace, front) if starts else pace


@inlined
def stable_step(s, pace, left):
    """Return the largest stable step of waves of a pace, or the time that is left where nothing moves."""
    real = type(pace)
    return s.cfl * s.dx / pace if pace > real(0) else real(left)


@inlined
def after(now, step, dt, stop):
    """Return the time after a step, which is `dt` in the working precision; exactly `stop` if the step ends there."""
    return stop if now + step >= stop else now + dt


@inlined
def outcome(clock, finite, shallowest, fastest_grain, at_edge, full):
    """Return why the loop ends now, or RUNNING; keeps REST_SINCE, the time since which no grain has moved."""
    if not finite:
        return NOT_FINITE
    if shallowest < 0.0:
        return NEGATIVE
    if fastest_grain > 0.0:
        clock[REST_SINCE] = -1.0
    elif clock[REST_SINCE] < 0.0:
        clock[REST_SINCE] = clock[NOW]
    if at_edge:
        return FRONT_AT_EDGE
    if fastest_grain == 0.0 and clock[NOW] >= clock[REST_FROM]:
        return AT_REST
    if clock[NOW] >= clock[STOP]:
        return REACHED
    return FULL if full else RUNNING
