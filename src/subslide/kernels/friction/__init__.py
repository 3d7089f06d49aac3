"""Friction of the grains on the bed: Coulomb's law, which every cell obeys, and what other laws add to it.

One law a file. To add one, write its file and name it in `keys.names.LAWS`; its keys are entries of `keys.entries`. A
file has

scaled(point) -> tuple of float
    Return up to MOST scaled numbers of the law, which kernels get as ``s.law_1`` and so on.
remaining(s, dt, h2, speed) -> float
    Return the factor that the law's friction beyond Coulomb's at delta leaves of a velocity in the time ``dt``, where
    grains are ``h2`` deep and have the ``speed``, all scaled; Coulomb's own file has none.
"""

from importlib import import_module

from subslide.kernels.chain import chain
from subslide.kernels.jit import inlined
from subslide.keys.names import LAWS, flags

MOST = 3
"""Numbers that a law may have."""

FLAGS = flags(LAWS)
COULOMB = FLAGS["coulomb"]
MODULES = {name: import_module(f"{__name__}.{name}") for name in LAWS}

_remaining = chain({flag: MODULES[name].remaining for name, flag in FLAGS.items() if flag != COULOMB})


@inlined
def remaining(s, dt, h2, speed):
    """Return the factor that the chosen law's friction beyond Coulomb's leaves of a velocity in the time dt."""
    return _remaining(s.law, s, dt, h2, speed)


def numbers(point):
    """Return the MOST scaled numbers of a point's friction law, 0 for those it does not have."""
    given = MODULES[point.friction].scaled(point)
    return (*given, *(0.0,) * (MOST - len(given)))
