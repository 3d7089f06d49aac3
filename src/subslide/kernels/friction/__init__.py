"""Friction of the grains on the bed: Coulomb's law, which every cell obeys, and what other laws add to it.

One law a file; to add one, name it in LAWS and give it a branch in `further`.
"""

from subslide.kernels.friction.pouliquen import pouliquen
from subslide.kernels.friction.voellmy import voellmy
from subslide.kernels.jit import inlined

LAWS = {"coulomb": 0, "voellmy": 1, "pouliquen": 2}
COULOMB, VOELLMY, POULIQUEN = LAWS.values()


@inlined
def further(s, dt, h2, speed):
    """Return the factor that the law's friction beyond Coulomb's leaves of a velocity in the time dt."""
    if s.law == VOELLMY:
        return voellmy(dt, s.turbulence, h2, speed)
    return pouliquen(dt * (type(s.r)(1) - s.r) * s.friction_rise, s.depths, h2, speed)
