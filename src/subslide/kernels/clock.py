"""Time: the next step, and why a loop of steps ended."""

from subslide.kernels.jit import inlined

RUNNING, REACHED, AT_REST, FRONT_AT_EDGE, NOT_FINITE, NEGATIVE, COLLAPSED, FULL, SHEARED, NO_ROOM = range(10)

# Indices into the float64 array `clock`.
NOW, STOP, REST_FROM, REST_SINCE = range(4)

# Indices into the int64 array `counters`.
SAMPLES, OUTCOME = range(2)

SMALLEST_STEP = 1e-6
"""In units of dx / sqrt(g H2): no wave of a run that can finish is a million times faster than sqrt(g H2)."""


@inlined
def next_step(now, stop, stable):
    """Return the step to take: `stable`, less when `stop` is near, so that no step before it is tiny."""
    left = stop - now
    if left <= stable:
        return left
    return min(stable, 0.5 * left) if left < 2.0 * stable else stable


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
