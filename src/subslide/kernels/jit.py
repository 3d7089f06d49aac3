"""How kernels are compiled.

Without fast-math: every operation then rounds as IEEE 754 says, so that mirrored states give mirrored bits, on any
processor, and no check for values that are not finite is deleted. The loops vectorise all the same.
"""

import numpy as np
from numba import njit

from subslide.kernels.cache import kept

inlined = njit(error_model="numpy", forceinline=True, _nrt=False)
"""For functions of scalars or rows: inlined into the loop that calls them, so that the loop vectorises.

Nothing is allocated inside kernels (numba refuses it without its run-time), so arrays that named groups carry need no
counting of references: at 200 cells that was a tenth of a step.
"""


def plain(function):
    """Return a kernel function as Python: compiling one for a few calls takes as long as a study's plan."""
    return getattr(function, "py_func", function)


WIDEST = (1 << 30) - 1
"""Cells of a row, at most."""


@inlined
def part(start, stop):
    """Return the first of a row's entries start..stop-1 and how many they are; start is not negative.

    Loops over a part of a row run over range(count) and add `first`, the smallest of the indices they need: by the
    masks LLVM sees that none is negative (numba counts such an index from the end) nor overflows, without which it
    gathers each entry on its own, at half the speed.
    """
    return max(0, start) & WIDEST, max(0, stop - start) & WIDEST


@inlined
def unsigned(i):
    """Return an index as one that cannot count from the end, for loops where `part` does not convince LLVM."""
    return np.uint64(i)


summed = njit(error_model="numpy", forceinline=True, _nrt=False, fastmath={"reassoc", "nsz"})
"""For sums over a row, which vectorise only in another order (fixed by the vector's width, not by the threads)."""

maximum = njit(error_model="numpy", forceinline=True, _nrt=False, fastmath={"nnan", "nsz", "reassoc"})
"""For maxima over a row, which vectorise only so; what is not finite is caught by the sums (see `budget`)."""

launch = kept(njit(error_model="numpy", parallel=True, nogil=True))
"""For entry points: `prange` tells LLVM that array arguments do not alias, without which no long loop here vectorises.

Its body may only call: a field or an entry of a tuple taken there counts as an alias of it, and the promise is dropped.
"""

driver = kept(njit(error_model="numpy", nogil=True))
"""For time loops that call launches. Without the lock of the interpreter, so that other threads see to signals."""
