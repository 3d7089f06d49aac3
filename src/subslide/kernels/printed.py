"""Formulas of the paper taken literally, beside what is used in their place: to see what they do."""

from subslide.kernels.arrays import is_general
from subslide.kernels.friction.coulomb import coulomb
from subslide.kernels.jit import inlined
from subslide.kernels.positivity import donor
from subslide.kernels.velocity import velocity
from subslide.keys.names import AS_PRINTED, flags

FLAGS = flags(AS_PRINTED)
STEP, UPWINDING = FLAGS["friction"], FLAGS["upwinding"]


@inlined
def braking(s, reach, speed, held):
    """Return the factor that Coulomb friction leaves of a velocity: `coulomb`, or the friction step as printed.

    In print u* = u - dt g (1-r) mu u / |u| is kept if |u*| <= g (1-r) mu, else grains stop: m/s are compared with
    m/s2, `printed_bound` being that number over sqrt(g H2) in m/s. Slow grains are turned round, and never rest.
    """
    real = type(speed)
    if is_general(s) and s.as_printed == STEP:
        factor = real(1) - reach / (speed if speed > real(0) else real(1))
        return factor if abs(speed - reach) <= s.printed_bound and speed > real(0) else real(0)
    return coulomb(reach, speed, held)


@inlined
def carried(s, flux, h_i, v_i, h_j, v_j):
    """Return the tangential velocity that a mass flux carries: that of its `donor`, or that of Eq. (13) as printed.

    In print a flux out of K_i carries the momentum of K_j, over h_{2,i} in the second layer, and one into it that of
    K_i. For the first layer, whose divisor is right, h_i is h_j.
    """
    if is_general(s) and s.as_printed == UPWINDING:
        return donor(flux, velocity(h_j * v_j, h_i, s.dry_depth), v_i)
    return donor(flux, v_i, v_j)
