"""Turbulent friction: the second term of Voellmy's law (Voellmy 1955), as McDougall and Hungr (2004) use it.

The bed resists with the stress rho_s g |u|^2 / xi beside Coulomb's, so that d|u|/dt = -g |u|^2 / (xi h2).
"""

from subslide.kernels.jit import inlined


def scaled(point):
    """Return g / (xi a_2), the turbulence in scaled variables."""
    return (point.turbulence,)


@inlined
def remaining(s, dt, h2, speed):
    """Return the factor that turbulent friction leaves of a velocity: 1 / (1 + dt g |u| / (xi h2)), exact alone."""
    real = type(speed)
    drag = dt * s.law_1 * speed
    total = h2 + drag
    return h2 / total if total > real(0) else real(1)
