"""Riemann solvers as polynomials of the Roe matrix (PVM methods, Castro and Fernandez-Nieto 2012).

Q = alpha0 Id + alpha1 A + alpha2 A^2 (Eq. 9), so a solver is a function from wave speeds to three numbers, in a file
of its own. To add one, write its file and name it in `keys.names.SCHEMES`. A file has

alpha(waves, dry) -> tuple of float
    Return (alpha0, alpha1, alpha2) for the speeds `waves.Waves` of an edge; ``dry``: whether a layer is dry on either
    side.

and, only where the solver needs them,

cubic(waves) -> tuple of float
    Return alpha0..3 of a polynomial with a fourth coefficient, which rules where no side is dry.
EXACT_FRONT : bool
    Whether grains may run onto a dry bed with the exact flux of a front.
"""

from importlib import import_module

from subslide.kernels.arrays import is_general
from subslide.kernels.chain import chain
from subslide.kernels.jit import inlined
from subslide.kernels.viscosity.hll import alpha as hll  # noqa: F401 - for edges whose speeds are complex
from subslide.kernels.viscosity.hll import line
from subslide.kernels.viscosity.rusanov import largest
from subslide.keys.names import LEAN, SCHEMES, flags

FLAGS = flags(SCHEMES)
RUSANOV, IFCP = FLAGS["rusanov"], FLAGS["ifcp"]
MODULES = {name: import_module(f"{__name__}.{name}") for name in SCHEMES}

CUBIC = tuple(FLAGS[name] for name, module in MODULES.items() if hasattr(module, "cubic"))

_alpha = chain({FLAGS[name]: module.alpha for name, module in MODULES.items()})
_lean_alpha = chain({FLAGS[name]: MODULES[name].alpha for name, known in SCHEMES.items() if known is LEAN})
cubic = chain({flag: MODULES[name].cubic for name, flag in FLAGS.items() if flag in CUBIC})
"""Function of (scheme, waves) that returns alpha0..3 of a solver that has them."""


@inlined
def alpha(s, waves, dry):
    """Return alpha0..2 of the chosen solver."""
    if is_general(s):
        return _alpha(s.scheme, waves, dry)
    return _lean_alpha(s.scheme, waves, dry)


@inlined
def is_cubic(scheme):
    """Return whether a solver's polynomial has a fourth coefficient."""
    return scheme in CUBIC


@inlined
def two_wave(scheme, s_l, s_r):
    """Return alpha0 and alpha1 for a layer alone, whose two waves leave nothing in between: HLL, or Rusanov."""
    if scheme == RUSANOV:
        return largest(s_l, s_r), type(s_l)(0)
    return line(s_l, s_r)


def takes_exact_front(name):
    """Return whether a solver lets grains run onto a dry bed with the exact flux of a front, by its EXACT_FRONT."""
    return getattr(MODULES[name], "EXACT_FRONT", False)
