"""Coulomb friction and the states at rest that it holds (Eq. 3 and Theorem 3.1 of the paper)."""

from subslide.kernels.jit import inlined


def scaled(point):
    """Return no numbers: the friction number is in every run's settings."""
    return ()


@inlined
def head(r, eta, h2):
    """Return r h1 + h2, whose slope drives the grains, in a form that is flat to the bit under a flat surface."""
    return r * eta + (type(r)(1) - r) * h2


@inlined
def holds(reach, bound, speed_squared, push_squared):
    """Return whether friction can stop and then hold grains: within this step, and against the driving force.

    The speed is compared with `reach` = dt (1-r) mu (speeds, not momenta: a dry cell counts as still), the jump |d(r h1
    + h2)| with `bound` = (1-r) mu dx, both as squares. An edge is stuck when this is true of both its cells; a cell is
    stopped when all its edges are stuck, so that fronts that outrun friction never freeze. Without it a first-order
    pile creeps for ever, and at second order single cells keep trembling.

    Deviation from the rest condition under Eq. (8): garbled in print. The length of the gradient is compared with mu,
    under a flat surface |grad h2| <= mu.

    Deviation from Theorem 3.1: printed is a root mean square of a cell's four slopes over |K_i|, an area too many.
    Each edge is judged on its own: the mean let a cone of 0.999 mu move at second order.
    """
    return speed_squared <= reach * reach and push_squared <= bound * bound


@inlined
def coulomb(reach, speed, held):
    """Return the factor that Coulomb friction leaves of a velocity: max(0, 1 - dt g (1-r) mu / |u|).

    Deviation from the friction step under Eq. (6): printed, m/s are compared with m/s2, and the pile never stops.
    """
    real = type(speed)
    moving = speed > reach and held == real(0)
    return real(1) - reach / (speed if moving else real(1)) if moving else real(0)
